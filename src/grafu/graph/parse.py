"""Asset to contact-only functional graph: which parts touch. It guesses no motion and changes no label.

The paper asks only whether two boxes come within 0.005 of a unit cube (official.md 2.2); L-shaped and round parts then
touch things that they only surround. Here the boxes choose the pairs and the distance of the meshes decides
(`grafu.graph.touching`).
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.box import Box
from grafu.geometry.budget import require_room
from grafu.geometry.sampling import PointCloud, sample_surfaces
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.touching import counters, touching_pairs


@final
@dataclass(frozen=True, slots=True)
class ParsingConfig:
    """How contacts are found. Tolerances are fractions of the object's largest side (the paper's unit cube).

    `contact` is `mesh` (boxes, then the distance of the meshes), `box` (the paper's rule alone) or `none`. `points` is
    the number of surface points kept on each node (the network's; 0: none), drawn with `seed`.

    Raises:
        ValueError: if a number is negative.
    """

    contact: Literal["mesh", "box", "none"] = "mesh"
    box_tolerance: float = 0.005  # the authors' number
    mesh_tolerance: float = 0.005  # the same, so that the meshes only take contacts away
    points: int = 0
    seed: int = 0

    def __post_init__(self) -> None:
        if min(self.box_tolerance, self.mesh_tolerance, self.points) < 0:
            raise ValueError("the tolerances and `points` of a ParsingConfig must not be negative")


_LOOKED_AT = 200  # bytes of a pair that is looked at: its numbers and the corners of two boxes
_JOINED = 800  # bytes of a pair that is found, until it is an edge of a graph


def parse_graph(asset: Asset, config: ParsingConfig = ParsingConfig()) -> FunctionalGraph:
    """Returns the asset's parts as nodes, in order, and a contact between each two that touch."""
    nodes = _nodes(asset.parts, config)
    if config.contact == "none":
        return FunctionalGraph(asset.name, nodes, ())
    pairs = near_pairs([n.box for n in nodes], config.box_tolerance * asset.extent)
    if config.contact == "mesh":
        pairs = touching_pairs([part.mesh for part in asset.parts], pairs, config.mesh_tolerance * asset.extent)
    edges = tuple(Contact(nodes[a].id, nodes[b].id) for a, b in pairs)
    return FunctionalGraph(asset.name, nodes, edges)


def near_pairs(boxes: list[Box], margin: float) -> list[tuple[int, int]]:
    """Returns the index pairs (i < j, in order) of boxes whose gap is at most `margin` metres along every axis.

    Boxes are swept along X, so that time grows with the number of pairs that are near along it, not with all.

    Raises:
        TooComplex: if so many boxes overlap that their pairs do not fit into the budget.
    """
    if len(boxes) < 2:
        return []
    low, high = np.array([b.low for b in boxes]), np.array([b.high for b in boxes])
    order = np.argsort(low[:, 0], kind="stable")
    ends = np.searchsorted(low[order, 0], high[order, 0] + margin, side="right")
    counts = np.maximum(ends - np.arange(len(order)) - 1, 0)
    require_room(int(counts.sum()), _LOOKED_AT, f"looking at the neighbours of {len(boxes):,} parts")
    first = np.repeat(np.arange(len(order)), counts)
    second = first + 1 + counters(counts)
    a, b = order[first], order[second]
    near = np.all(np.maximum(low[a] - high[b], low[b] - high[a]) <= margin, axis=1)
    require_room(int(near.sum()), _JOINED, f"the contacts of {len(boxes):,} parts")
    found = np.sort(np.stack([a[near], b[near]], axis=1), axis=1)
    return sorted((int(i), int(j)) for i, j in found)


def _nodes(parts: tuple[Part, ...], config: ParsingConfig) -> tuple[PartNode, ...]:
    clouds: Sequence[PointCloud | None] = [None] * len(parts)
    if config.points:
        clouds = sample_surfaces([part.mesh for part in parts], config.points, config.seed)
    return tuple(PartNode(p.id, p.label, p.box, c, p.source.name) for p, c in zip(parts, clouds, strict=True))
