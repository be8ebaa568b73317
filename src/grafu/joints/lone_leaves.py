"""Doors of buildings that are drawn without a frame: one leaf or a pair, and what is on them."""

from collections.abc import Collection, Sequence

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.box import Box
from grafu.joints.building_doors import BuildingDoorConfig, is_on_leaf
from grafu.joints.door_grips import hinged_side
from grafu.joints.framed_leaves import relabelled, turning_leaf
from grafu.joints.plan import RealizationPlan
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2


def lone_leaves_of(parts: Sequence[Part], config: BuildingDoorConfig = BuildingDoorConfig()) -> tuple[Part, ...]:
    """Returns the leaves of a door that is drawn alone; none where a part stands beside them, or no door is as large.

    They are called doors, the largest one or a pair side by side: a board of other furniture may have any size.
    """
    doors = [part for part in parts if part.label is PartLabel.DOOR]
    return _alone(doors, parts, config)


def with_lone_labels(asset: Asset, config: BuildingDoorConfig = BuildingDoorConfig()) -> Asset:
    """Returns the asset in which the nameless leaves of a door that is drawn alone are doors; else the asset itself.

    They fill the whole, and one at least is grasped at a hand's height near its edge: a single one from both sides, as
    a mirror or a blackboard has hooks, too.
    """
    if any(part.label not in (PartLabel.UNKNOWN, PartLabel.HANDLE) for part in asset.parts):
        return asset
    leaves = _alone([part for part in asset.parts if part.label is PartLabel.UNKNOWN], asset.parts, config)
    if not leaves or not _are_grasped(leaves, asset.parts, config):
        return asset
    return relabelled(asset, dict.fromkeys((leaf.id for leaf in leaves), PartLabel.DOOR))


def with_lone_leaf(
    plan: RealizationPlan,
    asset: Asset,
    settled: Collection[str] = (),
    config: BuildingDoorConfig = BuildingDoorConfig(),
) -> RealizationPlan:
    """Returns the plan in which leaves that stand alone turn, with all that is on them, about the sides of no handle.

    The frame that carries them is an addition. Any other plan stays as it is, and so do a leaf that is named and moves
    and leaves of which the user states (`settled`) how one moves.
    """
    leaves = lone_leaves_of(asset.parts, config)
    is_stated = len(leaves) == 1 and bool(plan.joints) and leaves[0].labelled_by != "shape"
    if not leaves or is_stated or any(leaf.id in settled for leaf in leaves):
        return plan
    on_leaf = _on_each(leaves, asset.parts)
    requests = tuple(
        turning_leaf(leaf, on_it, asset, hinged_side(leaf, leaves, on_it), opens_backwards=False)
        for leaf, on_it in zip(leaves, on_leaf, strict=True)
    )
    parts = {part.id for part in asset.parts}
    return RealizationPlan(requests, tuple(r for r in plan.refused if r.part not in parts))


def _alone(boards: Sequence[Part], parts: Sequence[Part], config: BuildingDoorConfig) -> tuple[Part, ...]:
    """Returns the largest of some boards, or a pair of them, where it is a door's leaf and all else is on it."""
    whole = Box.enclosing(part.box for part in parts)
    tall = [board for board in boards if _is_leaf(board, whole, config)]
    tall.sort(key=lambda part: -float(np.prod(part.box.size[[_WIDTH, _UP]])))
    for leaves in (tuple(tall[:1]), tuple(tall[:2])):
        rest = [part for part in parts if part not in leaves]
        on_some = all(any(is_on_leaf(part, leaf, config) for leaf in leaves) for part in rest)
        if leaves and on_some and _are_side_by_side(leaves, config) and not _has_frame(leaves, rest):
            return leaves
    return ()


def _has_frame(leaves: Sequence[Part], rest: Sequence[Part]) -> bool:
    """Whether a part is wider and higher than all leaves together: a slim frame ends near their edges."""
    size = Box.enclosing(leaf.box for leaf in leaves).size[[_WIDTH, _UP]]
    return any(bool(np.all(part.box.size[[_WIDTH, _UP]] > size)) for part in rest)


def _is_leaf(board: Part, whole: Box, config: BuildingDoorConfig) -> bool:
    return board.box.thin_axis == _DEPTH and bool(
        board.box.size[_UP] >= max(config.tall, config.high * whole.size[_UP])
    )


def _are_side_by_side(leaves: Sequence[Part], config: BuildingDoorConfig) -> bool:
    """Whether two leaves stand in one plane, one ends about where the other begins; one alone does."""
    if len(leaves) < 2:
        return True
    left, right = sorted((leaf.box for leaf in leaves), key=lambda box: float(box.center[_WIDTH]))
    narrow = float(min(left.size[_WIDTH], right.size[_WIDTH]))
    apart = abs(float(right.low[_WIDTH] - left.high[_WIDTH]))
    offset = abs(float(left.center[_DEPTH] - right.center[_DEPTH]))
    return apart <= config.threshold * narrow and offset <= float(min(left.size[_DEPTH], right.size[_DEPTH]))


def _are_grasped(leaves: Sequence[Part], parts: Sequence[Part], config: BuildingDoorConfig) -> bool:
    """Whether what is on leaves is small, and stands out of one at a hand's height, away from its middle."""
    rest = [part.box for part in parts if part not in leaves]
    if any(float(box.size.max()) > config.small * leaves[0].box.size[_UP] for box in rest):
        return False
    sides = {sign for leaf in leaves for box in rest for sign in (-1, 1) if _is_grip(box, leaf.box, sign, config)}
    return bool(sides) if len(leaves) > 1 else len(sides) == 2


def _is_grip(box: Box, leaf: Box, sign: int, config: BuildingDoorConfig) -> bool:
    """Whether a box stands out before (`sign` -1) or behind a leaf, as a handle or a knob does."""
    width, height = float(leaf.size[_WIDTH]), float(leaf.size[_UP])
    aside = abs(float(box.center[_WIDTH] - leaf.center[_WIDTH]))
    at = float(box.center[_UP] - leaf.low[_UP])
    out = float(box.high[_DEPTH] - leaf.high[_DEPTH]) if sign > 0 else float(leaf.low[_DEPTH] - box.low[_DEPTH])
    low, high = config.hand
    is_beside = config.aside * width <= aside <= width / 2
    return is_beside and low * height <= at <= high * height and out >= config.out * height


def _on_each(leaves: Sequence[Part], parts: Sequence[Part]) -> list[list[Part]]:
    """Returns what is on each leaf: what lies nearest to its middle, in widths."""
    found: list[list[Part]] = [[] for _ in leaves]
    for part in parts:
        if part in leaves:
            continue
        off = [
            abs(float(part.box.center[_WIDTH] - leaf.box.center[_WIDTH])) / float(leaf.box.size[_WIDTH])
            for leaf in leaves
        ]
        found[int(np.argmin(off))].append(part)
    return found
