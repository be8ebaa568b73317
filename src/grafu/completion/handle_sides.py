"""Doors hang on the side away from their handle, where the input has one that is clearly off the middle.

A handle beside the hinge would open nothing, and an upright bar at a side is pulled sideways. A level bar in the middle
of the upper or lower edge of a wide front is pulled down or up. It builds nothing.
"""

from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.completion.drawn_grips import grips_in
from grafu.completion.level_bars import are_level_bars
from grafu.completion.rehang import hung_on, stands_on_a_level_border, upright_borders
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, HingeBorder
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import border_to_face, face_to_border, level_axis, signed_axis
from grafu.vocabulary import PartLabel

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class HandleSideConfig:
    """When a handle states on which side a door hangs.

    Raises:
        ValueError: if a number is not above 0.
    """

    off: float = 0.25
    """How far the middle of the handles is from that of the door at least (fraction of the door's width)."""
    within: float = 0.5
    """How far at most: what is farther out is the handle of another door."""
    rim: float = 0.45
    """How far the handles of a lid are from its middle at least, to be at one of its borders (fraction of its side)."""
    upright: float = 1.5
    """A handle this many times as high as it is wide turns a predicted flap into a door that hangs on a side."""
    wide: float = 2.0
    """No door that is wider than this (ratio of width to height) is turned so."""

    flap: float = 1.35
    """A level bar in the middle turns a door this much wider than high about its lower or upper border. Of 21 real
    doors with such a bar that are narrower, 13 hang on a side; of four that are wider none does."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_handle_sides(
    completion: GraphCompletion, asset: Asset, config: HandleSideConfig = HandleSideConfig()
) -> GraphCompletion:
    """Returns the completion in which doors with a handle off the middle hang on the side away from it.

    That are doors that would hang on the handle's side, flaps with an upright handle, and wide fronts with a level bar
    at their upper or lower edge, and lids that would hang on the border at which their handle is. Leaves that fold stay
    as they are predicted. Where a door has no handle, a grip that is drawn in one with it counts.
    """
    given = {part.id for part in asset.parts}
    graph = completion.completed
    found: dict[str, HingeBorder] = {}
    for hinge in graph.hinges:
        if hinge.child not in given or hinge.coupling is not None:
            continue
        is_lid = graph.node(hinge.child).box.thin_axis == _UP
        handles = given_handles(hinge.child, graph, given)
        if not handles and not is_lid:
            handles = grips_in(asset.part(hinge.child).mesh, asset.box)
        side = (_side_of_lid if is_lid else _stated_side)(hinge, graph, handles, config)
        if side is not None and side != hinge.border:
            found[hinge.child] = side
    return hung_on(completion, found)


def given_handles(door: str, graph: FunctionalGraph, given: set[str]) -> list[Box]:
    """Returns the boxes of the handles on a door that the input has (`given`: the ids of its parts)."""
    nodes = (graph.node(edge.child) for edge in graph.attachments if edge.parent == door and edge.child in given)
    return [node.box for node in nodes if node.label is PartLabel.HANDLE]


def _stated_side(
    hinge: Hinge, graph: FunctionalGraph, handles: list[Box], config: HandleSideConfig
) -> HingeBorder | None:
    """Returns the border that the handles of a door state; None where they state none."""
    if not handles:
        return None
    box = graph.node(hinge.child).box
    level = level_axis(box.thin_axis)
    middle = np.mean([handle.center for handle in handles], axis=0) - box.center
    off, up = float(middle[level] / box.size[level]), float(middle[_UP] / box.size[_UP])
    is_wide = box.size[level] >= config.flap * box.size[_UP]
    if is_wide and are_level_bars(handles, box) and config.off <= abs(up) <= config.within:
        return face_to_border(box.thin_axis, signed_axis(_UP, positive=up < 0))
    if not config.off <= abs(off) <= config.within:
        return None
    if stands_on_a_level_border(hinge, graph) and not _opens_sideways(handles, box, level, config):
        return None
    return upright_borders(box.thin_axis)[0 if off > 0 else 1]


def _side_of_lid(
    hinge: Hinge, graph: FunctionalGraph, handles: list[Box], config: HandleSideConfig
) -> HingeBorder | None:
    """Returns the border opposite to that of a lid if its handles are at the latter; else None."""
    box = graph.node(hinge.child).box
    axis, is_high = divmod(border_to_face(box.thin_axis, hinge.border), 2)
    if not handles or box.size[axis] <= 0:
        return None
    middle = float(np.mean([handle.center[axis] for handle in handles]) - box.center[axis]) / float(box.size[axis])
    is_at = config.rim <= (middle if is_high else -middle)
    return face_to_border(box.thin_axis, signed_axis(axis, positive=not is_high)) if is_at else None


def _opens_sideways(handles: list[Box], door: Box, level: int, config: HandleSideConfig) -> bool:
    are_upright = all(handle.size[_UP] >= config.upright * handle.size[level] for handle in handles)
    return bool(are_upright and door.size[level] <= config.wide * door.size[_UP])
