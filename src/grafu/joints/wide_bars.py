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
    tall: float = 1.5
    """Where one of them is higher than this (ratio of height to width) all stay: doors of refrigerators have such bars
    where they meet ..."""
    meets: float = 0.05
    """... with gaps up to this between them (fraction of their width)."""
    upright: float = 0.9
    """From this cosine on to the vertical an axis is upright."""

    def __post_init__(self) -> None:
        require_positive(self, "out", "tall")
        require_ratios(self, "alone", "wide", "slim", "edge", "meets", "upright")


def with_wide_bars(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: WideBarConfig = WideBarConfig()
) -> RealizationPlan:
    """Returns the plan in which predicted side-hung doors with a bar across turn about the border away from the bar.

    High ones do not, nor do any where one is high; what meets that one bar to bar hangs as it does. `settled` are the
    parts whose motions the user states.
    """
    config = at_scale(config, metre_on(asset.extent))
    found = {r.moving: side for r in plan.joints if (side := _pulled_to(r, asset, config)) is not None}
    tall = [r for r in plan.joints if r.moving in found and _is_tall(asset.part(r.moving).box, config)]
    if tall:
        beside = (r if r.moving in settled else _as_above(r, tall[0], asset, config) for r in plan.joints)
        return replace(plan, joints=tuple(beside))
    joints = (_turned(r, found[r.moving], asset) if r.moving in found.keys() - set(settled) else r for r in plan.joints)
    return replace(plan, joints=tuple(joints))


def _as_above(request: JointRequest, tall: JointRequest, asset: Asset, config: WideBarConfig) -> JointRequest:
    """Returns the request of a door that drops or lifts on the side on which a high one hangs that it meets.

    It is right below or above that, as wide, and both have their bars where they meet.
    """
    door, high = asset.part(request.moving), asset.part(tall.moving)
    is_level = abs(float(request.axis.direction[_UP])) < config.upright
    if not request.kind.turns or not is_level or door.box.thin_axis != high.box.thin_axis or request.parent:
        return request
    across = 1 - high.box.thin_axis
    off = config.meets * float(high.box.size[across])
    ends = np.abs([door.box.low[across] - high.box.low[across], door.box.high[across] - high.box.high[across]])
    above, below = (high, door) if high.box.center[_UP] > door.box.center[_UP] else (door, high)
    gap = abs(float(above.box.low[_UP] - below.box.high[_UP]))
    sides = {
        part.id: {_side(p.box, part, config) for p in asset.parts if _is_handle(p, r)} - {None}
        for part, r in ((door, request), (high, tall))
    }
    meet = sides[above.id] == {Side.TOP} and sides[below.id] == {Side.BOTTOM}
    if max(*ends, gap) > off or not meet:
        return request
    axis = tall.axis
    place = np.array([axis.point[0], axis.point[1], door.box.center[_UP]])
    return replace(request, axis=replace(axis, point=place), source=SOURCE)


def _is_tall(door: Box, config: WideBarConfig) -> bool:
    return float(door.size[_UP]) >= config.tall * float(door.size[1 - door.thin_axis])


def _turned(request: JointRequest, side: Side, asset: Asset) -> JointRequest:
    choice = MotionChoice(Moves.TURNS, side)
    return replace(request, axis=axis_of_motion(asset.part(request.moving), choice, asset.box), source=SOURCE)


def _pulled_to(request: JointRequest, asset: Asset, config: WideBarConfig) -> Side | None:
    """Returns the border about which a side-hung door turns that has a bar across it, else None."""
    is_upright = abs(float(request.axis.direction[_UP])) >= config.upright
    if not (request.kind.turns and is_upright) or request.parent or request.coupling is not None:
        return None
    door = asset.part(request.moving)
    if float(door.box.size[:_UP].max()) < config.alone * float(asset.box.size[int(np.argmax(door.box.size[:_UP]))]):
        return None
    sides = {_side(part.box, door, config) for part in asset.parts if _is_handle(part, request)} - {None}
    return sides.pop() if len(sides) == 1 else None


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
