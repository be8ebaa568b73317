"""What lies on a lid goes with it as it opens: the cushion on the lid of a bench, which else held it shut."""

from collections.abc import Collection
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_UP: Final = 2
_LYING: Final = (PartLabel.MISC, PartLabel.UNKNOWN)


@final
@dataclass(frozen=True)
class OnLidConfig:
    """What lies on a lid; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("above", "slack", "beside")
    above: float = 0.005
    """How far above a lid, or sunk into it, what lies on it begins at most (metres)."""
    slack: float = 0.01
    """How far it may stand out of the lid's outline (metres): cushions are soft."""
    beside: float = 0.002
    """What is nearer than this to another part that stays is held by that (metres): a board that stands there."""
    high: float = 0.4
    """Greatest height of what lies there (fraction of that of the whole): what is higher stands on a top."""
    level: float = 0.9
    """From this cosine on to the horizontal the axis of a lid is level."""

    def __post_init__(self) -> None:
        require_positive(self, "above", "slack", "beside")
        require_ratios(self, "high", "level")


def with_parts_on_lids(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: OnLidConfig = OnLidConfig()
) -> RealizationPlan:
    """Returns the plan in which what lies on a lid alone is attached to it.

    Args:
        plan: the joints.
        asset: all parts.
        settled: the parts whose motions the user states: they stay as stated.
        config: the thresholds.
    """
    config = at_scale(config, metre_on(asset.extent))
    taken = {part for request in plan.joints for part in (request.moving, *request.attached)} | {*settled}
    joints = []
    for request in plan.joints:
        lying = _lying_on(request, asset, taken, config) if _is_lid(request, asset, config) else []
        taken |= {*lying}
        joints.append(replace(request, attached=(*request.attached, *lying)) if lying else request)
    return replace(plan, joints=tuple(joints))


def _is_lid(request: JointRequest, asset: Asset, config: OnLidConfig) -> bool:
    is_level = request.kind.turns and float(np.linalg.norm(request.axis.direction[:_UP])) >= config.level
    return is_level and asset.part(request.moving).box.thin_axis == _UP


def _lying_on(request: JointRequest, asset: Asset, taken: Collection[str], config: OnLidConfig) -> list[str]:
    """Returns the parts that lie on a lid, or on one another above it, and that nothing else holds."""
    lid = asset.part(request.moving).box
    found: list[Part] = []
    free = [p for p in asset.parts if p.id not in taken and p.label in _LYING and p.carried_by is None]
    free = [p for p in free if p.box.size[_UP] <= config.high * asset.box.size[_UP] and _is_over(p.box, lid, config)]
    for part in sorted(free, key=lambda p: float(p.box.low[_UP])):
        carriers = [lid, *(other.box for other in found)]
        if any(_rests(part.box, box, config) for box in carriers):
            found.append(part)
    own = {request.moving, *request.attached, *(p.id for p in found)}
    rest = [p.box for p in asset.parts if p.id not in own]
    return [p.id for p in found if not any(p.box.overlaps(box, config.beside) for box in rest)]


def _is_over(box: Box, lid: Box, config: OnLidConfig) -> bool:
    """Whether a box is within the outline of a lid, and not below it."""
    inside = np.all(box.low[:_UP] >= lid.low[:_UP] - config.slack) and np.all(
        box.high[:_UP] <= lid.high[:_UP] + config.slack
    )
    return bool(inside and box.low[_UP] >= lid.high[_UP] - config.above)


def _rests(box: Box, below: Box, config: OnLidConfig) -> bool:
    gaps = below.axis_gaps(box)
    return bool(abs(float(box.low[_UP] - below.high[_UP])) <= config.above and (gaps[:_UP] < 0).all())
