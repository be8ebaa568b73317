"""Without names, the front below a panel with knobs is the door of an oven: it drops, and the panel is fixed."""

from collections.abc import Iterator
from typing import Final, final

import numpy as np

from grafu.asset.appliance_names import is_dropping_door
from grafu.completion.lone_fronts import as_doors, is_alone
from grafu.completion.static_guesses import taken_for, with_static
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import face_to_border, signed_axis
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_LEVEL: Final = 0
_DEPTH: Final = 1
_UP: Final = 2
_FRONT: Final = 2  # the face that looks to -Y
_KNOBS: Final = 3  # a drawer has one or two, and with a keyhole these are no more than that in most


@final
@dataclass(frozen=True, slots=True)
class OvenDoorConfig:
    """What a panel with knobs above a door is.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    high: float = 0.4
    """Least height of the door (fraction of its width), and greatest height of the panel (of the door's)."""
    aligned: float = 0.05
    """How far their sides and their front faces are apart at most, and how far the panel is above (of the width)."""
    knob: float = 0.2
    """Greatest width of a knob, a button or a display (fraction of the panel's)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_oven_doors(completion: GraphCompletion, config: OvenDoorConfig = OvenDoorConfig()) -> GraphCompletion:
    """Returns the completion in which guessed drawers below panels with knobs drop, and guessed panels are fixed.

    What the input labels stays as it is. Above what is named an oven's door a panel needs no knobs.
    """
    graph = completion.completed
    guesses = {d.part: d for d in completion.decisions if d.question == "label"}
    above = {
        rail: panel
        for rail in graph.rails
        if rail.child in guesses and rail.axis == _FRONT and rail.coupling is None and is_alone(rail.child, graph)
        for panel in _panels(rail.child, graph, _KNOBS, config)
    }
    named = [node.id for node in graph.labelled(PartLabel.DOOR) if is_dropping_door(node.source_name)]
    panels = {*above.values(), *(panel for door in named for panel in _panels(door, graph, 0, config))}
    lower = face_to_border(_DEPTH, signed_axis(_UP, positive=False))
    turned = as_doors(completion, dict.fromkeys(above, lower)) if above else completion
    moving = sorted(panel for panel in panels if panel in guesses and panel in graph.moving)
    return with_static(turned, [_refused(panel, taken_for(guesses[panel])) for panel in moving]) if moving else turned


def _refused(panel: str, taken: str) -> Refusal:
    return Refusal(panel, Reason.UNLIKELY, f"{taken}, but an oven's door is right below: it is a panel")


def _panels(name: str, graph: FunctionalGraph, least: int, config: OvenDoorConfig) -> Iterator[str]:
    """Yields the plates right above a front that have at least so many knobs."""
    front = graph.node(name).box
    if front.size[_UP] < config.high * front.size[_LEVEL]:
        return
    for node in graph.nodes:
        if node.id != name and _is_above(node.box, front, config):
            knobs = [other for other in graph.nodes if _is_on(other.box, node.box, config)]
            if len(knobs) >= least:
                yield node.id


def _is_above(panel: Box, front: Box, config: OvenDoorConfig) -> bool:
    slack = config.aligned * float(front.size[_LEVEL])
    sides = np.abs([panel.low[_LEVEL] - front.low[_LEVEL], panel.high[_LEVEL] - front.high[_LEVEL]])
    is_level = abs(float(panel.low[_DEPTH] - front.low[_DEPTH])) <= slack
    is_next = abs(float(panel.low[_UP] - front.high[_UP])) <= slack
    is_low = panel.size[_UP] <= config.high * front.size[_UP]
    return bool((sides <= slack).all() and is_level and is_next and is_low)


def _is_on(knob: Box, panel: Box, config: OvenDoorConfig) -> bool:
    """Whether something small lies before a panel, within its outline."""
    small = knob.size[_LEVEL] <= config.knob * panel.size[_LEVEL] and knob.size[_UP] <= panel.size[_UP]
    inside = all(panel.low[k] <= knob.center[k] <= panel.high[k] for k in (_LEVEL, _UP))
    return bool(small and inside and knob.low[_DEPTH] < panel.low[_DEPTH] <= knob.high[_DEPTH] + panel.size[_DEPTH])
