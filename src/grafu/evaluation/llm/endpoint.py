"""Any endpoint that speaks OpenAI's chat completions: one request to it, and the reply or why there is none.

Address and key are those of the `openai` client, from the environment. They are in no message and in no value that is
kept: also where an endpoint repeats them in its reply.
"""

import os
from base64 import b64encode
from collections.abc import Mapping
from dataclasses import field
from importlib.util import find_spec
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final, final

from grafu.dataclass import dataclass
from grafu.errors import NotRun
from grafu.evaluation.llm.chat import ChatRequest, Message, Reply

if TYPE_CHECKING:
    from openai import OpenAI

KEY, ADDRESS = "OPENAI_API_KEY", "OPENAI_BASE_URL"
_NO_KEY: Final = "none"  # the client wants one, also where the endpoint does not
_BUSY: Final = (408, 409, 429)  # HTTP states in which it is worth asking again, beside the server's own errors
_SERVER: Final = 500
_REFUSED: Final = 400
_NO_PICTURES: Final = " (for a model that reads no pictures, state `picture = false` in the file of --llm)"
_HIDDEN: Final = "[removed]"
_LEAST_SECRET: Final = 8  # characters: servers without keys take any short word, which a reply may well hold


class NoReply(Exception):
    """A request to which no reply came; `again` states whether it may be sent again."""

    def __init__(self, why: str, again: bool) -> None:
        super().__init__(why)
        self.again = again


@final
@dataclass(frozen=True)
class Endpoint:
    """Where requests go. It shows neither its address nor its key."""

    client: "OpenAI" = field(repr=False)
    secrets: tuple[str, ...] = field(repr=False)

    def send(self, request: ChatRequest, timeout: float) -> Reply:
        """Returns the reply to one request, which is sent once; it may take `timeout` seconds.

        Raises:
            NoReply: if none comes, or what comes is no reply.
        """
        from openai import APIConnectionError, APIStatusError, APITimeoutError, OpenAIError

        started = perf_counter()
        messages: Any = [_as_sent(message) for message in request.messages]
        try:
            answer: Any = self.client.chat.completions.create(
                model=request.model, messages=messages, timeout=timeout, **request.options
            )
        except APITimeoutError:
            raise NoReply(f"no reply within {timeout:g} s", again=True) from None
        except APIConnectionError:
            raise NoReply(f"the endpoint of {ADDRESS} cannot be reached", again=True) from None
        except APIStatusError as error:
            state, shown = error.status_code, any(message.picture for message in request.messages)
            hint = _NO_PICTURES if state == _REFUSED and shown else ""
            raise NoReply(f"the endpoint answered HTTP {state}{hint}", state in _BUSY or state >= _SERVER) from None
        except (OpenAIError, ValueError) as error:
            raise NoReply(f"the endpoint sent no chat completion ({type(error).__name__})", again=True) from None
        return self._reply(answer, perf_counter() - started)

    def close(self) -> None:
        """Ends the connections."""
        self.client.close()

    def _reply(self, answer: Any, seconds: float) -> Reply:
        try:
            text = answer.choices[0].message.content or ""
        except (AttributeError, IndexError, TypeError):
            raise NoReply("the endpoint sent no chat completion", again=True) from None
        for secret in self.secrets:
            text = text.replace(secret, _HIDDEN)
        usage = getattr(answer, "usage", None)
        tokens = (_count(getattr(usage, name, None)) for name in ("prompt_tokens", "completion_tokens"))
        return Reply(text, next(tokens), next(tokens), round(seconds, 3))


def endpoint_of(environment: Mapping[str, str] = os.environ) -> Endpoint:
    """Returns the endpoint that the environment states.

    Raises:
        NotRun: if it states none, or the client is not installed.
    """
    key, address = environment.get(KEY, ""), environment.get(ADDRESS, "")
    if not (key or address):
        raise NotRun(f"no endpoint is stated: set {KEY}, and {ADDRESS} for another than OpenAI's")
    if find_spec("openai") is None:
        raise NotRun("the `openai` client is not installed: pip install 'grafu[llm]'")
    from openai import OpenAI

    client = OpenAI(api_key=key or _NO_KEY, base_url=address or None, max_retries=0)
    return Endpoint(client, tuple(s for s in (key, address.rstrip("/")) if len(s) >= _LEAST_SECRET))


def _as_sent(message: Message) -> dict[str, Any]:
    if not message.picture:
        return {"role": message.role, "content": message.text}
    picture = f"data:image/png;base64,{b64encode(message.picture).decode()}"
    shown = {"type": "image_url", "image_url": {"url": picture}}
    return {"role": message.role, "content": [{"type": "text", "text": message.text}, shown]}


def _count(value: object) -> int | None:
    return value if isinstance(value, int) and not isinstance(value, bool) and value >= 0 else None
