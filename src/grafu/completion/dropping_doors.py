"""Doors of ovens and dishwashers drop: they hang on their lower border, unless a handle may show another one.

Names tell which these are. It builds nothing.
"""

from typing import final

from grafu.asset.appliance_names import is_drop_down, is_dropping_door
from grafu.asset.part import Asset
from grafu.completion.level_bars import are_level_bars
from grafu.completion.rehang import hung_on, stands_on_a_level_border
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge
from grafu.graph.functional_graph import FunctionalGraph, PartNode
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
    """Height over width at most: the tall door of a cooker that stands alone may hang on a side."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_dropping_doors(
    completion: GraphCompletion, asset: Asset, config: DroppingDoorConfig = DroppingDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which doors that are called an oven's or a dishwasher's drop.

    Those with a handle stay as they are predicted; what is called an oven's door itself, and not as the whole oven,
    drops with a level bar in its middle, too.
    """
    named = {part.id for part in asset.parts if part.labelled_by == "name" and is_drop_down(part.source.name)}
    graph, given = completion.completed, {part.id for part in asset.parts}
    handles: dict[str, list[Box]] = {}
    for edge in graph.attachments:
        if edge.child in given and _is_handle(graph.node(edge.child)):
            handles.setdefault(edge.parent, []).append(graph.node(edge.child).box)
    doors = {part.id for part in asset.parts if is_dropping_door(part.source.name)}
    held = {name for name, of in handles.items() if name not in doors or not are_level_bars(of, graph.node(name).box)}
    found = {}
    for hinge in graph.hinges:
        box = graph.node(hinge.child).box
        if hinge.child in named - held and hinge.coupling is None and _may_drop(hinge, box, graph, config):
            lower = face_to_border(box.thin_axis, signed_axis(_UP, positive=False))
            found[hinge.child] = lower
    return hung_on(completion, found)


def _is_handle(node: PartNode) -> bool:
    return node.label is PartLabel.HANDLE


def _may_drop(hinge: Hinge, box: Box, graph: FunctionalGraph, config: DroppingDoorConfig) -> bool:
    """Whether an upright door hangs on a side, and is not tall."""
    if box.thin_axis == _UP or stands_on_a_level_border(hinge, graph):
        return False
    level = level_axis(box.thin_axis)
    return float(box.size[_UP]) <= config.high * float(box.size[level])
