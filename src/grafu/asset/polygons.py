"""Polygons to triangles that have an area and use every corner, so that neighbours still share their edges.

Modellers leave corners on straight edges: where a board meets the middle of a side, or a front was cut into a grid.
A fan or an ear on such a corner is a triangle without area; dropped later, it would tear the surface open there.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive


@final
@dataclass(frozen=True, slots=True)
class PolygonConfig:
    """When a corner counts as straight, and how large a polygon is clipped corner by corner.

    Raises:
        ValueError: if a number is not above 0.
    """

    straight: float = 1e-4
    """Sine of the turn up to which a corner is straight: a file of six digits moves a corner on a 1 m edge by less."""
    concave: float = 1e-6
    """How far a corner turns back in a concave polygon (cross product of its edges, of the polygon's area squared)."""
    most: int = 256
    """More corners than this are left to a faster method, which drops the straight ones: time grows with the square."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def triangulate(
    positions: np.ndarray, vertex: np.ndarray, starts: np.ndarray, config: PolygonConfig = PolygonConfig()
) -> tuple[np.ndarray, np.ndarray]:
    """Returns triangles as positions in the corner list (m, 3), and the polygon that each comes from (m,).

    Polygons become fans where they are convex, else ears. Those whose corners all lie on a line keep triangles
    without area.

    Args:
        positions: vertices, (n, 3).
        vertex: for each corner its vertex, polygons one after another.
        starts: where each polygon starts in `vertex`, and the end.
        config: the thresholds.
    """
    counts = np.diff(starts)
    triangles, owners = [], []
    for n in np.unique(counts):
        polygons = np.flatnonzero(counts == n)
        if n < 3:
            continue
        corners = starts[polygons][:, None] + np.arange(n)
        made = corners.reshape(-1, 1, 3) if n == 3 else _fans(positions, vertex, corners, config)
        triangles.append(made.reshape(-1, 3))
        owners.append(np.repeat(polygons, n - 2))
    if not triangles:
        return np.zeros((0, 3), np.int64), np.zeros(0, np.int64)
    owner = np.concatenate(owners)
    order = np.argsort(owner, kind="stable")
    return np.concatenate(triangles)[order], owner[order]


def _fans(positions: np.ndarray, vertex: np.ndarray, corners: np.ndarray, config: PolygonConfig) -> np.ndarray:
    """Returns the triangles of polygons of one number of corners, (polygons, corners - 2, 3)."""
    n = corners.shape[1]
    fan = np.array([[0, k, k + 1] for k in range(1, n - 1)])
    points = positions[vertex[corners]]
    after, before = np.roll(points, -1, axis=1) - points, points - np.roll(points, 1, axis=1)
    normal = np.cross(points, np.roll(points, -1, axis=1)).sum(axis=1)
    size = np.linalg.norm(normal, axis=1)
    turns = (np.cross(before, after) * normal[:, None]).sum(axis=2)
    concave = (turns < -config.concave * size[:, None] ** 2).any(axis=1)
    lengths = np.linalg.norm(before, axis=2) * np.linalg.norm(after, axis=2) * size[:, None]
    straight = np.abs(turns) <= config.straight * lengths
    apex = ~(np.roll(straight, -1, axis=1) | np.roll(straight, 1, axis=1))  # a fan from here has no flat triangle
    turned = np.argmax(apex, axis=1)
    made = np.take_along_axis(corners, (turned[:, None] + np.arange(n)) % n, axis=1)[:, fan]
    for row in np.flatnonzero((concave | ~apex.any(axis=1)) & (size > 0)):
        ears = _ears(points[row], normal[row], config)
        if ears is not None:
            made[row] = corners[row][ears]
    return made


def _ears(points: np.ndarray, normal: np.ndarray, config: PolygonConfig) -> np.ndarray | None:
    """Returns triangles of a polygon with its winding, as many as it has corners but two; None where there are none.

    Where corners cannot be kept, triangles at the end repeat one of them.
    """
    import mapbox_earcut  # local: few polygons need it

    drop = int(np.argmax(np.abs(normal)))
    flat = np.delete(points, drop, axis=1)
    flat = flat if (normal[drop] > 0) == (drop != 1) else flat[:, ::-1]  # counterclockwise as seen
    ears = mapbox_earcut.triangulate_float64(np.ascontiguousarray(flat), np.array([len(flat)], np.uint32))
    ears = ears.reshape(-1, 3).astype(np.int64)
    sides = _turns(*(flat[ears[:, k]] for k in range(3)))
    if len(ears) and sides.sum() < 0:
        ears = ears[:, ::-1]
    if len(ears) == len(points) - 2 and _sines(*(flat[ears[:, k]] for k in range(3))).min() > config.straight:
        return ears
    clipped = _clipped(flat, config) if len(flat) <= config.most else None
    if clipped is not None:
        return clipped
    if not 0 < len(ears) <= len(points) - 2:
        return None
    return np.vstack([ears, np.full((len(points) - 2 - len(ears), 3), ears[0, 0])])


def _clipped(flat: np.ndarray, config: PolygonConfig) -> np.ndarray | None:
    """Returns the triangles of a counterclockwise outline that keep its straight corners, or None.

    Each ear is the plumpest whose triangle holds no other corner, not even on the edge that it leaves behind.
    """
    left, made = list(range(len(flat))), []
    while len(left) > 3:
        points = flat[left]
        before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
        sines = _sines(before, points, after)
        plump = np.argsort(-sines, kind="stable")
        ear = next((k for k in plump.tolist() if sines[k] > config.straight and _is_empty(points, k)), None)
        if ear is None:
            return None
        made.append([left[ear - 1], left[ear], left[(ear + 1) % len(left)]])
        del left[ear]
    last = flat[left]
    if _sines(last[None, 0], last[None, 1], last[None, 2])[0] <= config.straight:
        return None
    return np.array([*made, left], np.int64)


def _is_empty(points: np.ndarray, ear: int) -> bool:
    """Whether no other corner lies in the triangle at one or on its border; corners at the same place do not count."""
    a, b, c = points[ear - 1], points[ear], points[(ear + 1) % len(points)]
    slack = -1e-9 * abs(float(_turns(a[None], b[None], c[None])[0]))
    inside = _turns(a[None], b[None], points) >= slack
    inside &= _turns(b[None], c[None], points) >= slack
    inside &= _turns(c[None], a[None], points) >= slack
    corners = np.stack([a, b, c])
    return not (inside & ~(points[:, None] == corners).all(axis=2).any(axis=1)).any()


def _turns(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Returns twice the signed areas of plane triangles."""
    return (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])


def _sines(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Returns how plump plane triangles are: twice the area over the square of the longest side, with its sign."""
    longest = np.max([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    return _turns(a, b, c) / np.maximum(longest, 1e-300)
