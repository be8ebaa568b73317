"""Which meshes come within a tolerance: by arithmetic where surfaces are boards, by triangles elsewhere.

Axis-aligned rectangles (two triangles each, as boards are drawn) and loose corners are boxes without thickness, whose
distance is exact. Two of them that are near settle a contact; where both meshes are rectangles and nothing else, none
that are near settles it too.
"""

from collections.abc import Sequence
from functools import cached_property
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Mask, Points, counters, cross
from grafu.geometry.box import Box
from grafu.geometry.budget import require_room, require_time
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, triangle_bounds

Pairs = Sequence[tuple[int, int]]

# So many of a part's largest triangles are tried before all of them: on real furniture 50 to 100 are quickest, four
# times as quick as none.
_FEW = 100
_MOST_FACES = 1000  # a mesh of more is rarely boards, and looking costs more than the triangles' own distance
_MOST_PAIRS = 20_000  # of rectangles and corners between two meshes, likewise
_EXACT = 1e-9  # metres by which a corner may miss its rectangle
_AT_ONCE = 200_000  # pairs that are looked at at once: 200 bytes each, their numbers and the corners of two boxes
_MOST_LOOKED_AT = 100_000  # pairs along X from which on the other axes are tried, too
_FOUND = 32  # bytes of a pair that is found, as two numbers, and once more while batches are put together
_JOINED = 800  # bytes of a pair that is found, until it is an edge of a graph


def near_pairs(boxes: list[Box], margin: float) -> list[tuple[int, int]]:
    """Returns the index pairs (i < j, in order) of boxes whose gap is at most `margin` metres along every axis.

    Boxes are swept along one axis, so that time grows with the number of pairs that are near along it, not with all.

    Raises:
        TooComplex: if so many boxes overlap that their pairs do not fit into the budget.
    """
    if len(boxes) < 2:
        return []
    first, second = near_ends(np.array([b.low for b in boxes]), np.array([b.high for b in boxes]), margin)
    require_room(len(first), _JOINED, f"the contacts of {len(boxes):,} parts")
    low, high = np.minimum(first, second), np.maximum(first, second)
    order = np.lexsort((high, low))
    return list(zip(low[order].tolist(), high[order].tolist(), strict=True))


def near_ends(low: Points, high: Points, margin: float) -> tuple[np.ndarray, np.ndarray]:
    """Returns the indices of the first and of the second box of each such pair, in no order, from the boxes' ends.

    Pairs are looked at in batches: only those that are near take memory.

    Raises:
        TooComplex: if so many boxes overlap that their pairs do not fit into the budget, or time ends.
    """
    order, counts = _swept(low, high, margin, 0)
    if counts.sum() > _MOST_LOOKED_AT:  # a row along Y, or a stack, overlaps along X: another axis parts it
        others = ((order, counts), *(_swept(low, high, margin, axis) for axis in (1, 2)))
        order, counts = min(others, key=lambda found: int(found[1].sum()))
    found, total = [], 0
    for start, end in batches(counts, _AT_ONCE):
        first = np.repeat(np.arange(start, end), counts[start:end])
        second = first + 1 + counters(counts[start:end])
        a, b = order[first], order[second]
        near = np.all(np.maximum(low[a] - high[b], low[b] - high[a]) <= margin, axis=1)
        found.append((a[near], b[near]))
        total += len(found[-1][0])
        require_time()
        require_room(total, _FOUND, f"the neighbours of {len(low):,} parts")
    if len(found) == 1:
        return found[0]
    return np.concatenate([ends[0] for ends in found]), np.concatenate([ends[1] for ends in found])


def batches(counts: Indices, most: int) -> list[tuple[int, int]]:
    """Returns the first and the end of rows of things whose counts add up to `most` at most, or which are one thing.

    There is one row at least, which may be empty.
    """
    before = np.concatenate([[0], np.cumsum(counts)])
    rows, start = [], 0
    while start < len(counts):
        end = max(int(np.searchsorted(before, before[start] + most, side="right")) - 1, start + 1)
        rows.append((start, end))
        start = end
    return rows or [(0, 0)]


def _swept(low: Points, high: Points, margin: float, axis: int) -> tuple[Indices, Indices]:
    """Returns the boxes in the order in which they begin along an axis, and how many begin before each of them ends."""
    order = np.argsort(low[:, axis], kind="stable")
    ends = np.searchsorted(low[order, axis], high[order, axis] + margin, side="right")
    return order, np.maximum(ends - np.arange(len(order)) - 1, 0)


def touching_pairs(meshes: Sequence[TriangleMesh], pairs: Pairs, tolerance: float) -> list[tuple[int, int]]:
    """Returns those of the pairs of meshes whose surfaces come within `tolerance` metres, in order."""
    return TouchingMeshes(meshes, tolerance).among(pairs)


@final
class TouchingMeshes:
    """Meshes, prepared once to be asked again and again which of them come within `tolerance` metres; not a value."""

    def __init__(self, meshes: Sequence[TriangleMesh], tolerance: float) -> None:
        self._meshes, self._tolerance = meshes, tolerance
        self._parts: dict[int, _Triangles] = {}

    @cached_property
    def _flat(self) -> "_Flats":
        return _flats([mesh.triangles for mesh in self._meshes])

    @cached_property
    def _boxes(self) -> list[Box]:
        return [mesh.box for mesh in self._meshes]

    def among(self, pairs: Pairs) -> list[tuple[int, int]]:
        """Returns those of the pairs whose surfaces come so near, in order."""
        if not pairs:
            return []
        found, settled = _near_flats(self._flat, self._boxes, np.array(pairs), self._tolerance)
        return [
            (a, b)
            for (a, b), near, sure in zip(pairs, found.tolist(), settled.tolist(), strict=True)
            if near or (not sure and _touch(self._part(a), self._part(b), self._tolerance))
        ]

    def _part(self, k: int) -> "_Triangles":
        if k not in self._parts:
            self._parts[k] = _Triangles(self._meshes[k])
        return self._parts[k]


@final
@dataclass(frozen=True, eq=False)
class _Flats:
    """Rectangles and loose corners of all but large meshes, those of mesh k from `starts[k]` to `starts[k + 1]`.

    `is_whole` states about each mesh whether it is rectangles and nothing else.
    """

    low: np.ndarray
    high: np.ndarray
    starts: np.ndarray
    is_whole: Mask


def _flats(triangles: list[np.ndarray]) -> _Flats:
    sizes = np.array([len(t) for t in triangles])
    counts = np.where(sizes <= _MOST_FACES, sizes, 0)
    ends = np.cumsum(counts)
    corners = np.concatenate([t[:n] for t, n in zip(triangles, counts.tolist(), strict=True)])
    first = np.concatenate([np.arange(e - n, e - 1, 2) for n, e in zip(counts.tolist(), ends.tolist(), strict=True)])
    is_rectangle, low, high = _rectangles(corners[first], corners[first + 1])
    first = first[is_rectangle]
    is_loose = np.ones(len(corners), dtype=bool)
    is_loose[first] = is_loose[first + 1] = False
    owner = np.repeat(np.arange(len(counts)), counts)
    points = corners[is_loose].reshape(-1, 3)
    of = np.concatenate([owner[first], np.repeat(owner[is_loose], 3)])
    order = np.argsort(of, kind="stable")
    starts = np.searchsorted(of[order], np.arange(len(counts) + 1))
    low, high = np.concatenate([low[is_rectangle], points])[order], np.concatenate([high[is_rectangle], points])[order]
    loose = np.bincount(owner[is_loose], minlength=len(counts))
    return _Flats(low, high, starts, (loose == 0) & (counts == sizes))


def _rectangles(a: np.ndarray, b: np.ndarray) -> tuple[Mask, np.ndarray, np.ndarray]:
    """Returns which pairs of triangles are the halves of an axis-aligned rectangle, and the boxes around all pairs."""
    corners = np.concatenate([a, b], axis=1)
    low, high = corners.min(axis=1), corners.max(axis=1)
    sides = np.sort(high - low, axis=1)
    area = sides[:, 1] * sides[:, 2]
    is_flat = (sides[:, 0] <= _EXACT) & (area > 0)
    at_corner = (np.minimum(corners - low[:, None], high[:, None] - corners) <= _EXACT).all(axis=(1, 2))
    is_opposite = (np.abs(corners.mean(axis=1) - (low + high) / 2) <= _EXACT).all(axis=1)
    halves = [np.linalg.norm(cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]), axis=1) for t in (a, b)]
    is_half = (np.abs(halves[0] - area) <= 1e-6 * area) & (np.abs(halves[1] - area) <= 1e-6 * area)
    return is_flat & at_corner & is_opposite & is_half, low, high


def _near_flats(flats: _Flats, boxes: list[Box], pairs: np.ndarray, tolerance: float) -> tuple[Mask, Mask]:
    """Returns for each pair whether two of its rectangles and corners are near, and whether that settles it."""
    low, high = np.array([b.low for b in boxes]) - tolerance, np.array([b.high for b in boxes]) + tolerance
    rows_a, counts_a = _rows_near(flats, pairs[:, 0], low[pairs[:, 1]], high[pairs[:, 1]])
    rows_b, counts_b = _rows_near(flats, pairs[:, 1], low[pairs[:, 0]], high[pairs[:, 0]])
    few = counts_a * counts_b <= _MOST_PAIRS
    products = np.where(few, counts_a * counts_b, 0)
    of = np.repeat(np.arange(len(pairs)), products)
    step = counters(products)
    a = rows_a[(np.cumsum(counts_a) - counts_a)[of] + step // np.maximum(counts_b, 1)[of]]
    b = rows_b[(np.cumsum(counts_b) - counts_b)[of] + step % np.maximum(counts_b, 1)[of]]
    gaps = np.maximum(np.maximum(flats.low[a] - flats.high[b], flats.low[b] - flats.high[a]), 0.0)
    near = np.zeros(len(pairs), dtype=bool)
    near[of[(gaps**2).sum(axis=1) <= tolerance**2]] = True
    return near, near | (few & flats.is_whole[pairs].all(axis=1))


def _rows_near(flats: _Flats, meshes: Indices, low: np.ndarray, high: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the rows of each of the meshes that meet its box, one mesh after another, and how many they are."""
    counts = flats.starts[meshes + 1] - flats.starts[meshes]
    of = np.repeat(np.arange(len(meshes)), counts)
    rows = flats.starts[meshes][of] + counters(counts)
    near = np.all((flats.low[rows] <= high[of]) & (flats.high[rows] >= low[of]), axis=1)
    return rows[near], np.bincount(of[near], minlength=len(meshes))


@final
class _Triangles:
    """A mesh as loose triangles, with what is asked of them for every pair; not a value."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self.box = mesh.box
        largest_first = np.argsort(-mesh.face_areas, kind="stable")
        self.corners = mesh.triangles[largest_first]
        self._low, self._high = triangle_bounds(self.corners)

    @cached_property
    def whole(self) -> MeshCollider:
        """All triangles, ready for queries."""
        return _collider(self.corners)

    def near(self, box: Box, margin: float) -> np.ndarray:
        """Returns the corners of the triangles that come near a box, the largest triangles first."""
        return self.corners[np.all((self._low <= box.high + margin) & (self._high >= box.low - margin), axis=1)]


def _touch(a: _Triangles, b: _Triangles, tolerance: float) -> bool:
    """Whether two meshes come within `tolerance`.

    Building the trees costs most. Small meshes keep theirs; of large ones only triangles near the other's box are
    looked at, and the largest of these first, because parts mostly touch with their large faces.
    """
    if not (len(a.corners) and len(b.corners)):
        return False
    if max(len(a.corners), len(b.corners)) <= _FEW:
        return a.whole.distance(b.whole) <= tolerance
    near_a, near_b = a.near(b.box, tolerance), b.near(a.box, tolerance)
    if not (len(near_a) and len(near_b)):
        return False
    if max(len(near_a), len(near_b)) > _FEW and _distance(near_a[:_FEW], near_b[:_FEW]) <= tolerance:
        return True
    return _distance(near_a, near_b) <= tolerance


def _distance(a: np.ndarray, b: np.ndarray) -> float:
    return _collider(a).distance(_collider(b))


def _collider(corners: np.ndarray) -> MeshCollider:
    faces = np.arange(3 * len(corners)).reshape(-1, 3)
    return MeshCollider(TriangleMesh(corners.reshape(-1, 3), faces))
