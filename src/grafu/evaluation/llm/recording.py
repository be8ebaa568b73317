"""Replies kept in a folder by what was asked: the same request is answered from there, without any network.

A file holds the request and the reply, and nothing of where it was sent. Long instructions, which many requests begin
with, stand once in a file of their own. Replies that are of no use are kept, too: they were given, and cost as much.
"""

import json
import os
from collections.abc import Callable
from contextlib import closing
from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from time import perf_counter, sleep
from typing import Any, Final

from pydantic import TypeAdapter, ValidationError

from grafu.asset.json_files import read_own_json
from grafu.errors import AssetError, ExportError
from grafu.evaluation.llm.chat import ChatRequest, Message, Reply
from grafu.evaluation.llm.config import LanguageModel
from grafu.evaluation.llm.endpoint import Endpoint, NoReply, endpoint_of
from grafu.export.whole_file import write_whole

SCHEMA: Final = "grafu.reply/1"
Ask = Callable[[tuple[Message, ...]], Reply]


class Unanswered(Exception):
    """A request that got no reply however often it was sent, and how often and how long that was."""

    def __init__(self, why: str, requests: int) -> None:
        super().__init__(why)
        self.requests = requests


def replies_of(model: LanguageModel, open_endpoint: Callable[[], Endpoint] = endpoint_of) -> Ask:
    """Returns how to get the reply of a model to messages: the recorded one, or else a new one, which is recorded.

    What is returned raises NotRun where there is neither a record nor an endpoint, Unanswered where no reply comes,
    and ExportError where it cannot be recorded.
    """

    def ask(messages: tuple[Message, ...]) -> Reply:
        request = ChatRequest(model.name, messages, model.config.max_tokens, model.config.temperature)
        file = model.replies / f"{request.key}.json"
        known = _recorded(file)
        if known is not None:
            return known
        with closing(open_endpoint()) as endpoint:
            _require_room(model.replies)
            reply = _sent(request, endpoint, model)
        _record(file, request, reply)
        return reply

    return ask


def _require_room(folder: Path) -> None:
    """Refuses a folder that cannot be written to, before a reply costs anything."""
    above = next(place for place in (folder, *folder.absolute().parents) if place.exists())
    if not above.is_dir() or not os.access(above, os.W_OK):
        raise ExportError(f"replies cannot be kept in `{folder}`: choose another --replies")


def _sent(request: ChatRequest, endpoint: Endpoint, model: LanguageModel) -> Reply:
    config, started = model.config, perf_counter()
    for number in range(1, config.attempts + 1):
        try:
            reply = endpoint.send(request, config.timeout)
        except NoReply as failure:
            if number == config.attempts or not failure.again:
                times = "once" if number == 1 else f"{number} times"
                raise Unanswered(f"{failure}; asked {times}", number) from None
            sleep(config.pause * 2 ** (number - 1))
        else:
            return Reply(reply.text, reply.tokens_in, reply.tokens_out, round(perf_counter() - started, 3), number)
    raise AssertionError("the last attempt returns or raises")


def _recorded(file: Path) -> Reply | None:
    """Returns the reply in a file; None where there is no file, or it is damaged: it is asked for again then."""
    if not file.is_file():
        return None
    try:
        held = read_own_json(file, f"a reply of the form {SCHEMA}")
        adapter: Any = TypeAdapter(Reply)
        return adapter.validate_python(held["reply"]) if held["schema"] == SCHEMA else None
    except (AssetError, ValidationError, KeyError, TypeError):
        return None


def _record(file: Path, request: ChatRequest, reply: Reply) -> None:
    """Keeps a reply.

    Raises:
        ExportError: if it cannot be written.
    """
    said = [
        {"role": message.role, "has_picture": bool(message.picture)} | _text_of(message, file.parent)
        for message in request.messages
    ]
    record = {"schema": SCHEMA, "model": request.model, **request.options, "messages": said, "reply": asdict(reply)}
    write_whole(json.dumps(record, indent=1) + "\n", file)


def _text_of(message: Message, folder: Path) -> dict[str, str]:
    if message.role != "system":
        return {"text": message.text}
    name = f"instructions-{sha256(message.text.encode()).hexdigest()[:16]}.txt"
    if not (folder / name).is_file():
        write_whole(message.text, folder / name)
    return {"text_in": name}
