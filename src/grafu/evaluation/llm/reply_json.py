"""The one JSON object that a reply holds, whatever stands around it: sentences, fences of code, other braces."""

import json
from typing import Any, Final

from pydantic import ValidationError

from grafu.asset.json_files import parse_json, spelled
from grafu.errors import AssetError, ReplyError

_MOST_BYTES: Final = 4 * 2**20
_MOST_STARTS: Final = 400  # braces that are tried as the beginning of the object


def object_in_reply(text: str, key: str) -> dict[str, Any]:
    """Returns the first JSON object in a reply that has this key.

    Raises:
        ReplyError: if there is none, or a value in it is named twice.
    """
    if len(text) > _MOST_BYTES:
        raise ReplyError(f"a reply must have at most {_MOST_BYTES:,} characters: got {len(text):,}")
    decoder, start = json.JSONDecoder(), text.find("{")
    for _ in range(_MOST_STARTS):
        if start < 0:
            break
        try:
            found, end = decoder.raw_decode(text, start)
        except (ValueError, RecursionError):
            start = text.find("{", start + 1)
            continue
        if key in found:
            return _strict(text[start:end])
        start = text.find("{", end)
    raise ReplyError(f"a reply must hold one JSON object with `{key}`: got {_kind(text)}")


def first_fault(error: ValidationError) -> str:
    """Returns the first thing that is wrong with the values of a reply, in one line for who wrote it."""
    first = error.errors()[0]
    where = ".".join(str(step) for step in first["loc"])
    return f"`{where}` of the reply is wrong: {first['msg']}"


def _strict(text: str) -> dict[str, Any]:
    try:
        found: dict[str, Any] = parse_json(text.encode(errors="replace"), "the JSON of the reply", "one JSON object")
    except AssetError as error:
        raise ReplyError(str(error)) from None
    return found


def _kind(text: str) -> str:
    if not text.strip():
        return "an empty reply"
    cut_off = text.count("{") > text.count("}")
    return "one that is cut off" if cut_off else f"none in {spelled(text.strip())}"
