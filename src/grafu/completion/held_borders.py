"""A door hangs on a border at which something is that could hold it.

One that stands open far out of its case has two upright borders that look alike: only one of them is near the case.
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.completion.rehang import hung_on
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, HingeBorder
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import border_to_face, face_to_border, signed_axis


@final
@dataclass(frozen=True, slots=True)
class HeldBorderConfig:
    """When a border hangs in the air and the one opposite does not; fractions of the width of the door between them.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    strip: float = 0.1
    """How wide the strip along a border is in which something may hold the door."""
    near: float = 0.05
    """How far from the strip along the border that holds it something is at most ..."""
    far: float = 0.4
    """... and how far from that along the border that does not everything is at least."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_held_borders(completion: GraphCompletion, config: HeldBorderConfig = HeldBorderConfig()) -> GraphCompletion:
    """Returns the completion in which doors hang on the border opposite to one that is far from all other parts."""
    graph = completion.completed
    given = {decision.part for decision in completion.decisions if decision.question == "border"}
    found: dict[str, HingeBorder] = {}
    for hinge in graph.hinges:
        if hinge.coupling is not None or hinge.child not in given:
            continue
        opposite = _held_opposite(hinge, graph, config)
        if opposite is not None:
            found[hinge.child] = opposite
    return hung_on(completion, found)


def _held_opposite(hinge: Hinge, graph: FunctionalGraph, config: HeldBorderConfig) -> HingeBorder | None:
    """Returns the border opposite to that of a hinge where that one alone is near other parts."""
    door = graph.node(hinge.child).box
    axis, side = divmod(border_to_face(door.thin_axis, hinge.border), 2)
    width = float(door.size[axis])
    others = list(_others(hinge.child, graph))
    own, opposite = (_gap(_strip(door, axis, bool(high), config.strip * width), others) for high in (side, 1 - side))
    if own < config.far * width or opposite > config.near * width:
        return None
    return face_to_border(door.thin_axis, signed_axis(axis, positive=not side))


def _others(door: str, graph: FunctionalGraph) -> Iterator[Box]:
    """Yields the boxes of the parts that are not attached to a door, nor have their middle in its box, as panes do."""
    own = {door, *(edge.child for edge in graph.attachments if edge.parent == door)}
    own |= {edge.child for edge in graph.attachments if edge.parent in own}
    box = graph.node(door).box
    for node in graph.nodes:
        is_within = np.all(node.box.center >= box.low) and np.all(node.box.center <= box.high)
        if node.id not in own and not is_within:
            yield node.box


def _strip(door: Box, axis: int, is_high: bool, width: float) -> Box:
    """Returns the part of a box that lies along one of its ends."""
    low, high = np.array(door.low), np.array(door.high)
    if is_high:
        low[axis] = high[axis] - width
    else:
        high[axis] = low[axis] + width
    return Box(low, high)


def _gap(strip: Box, others: list[Box]) -> float:
    return min((strip.gap(other) for other in others), default=np.inf)
