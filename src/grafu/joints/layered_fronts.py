"""One front drawn as several parts: a leaf in layers, a plate before the box of a drawer.

Each part was guessed to be a door or a drawer of its own, or is called a door; they move as one.
"""

from collections.abc import Collection
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class LayerConfig:
    """What counts as a layer of another front; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("gap", "named_gap")
    gap: float = 0.01
    """How far a layer lies before or behind the other at most (metres): with more between them they are two."""
    named_gap: float = 0.002
    """The same where one of the two is called a door by the input (metres)."""
    shared: float = 0.8
    """What the outlines of two layers of a leaf share at least (fraction of the smaller one) ..."""
    plate: float = 0.5
    """... and of a drawer and the plate before it (fraction of each)."""
    within: float = 0.5
    """Two that lie in each other by this much of the thinner one are one, whatever they are held by (fraction)."""
    thin: float = 0.25
    """Greatest thickness of such a plate, of the depth of the drawer behind it (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "gap", "named_gap")
        require_ratios(self, "shared", "plate", "within", "thin")


def with_layered_fronts(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: LayerConfig = LayerConfig()
) -> RealizationPlan:
    """Returns the plan in which layers of one front move as one, by the joint of the largest.

    What moves on another part stays as it is, unless it is a nameless pane on a leaf, and so do two that lie before one
    another and carry something each: handles of their own. What the input calls a door is a layer where just one of the
    two has a handle, and they touch; a nameless plate goes with what it calls a drawer behind it.

    Args:
        plan: the joints.
        asset: all parts.
        settled: the parts whose motions the user states, which stay.
        config: the thresholds.
    """
    if len(plan.joints) < 2:
        return plan
    names = [r.moving for r in plan.joints if asset.part(r.moving).label is PartLabel.UNKNOWN]
    config, guessed = at_scale(config, metre_on(asset.extent)), frozenset(names)
    kept: list[JointRequest] = []
    for request in sorted(plan.joints, key=lambda r: -float(np.prod(np.sort(asset.part(r.moving).box.size)[1:]))):
        on = next((k for k, other in enumerate(kept) if _is_layer(request, other, guessed, asset, config)), None)
        on = None if request.moving in settled else on
        if on is None:
            kept.append(request)
        else:
            attached = (*kept[on].attached, request.moving, *request.attached)
            kept[on] = replace(kept[on], attached=tuple(dict.fromkeys(attached)))
    if len(kept) == len(plan.joints):
        return plan
    joints = {request.moving: request for request in kept}
    return replace(plan, joints=tuple(joints[r.moving] for r in plan.joints if r.moving in joints))


def _is_layer(
    request: JointRequest, front: JointRequest, guessed: frozenset[str], asset: Asset, config: LayerConfig
) -> bool:
    """Whether a part is a layer of a larger front: of a leaf that turns, or the plate before a drawer that slides.

    So is a nameless one that was taken for a door on that leaf, and carries nothing: its pane, or a mirror on it.
    """
    both = (request, front)
    is_pane = request.parent == front.moving and request.moving in guessed and not request.attached
    if front.parent or (request.parent and not is_pane) or any(r.coupling for r in both):
        return False
    if request.type is not front.type:
        return False
    one, other = asset.part(request.moving).box, asset.part(front.moving).box
    are_held, is_named = bool(request.attached and front.attached), any(r.moving not in guessed for r in both)
    handles = sum(_has_handle(r, asset) for r in both) if is_named else 0
    if not front.kind.turns:
        may_join = request.moving in guessed and handles < 2 if is_named else not are_held
        return may_join and _is_plate(one, other, front, config)
    if is_named and handles != 1:
        return False
    are_held = are_held and not is_named
    axis = other.thin_axis
    if one.thin_axis != axis or max(_shared_ratios(one, other, axis)) < config.shared:
        return False
    common = float(min(one.high[axis], other.high[axis]) - max(one.low[axis], other.low[axis]))
    thinner = float(min(one.size[axis], other.size[axis]))
    return common >= -(config.named_gap if is_named else config.gap) and (
        not are_held or 0 < config.within * thinner <= common
    )


def _has_handle(request: JointRequest, asset: Asset) -> bool:
    return any(asset.part(name).label is PartLabel.HANDLE for name in request.attached)


def _shared_ratios(one: Box, other: Box, axis: int) -> tuple[float, float]:
    """Returns what two outlines, seen along an axis, share, as a fraction of each."""
    across = [k for k in range(3) if k != axis]
    shared = np.minimum(one.high, other.high)[across] - np.maximum(one.low, other.low)[across]
    area = float(np.prod(np.maximum(shared, 0.0)))
    return area / max(float(np.prod(one.size[across])), 1e-12), area / max(float(np.prod(other.size[across])), 1e-12)


def _is_plate(plate: Box, drawer: Box, slide: JointRequest, config: LayerConfig) -> bool:
    """Whether a plate covers the face that leads a drawer as it slides out."""
    axis = int(np.argmax(np.abs(slide.axis.direction)))
    thin = plate.thin_axis == axis and plate.size[axis] <= config.thin * drawer.size[axis]
    if not thin or min(_shared_ratios(plate, drawer, axis)) < config.plate:
        return False
    leads = drawer.high[axis] if slide.axis.direction[axis] > 0 else drawer.low[axis]
    return bool(plate.low[axis] - config.gap <= leads <= plate.high[axis] + config.gap)
