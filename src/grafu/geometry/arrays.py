"""Array shapes by name, and the base of every value that holds arrays.

Arrays inside values are copies that cannot be written to; values compare and hash by content.
"""

from collections.abc import Callable, Sequence
from hashlib import blake2b
from typing import Any, ClassVar

import numpy as np

from grafu.shapes import Bool, Float, Int, Integer

Vec3 = Float[np.ndarray, "3"]
Vec2 = Float[np.ndarray, "2"]
Points = Float[np.ndarray, "n 3"]
Faces = Int[np.ndarray, "m 3"]
Mat3 = Float[np.ndarray, "3 3"]
Mat4 = Float[np.ndarray, "4 4"]
Scalars = Float[np.ndarray, " n"]
Indices = Int[np.ndarray, " n"]
Mask = Bool[np.ndarray, " n"]


def frozen_array(values: Any, dtype: type = np.float64) -> Any:
    """Returns a contiguous copy of `values` that cannot be written to (or `values`, where it already is one)."""
    if isinstance(values, np.ndarray) and values.dtype == dtype and not values.flags.writeable and values.base is None:
        return values
    array: np.ndarray = np.array(values, dtype=dtype, order="C", copy=True)
    array.setflags(write=False)
    return array


def freeze_arrays(value: object, *names: str, dtype: type | None = None) -> None:
    """Makes arrays of a frozen value read-only copies of a type (None: each of its own); for its `__post_init__`.

    `names` are the fields; without any, all that hold arrays.
    """
    for name in names or value.__dataclass_fields__:  # type: ignore[attr-defined]
        array = getattr(value, name)
        if names or isinstance(array, np.ndarray):
            object.__setattr__(value, name, frozen_array(array, array.dtype.type if dtype is None else dtype))


def vec3(x: float, y: float, z: float) -> Vec3:
    """Returns one vector of three floats."""
    return np.array([x, y, z], dtype=np.float64)


def median(values: np.ndarray | Sequence[Any]) -> float:
    """Returns the median of at least one number: that of `numpy.median`, which takes ten times as long for a few."""
    rising = np.sort(np.asarray(values, dtype=np.float64), axis=None)
    middle = len(rising) // 2
    if np.isnan(rising[-1]):
        return float("nan")
    return float(rising[middle] if len(rising) % 2 else (rising[middle - 1] + rising[middle]) / 2)


def row_medians(rows: Float[np.ndarray, "n m"]) -> Float[np.ndarray, " _"]:
    """Returns the median of the numbers in each row that has any: `numpy.nanmedian` imports masked arrays for it."""
    count = (~np.isnan(rows)).sum(axis=1)
    rising, count = np.sort(rows[count > 0], axis=1), count[count > 0]  # what is no number comes last
    row = np.arange(len(rising))
    return np.asarray((rising[row, (count - 1) // 2] + rising[row, count // 2]) / 2)


def cross(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Returns the cross products of rows of three: those of `numpy.cross`, which costs three times as much."""
    product = np.empty(np.broadcast_shapes(first.shape, second.shape))
    (x, y, z), (u, v, w) = ((rows[..., 0], rows[..., 1], rows[..., 2]) for rows in (first, second))
    np.subtract(y * w, z * v, out=product[..., 0])
    np.subtract(z * u, x * w, out=product[..., 1])
    np.subtract(x * v, y * u, out=product[..., 2])
    return product


def extremes(rows: Float[np.ndarray, "n k"]) -> tuple[Float[np.ndarray, " k"], Float[np.ndarray, " k"]]:
    """Returns the smallest and the largest of each column of at least one row.

    Of many short rows numpy finds them many times as quickly along columns that lie in one piece.
    """
    columns = np.ascontiguousarray(rows.T)
    return columns.min(axis=1), columns.max(axis=1)


def row_keys(triples: np.ndarray) -> Indices:
    """Returns one 64-bit key for each row of three integers."""
    # odd multipliers of no pattern make two rows of one key practically impossible
    return triples @ np.array([0x1E3779B97F4A7C15, 0x42B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.int64)


_SPARSE = 8  # times as many rows as are named: then to sort the names is quicker


def renumbered(named: Int[np.ndarray, "*_"], count: int) -> tuple[Indices, Int[np.ndarray, "*_"]]:
    """Returns which of `count` rows are named, rising, and the number of each named one among them, shaped as `named`.

    It is `numpy.unique` of whole numbers without sorting.
    """
    if _SPARSE * named.size < count:
        rows, number = np.unique(named, return_inverse=True)
        return rows, number.reshape(named.shape)
    is_named = np.zeros(count, dtype=bool)
    is_named[named] = True
    return np.flatnonzero(is_named), (np.cumsum(is_named) - 1)[named]


def distinct(numbers: np.ndarray) -> np.ndarray:
    """Returns each of some numbers once, in order; all are numbers.

    As `numpy.unique` does, which takes several times as long on few, and imports masked arrays for it.
    """
    ordered = np.sort(numbers, axis=None)
    is_new = np.ones(len(ordered), dtype=np.bool_)
    is_new[1:] = ordered[1:] != ordered[:-1]
    return ordered[is_new]


def without(numbers: Int[np.ndarray, " _"], others: Int[np.ndarray, " _"] | Sequence[int]) -> Int[np.ndarray, " _"]:
    """Returns the numbers that are not among others, in their order."""
    return numbers[~np.isin(numbers, others)]


def counters(counts: Indices) -> Int[np.ndarray, " _"]:
    """Returns 0..count-1 for each count, one after the other."""
    starts = np.repeat(np.cumsum(counts) - counts, counts)
    return np.arange(len(starts)) - starts


def first_of_each(keys: Integer[np.ndarray, " n"]) -> tuple[Int[np.ndarray, " m"], Indices]:
    """Returns where each distinct key comes first, by rising keys, and for each key the number of its like.

    It is what `numpy.unique` gives; of many keys in a third of the time.
    """
    order = np.argsort(keys)
    rising = keys[order]
    is_new = np.append(np.ones(min(1, len(keys)), dtype=bool), rising[1:] != rising[:-1])
    starts, number = np.flatnonzero(is_new), np.empty(len(keys), np.int64)
    number[order] = np.cumsum(is_new) - 1
    return (np.minimum.reduceat(order, starts) if len(starts) else starts), number


class ArrayValue:
    """Abstract base of frozen dataclasses with array fields: equality, hash and pickling by content, a short repr."""

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Any]]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = ArrayValue.__repr__  # type: ignore[method-assign]  # `dataclass` would write its own

    def __repr__(self) -> str:
        fields = zip(self.__dataclass_fields__, self._content(), strict=True)
        return f"{type(self).__name__}({', '.join(f'{name}={_short(value)}' for name, value in fields)})"

    def _content(self) -> tuple[Any, ...]:
        return tuple(getattr(self, name) for name in self.__dataclass_fields__)

    def __eq__(self, other: object) -> bool:
        if other.__class__ is not self.__class__:
            return NotImplemented
        pairs = zip(self._content(), other._content(), strict=True)
        return all(np.array_equal(a, b) if isinstance(a, np.ndarray) else a == b for a, b in pairs)

    def __hash__(self) -> int:
        digest = blake2b(digest_size=8)
        for item in self._content():
            digest.update(item.tobytes() if isinstance(item, np.ndarray) else str(hash(item)).encode())
        return int.from_bytes(digest.digest(), "little", signed=True)

    def __reduce__(self) -> tuple[Callable[..., Any], tuple[Any, ...]]:
        return (self.__class__, self._content())


def _short(value: object) -> str:
    """Returns a value as `repr` does; of a large array its shape and type alone."""
    if isinstance(value, np.ndarray):
        large = value.size > 16
        return f"<{'x'.join(map(str, value.shape))} {value.dtype}>" if large else str(np.round(value, 6).tolist())
    if isinstance(value, tuple | dict) and len(value) > 4:
        return f"<{len(value)} items>"
    return repr(value)
