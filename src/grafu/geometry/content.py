"""What a value is made of, as one short key: equal content gives equal keys, whoever made it and when.

It knows arrays, plain data and dataclasses; of anything else (a function, an open network) only which one it is.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from hashlib import blake2b
from typing import Any
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
