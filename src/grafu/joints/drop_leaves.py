"""Leaves of tables that hang from their tops, and swing up level with them.

They are found by boxes, whatever the parts are called: an upright board outside the top's edge, along most of it, that
neither reaches the floor nor is held at its ends, at its lower edge or behind its lower half.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scene import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a drop leaf: its shape alone tells."""
_UP = 2
_RAISED = MotionChoice(Moves.TURNS, Side.TOP)


@final
@dataclass(frozen=True)
class DropLeafConfig:
    """What counts as a leaf that hangs from the top of a table; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("gap",)
    thin: float = 0.15
    """Greatest thickness of a top or a leaf (fraction of its shorter other side)."""
    covers: float = 0.3
    """Fraction of the plan that the top covers at least."""
    high: float = 0.1
    """How far below the highest point the top's upper face lies at most (fraction of the height)."""
    gap: float = 0.015
    """How far the leaf's inner face stands off the top's edge, or reaches under it, at most (metres)."""
    along: float = 0.7
    """Fraction of the top's edge along which the leaf hangs at least; as much of the leaf is before the edge."""
    tall: tuple[float, float] = (0.15, 0.75)
    """Least and greatest height of a leaf (fraction of the piece's height)."""
    off_floor: float = 0.2
    """How high above the floor it ends at least (fraction of the piece's height)."""
    held: float = 0.4
    """Nothing stands behind this lower part of it (fraction of its height): a side of a case is held there."""
    core: float = 0.5
    """What stands within this middle part of its thickness, beside or below it, holds it (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "gap")
        require_ratios(self, "thin", "covers", "high", "along", "off_floor", "held", "core")
        if not 0 < self.tall[0] < self.tall[1] < 1:
            raise ValueError(f"`DropLeafConfig.tall` must be two rising fractions: got {self.tall}")


def with_drop_leaves(plan: RealizationPlan, asset: Asset, config: DropLeafConfig = DropLeafConfig()) -> RealizationPlan:
    """Returns the plan in which leaves that hang from a table's top swing up.

    What was predicted to turn about another border is a leaf where it hangs as one; other joints stay as they are.
    """
    config = at_scale(config, metre_on(asset.extent))
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    turning = {r.moving: r for r in plan.joints if r.kind.turns and not r.parent and r.coupling is None}
    static = [part for part in asset.parts if part.id not in moving and not part.label.is_movable]
    may_hang = [part for part in asset.parts if part.id in turning or _is_free(part, moving)]
    tops = [part for part in static if _is_top(part.box, asset.box, config)]
    found = {leaf.id: leaf for top in tops for leaf in _leaves(top, may_hang, asset, config)}
    if not found:
        return plan
    kept = tuple(request for request in plan.joints if request.moving not in found)
    swung = (_swung(leaf, asset, turning.get(leaf.id)) for leaf in found.values())
    refused = tuple(refusal for refusal in plan.refused if refusal.part not in found)
    return replace(plan, joints=(*kept, *swung), refused=refused)


def _is_free(part: Part, moving: set[str]) -> bool:
    return part.id not in moving and part.label not in (PartLabel.DRAWER, PartLabel.HANDLE)


def _swung(leaf: Part, asset: Asset, predicted: JointRequest | None) -> JointRequest:
    attached = predicted.attached if predicted else ()
    return JointRequest(leaf.id, _RAISED.type, axis_of_motion(leaf, _RAISED, asset.box), SOURCE, attached=attached)


def _is_top(box: Box, whole: Box, config: DropLeafConfig) -> bool:
    """Whether a part is a level board near the highest point that covers much of the plan."""
    size = box.size
    flat = size[_UP] <= config.thin * size[:_UP].min()
    covers = np.prod(size[:_UP]) >= config.covers * np.prod(whole.size[:_UP])
    return bool(flat and covers and box.high[_UP] >= whole.high[_UP] - config.high * whole.size[_UP])


def _leaves(top: Part, may_hang: list[Part], asset: Asset, config: DropLeafConfig) -> Iterator[Part]:
    for part in may_hang:
        sides = [(axis, sign) for axis in (0, 1) for sign in (-1, 1) if _hangs(part.box, top.box, axis, sign, config)]
        if len(sides) != 1 or not _is_leaf(part.box, asset.box, sides[0][0], config):
            continue
        others = [other.box for other in asset.parts if other is not part and other is not top]
        if not any(_holds(other, part.box, sides[0][0], config) for other in others):
            yield part


def _hangs(leaf: Box, top: Box, axis: int, sign: int, config: DropLeafConfig) -> bool:
    """Whether a board hangs outside the top's edge at this side: as high as the top, along most of its edge."""
    across = 1 - axis
    inner, edge = (leaf.low[axis], top.high[axis]) if sign > 0 else (-leaf.high[axis], -top.low[axis])
    along = min(leaf.high[across], top.high[across]) - max(leaf.low[across], top.low[across])
    longest = max(leaf.size[across], top.size[across])
    level = top.low[_UP] - config.gap <= leaf.high[_UP] <= top.high[_UP] + config.gap
    return bool(level and abs(inner - edge) <= config.gap and along >= config.along * longest)


def _is_leaf(leaf: Box, whole: Box, axis: int, config: DropLeafConfig) -> bool:
    """Whether a board has a leaf's proportions, and ends well above the floor."""
    size, height = leaf.size, whole.size[_UP]
    thin = size[axis] <= config.thin * np.delete(size, axis).min()
    tall = config.tall[0] * height <= size[_UP] <= config.tall[1] * height
    return bool(thin and tall and leaf.low[_UP] >= whole.low[_UP] + config.off_floor * height)


def _holds(other: Box, leaf: Box, axis: int, config: DropLeafConfig) -> bool:
    """Whether a part holds a board at its ends or lower edge, or behind its lower part."""
    around, behind = config.gap * (np.arange(3) != axis), config.gap * (np.arange(3) == axis)
    core = 0.5 * (1 - config.core) * leaf.size * (np.arange(3) == axis)
    below = np.array([*leaf.high[:_UP], leaf.low[_UP] + config.held * leaf.size[_UP]])
    beside = Box(leaf.low - around + core, np.array([*(leaf.high + around - core)[:_UP], below[_UP]]))
    return other.overlaps(beside) or other.overlaps(Box(leaf.low - behind, below + behind))
