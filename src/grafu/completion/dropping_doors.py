"""Doors of ovens and dishwashers drop, unless a handle may show another border; those of refrigerators hang on a side.

Names tell which these are, their own or those of the bodies behind them. It builds nothing.
"""

from typing import final

from grafu.asset.appliance_names import is_drop_down, is_drop_down_body, is_dropping_door, is_refrigerator
from grafu.asset.part import Asset
from grafu.completion.appliance_bodies import doors_of_bodies
from grafu.completion.level_bars import are_level_bars
from grafu.completion.rehang import hung_on, hung_on_sides, stands_on_a_level_border
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import PartNode
from grafu.graph.motion import face_to_border, level_axis, signed_axis
from grafu.vocabulary import PartLabel

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class DroppingDoorConfig:
    """Which doors of appliances drop.

    Raises:
        ValueError: if a number is not above 0.
    """

    high: float = 1.5
    """Height over width at most: the tall door of a cooker that stands alone may hang on a side ..."""
    pulled: float = 1.8
    """... and more where it is pulled down: doors of slim dishwashers."""
    wide: float = 0.3
    """What pulls it down is a level bar in the middle of its upper half, so wide at least (fraction of the door's)."""
    low: float = 0.6
    """Height over width at least of the door of a refrigerator: lower ones are flaps of a freezer's compartments."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_dropping_doors(
    completion: GraphCompletion, asset: Asset, config: DroppingDoorConfig = DroppingDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which doors that are called an oven's or a dishwasher's drop, no refrigerator's does.

    Those with a handle stay as they are predicted; what is called an oven's door itself, and not as the whole oven,
    drops with a level bar in its middle, too, and so does the door of what is called an oven where the bar is high.
    """
    named = {part.id for part in asset.parts if part.labelled_by == "name" and is_drop_down(part.source.name)}
    graph, given = completion.completed, {part.id for part in asset.parts}
    handles: dict[str, list[Box]] = {}
    for edge in graph.attachments:
        if edge.child in given and _is_handle(graph.node(edge.child)):
            handles.setdefault(edge.parent, []).append(graph.node(edge.child).box)
    doors = {part.id for part in asset.parts if is_dropping_door(part.source.name)}
    held = {name for name, of in handles.items() if name not in doors or not are_level_bars(of, graph.node(name).box)}
    of_bodies = doors_of_bodies(asset, graph, is_drop_down_body)
    found = {}
    for hinge in graph.hinges:
        door, box = hinge.child, graph.node(hinge.child).box
        if hinge.coupling is not None or box.thin_axis == _UP or stands_on_a_level_border(hinge, graph):
            continue
        is_pulled = door in of_bodies and any(_pulls_down(handle, box, config) for handle in handles.get(door, ()))
        may_drop = _ratio(box) <= (config.pulled if is_pulled else config.high)
        if may_drop and (is_pulled or door in named - held):
            found[door] = face_to_border(box.thin_axis, signed_axis(_UP, positive=False))
    return _with_refrigerators(hung_on(completion, found), asset, config)


def _with_refrigerators(completion: GraphCompletion, asset: Asset, config: DroppingDoorConfig) -> GraphCompletion:
    """Returns the completion in which no door of a refrigerator drops or lifts."""
    graph = completion.completed
    called = {part.id for part in asset.parts if part.labelled_by == "name" and is_refrigerator(part.source.name)}
    doors = called | doors_of_bodies(asset, graph, is_refrigerator)
    return hung_on_sides(completion, lambda door: door in doors and _ratio(graph.node(door).box) >= config.low)


def _is_handle(node: PartNode) -> bool:
    return node.label is PartLabel.HANDLE


def _pulls_down(handle: Box, door: Box, config: DroppingDoorConfig) -> bool:
    """Whether a handle is a level bar in the middle of the upper half of an upright door."""
    level = level_axis(door.thin_axis)
    is_wide = float(handle.size[level]) >= config.wide * float(door.size[level])
    return is_wide and float(handle.center[_UP]) > float(door.center[_UP]) and are_level_bars([handle], door)


def _ratio(box: Box) -> float:
    """Returns the height of an upright door over its width."""
    return float(box.size[_UP]) / max(float(box.size[level_axis(box.thin_axis)]), 1e-12)
