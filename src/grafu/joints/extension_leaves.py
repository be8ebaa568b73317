"""Leaves that make a table longer: halves of a top that slide apart, one after the other, and draw leaves under a top.

They run on the frame, the runners or between the boards that the table has, without hardware. What slides to a side and
is a level board near the top is such a leaf; without annotation only what is called so.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.asset.names import spoken
from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.graph.edges import Slide
from grafu.joints.motion_choice import DIRECTIONS, Side
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a leaf without annotation: its name tells."""
_WORDS = frozenset({"extension", "extending", "extendable", "extends", "drawleaf", "ausziehplatte"})
_OF_TABLES = frozenset({"extension", "extending", "extendable", "expandable", "ausziehtisch", "extensible"})
_PREDICTED = ("network", SOURCE)
_UP = 2
_SIDES = (Side.LEFT, Side.RIGHT, Side.FRONT, Side.BACK)


@final
@dataclass(frozen=True)
class ExtensionConfig:
    """What counts as a leaf that makes a table longer; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("seam", "step")
    thin: float = 0.15
    """Greatest thickness of a leaf (fraction of its shorter other side)."""
    covers: float = 0.12
    """Fraction of the plan that it covers at least."""
    high: float = 0.2
    """How far below the highest point its upper face lies at most (fraction of the height)."""
    travel: float = 0.65
    """How far a leaf comes out where the input states nothing (fraction of its length along its motion)."""
    seam: float = 0.02
    """Widest seam between two halves that slide apart (metres)."""
    step: float = 0.004
    """Largest step between the upper faces of two halves (metres)."""
    level: float = 0.99
    """Least cosine of the angle between the motion of a half and the axis along which the two lie (cosine)."""
    alike: float = 0.05
    """By how much the sides of two halves may differ (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "seam", "step")
        require_ratios(self, "thin", "covers", "high", "travel", "level", "alike")


def with_shown_extensions(
    plan: RealizationPlan, asset: Asset, config: ExtensionConfig = ExtensionConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which leaves slide out that are called so, or halves whose table is."""
    of_table = bool(_OF_TABLES & set(spoken(asset.name)))
    if not of_table and not any(_WORDS & set(spoken(part.source.name)) for part in asset.parts):
        return plan
    config = at_scale(config, metre_on(asset.extent))
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    boards = [p for p in asset.parts if p.id not in moving and not p.carried_by and _is_leaf(p.box, asset.box, config)]
    named = [part for part in boards if _WORDS & set(spoken(part.source.name))]
    halves = [part for part in boards if part.label in (PartLabel.TOP_PANEL, PartLabel.UNKNOWN)] if of_table else []
    pairs = [(a, b) for a, b in combinations(halves, 2) if _are_halves(a.box, b.box, config) is not None]
    found = {part.id: part for part in (*named, *(pairs[0] if len(pairs) == 1 else ()))}
    made = (
        JointRequest(p.id, Slide.joint_type, _outwards(p, asset), SOURCE, role=MotionRole.EXTENSION)
        for p in found.values()
    )
    return replace(plan, joints=(*plan.joints, *made)) if found else plan


def _outwards(leaf: Part, asset: Asset) -> Axis:
    """Returns the axis along which a leaf slides away from the middle of the whole."""
    off = (leaf.box.center - asset.box.center) / asset.box.size
    side = max(_SIDES, key=lambda one: float(DIRECTIONS[one] @ off))
    return Axis(leaf.box.center, DIRECTIONS[side])


def with_extension_leaves(
    plan: RealizationPlan, asset: Asset, config: ExtensionConfig = ExtensionConfig()
) -> RealizationPlan:
    """Returns the plan in which level boards near the top that are stated to slide to a side are leaves.

    Two halves among the leaves are coupled.
    """
    if not any(request.kind.slides for request in plan.joints):
        return plan
    config = at_scale(config, metre_on(asset.extent))
    leaves = {r.moving: _as_leaf(r, asset, config) for r in plan.joints if _slides_out(r, asset, config)}
    coupled = {second: first for first, second in _pairs(leaves, asset, config)}
    made = {
        name: replace(leaf, coupling=Coupling(coupled[name])) if name in coupled else leaf
        for name, leaf in leaves.items()
    }
    return replace(plan, joints=tuple(made.get(r.moving, r) for r in plan.joints)) if made else plan


def _slides_out(request: JointRequest, asset: Asset, config: ExtensionConfig) -> bool:
    """Whether a request is of a leaf: found by its name, or stated to slide to a side; predicted ones are drawers."""
    part, direction = asset.part(request.moving), request.axis.direction
    if not request.kind.slides or request.parent or part.label.is_movable:
        return False
    if request.role is MotionRole.EXTENSION:
        return True
    stated = request.source not in _PREDICTED and float(direction @ DIRECTIONS[Side.FRONT]) < config.level
    return stated and abs(float(direction[_UP])) < config.thin and _is_leaf(part.box, asset.box, config)


def _is_leaf(box: Box, whole: Box, config: ExtensionConfig) -> bool:
    """Whether a part is a level board near the highest point that covers enough of the plan."""
    flat = box.size[_UP] <= config.thin * box.size[:_UP].min()
    covers = np.prod(box.size[:_UP]) >= config.covers * np.prod(whole.size[:_UP])
    return bool(flat and covers and box.high[_UP] >= whole.high[_UP] - config.high * whole.size[_UP])


def _as_leaf(request: JointRequest, asset: Asset, config: ExtensionConfig) -> JointRequest:
    length = float(np.abs(request.axis.direction) @ asset.part(request.moving).box.size)
    return replace(request, role=MotionRole.EXTENSION, reference=request.reference or config.travel * length)


def _pairs(leaves: dict[str, JointRequest], asset: Asset, config: ExtensionConfig) -> Iterator[tuple[str, str]]:
    """Yields the leaves that meet in the middle and slide apart by as much, without a stated coupling."""
    for first, second in combinations(leaves.values(), 2):
        axis = _are_halves(asset.part(first.moving).box, asset.part(second.moving).box, config)
        apart = float(first.axis.direction @ second.axis.direction) < -config.level
        if axis is None or not apart or first.coupling or second.coupling or str(first.choice) or str(second.choice):
            continue
        if abs(float(first.axis.direction[axis])) > config.level and first.reference == second.reference:
            yield first.moving, second.moving


def _are_halves(one: Box, other: Box, config: ExtensionConfig) -> int | None:
    """Returns the axis along which two like boards of one level lie side by side; None where they do not."""
    if abs(float(one.high[_UP] - other.high[_UP])) > config.step:
        return None
    if not np.allclose(one.size, other.size, rtol=config.alike, atol=config.step):
        return None
    gaps = [max(float(one.low[k] - other.high[k]), float(other.low[k] - one.high[k])) for k in range(_UP)]
    axis = int(np.argmax(gaps))
    along = abs(float(one.center[1 - axis] - other.center[1 - axis]))
    return axis if abs(gaps[axis]) <= config.seam and along <= config.seam else None
