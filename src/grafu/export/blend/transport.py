"""An articulated object as bytes for another process, whose numpy may be older. It does not know Blender.

Values travel as what made them: nothing that was worked out meanwhile goes along, and they check themselves again.
"""

import io
import pickle
from dataclasses import fields, is_dataclass
from typing import Any, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject


def packed(articulated: ArticulatedObject) -> bytes:
    """Returns an object as bytes for `unpacked`."""
    stream = io.BytesIO()
    _Packer(stream, pickle.HIGHEST_PROTOCOL).dump(articulated)
    return stream.getvalue()


def unpacked(data: bytes) -> ArticulatedObject:
    """Returns the object that `packed` was given; bytes of anybody else's must not be given, for they may run code."""
    articulated: ArticulatedObject = pickle.loads(data)
    return articulated


@final
class _Packer(pickle.Pickler):
    def reducer_override(self, value: Any) -> Any:
        if isinstance(value, np.ndarray):
            return _array, (np.ascontiguousarray(value).tobytes(), value.dtype.str, value.shape)
        if is_dataclass(value) and not isinstance(value, type):
            return type(value), tuple(getattr(value, field.name) for field in fields(value) if field.init)
        return NotImplemented


def _array(data: bytes, dtype: str, shape: tuple[int, ...]) -> np.ndarray:
    return np.frombuffer(data, np.dtype(dtype)).reshape(shape)
