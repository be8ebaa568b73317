"""Without names, a small front with buttons or dials beside the door of an appliance is its control panel, and stays.

Microwaves have it beside the door, dishwashers above it. A drawer above a door has one or two knobs side by side.
"""

from typing import Final, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.completion.static_guesses import guessed_to_move, taken_for, with_static
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.components import connected_parts
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.graph.completion import GraphCompletion
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_LEVEL: Final = 0
_DEPTH: Final = 1
_UP: Final = 2
_ACROSS: Final = [_LEVEL, _UP]


@final
@dataclass(frozen=True, slots=True)
class ControlPanelConfig:
    """What is a control panel without names.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    smaller: float = 0.6
    """Greatest area of the panel, seen from the front (fraction of that of the door beside it)."""
    aligned: float = 0.08
    """How far their sides, their front faces and the gap between them are off at most (fraction of the longest side of
    the door)."""
    small: float = 0.4
    """Greatest side of a button or dial (fraction of the panel's shorter one) ..."""
    alike: float = 0.25
    """... and how much its sides differ from those of the others (fraction)."""
    buttons: int = 3
    """So many of these alike tell ..."""
    apart: float = 0.2
    """... or two dials, one above the other by this (fraction of the height of a panel that is higher than wide)."""
    fronts: int = 3
    """An appliance has so many doors and drawers at most, the panel counted in: chests of drawers have more."""
    shells: int = 200
    """Of what has more shells than this none is looked at: a relief is no row of buttons."""

    def __post_init__(self) -> None:
        require_ratios(self, "smaller", "aligned", "small", "alike", "apart")
        require_positive(self, "buttons", "fronts", "shells")


def with_panels_of_controls(
    completion: GraphCompletion, asset: Asset, config: ControlPanelConfig = ControlPanelConfig()
) -> GraphCompletion:
    """Returns the completion in which fronts stay that are only guessed to move, and have controls beside a door."""
    graph = completion.completed
    guesses = guessed_to_move(completion)
    fronts = [node for node in graph.nodes if node.label.is_movable and node.box.thin_axis == _DEPTH]
    if not guesses or not 1 < len(fronts) <= config.fronts:
        return completion
    doors = [node for node in fronts if node.label is PartLabel.DOOR]
    found = []
    for guess in guesses:
        panel = graph.node(guess.part)
        beside = (d.id for d in doors if d.id != panel.id and _is_beside(panel.box, d.box, config))
        door = next(beside, "") if panel in fronts else ""
        if door and _has_controls(asset.part(panel.id), asset, config):
            why = f"{taken_for(guess)}, but it has buttons or dials, beside {door}: it is a panel"
            found.append(Refusal(panel.id, Reason.UNLIKELY, why))
    return with_static(completion, found) if found else completion


def _is_beside(panel: Box, door: Box, config: ControlPanelConfig) -> bool:
    """Whether a front continues a larger one to a side, or above or below it, in its plane."""
    off = config.aligned * float(door.size.max())
    is_smaller = float(np.prod(panel.size[_ACROSS])) <= config.smaller * float(np.prod(door.size[_ACROSS]))
    if not is_smaller or abs(float(panel.low[_DEPTH] - door.low[_DEPTH])) > off:
        return False
    for along, across in ((_LEVEL, _UP), (_UP, _LEVEL)):
        gap = max(float(panel.low[along] - door.high[along]), float(door.low[along] - panel.high[along]))
        ends = np.abs([panel.low[across] - door.low[across], panel.high[across] - door.high[across]])
        if abs(gap) <= off and ends.max() <= off:
            return True
    return False


def _has_controls(panel: Part, asset: Asset, config: ControlPanelConfig) -> bool:
    boxes = [box for part in asset.parts if part is not panel for box in _controls(part, panel.box, config)]
    for box in boxes:
        same = [o for o in boxes if np.abs(o.size - box.size).max() <= config.alike * float(box.size.max())]
        if len(same) >= config.buttons:
            return True
        heights = [float(o.center[_UP]) for o in same]
        is_high = panel.box.size[_UP] > panel.box.size[_LEVEL]
        if is_high and len(same) > 1 and max(heights) - min(heights) >= config.apart * float(panel.box.size[_UP]):
            return True
    return False


def _controls(part: Part, panel: Box, config: ControlPanelConfig) -> list[Box]:
    """Returns the boxes of the small shells of a part that lie before a panel, within its outline."""
    box, most = part.box, config.small * float(panel.size[_ACROSS].min())
    is_on = all(panel.low[k] <= box.center[k] <= panel.high[k] for k in _ACROSS)
    if not is_on or box.low[_DEPTH] >= panel.low[_DEPTH] or box.high[_DEPTH] < panel.low[_DEPTH] - most:
        return []
    shells = [shell.box for shell in connected_parts(part.mesh)]
    return [] if len(shells) > config.shells else [b for b in shells if b.size[_ACROSS].max() <= most]
