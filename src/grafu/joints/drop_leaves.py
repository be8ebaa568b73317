"""Leaves of tables that hang from their tops, and swing up level with them.

They are found by boxes, whatever the parts are called: an upright board outside the top's edge, along most of it, that
neither reaches the floor nor is held at its ends, at its lower edge or behind its lower half. What carries it once it
is raised (`drop_supports`) only stands behind it.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.names import singular, spoken
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.joints.motion_choice import MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a drop leaf: its shape alone tells."""
_PANELS = frozenset({PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.FACE_FRAME, PartLabel.DIVIDER})
_SUPPORTS = frozenset({"gateleg", "gate", "bracket", "support", "loper", "flyleg"})
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
    level: float = 0.1
    """Below this cosine to the vertical an axis is level: a leaf turns up about it."""
    core: float = 0.5
    """What stands within this middle part of its thickness, beside or below it, holds it (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "gap")
        require_ratios(self, "thin", "covers", "high", "along", "off_floor", "held", "level", "core")
        if not 0 < self.tall[0] < self.tall[1] < 1:
            raise ValueError(f"`DropLeafConfig.tall` must be two rising fractions: got {self.tall}")


@final
@dataclass(frozen=True, slots=True)
class HangingLeaf:
    """A leaf that hangs from a top: the level `axis` (0 or 1) that its faces look along, and the side, -1 or 1."""

    part: Part
    top: Part
    axis: int
    sign: int


def is_called_support(part: Part) -> bool:
    """Whether a part's name is that of what carries a leaf: a gate leg, a bracket, a loper."""
    return bool(_SUPPORTS & {singular(word) for word in spoken(part.source.name)})


def no_supports(_leaf: HangingLeaf) -> frozenset[str]:
    """Returns the parts that carry a leaf once it is raised: none."""
    return frozenset()


def with_drop_leaves(
    plan: RealizationPlan,
    asset: Asset,
    config: DropLeafConfig = DropLeafConfig(),
    supports: Callable[[HangingLeaf], frozenset[str]] = no_supports,
) -> RealizationPlan:
    """Returns the plan in which leaves that hang from a table's top swing up.

    `supports` returns the ids of what will carry a leaf once it is raised: that does not hold it while it hangs, nor
    does what is called so. What was predicted to turn about another border is a leaf where it hangs as one; other
    joints stay as they are.
    """
    config = at_scale(config, metre_on(asset.extent))
    moving = moving_parts(plan)
    turning = {r.moving: r for r in plan.joints if r.kind.turns and not r.parent and r.coupling is None}
    may_hang = [part for part in asset.parts if part.id in turning or _is_free(part, moving)]
    hanging = _hanging(may_hang, moving, asset, config)
    found = {leaf.part.id: leaf.part for leaf in hanging if _is_alone(leaf, supports(leaf), asset, config)}
    if not found:
        return plan
    kept = tuple(request for request in plan.joints if request.moving not in found)
    swung = (_swung(leaf, asset, turning.get(leaf.id)) for leaf in found.values())
    refused = tuple(refusal for refusal in plan.refused if refusal.part not in found)
    return replace(plan, joints=(*kept, *swung), refused=refused)


def moving_parts(plan: RealizationPlan) -> frozenset[str]:
    """Returns the ids of all parts that move as a plan has it."""
    return frozenset(part for request in plan.joints for part in (request.moving, *request.attached))


def hanging_leaves(
    plan: RealizationPlan, asset: Asset, config: DropLeafConfig = DropLeafConfig()
) -> tuple[HangingLeaf, ...]:
    """Returns the leaves that hang from a table's top and turn up, as a plan has it, wherever that comes from."""
    turning = {r.moving for r in plan.joints if r.kind.turns and abs(float(r.axis.direction[_UP])) < config.level}
    if not turning:
        return ()
    may_hang = [part for part in asset.parts if part.id in turning]
    return tuple(_hanging(may_hang, moving_parts(plan), asset, at_scale(config, metre_on(asset.extent))))


def _is_free(part: Part, moving: frozenset[str]) -> bool:
    """Whether a part may be a leaf that nothing moves yet: what is called a panel of a case is none."""
    is_named = part.labelled_by == "name" and part.label in _PANELS
    return part.id not in moving and not is_named and part.label not in (PartLabel.DRAWER, PartLabel.HANDLE)


def _swung(leaf: Part, asset: Asset, predicted: JointRequest | None) -> JointRequest:
    attached = predicted.attached if predicted else ()
    return JointRequest(leaf.id, _RAISED.type, axis_of_motion(leaf, _RAISED, asset.box), SOURCE, attached=attached)


def _is_top(box: Box, whole: Box, config: DropLeafConfig) -> bool:
    """Whether a part is a level board near the highest point that covers much of the plan."""
    size = box.size
    flat = size[_UP] <= config.thin * size[:_UP].min()
    covers = np.prod(size[:_UP]) >= config.covers * np.prod(whole.size[:_UP])
    return bool(flat and covers and box.high[_UP] >= whole.high[_UP] - config.high * whole.size[_UP])


def _hanging(
    may_hang: list[Part], moving: frozenset[str], asset: Asset, config: DropLeafConfig
) -> Iterator[HangingLeaf]:
    """Yields what has a leaf's proportions, and hangs at one side of a top alone."""
    static = [part for part in asset.parts if part.id not in moving and not part.label.is_movable]
    for top in (part for part in static if _is_top(part.box, asset.box, config)):
        for part in may_hang:
            all_sides = [(axis, sign) for axis in (0, 1) for sign in (-1, 1)]
            sides = [(axis, sign) for axis, sign in all_sides if _hangs(part.box, top.box, axis, sign, config)]
            if len(sides) == 1 and _is_leaf(part.box, asset.box, sides[0][0], config):
                yield HangingLeaf(part, top, *sides[0])


def _is_alone(leaf: HangingLeaf, supports: frozenset[str], asset: Asset, config: DropLeafConfig) -> bool:
    """Whether nothing but the top holds a leaf, its supports apart."""
    apart = supports | {leaf.part.id, leaf.top.id}
    others = [part for part in asset.parts if part.id not in apart]
    holding = [part.box for part in others if not is_called_support(part)]
    return not any(_holds(other, leaf.part.box, leaf.axis, config) for other in holding)


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
