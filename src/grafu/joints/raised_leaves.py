"""Leaves of tables that are drawn level with their tops, with nothing below them: they swing down.

They are found by boxes, whatever the parts are called: a board beside the top's edge, along most of it, as high and as
thick as the top, below which nothing stands, and which is short enough to hang clear of the floor. The top itself has
legs below it.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.joints.drop_leaves import SOURCE, is_called_support, moving_parts
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on

_UP = 2
_SIDES = {(0, 1): Side.LEFT, (0, -1): Side.RIGHT, (1, 1): Side.FRONT, (1, -1): Side.BACK}
"""The border on which a leaf hangs, by the axis and the direction in which it is beside the top."""


@final
@dataclass(frozen=True)
class RaisedLeafConfig:
    """What counts as a leaf that is drawn raised; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("gap", "even")
    gap: float = 0.008
    """Greatest gap between the leaf and the edge of the top (metres)."""
    even: float = 0.004
    """How far their upper and lower faces differ at most (metres)."""
    thin: float = 0.15
    """Greatest thickness of a top or a leaf (fraction of its shorter level side)."""
    high: float = 0.1
    """How far below the highest point the top's upper face lies at most (fraction of the height)."""
    along: float = 0.9
    """Fraction of the seam along which both run at least."""
    wide: tuple[float, float] = (0.2, 0.9)
    """Least and greatest width of a leaf, across the seam (fraction of the height of its lower face)."""
    bearing: float = 0.1
    """What is below the leaf within this of its width from the seam may be the top's frame (fraction)."""
    legs: int = 2
    """How many parts touch the top from below at least, without its leaves."""

    def __post_init__(self) -> None:
        require_positive(self, "gap", "even")
        require_ratios(self, "thin", "high", "along", "bearing")
        if not 0 < self.wide[0] < self.wide[1] < 1 or self.legs < 1:
            raise ValueError(f"`wide` must be two rising fractions, and `legs` above 0: got {self}")


def with_raised_leaves(
    plan: RealizationPlan, asset: Asset, config: RaisedLeafConfig = RaisedLeafConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which leaves that are drawn level with a table's top swing down; others stay."""
    config = at_scale(config, metre_on(asset.extent))
    found = dict(_leaves(plan, asset, config))
    if not found:
        return plan
    swung = (
        JointRequest(leaf.id, choice.type, axis_of_motion(leaf, choice, asset.box), SOURCE)
        for leaf, choice in found.values()
    )
    return replace(plan, joints=(*plan.joints, *swung), refused=tuple(r for r in plan.refused if r.part not in found))


def _leaves(
    plan: RealizationPlan, asset: Asset, config: RaisedLeafConfig
) -> Iterator[tuple[str, tuple[Part, MotionChoice]]]:
    moving = moving_parts(plan)
    static = [part for part in asset.parts if part.id not in moving and not part.label.is_movable]
    boards = [part for part in static if _is_board(part.box, asset.box, config)]
    for top in boards:
        for leaf in boards:
            sides = [side for side in _SIDES if leaf is not top and _continues(leaf.box, top.box, *side, config)]
            others = [part.box for part in asset.parts if part not in (leaf, top) and not is_called_support(part)]
            if len(sides) == 1 and _stands(top.box, others, config) and _is_free(leaf.box, others, *sides[0], config):
                yield leaf.id, (leaf, MotionChoice(Moves.TURNS, _SIDES[sides[0]], inwards=True))


def _is_board(box: Box, whole: Box, config: RaisedLeafConfig) -> bool:
    """Whether a part is a level board near the highest point."""
    flat = box.size[_UP] <= config.thin * box.size[:_UP].min()
    return bool(flat and box.high[_UP] >= whole.high[_UP] - config.high * whole.size[_UP])


def _continues(leaf: Box, top: Box, axis: int, sign: int, config: RaisedLeafConfig) -> bool:
    """Whether a board continues a top at this side: as high and thick, along its edge, and not too wide to hang."""
    across = 1 - axis
    gap = leaf.low[axis] - top.high[axis] if sign > 0 else top.low[axis] - leaf.high[axis]
    even = max(abs(leaf.low[_UP] - top.low[_UP]), abs(leaf.high[_UP] - top.high[_UP])) <= config.even
    along = min(leaf.high[across], top.high[across]) - max(leaf.low[across], top.low[across])
    is_next = abs(float(gap)) <= config.gap and along >= config.along * max(leaf.size[across], top.size[across])
    return bool(even and is_next and config.wide[0] <= leaf.size[axis] / max(leaf.low[_UP], 1e-9) <= config.wide[1])


def _stands(top: Box, others: list[Box], config: RaisedLeafConfig) -> bool:
    """Whether parts below the top carry it."""
    lower = Box(np.array([*top.low[:_UP], top.low[_UP] - config.gap]), np.array([*top.high[:_UP], top.low[_UP]]))
    return sum(other.low[_UP] < lower.low[_UP] and other.overlaps(lower) for other in others) >= config.legs


def _is_free(leaf: Box, others: list[Box], axis: int, sign: int, config: RaisedLeafConfig) -> bool:
    """Whether nothing is below a leaf, or on it, but at the seam."""
    margin = config.bearing * float(leaf.size[axis])
    low, high = leaf.low.copy(), leaf.high.copy()
    low[axis] += margin if sign > 0 else 0.0
    high[axis] -= margin if sign < 0 else 0.0
    low[_UP], high[_UP] = 0.0, high[_UP] + config.gap
    low[1 - axis] += config.gap
    high[1 - axis] -= config.gap
    return not any(other.overlaps(Box(low, high)) for other in others)
