"""Doors side by side whose level bars are copies of each other, not mirror images, drop or lift.

The doors of a pair are mirror images, and so are the bars on them. Where the bars on doors side by side are a little
off the middle to the same side, they state no side on which a door hangs: they are pulled down or up.
"""

from itertools import combinations
from typing import final

from grafu.asset.part import Asset
from grafu.completion.handle_sides import given_handles
from grafu.completion.level_bars import are_level_bars
from grafu.completion.rehang import hung_on, stands_on_a_level_border
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import HingeBorder
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import face_to_border, level_axis, signed_axis

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class CopiedBarsConfig:
    """Which level bars are copies of each other.

    Raises:
        ValueError: if a number is not above 0.
    """

    off: float = 0.05
    """How far a bar is from the middle of its door at least (fraction of the door's width): of bars in the middle
    nothing tells copies from mirror images."""
    alike: float = 0.02
    """How far places and sizes of bars and doors may differ (fraction of the door's width or height)."""
    apart: float = 0.1
    """How wide the gap between two doors side by side is at most (fraction of the width of one)."""
    edge: float = 0.25
    """How far a bar is from half height at least (fraction of the door's height)."""
    tall: float = 1.25
    """Doors that are higher than this (ratio of height to width) stay as they are predicted."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_copied_bars(
    completion: GraphCompletion, asset: Asset, config: CopiedBarsConfig = CopiedBarsConfig()
) -> GraphCompletion:
    """Returns the completion in which doors side by side with copied level bars turn about the border away from these.

    Doors that drop or lift already, and leaves that fold, stay as they are predicted.
    """
    graph = completion.completed
    given = {part.id for part in asset.parts}
    doors = [
        hinge.child
        for hinge in graph.hinges
        if hinge.child in given and hinge.coupling is None and not stands_on_a_level_border(hinge, graph)
    ]
    bars = {door: bar for door in doors if (bar := _bar_off_the_middle(door, graph, given, config)) is not None}
    copied: set[str] = set()
    for one, other in combinations(bars, 2):
        if _are_copies((graph.node(one).box, bars[one]), (graph.node(other).box, bars[other]), config):
            copied |= {one, other}
    found: dict[str, HingeBorder] = {}
    for name in copied:
        box = graph.node(name).box
        is_above = float(bars[name].center[_UP]) > float(box.center[_UP])
        found[name] = face_to_border(box.thin_axis, signed_axis(_UP, positive=not is_above))
    return hung_on(completion, found)


def _bar_off_the_middle(door: str, graph: FunctionalGraph, given: set[str], config: CopiedBarsConfig) -> Box | None:
    """Returns the box of the one level bar near the lower or upper edge of an upright door, if it is off the middle."""
    box, handles = graph.node(door).box, given_handles(door, graph, given)
    if len(handles) != 1 or box.thin_axis == _UP or not are_level_bars(handles, box):
        return None
    level = level_axis(box.thin_axis)
    off, up = ((handles[0].center - box.center)[[level, _UP]] / box.size[[level, _UP]]).tolist()
    is_low = bool(box.size[_UP] <= config.tall * box.size[level])
    return handles[0] if is_low and abs(off) >= config.off and abs(up) >= config.edge else None


def _are_copies(one: tuple[Box, Box], other: tuple[Box, Box], config: CopiedBarsConfig) -> bool:
    """Whether two doors, each with its bar, stand side by side, and one with its bar is a copy of the other."""
    (door, bar), (next_door, next_bar) = one, other
    level = level_axis(door.thin_axis)
    if next_door.thin_axis != door.thin_axis:
        return False
    moved = next_door.center - door.center
    near = config.alike * door.size.max()
    gap = abs(float(moved[level])) - float(door.size[level])
    beside = -near <= gap <= config.apart * float(door.size[level])
    return bool(
        beside
        and abs(moved[_UP]) <= near
        and abs(moved[door.thin_axis]) <= near
        and (abs(next_door.size - door.size) <= near).all()
        and (abs(next_bar.center - bar.center - moved) <= near).all()
        and (abs(next_bar.size - bar.size) <= near).all()
    )
