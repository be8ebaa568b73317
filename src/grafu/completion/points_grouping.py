"""Points of parts in groups, many parts at once: spread anchors, and the nearest points of each (PointNet++).

Everything is the same for the same points, and for one part alone as for many. It knows no parts and no labels.
"""

import numpy as np
from jaxtyping import Float, Float32

from grafu.geometry.arrays import Points

# The fractional parts of multiples of these fill the unit cube evenly (Roberts' sequence: the root of x^4 = x + 1).
_SPREAD = 1.0 / 1.2207440846057596 ** np.arange(1, 4)


def group_points(
    clouds: Float32[np.ndarray, "n p 3"], anchors: int, neighbours: int
) -> tuple[Float32[np.ndarray, "n g 3"], Float32[np.ndarray, "n g s 3"]]:
    """Returns for each cloud its anchors, spread farthest apart, and each anchor's nearest points relative to it."""
    if not len(clouds):
        shape = (0, anchors, neighbours, 3)
        return np.zeros((0, anchors, 3), dtype=np.float32), np.zeros(shape, dtype=np.float32)
    rows = np.arange(len(clouds))[:, None]
    centres = clouds[rows, farthest_points(clouds, anchors)]
    nearest = _nearest(clouds, centres, neighbours)
    groups = clouds[rows[:, :, None], nearest] - centres[:, :, None]
    return centres, groups


def farthest_points(clouds: Float32[np.ndarray, "n p 3"], count: int) -> np.ndarray:
    """Returns the places of `count` points of each cloud: the farthest from its mean, then ever the farthest from all.

    A cloud of fewer different points repeats its first ones.
    """
    across = np.ascontiguousarray(clouds.transpose(2, 0, 1))  # one coordinate at a time is twice as fast
    rows = np.arange(len(clouds))
    chosen = np.empty((len(clouds), count), dtype=np.int64)
    away = _squared(across, across.mean(axis=2))
    for k in range(count):
        chosen[:, k] = away.argmax(axis=1)
        from_last = _squared(across, across[:, rows, chosen[:, k]])
        away = from_last if k == 0 else np.minimum(away, from_last)
    return chosen


def box_points(low: Points, high: Points, count: int) -> Float[np.ndarray, "n p 3"]:
    """Returns points spread evenly over the surface of each box, always the same ones."""
    spread = (0.5 + np.arange(1, count + 1)[:, None] * _SPREAD) % 1.0
    size = high - low
    areas = size[:, [1, 2, 0]] * size[:, [2, 0, 1]]  # of the two faces square to each axis
    ends = np.cumsum(areas, axis=1)
    where = spread[None, :, 2] * ends[:, -1:]
    face = (where[:, :, None] >= ends[:, None, :2]).sum(axis=2)
    width = np.maximum(np.take_along_axis(areas, face, axis=1), 1e-300)
    within = (where - np.take_along_axis(ends - areas, face, axis=1)) / width
    rows, columns = np.indices(face.shape)
    shares = np.empty((*face.shape, 3))
    shares[rows, columns, (face + 1) % 3] = spread[None, :, 0]
    shares[rows, columns, (face + 2) % 3] = spread[None, :, 1]
    shares[rows, columns, face] = within >= 0.5
    return low[:, None] + shares * size[:, None]


def resampled(points: Points, count: int) -> Float[np.ndarray, "p 3"]:
    """Returns exactly `count` of the points: evenly picked where there are more, repeated where there are fewer."""
    if len(points) == count:
        return points
    places = np.arange(count) * len(points) // count if len(points) > count else np.arange(count) % len(points)
    return points[places]


def _squared(across: Float32[np.ndarray, "3 n p"], centres: Float32[np.ndarray, "3 n"]) -> Float32[np.ndarray, "n p"]:
    """Returns the squared distance of each point from its cloud's centre."""
    x, y, z = across - centres[:, :, None]
    return x * x + y * y + z * z


def _nearest(clouds: Float32[np.ndarray, "n p 3"], centres: Float32[np.ndarray, "n g 3"], count: int) -> np.ndarray:
    """Returns the places of each centre's nearest points, in no order of theirs."""
    middle = clouds.mean(axis=1, keepdims=True)
    points, around = clouds - middle, centres - middle
    # Up to what is the same for all points of a centre, the squared distance.
    away = (points * points).sum(axis=2)[:, None, :] - 2.0 * (around @ points.transpose(0, 2, 1))
    return np.argpartition(away, count - 1, axis=2)[:, :, :count]
