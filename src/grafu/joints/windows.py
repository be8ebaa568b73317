"""Windows: leaves of a frame and panes in a frame that is closed all around. They are found by shape alone.

A leaf is a frame of its own with panes in it; pictures and mirrors have none. It turns about the edge away from its
handle. Leaves that lap in two planes slide. What is called a door within the frame is a leaf, glazed in one object or
not, and where some are called so the others stay.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.box import Box
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster, covered_ratio
from grafu.graph.edges import Slide
from grafu.joints.building_doors import building_door
from grafu.joints.framed_leaves import (
    SOURCE,
    FramedLeaves,
    is_called_door,
    nearer_to_back,
    relabelled,
    turning_leaf,
)
from grafu.joints.motion_choice import DIRECTIONS, MotionChoice, Moves, Side, axis_of_motion
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.joints.window_config import WindowConfig
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2
_PLANE = [_WIDTH, _UP]
_RAYS = 12  # along each side of a leaf


def window(asset: Asset, config: WindowConfig = WindowConfig()) -> FramedLeaves | None:
    """Returns the window that an asset is; None where it is another piece, or something stands behind its leaves.

    A door of a building with a threshold is closed all around, too: it is no window.
    """
    frame = _frame(asset, config)
    if frame is None or building_door(asset) is not None:
        return None
    others = [part for part in asset.parts if part is not frame]
    leaves = tuple(_leaves(frame, others, config))
    rest = [part for part in others if part not in leaves]
    on_leaf = tuple(tuple(part for part in rest if _is_on(part, leaf, config)) for leaf in leaves)
    held = {part.id for parts in on_leaf for part in parts}
    blocked = any(_lies_before(part, leaf, config) for part in rest if part.id not in held for leaf in leaves)
    glazed = all(_has_panes(leaf, parts, config) for leaf, parts in zip(leaves, on_leaf, strict=True))
    return FramedLeaves(frame, leaves, on_leaf) if leaves and glazed and not blocked else None


def with_window_labels(asset: Asset, config: WindowConfig = WindowConfig()) -> Asset:
    """Returns the asset in which the leaves of a window that move are doors, and no other part; any other asset itself.

    Labels that the user gave stay.
    """
    found = window(asset, config)
    if found is None:
        return asset
    panes = {part.id for parts in found.on_leaf for part in parts if part.label.is_movable}
    stay = {leaf.id for leaf in found.leaves if _stays(leaf, found.leaves, config) or found.is_fixed(leaf)}
    labels = {leaf.id: PartLabel.FACE_FRAME if leaf.id in stay else PartLabel.DOOR for leaf in found.leaves}
    labels[found.frame.id] = PartLabel.FACE_FRAME
    labels |= dict.fromkeys(panes, PartLabel.MISC)
    return relabelled(asset, labels)


def with_windows(plan: RealizationPlan, asset: Asset, config: WindowConfig = WindowConfig()) -> RealizationPlan:
    """Returns the plan in which the leaves of a window turn or slide; the plan itself for any other piece."""
    found = window(asset, config)
    if found is None:
        return plan
    return found.with_joints(plan, asset, lambda leaf, on_it: _request(leaf, on_it, found, asset, config))


def _frame(asset: Asset, config: WindowConfig) -> Part | None:
    """Returns the part that is closed around the middle of the whole and spans most of it; None where no part is."""
    size = asset.box.size[_PLANE]
    frames = (
        part
        for part in asset.parts
        if (part.box.size[_PLANE] >= config.around * size).all()
        and part.box.size[_DEPTH] <= config.shallow * part.box.size[_PLANE].min()
        and _is_ring(part, config)
    )
    return max(frames, key=lambda part: float(np.prod(part.box.size[_PLANE])), default=None)


def _leaves(frame: Part, others: Sequence[Part], config: WindowConfig) -> Iterator[Part]:
    """Yields the upright frames with an open middle within a frame, without those that lie within another."""
    rays, found = RayCaster(frame.mesh), list[Part]()
    least = config.leaf * float(np.prod(frame.box.size[_PLANE]))
    for part in sorted(others, key=lambda part: (not is_called_door(part), -float(np.prod(part.box.size[_PLANE])))):
        size, area = part.box.size, float(np.prod(part.box.size[_PLANE]))
        if (
            area < least
            or size[_DEPTH] > config.thin * size[_PLANE].min()
            or any(_is_on(part, f, config) for f in found)
        ):
            continue
        room = config.within * size
        inside = (part.box.low >= frame.box.low - room)[_PLANE] & (part.box.high <= frame.box.high + room)[_PLANE]
        is_leaf = inside.all() and (is_called_door(part) or _is_ring(part, config))
        if is_leaf and _covered(rays, part.box, frame.box) <= config.hidden:
            found.append(part)
    yield from found


def _is_ring(part: Part, config: WindowConfig) -> bool:
    """Whether a part is closed all around, and open in its middle but for bars, seen from before it."""
    rays, box = RayCaster(part.mesh), part.box
    low, high = box.low + config.rim * box.size, box.high - config.rim * box.size
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    for axis in _PLANE:
        along = low[axis] + steps * (high[axis] - low[axis])
        for end in (low, high):
            points = np.tile(end, (_RAYS, 1))
            points[:, axis] = along
            if _hit(rays, points, box) < config.closed:
                return False
    return _covered(rays, _middle(box, config), box) <= config.bars


def _middle(box: Box, config: WindowConfig) -> Box:
    return Box.from_center(box.center, config.middle * box.half)


def _covered(rays: RayCaster, area: Box, whole: Box) -> float:
    """Returns what of an area is covered, seen from before it (fraction)."""
    return covered_ratio(rays, area, _DEPTH, _RAYS, whole.diagonal)


def _hit(rays: RayCaster, points: Float[np.ndarray, "n 3"], whole: Box) -> float:
    """Returns which fraction of the lines in depth through some points meet anything."""
    origins = np.column_stack([points[:, 0], np.full(len(points), whole.low[_DEPTH] - whole.diagonal), points[:, 2]])
    return float(np.isfinite(rays.along(origins, DIRECTIONS[Side.BACK])).mean())


def _has_panes(leaf: Part, on_it: Sequence[Part], config: WindowConfig) -> bool:
    """Whether what is on a leaf, or a leaf that is called a door itself, closes its middle."""
    closing = [*on_it, leaf] if is_called_door(leaf) else on_it
    if not closing:
        return False
    rays = RayCaster(merge_meshes([part.mesh for part in closing]))
    return _covered(rays, _middle(leaf.box, config), leaf.box) >= config.pane


def _is_on(part: Part, leaf: Part, config: WindowConfig) -> bool:
    """Whether a part lies within the outline of a leaf, seen from before it, and close to it."""
    room = config.within * leaf.box.size
    room[_DEPTH] = config.before * float(leaf.box.size[_PLANE].min())
    return bool(np.all(part.box.low >= leaf.box.low - room) and np.all(part.box.high <= leaf.box.high + room))


def _lies_before(part: Part, leaf: Part, config: WindowConfig) -> bool:
    """Whether a part that is on no leaf lies before or behind the middle of a leaf: the back of a cabinet does."""
    middle = _middle(leaf.box, config)
    overlap = np.minimum(part.box.high, middle.high) - np.maximum(part.box.low, middle.low)
    return bool((overlap[_PLANE] > 0).all())


def _request(
    leaf: Part, on_it: Sequence[Part], found: FramedLeaves, asset: Asset, config: WindowConfig
) -> JointRequest | None:
    """Returns the joint of a leaf; None for one that stays where it is."""
    if found.is_fixed(leaf):
        return None
    attached = tuple(part.id for part in on_it)
    past = _past(leaf, found.leaves, config)
    if past is not None:
        side = _sliding_side(leaf, past)
        reach = float(abs(leaf.box.center - past.box.center) @ abs(DIRECTIONS[side]))
        axis = axis_of_motion(leaf, MotionChoice(Moves.SLIDES, side), asset.box)
        if _stays(leaf, found.leaves, config):
            return None
        return JointRequest(leaf.id, Slide.joint_type, axis, SOURCE, reach, attached=attached)
    side = _hinged_side(leaf, found, on_it, config)
    return turning_leaf(leaf, on_it, asset, side, _opens_backwards(leaf, found.frame, on_it, config))


def _past(leaf: Part, leaves: Sequence[Part], config: WindowConfig) -> Part | None:
    """Returns the leaf that a leaf slides past; None where it turns."""
    return next((other for other in leaves if other is not leaf and _laps(leaf, other, config)), None)


def _stays(leaf: Part, leaves: Sequence[Part], config: WindowConfig) -> bool:
    """Whether a leaf stays where it is as another slides past it: the upper sash, which the lower one passes."""
    past = _past(leaf, leaves, config)
    return past is not None and _sliding_side(leaf, past) is Side.BOTTOM


def _laps(leaf: Part, other: Part, config: WindowConfig) -> bool:
    """Whether two leaves stand in two planes and lap one another along one edge, or stand close side by side."""
    overlap = np.minimum(leaf.box.high, other.box.high) - np.maximum(leaf.box.low, other.box.low)
    apart = overlap[_DEPTH] <= config.lap * min(leaf.box.size[_DEPTH], other.box.size[_DEPTH])
    ratios = np.sort(overlap[_PLANE] / leaf.box.size[_PLANE])
    near = ratios[0] > config.lap or (ratios[0] >= -config.beside and ratios[1] >= config.level)
    return bool(apart and near and ratios[1] > config.lap)


def _sliding_side(leaf: Part, past: Part) -> Side:
    """Returns where a leaf slides past another: to its side, or up or down."""
    shift = past.box.center - leaf.box.center
    if abs(shift[_UP]) > abs(shift[_WIDTH]):
        return Side.TOP if shift[_UP] > 0 else Side.BOTTOM
    return Side.RIGHT if shift[_WIDTH] > 0 else Side.LEFT


def _hinged_side(leaf: Part, found: FramedLeaves, on_it: Sequence[Part], config: WindowConfig) -> Side:
    """Returns the edge away from the handle; without one the outer edge of several leaves, the upper one of a low one.

    A handle near a corner lies at the side: the leaf turns about an upright edge. A leaf between one that turns and one
    that is fixed hangs on the latter.
    """
    box, leaves = leaf.box, found.leaves
    small = [part.box for part in on_it if part.box.size.max() <= config.small * box.size[_PLANE].max()]
    for axis, sides in ((_WIDTH, (Side.LEFT, Side.RIGHT)), (_UP, (Side.BOTTOM, Side.TOP))):
        offsets = [float(one.center[axis] - box.center[axis]) for one in small]
        aside = sum(float(np.sign(offset)) for offset in offsets if abs(offset) >= config.aside * box.size[axis])
        if aside:
            return sides[0] if aside > 0 else sides[1]
    if box.size[_UP] < config.wide * box.size[_WIDTH] or _is_fanlight(leaf, leaves, config):
        return Side.TOP
    held = found.held_side(leaf, config.beside, config.level)
    if held is not None:
        return held
    middle = float(np.mean([one.box.center[_WIDTH] for one in leaves]))
    return Side.RIGHT if box.center[_WIDTH] > middle + config.rim * box.size[_WIDTH] else Side.LEFT


def _is_fanlight(leaf: Part, leaves: Sequence[Part], config: WindowConfig) -> bool:
    """Whether a leaf that is wider than high stands above a higher one of its width."""
    box = leaf.box
    if box.size[_UP] >= box.size[_WIDTH]:
        return False
    higher = [other.box for other in leaves if other.box.size[_UP] > box.size[_UP]]
    below = [b for b in higher if b.high[_UP] <= box.low[_UP]]
    laps = [min(box.high[_WIDTH], b.high[_WIDTH]) - max(box.low[_WIDTH], b.low[_WIDTH]) for b in below]
    return any(lap >= config.level * box.size[_WIDTH] for lap in laps)


def _opens_backwards(leaf: Part, frame: Part, on_it: Sequence[Part], config: WindowConfig) -> bool:
    """Whether a leaf opens away from the viewer: to the face of the frame that it is nearer to.

    In the middle of its frame it opens to the side of its handle, and without one to the viewer.
    """
    at_back = nearer_to_back(leaf, frame.box, config.flush)
    if at_back is not None:
        return at_back
    low, high = leaf.box.low[_DEPTH], leaf.box.high[_DEPTH]
    before = max((low - one.box.low[_DEPTH] for one in on_it), default=0.0)
    behind = max((one.box.high[_DEPTH] - high for one in on_it), default=0.0)
    return bool(behind > before)
