"""JSON from anybody to plain values: no names that stand twice, no nesting without end, no half characters.

It knows no formats; `json_shapes` reads typed values out of what it returns, and refuses NaN for a number.
"""

import json
import re
from pathlib import Path
from typing import Any

from grafu.asset.options import Limits
from grafu.asset.resources import ModelFiles
from grafu.errors import UnreadableAsset

_LIMITS = Limits()
_HALVES = re.compile("[\ud800-\udfff]")
_HALF = re.compile(rb"\\u[dD][89a-fA-F]")  # half of a character, which JSON can spell and no text can hold


def read_json(path: Path, files: ModelFiles, expected: str) -> Any:
    """Returns the values in a JSON file of a model; `expected` says in words what the file should be.

    Raises:
        UnreadableAsset: if it is missing, cannot be read, or is no JSON.
        AssetTooLarge: if it is larger than the limit.
    """
    return parse_json(files.read(path), path, expected, files.limits)


def parse_json(data: bytes, where: object, expected: str, limits: Limits = _LIMITS) -> Any:
    """Returns the values in JSON; `where` names the file, `expected` says in words what it should be.

    Raises:
        UnreadableAsset: if it is no JSON, names a value twice, or is nested too deeply.
        AssetTooLarge: if it holds more values than are read.
    """
    limits.require("values", sum(data.count(sign) for sign in (b",", b"[", b"{")), where)
    try:
        values = json.loads(data, object_pairs_hook=_unique)
        if _HALF.search(data):
            values = json.loads(_HALVES.sub("\N{REPLACEMENT CHARACTER}", json.dumps(values, ensure_ascii=False)))
        return values
    except RecursionError:
        raise UnreadableAsset(f"{where} is damaged (JSON nested too deeply): expected {expected}") from None
    except _NotPlain as error:
        raise UnreadableAsset(f"{where} is damaged ({error}): expected {expected}") from None
    except ValueError:
        raise UnreadableAsset(f"{where} is damaged, for it is not JSON: expected {expected}") from None


class _NotPlain(Exception):
    """JSON that no two readers need to understand alike."""


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise _NotPlain("one object names a value twice")
    return found
