"""What the rules ask of a graph again and again: the static body, its size, who may carry, whose handle is whose."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import final

import numpy as np

from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

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
@dataclass(frozen=True)
class Scene:
    """A graph whose handles are attached, prepared for the rules. Lengths are metres, `unit` the largest side."""

    graph: FunctionalGraph

    @cached_property
    def unit(self) -> float:
        """The object's largest side; never 0, so that shares of it can be formed."""
        return max(float(self.graph.box.size.max()), 1e-9)

    @cached_property
    def supports(self) -> tuple[PartNode, ...]:
        """The parts that may carry a mechanism."""
        return tuple(n for n in self.graph.nodes if n.label.is_support)

    @cached_property
    def body(self) -> Box:
        """The box around the parts that may carry, rails and ornaments left out; else around everything."""
        solid = [n for n in self.supports if n.label is not PartLabel.MISC] or self.supports
        if not solid:
            return self.graph.box
        lows, highs = [n.box.low for n in solid], [n.box.high for n in solid]
        return Box(np.min(lows, axis=0), np.max(highs, axis=0))

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


def overlap_share(a: Box, b: Box, axis: int) -> float:
    """Returns which share of a's extent along an axis b covers, 0..1; a flat extent is covered or not."""
    low, high = max(a.low[axis], b.low[axis]), min(a.high[axis], b.high[axis])
    length = float(a.size[axis])
    if length <= 1e-9:
        return float(high >= low)
    return float(np.clip((high - low) / length, 0.0, 1.0))


def offset_share(box: Box, point: np.ndarray, axis: int) -> float:
    """Returns where a point lies along an axis of a box: -1 and 1 are its ends, 0 its middle."""
    return float((point[axis] - box.center[axis]) / max(float(box.half[axis]), 1e-9))
