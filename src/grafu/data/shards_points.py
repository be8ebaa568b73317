"""Surface points in four bytes each: a place on a grid of 1625 steps along each side of the part's box.

    code = (x * 1625 + y) * 1625 + z,   x, y, z = 0..1624 from the box's low corner to its high one

1625 is the largest number whose cube fits into 32 bits. The error is at most 1/3248 of the box's side along each axis:
0.3 mm on a board of one metre, where 512 points lie centimetres apart. What lies on a face of the box stays on it.
Coding what was decoded changes nothing.
"""

import numpy as np
from jaxtyping import Float, Int, UInt32

from grafu.errors import GraphError
from grafu.geometry.arrays import Points

STEPS = 1625
LARGEST_ERROR = 1 / (2 * (STEPS - 1))  # of the box's side, along each axis

Boxes = Float[np.ndarray, "parts 2 3"]
Counts = Int[np.ndarray, " parts"]
Codes = UInt32[np.ndarray, " p"]

_OUTSIDE = 1e-3  # of the box's diagonal: so far may a point lie outside (readers and files round), and is laid onto it
_OUTSIDE_METRES = 1e-5


def points_to_codes(points: Points, boxes: Boxes, counts: Counts) -> Codes:
    """Returns the codes of all points; `counts` says how many points belong to each box in turn (low, high; metres).

    Raises:
        GraphError: if a point lies outside its box.
    """
    low, size = _per_point(boxes, counts)
    far = np.maximum(low - points, points - low - size).max(axis=1, initial=-np.inf)
    if np.any(far > _OUTSIDE * np.linalg.norm(size, axis=1) + _OUTSIDE_METRES):
        raise GraphError(f"the points of a node must lie in its box: one lies {far.max():.3g} m outside")
    share = np.divide(points - low, size, out=np.zeros_like(points), where=size > 0)
    grid = np.rint(np.clip(share, 0, 1) * (STEPS - 1)).astype(np.uint32)
    return (grid[:, 0] * STEPS + grid[:, 1]) * STEPS + grid[:, 2]


def codes_to_points(codes: Codes, boxes: Boxes, counts: Counts) -> Points:
    """Returns the points of all codes, metres, in the frame of the boxes (float64)."""
    rest = codes // STEPS
    grid = np.empty((len(codes), 3))
    np.subtract(codes, rest * STEPS, out=grid[:, 2], casting="unsafe")
    np.floor_divide(rest, STEPS, out=grid[:, 0], casting="unsafe")
    np.subtract(rest, (rest // STEPS) * STEPS, out=grid[:, 1], casting="unsafe")
    low, size = boxes[:, 0], boxes[:, 1] - boxes[:, 0]
    if len(counts) and np.all(counts == counts[0]):
        per_box = grid.reshape(len(counts), -1, 3)
        per_box *= size[:, None] / (STEPS - 1)
        per_box += low[:, None]
        return np.minimum(per_box, boxes[:, None, 1]).reshape(-1, 3)
    lows, sizes = _per_point(boxes, counts)
    return np.minimum(lows + grid * (sizes / (STEPS - 1)), lows + sizes)


def _per_point(boxes: Boxes, counts: Counts) -> tuple[Points, Points]:
    """Returns the low corner and the side lengths of each point's box."""
    return np.repeat(boxes[:, 0], counts, axis=0), np.repeat(boxes[:, 1] - boxes[:, 0], counts, axis=0)
