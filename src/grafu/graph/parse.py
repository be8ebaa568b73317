"""Asset to contact-only functional graph: which parts touch. It guesses no motion and changes no label.

The paper asks only whether two boxes come within 0.005 of a unit cube (official.md 2.2); L-shaped and round parts then
touch things that they only surround. Here the boxes choose the pairs and the distance of the meshes decides.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import Indices
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sampling import sample_surface
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph, PartNode

# So many of a part's largest triangles are tried before all of them: on real furniture 50 to 100 are quickest, four
# times as quick as none.
_FEW = 100


@final
@dataclass(frozen=True, slots=True)
class ParsingConfig:
    """How contacts are found. Tolerances are shares of the object's largest side (the paper's unit cube).

    `contact` is `mesh` (boxes, then the distance of the meshes) or `box` (the paper's rule alone). `points` is the
    number of surface points kept on each node (the network's; 0: none), drawn with `seed`.

    Raises:
        ValueError: if a number is negative.
    """

    contact: Literal["mesh", "box"] = "mesh"
    box_tolerance: float = 0.005  # the authors' number
    mesh_tolerance: float = 0.005  # the same, so that the meshes only take contacts away
    points: int = 0
    seed: int = 0

    def __post_init__(self) -> None:
        if min(self.box_tolerance, self.mesh_tolerance, self.points) < 0:
            raise ValueError("the tolerances and `points` of a ParsingConfig must not be negative")


def parse_graph(asset: Asset, config: ParsingConfig = ParsingConfig()) -> FunctionalGraph:
    """Returns the asset's parts as nodes, in order, and a contact between each two that touch."""
    nodes = tuple(_node(part, config) for part in asset.parts)
    pairs = near_pairs([n.box for n in nodes], config.box_tolerance * asset.unit)
    if config.contact == "mesh":
        pairs = _touching_pairs(asset, pairs, config.mesh_tolerance * asset.unit)
    edges = tuple(Contact(nodes[a].id, nodes[b].id) for a, b in pairs)
    return FunctionalGraph(asset.name, nodes, edges)


def near_pairs(boxes: list[Box], margin: float) -> list[tuple[int, int]]:
    """Returns the index pairs (i < j, in order) of boxes whose gap is at most `margin` metres along every axis.

    Boxes are swept along X, so that time grows with the number of pairs that are near along it, not with all.
    """
    if len(boxes) < 2:
        return []
    low, high = np.array([b.low for b in boxes]), np.array([b.high for b in boxes])
    order = np.argsort(low[:, 0], kind="stable")
    ends = np.searchsorted(low[order, 0], high[order, 0] + margin, side="right")
    counts = np.maximum(ends - np.arange(len(order)) - 1, 0)
    first = np.repeat(np.arange(len(order)), counts)
    second = first + 1 + _counters(counts)
    a, b = order[first], order[second]
    near = np.all(np.maximum(low[a] - high[b], low[b] - high[a]) <= margin, axis=1)
    found = np.sort(np.stack([a[near], b[near]], axis=1), axis=1)
    return sorted((int(i), int(j)) for i, j in found)


def _counters(counts: Indices) -> np.ndarray:
    """Returns 0..count-1 for each count, one after the other."""
    starts = np.repeat(np.cumsum(counts) - counts, counts)
    return np.arange(len(starts)) - starts


def _node(part: Part, config: ParsingConfig) -> PartNode:
    points = sample_surface(part.mesh, config.points, config.seed) if config.points else None
    return PartNode(part.id, part.label, part.box, points, part.source.name)


def _touching_pairs(asset: Asset, pairs: list[tuple[int, int]], tolerance: float) -> list[tuple[int, int]]:
    parts = [_Triangles(part.mesh) for part in asset.parts]
    return [(a, b) for a, b in pairs if _touch(parts[a], parts[b], tolerance)]


@final
class _Triangles:
    """A mesh as loose triangles, with what is asked of them for every pair; not a value."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self.box = mesh.box
        largest_first = np.argsort(-mesh.face_areas, kind="stable")
        self.corners = mesh.triangles[largest_first]
        self._low, self._high = self.corners.min(axis=1), self.corners.max(axis=1)

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
