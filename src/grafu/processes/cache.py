"""A cache by content, so that a run that changes little builds little again.

A cached value is what the function would return again: the functions are pure, and the key is the content of everything
that they are given.

The key is what a value is made of: equal content gives equal keys.

It knows arrays, plain data and dataclasses; of anything else (a function, an open network) only which one it is.
"""

from collections import OrderedDict
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from hashlib import blake2b
from typing import Any, TypeVar, final
from weakref import finalize

import numpy as np

_SIZE = 16  # bytes: no two values of a session meet by chance
_known: dict[int, bytes] = {}


def content_key(value: object) -> bytes:
    """Returns the key of a value's content.

    Fields that begin with `_` are left out: they hold what was worked out meanwhile. Values are taken to be frozen; the
    key of one that lives on is worked out once. What is known by which one it is must live as long as its key is used.
    """
    remembers = is_dataclass(value) and type(value).__weakrefoffset__ != 0  # asking for the attribute may raise
    if remembers and id(value) in _known:
        return _known[id(value)]
    key = _digest(value)
    if remembers:
        _known[id(value)] = key
        finalize(value, _known.pop, id(value), None)
    return key


def _digest(value: Any) -> bytes:
    digest = blake2b(type(value).__qualname__.encode() + b"\0", digest_size=_SIZE)
    if isinstance(value, Enum | bool | int | float | complex | str | None):
        digest.update(repr(value).encode("utf-8", "surrogatepass"))
    elif isinstance(value, bytes):
        digest.update(value)
    elif isinstance(value, np.ndarray | np.generic):
        digest.update(f"{value.dtype.str} {value.shape}".encode())
        digest.update(np.ascontiguousarray(value).tobytes())
    elif is_dataclass(value) and not isinstance(value, type):
        for field in fields(value):
            if not field.name.startswith("_"):
                digest.update(content_key(getattr(value, field.name)))
    elif isinstance(value, Mapping):
        for name, item in value.items():  # in order: order is content, too
            digest.update(content_key(name) + content_key(item))
    elif isinstance(value, tuple | list):
        digest.update(b"".join(content_key(item) for item in value))
    elif isinstance(value, set | frozenset):
        digest.update(b"".join(sorted(content_key(item) for item in value)))
    else:
        digest.update(str(id(value)).encode())
    return digest.digest()


T = TypeVar("T")


@final
class Cache:
    """The last `most` values that were asked for; not a value. With `most` 0 nothing is cached, and no key is made.

    `made` counts how often something was made rather than found, by name.
    """

    def __init__(self, most: int) -> None:
        self._most = most
        self._values: OrderedDict[bytes, tuple[Any, tuple[object, ...]]] = OrderedDict()
        self.made: dict[str, int] = {}

    def value(self, name: str, make: Callable[..., T], *given: object) -> T:
        """Returns `make(*given)`: the one that was cached under this name for the same content, else a new one."""
        if not self._most:
            return make(*given)
        key = content_key((name, given))
        if key not in self._values:
            self.count(name)
            self._values[key] = make(*given), given
            while len(self._values) > self._most:
                self._values.popitem(last=False)
        self._values.move_to_end(key)
        found: T = self._values[key][0]
        return found

    def count(self, name: str) -> None:
        """Counts something that was made, whoever keeps it."""
        self.made[name] = self.made.get(name, 0) + 1

    @property
    def keeps(self) -> bool:
        """Whether it keeps anything."""
        return self._most > 0


CACHED_VALUES = 400
"""Values of some ten changes of a model with twenty joints. Most are scenes that share their meshes."""
NO_CACHE = Cache(0)
"""Makes everything anew."""
