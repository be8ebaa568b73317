"""JSON from any source to plain and typed values: no repeated names, no endless nesting, no half characters.

What should be an object, a list or a number is, or one line states that not; NaN is refused for a number.

Files that grafu wrote are read again with the same care: folders of results are passed on. Such a file is read where it
lies in the folder that it is sought in, links followed.
"""

import json
import math
import os
import re
from collections.abc import Callable, Mapping
from dataclasses import field
from pathlib import Path
from typing import Any, Final, final, overload

from grafu.asset.options import Limits
from grafu.asset.regular_files import TooManyBytes, read_regular
from grafu.asset.resources import ModelFiles, reason_of
from grafu.dataclass import dataclass
from grafu.errors import AssetTooLarge, UnreadableAsset

Damaged = Callable[[str], UnreadableAsset]
_EXACT = 2**53  # beyond, whole numbers are not exact in JSON


@final
@dataclass(frozen=True)
class JsonObject:
    """A JSON object of a file, and how to say where it stands.

    A value that is null counts as left out. `where` is the path to it (`meshes[2]`), empty for the root; `damaged`
    makes the error from what is wrong.
    """

    data: Mapping[str, Any]
    where: str = field(compare=False)
    damaged: Damaged = field(compare=False)

    def __contains__(self, key: str) -> bool:
        return self.data.get(key) is not None

    def get(self, key: str) -> Any:
        """Returns a value of any kind, None where it is left out."""
        return self.data.get(key)

    def wrong(self, key: str, expected: str) -> UnreadableAsset:
        """Returns the error for a value of another kind than expected, to be raised."""
        return self.damaged(f"`{self._path(key)}` must be {expected}: got {spelled(self.data.get(key))}")

    def member(self, key: str) -> "JsonObject":
        """Returns the object under a key, an empty one where it is left out.

        Raises:
            UnreadableAsset: if it is something else.
        """
        value = self.data.get(key)
        if value is not None and not isinstance(value, dict):
            raise self.wrong(key, "an object")
        return JsonObject(value or {}, self._path(key), self.damaged)

    def array(self, key: str) -> list[Any]:
        """Returns the list under a key, an empty one where it is left out.

        Raises:
            UnreadableAsset: if it is something else.
        """
        value = self.data.get(key)
        if value is not None and not isinstance(value, list):
            raise self.wrong(key, "a list")
        return value or []

    def objects(self, key: str) -> "list[JsonObject]":
        """Returns the objects in the list under a key.

        Raises:
            UnreadableAsset: if it is something else, or one of them is.
        """
        return [
            object_of(value, f"{self._path(key)}[{index}]", self.damaged) for index, value in enumerate(self.array(key))
        ]

    def text(self, key: str, default: str = "") -> str:
        """Returns the string under a key. Raises UnreadableAsset if it is something else."""
        value = self.data.get(key)
        if value is not None and not isinstance(value, str):
            raise self.wrong(key, "text")
        return default if value is None else value

    @overload
    def whole(self, key: str, default: int, least: int = ...) -> int: ...
    @overload
    def whole(self, key: str, default: None = ..., least: int = ...) -> int | None: ...
    def whole(self, key: str, default: int | None = None, least: int = 0) -> int | None:
        """Returns the whole number under a key, `least` or above. Raises UnreadableAsset if it is something else."""
        value = self.data.get(key)
        if value is None:
            return default
        number = int(value) if isinstance(value, float) and value.is_integer() else value
        if isinstance(number, bool) or not isinstance(number, int) or not least <= number <= _EXACT:
            raise self.wrong(key, f"a whole number from {least}")
        return number

    def number(self, key: str, default: float) -> float:
        """Returns the finite number under a key. Raises UnreadableAsset if it is something else."""
        value = self.data.get(key)
        if value is None:
            return default
        found = finite(value)
        if found is None:
            raise self.wrong(key, "a finite number")
        return found

    @overload
    def numbers(self, key: str, count: int, default: tuple[float, ...]) -> tuple[float, ...]: ...
    @overload
    def numbers(self, key: str, count: int, default: None = ...) -> tuple[float, ...] | None: ...
    def numbers(self, key: str, count: int, default: tuple[float, ...] | None = None) -> tuple[float, ...] | None:
        """Returns so many finite numbers under a key. Raises UnreadableAsset if it is something else."""
        value = self.data.get(key)
        if value is None:
            return default
        found = [finite(v) for v in value] if isinstance(value, list) and len(value) == count else [None]
        if None in found:
            raise self.wrong(key, f"{count} finite numbers")
        return tuple(v for v in found if v is not None)

    def indices(self, key: str) -> list[int]:
        """Returns the list of whole numbers from 0 under a key. Raises UnreadableAsset if it is something else."""
        values = self.array(key)
        if not all(isinstance(v, int) and not isinstance(v, bool) and 0 <= v <= _EXACT for v in values):
            raise self.wrong(key, "a list of whole numbers from 0")
        return values

    def _path(self, key: str) -> str:
        return f"{self.where}.{key}" if self.where else key


def object_of(value: Any, where: str, damaged: Damaged) -> JsonObject:
    """Returns a JSON value that must be an object. Raises UnreadableAsset if it is something else."""
    if not isinstance(value, dict):
        raise damaged(f"{f'`{where}`' if where else 'it'} must be an object: got {spelled(value)}")
    return JsonObject(value, where, damaged)


def finite(value: Any) -> float | None:
    """Returns a JSON number as a float, None where it is no number, or one that no float can hold."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    try:
        number = float(value)
    except OverflowError:
        return None
    return number if math.isfinite(number) else None


def spelled(value: Any) -> str:
    """Returns a JSON value in a few words, for a message."""
    if isinstance(value, dict | list):
        kind = "an object" if isinstance(value, dict) else "a list"
        return f"{kind} of {len(value)}"
    if value is None:
        return "nothing"
    text = repr(value) if not isinstance(value, int) or abs(value) < 10**30 else "a number of many digits"
    return text if len(text) <= 60 else f"{text[:57]}..."


_LIMITS = Limits()
_HALVES = re.compile("[\ud800-\udfff]")
_HALF = re.compile(rb"\\u[dD][89a-fA-F]")  # half of a character, which JSON can spell and no text can hold


def read_json(path: Path, files: ModelFiles, expected: str) -> Any:
    """Returns the values in a JSON file of a model; `expected` states in words what the file should be.

    Raises:
        UnreadableAsset: if it is missing, cannot be read, or is no JSON.
        AssetTooLarge: if it is larger than the limit.
    """
    return parse_json(files.read(path), path, expected, files.limits)


def parse_json(data: bytes, where: object, expected: str, limits: Limits = _LIMITS) -> Any:
    """Returns the values in JSON; `where` names the file, `expected` states in words what it should be.

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


MOST_BYTES: Final = 64 * 2**20
"""Of a report, settings or a manifest; those of a thousand parts have one or two million."""


def read_own(path: Path, expected: str, most: int = MOST_BYTES) -> bytes:
    """Returns the content of a file that grafu wrote; `expected` states in words what it should be.

    Raises:
        UnreadableAsset: if it is missing, cannot be read, is no regular file, or leads out of its folder.
        AssetTooLarge: if it has more than `most` bytes.
    """
    try:
        folder, target = Path(os.path.realpath(path.parent)), Path(os.path.realpath(path))
        if not target.is_relative_to(folder):
            raise UnreadableAsset(f"{path} is a link that leads out of its folder: expected {expected}")
        return read_regular(target, most, folder)
    except TooManyBytes:
        raise AssetTooLarge(f"{path} has more than {most / 2**20:g} MiB: expected {expected}") from None
    except (OSError, ValueError) as error:
        raise UnreadableAsset(f"{path} cannot be read ({reason_of(error)}): expected {expected}") from None


def read_own_json(path: Path, expected: str, most: int = MOST_BYTES) -> Any:
    """Returns the values in a JSON file that grafu wrote.

    Raises:
        UnreadableAsset: if it cannot be read, as by `read_own`, or is no JSON.
        AssetTooLarge: if it has more than `most` bytes, or more values than are read.
    """
    return parse_json(read_own(path, expected, most), path, expected)
