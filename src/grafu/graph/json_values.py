"""Reads typed values out of decoded JSON and states where one is wrong."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from grafu.errors import GraphError

Json = Mapping[str, Any]


def read_object(data: Any, where: str) -> Json:
    """Returns `data` as a JSON object.

    Raises:
        GraphError: if it is something else.
    """
    if not isinstance(data, Mapping):
        raise GraphError(f"{where} must be a JSON object: got {type(data).__name__}")
    return data


def read_list(data: Json, key: str, where: str) -> Sequence[Any]:
    """Returns the list under `key`, empty where the key is absent.

    Raises:
        GraphError: if it is not a list.
    """
    value = data.get(key, [])
    if not isinstance(value, list | tuple):
        raise GraphError(f"`{key}` of {where} must be a list: got {type(value).__name__}")
    return value


def read_text(data: Json, key: str, where: str, default: str | None = None) -> str:
    """Returns the string under `key`, or `default` where the key is absent.

    Raises:
        GraphError: if it is not a string, or absent without a default.
    """
    value = data.get(key, default)
    if not isinstance(value, str):
        raise GraphError(f"`{key}` of {where} must be a string: got {value!r}")
    return value


def read_code(data: Json, key: str, count: int) -> int | None:
    """Returns the integer 0..count-1 under `key`, or None where it is absent, null or -1 (unlabelled).

    Raises:
        GraphError: if it is anything else.
    """
    value = data.get(key)
    if value is None or value == -1:
        return None
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < count:
        raise GraphError(f"`{key}` of an edge must be 0..{count - 1}, or -1 or null for unlabelled: got {value!r}")
    return value


def read_number(data: Json, key: str, where: str, default: float | None = None) -> float:
    """Returns the finite number under `key`, or `default` where the key is absent.

    Raises:
        GraphError: if it is not a finite number, or absent without a default.
    """
    return float(read_vector(data, key, where, (), default))


def read_vector(data: Json, key: str, where: str, shape: tuple[int, ...], default: Any = None) -> np.ndarray:
    """Returns the finite numbers under `key`; -1 in `shape` stands for any length.

    Raises:
        GraphError: if they are absent without a default, not numbers, or of another shape.
    """
    try:
        values = np.array(data.get(key, default), dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        values = np.array(np.nan)
    fits = values.ndim == len(shape) and all(want in (-1, got) for want, got in zip(shape, values.shape, strict=True))
    if not fits or not np.all(np.isfinite(values)):
        raise GraphError(f"`{key}` of {where} must be finite numbers of shape {shape}: got {str(data.get(key))[:80]}")
    return values
