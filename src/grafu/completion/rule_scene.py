"""What the rules ask of a graph again and again: the static body, its size, who may carry, whose handle is whose."""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import final

import numpy as np

from grafu.completion.config import RuleConfig
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Scalars
from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

_FLAT = 1e-9  # metres: an extent below this has no length to take fractions of

# How likely a part of this label carries a door's hinge or a drawer's rail, other things equal.
CARRIES: Mapping[PartLabel, float] = {
    PartLabel.SIDE_PANEL: 1.0,
    PartLabel.DIVIDER: 1.0,
    PartLabel.FACE_FRAME: 0.95,
    PartLabel.BAR: 0.85,
    PartLabel.TOP_PANEL: 0.8,
    PartLabel.BOTTOM_PANEL: 0.8,
    PartLabel.UNKNOWN: 0.7,
    PartLabel.BACK_PANEL: 0.6,
    PartLabel.LEG: 0.6,
    PartLabel.SHELF: 0.5,
    PartLabel.MISC: 0.35,
}


@final
class NodeBoxes:
    """The boxes of some nodes as arrays, so that one of them is compared with all at once; not a value."""

    def __init__(self, nodes: Sequence[PartNode]) -> None:
        self.nodes = tuple(nodes)
        self._low = np.array([n.box.low for n in nodes]).reshape(-1, 3)
        self._high = np.array([n.box.high for n in nodes]).reshape(-1, 3)

    def gaps(self, box: Box) -> Scalars:
        """Returns the distance of each box from `box`, metres, 0 where they touch or overlap."""
        apart = np.maximum(np.maximum(self._low - box.high, box.low - self._high), 0.0)
        return np.linalg.norm(apart, axis=1)

    def overlap_ratios(self, box: Box) -> Points:
        """Returns which fraction of `box` along each axis each box covers; a flat extent is covered or not."""
        lengths = np.minimum(self._high, box.high) - np.maximum(self._low, box.low)
        flat = box.size <= _FLAT
        return np.where(flat, lengths >= 0, np.clip(lengths / np.where(flat, 1.0, box.size), 0.0, 1.0))

    def level_with(self, box: Box) -> list[PartNode]:
        """Returns the nodes at the height of a box, in order: those whose extents along Z meet its own."""
        level = (self._low[:, 2] <= box.high[2]) & (self._high[:, 2] >= box.low[2])
        return [self.nodes[k] for k in np.flatnonzero(level).tolist()]

    def offset_ratios(self, box: Box) -> Points:
        """Returns where the middle of each box lies along each axis of `box`: -1 and 1 are its ends."""
        return ((self._low + self._high) / 2 - box.center) / np.maximum(box.half, _FLAT)


@final
@dataclass(frozen=True)
class RuleScene:
    """A graph whose handles are attached, prepared for the rules. Lengths are metres, `extent` the largest side."""

    graph: FunctionalGraph
    config: RuleConfig = RuleConfig()

    @cached_property
    def extent(self) -> float:
        """The object's largest side; never 0, so that fractions of it can be formed."""
        return max(float(self.graph.box.size.max()), 1e-9)

    @cached_property
    def supports(self) -> tuple[PartNode, ...]:
        """The parts that may carry a mechanism."""
        return tuple(n for n in self.graph.nodes if n.label.is_support)

    @cached_property
    def support_boxes(self) -> NodeBoxes:
        """The boxes of the supports."""
        return NodeBoxes(self.supports)

    @cached_property
    def blocker_boxes(self) -> NodeBoxes:
        """The boxes of what a drawer cannot pass through: solid static parts and other drawers."""
        passable = (PartLabel.FACE_FRAME, PartLabel.MISC)
        solid = (n for n in self.graph.nodes if n.label.is_support and n.label not in passable)
        return NodeBoxes([*solid, *self.graph.labelled(PartLabel.DRAWER)])

    @cached_property
    def body(self) -> Box:
        """The box around the parts that may carry, rails and ornaments left out; else around everything."""
        solid = [n for n in self.supports if n.label is not PartLabel.MISC] or self.supports
        if not solid:
            return self.graph.box
        lows, highs = [n.box.low for n in solid], [n.box.high for n in solid]
        return Box(np.min(lows, axis=0), np.max(highs, axis=0))

    @cached_property
    def door_boxes(self) -> NodeBoxes:
        """The boxes of the doors."""
        return NodeBoxes(self.doors)

    @cached_property
    def doors(self) -> tuple[PartNode, ...]:
        """All doors, in order."""
        return self.graph.labelled(PartLabel.DOOR)

    @cached_property
    def _handles(self) -> dict[str, tuple[PartNode, ...]]:
        found: dict[str, list[PartNode]] = {}
        for edge in self.graph.attachments:
            found.setdefault(edge.parent, []).append(self.graph.node(edge.child))
        return {parent: tuple(handles) for parent, handles in found.items()}

    def handles_of(self, node: PartNode) -> tuple[PartNode, ...]:
        """Returns the handles that are attached to a door or drawer."""
        return self._handles.get(node.id, ())

    def touch(self, a: PartNode, b: PartNode) -> bool:
        """Whether an edge of any kind joins the two."""
        return b.id in self.graph.neighbours[a.id]


def overlap_ratio(a: Box, b: Box, axis: int) -> float:
    """Returns which fraction of a's extent along an axis b covers, 0..1; a flat extent is covered or not."""
    shared = float(min(a.high[axis], b.high[axis])) - float(max(a.low[axis], b.low[axis]))
    length = float(a.high[axis]) - float(a.low[axis])
    return float(shared >= 0) if length <= _FLAT else min(max(shared / length, 0.0), 1.0)


def offset_ratio(box: Box, point: np.ndarray, axis: int) -> float:
    """Returns where a point lies along an axis of a box: -1 and 1 are its ends, 0 its middle."""
    return float((point[axis] - box.center[axis]) / max(float(box.half[axis]), _FLAT))
