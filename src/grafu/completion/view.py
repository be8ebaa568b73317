"""A graph beside its probabilities, and what selecting among parts asks repeatedly."""

from collections.abc import Mapping
from dataclasses import field
from functools import cached_property
from typing import final

import numpy as np

from grafu.completion.decode_config import DecodeConfig
from grafu.completion.probabilities import Probabilities
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Scalars
from grafu.graph.arrays import HINGE
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.shapes import Int64
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class GraphView:
    """A graph whose labels are settled: node k is slot k of the probabilities, and slots beyond the nodes are free.

    Only the nodes of `given` may carry a mechanism: they are there, while what was added may still be left out. Doors
    that are known to be `still` carry none either: nothing carries them.

    `borders` holds what is stated of the four borders of doors where that is not what the probabilities state: of a
    door to which a handle was added, these repeat where the network itself put the handle.
    """

    graph: FunctionalGraph
    probabilities: Probabilities
    given: frozenset[str]
    config: DecodeConfig
    still: frozenset[str] = frozenset()
    borders: Mapping[str, Scalars] = field(default_factory=dict)

    @cached_property
    def place(self) -> dict[str, int]:
        """The slot of each node."""
        return {node.id: k for k, node in enumerate(self.graph.nodes)}

    @cached_property
    def extent(self) -> float:
        """The object's largest side, metres; never 0."""
        return max(float(self.graph.box.size.max()), 1e-9)

    @cached_property
    def supports(self) -> Indices:
        """The slots of the parts that may carry a mechanism."""
        found = [k for k, n in enumerate(self.graph.nodes) if n.label.is_support and n.id in self.given]
        return np.array(found, dtype=np.int64)

    @cached_property
    def moving_bodies(self) -> Indices:
        """The slots of the doors and drawers."""
        return np.array([k for k, n in enumerate(self.graph.nodes) if n.label.is_movable], dtype=np.int64)

    @cached_property
    def low(self) -> np.ndarray:
        """The low corners of all boxes, metres."""
        return np.array([n.box.low for n in self.graph.nodes]).reshape(-1, 3)

    @cached_property
    def high(self) -> np.ndarray:
        """The high corners of all boxes, metres."""
        return np.array([n.box.high for n in self.graph.nodes]).reshape(-1, 3)

    @cached_property
    def held(self) -> Scalars:
        """How likely a hinge joins each slot to a part that may carry it."""
        hinges = self.probabilities.edge[: len(self.graph.nodes), self.supports, HINGE]
        return np.asarray(hinges.max(axis=1, initial=0.0))

    def hinged_doors(self, door: PartNode) -> Indices:
        """Returns the slots of the doors that this one likely hangs on: such are held better themselves."""
        slot = self.place[door.id]
        doors = [
            k for k, n in enumerate(self.graph.nodes) if n.label is PartLabel.DOOR and n.id in self.given - self.still
        ]
        likely = (k for k in doors if self.probabilities.edge[slot, k, HINGE] >= self.config.nested)
        return np.array([k for k in likely if (self.held[k], -k) > (self.held[slot], -slot)], dtype=np.int64)

    def within_reach(self, node: PartNode, slots: Indices) -> Int64[np.ndarray, " near"]:
        """Returns those of the slots whose boxes are near enough to the node's; all of them where none is."""
        near = slots[self.gaps(node, slots) <= self.config.reach * self.extent]
        return near if len(near) else slots

    def gaps(self, node: PartNode, slots: Indices) -> Scalars:
        """Returns the distance of each slot's box from the node's, metres."""
        apart = np.maximum(np.maximum(self.low[slots] - node.box.high, node.box.low - self.high[slots]), 0.0)
        return np.linalg.norm(apart, axis=1)

    def ids(self, slots: Indices) -> tuple[str, ...]:
        """Returns the ids of the nodes in these slots."""
        return tuple(self.graph.nodes[k].id for k in slots.tolist())
