"""Single doors with a bar across nearly all of their width: they drop or lift away from it, and open to no side.

Doors of ovens and dishwashers, and flaps of wall units, are pulled by such bars; a bar on a single side-hung door is
upright, or short and near its free edge.
"""

from collections.abc import Collection
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of such a door: its handle tells."""
_UP = 2


@final
@dataclass(frozen=True)
class WideBarConfig:
    """What counts as a bar across a door; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("out",)
    alone: float = 0.8
    """Least width of the door (fraction of the piece's): doors side by side may have such bars, and be side-hung."""
    wide: float = 0.5
    """Least width of the bar (fraction of the door's)."""
    slim: float = 0.2
    """Greatest height of the bar (fraction of its width)."""
    out: float = 0.02
    """How far it stands out of the door at least (metres): a profile on an edge is on side-hung doors, too."""
    edge: float = 0.3
    """It lies in this upper or lower part of the door (fraction of its height)."""
    upright: float = 0.9
    """From this cosine on to the vertical an axis is upright."""

    def __post_init__(self) -> None:
        require_positive(self, "out")
        require_ratios(self, "alone", "wide", "slim", "edge", "upright")


def with_wide_bars(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: WideBarConfig = WideBarConfig()
) -> RealizationPlan:
    """Returns the plan in which predicted side-hung doors with a bar across turn about the border away from the bar.

    `settled` are the parts whose motions the user states.
    """
    config = at_scale(config, metre_on(asset.extent))
    joints = tuple(r if r.moving in settled else _turned(r, asset, config) for r in plan.joints)
    return replace(plan, joints=joints)


def _turned(request: JointRequest, asset: Asset, config: WideBarConfig) -> JointRequest:
    is_upright = abs(float(request.axis.direction[_UP])) >= config.upright
    if not (request.kind.turns and is_upright) or request.parent or request.coupling is not None:
        return request
    door = asset.part(request.moving)
    if float(door.box.size[:_UP].max()) < config.alone * float(asset.box.size[int(np.argmax(door.box.size[:_UP]))]):
        return request
    sides = {_side(part.box, door, config) for part in asset.parts if _is_handle(part, request)} - {None}
    if len(sides) != 1:
        return request
    choice = MotionChoice(Moves.TURNS, sides.pop())
    return replace(request, axis=axis_of_motion(door, choice, asset.box), source=SOURCE)


def _is_handle(part: Part, request: JointRequest) -> bool:
    """Whether a part is a handle of the door: so is what has no label and was predicted to be attached to it."""
    is_attached = part.id in request.attached
    if part.label is PartLabel.UNKNOWN:
        return is_attached
    return part.label is PartLabel.HANDLE and (is_attached or part.carried_by == request.moving)


def _side(bar: Box, door: Part, config: WideBarConfig) -> Side | None:
    """Returns the border that a door turns about whose bar this is, None where it is none."""
    thin = door.box.thin_axis
    if thin == _UP:
        return None
    across = 1 - thin
    height, width = float(bar.size[_UP]), float(bar.size[across])
    out = max(float(door.box.low[thin] - bar.low[thin]), float(bar.high[thin] - door.box.high[thin]))
    if width < config.wide * door.box.size[across] or height > config.slim * width or out < config.out:
        return None
    level = float(bar.center[_UP] - door.box.low[_UP]) / float(door.box.size[_UP])
    if level >= 1.0 - config.edge:
        return Side.BOTTOM
    return Side.TOP if level <= config.edge else None
