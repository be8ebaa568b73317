"""Doors of buildings: leaves in a frame that stands on the floor. They turn about the edge away from their handles.

They are found by shape alone: a slim piece of a door's height, a frame around it that is open at the floor, and upright
boards that reach down to it within. A frame may stand in another one, and what is beside all leaves stays.
"""

from collections.abc import Iterator, Sequence
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.raycast import RayCaster, covered_ratio
from grafu.graph.edges import Slide
from grafu.joints.door_grips import grasped_side, hinged_side
from grafu.joints.framed_leaves import SOURCE, FramedLeaves, nearer_to_back, relabelled, turning_leaf
from grafu.joints.motion_choice import Side
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.border import part_axes
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2
_RAYS = 12  # along each side of a leaf


@final
@dataclass(frozen=True)
class BuildingDoorConfig:
    """What counts as a door of a building.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    tall: float = 1.6
    """Least height of the whole (m, by the unit of the input): doors are made for people."""
    slim: float = 0.5
    """Greatest depth of the whole, a leaf drawn ajar with it (fraction of its height)."""
    shallow: float = 0.15
    """Greatest depth of the frame (fraction of the height of the whole)."""
    before: float = 0.15
    """How far handles stand out before and behind their leaf at most (fraction of its width)."""
    around: float = 0.65
    """What of the width of the whole the frame spans at least (fraction); of its height it spans nearly all."""
    high: float = 0.95
    """What of the height of the whole the frame spans at least (fraction)."""
    solid: float = 0.95
    """What covers more than this of its own outline, seen from before it, is a board and no frame (fraction)."""
    open: float = 0.1
    """What of a leaf the frame covers at most, seen from before it (fraction)."""
    leaf: float = 0.6
    """Least height of a leaf (fraction of the height of the whole)."""
    half: float = 0.25
    """Least height of each of two leaves that stand one above the other (fraction of the height of the whole)."""
    thin: float = 0.3
    """Greatest thickness of a leaf (fraction of its width)."""
    threshold: float = 0.05
    """How high above the floor a leaf ends at most (fraction of the height of the whole)."""
    sill: float = 0.01
    """How high above a frame around it a leaf ends at most (fraction of the height of the whole): rails are higher."""
    beside: float = 0.15
    """Greatest side of what is beside a leaf: buttons, a lamp (fraction of the height of the whole)."""
    touch: float = 0.002
    """What reaches into the outline of a leaf by so much at most (fraction of the height of the whole) touches it."""
    small: float = 0.3
    """Greatest side of what is on a nameless leaf without a frame (fraction of the leaf's height)."""
    aside: float = 0.2
    """Its handle is this far to one side of the leaf's middle at least (fraction of the leaf's width); a leaf that
    stands out of its frame by as much slides."""
    garage: float = 1.7
    """A single leaf that is so wide hangs from its upper edge, as of a garage (m): no side hinges would carry it."""
    near: float = 0.15
    """What stands beside a leaf is no farther from it than this (fraction of the leaf's width) ..."""
    level: float = 0.8
    """... along this much of its height (fraction): a leaf hangs on nothing that turns itself."""
    hand: tuple[float, float] = (0.3, 0.65)
    """A handle of a leaf without a frame is between these heights (fractions of the leaf's height) ..."""
    out: float = 0.01
    """... and stands out of it by this much at least (fraction of its height)."""
    flush: float = 0.1
    """A leaf is nearer to one face of the frame if the two gaps differ by this much (fraction of the frame's depth)."""

    def __post_init__(self) -> None:
        require_positive(self, "tall", "garage")
        require_ratios(self, *(name for name in self.__dataclass_fields__ if name not in ("tall", "garage", "hand")))
        if not 0 <= self.hand[0] <= self.hand[1] <= 1:
            raise ValueError(f"`BuildingDoorConfig.hand` must be two rising fractions: got {self.hand}")


def building_door(asset: Asset, config: BuildingDoorConfig = BuildingDoorConfig()) -> FramedLeaves | None:
    """Returns the door that an asset is; None where it is another piece, or has parts that no door has."""
    frame = _frame(asset, config)
    if frame is None:
        return None
    boards = list(_boards(frame, asset, config))
    inner = tuple(board for board in boards if _is_around(board, boards, asset.box, config))
    leaves = tuple(_outermost([board for board in boards if board not in inner]))
    if not leaves:
        return None
    others = [part for part in asset.parts if part not in (frame, *inner, *leaves)]
    on_leaf = tuple(tuple(part for part in others if is_on_leaf(part, leaf, config)) for leaf in leaves)
    known = {part.id for parts in on_leaf for part in parts}
    left = (part for part in others if part.id not in known)
    stay = all(_is_beside(part, leaf.box, asset.box, config) for part in left for leaf in leaves)
    return FramedLeaves(frame, leaves, on_leaf, inner) if stay else None


def with_door_labels(asset: Asset, config: BuildingDoorConfig = BuildingDoorConfig()) -> Asset:
    """Returns the asset in which the leaves of a door in its frame are doors, and the frame is none; else itself.

    Labels that the user gave stay.
    """
    found = building_door(asset, config)
    if found is None:
        return asset
    labels = dict.fromkeys((frame.id for frame in (found.frame, *found.inner_frames)), PartLabel.FACE_FRAME)
    labels |= {leaf.id: PartLabel.FACE_FRAME if found.is_fixed(leaf) else PartLabel.DOOR for leaf in found.leaves}
    return relabelled(asset, labels)


def with_building_doors(
    plan: RealizationPlan, asset: Asset, config: BuildingDoorConfig = BuildingDoorConfig()
) -> RealizationPlan:
    """Returns the plan in which the leaves of a door in its frame turn; the plan itself for any other piece.

    A leaf that the plan slides keeps its motion. A single leaf without handles turns about the edge that the plan has.
    What is on a leaf goes with it. Where some leaves are called doors, the others stay.
    """
    found = building_door(asset, config)
    if found is None:
        return plan
    predicted = {r.moving: r for r in plan.joints}

    def request(leaf: Part, on_it: Sequence[Part]) -> JointRequest | None:
        planned = predicted.get(leaf.id)
        if found.is_fixed(leaf):
            return None
        if planned is not None and planned.kind.slides:
            return planned
        return _request(leaf, on_it, found, planned, asset, config)

    return found.with_joints(plan, asset, request)


def _frame(asset: Asset, config: BuildingDoorConfig) -> Part | None:
    """Returns the part that stands around a door; None where the whole is no door's size, or no part does."""
    size = asset.box.size
    if size[_UP] < config.tall or size[_DEPTH] > config.slim * size[_UP]:
        return None
    frames = (
        part
        for part in asset.parts
        if part.box.size[_WIDTH] >= config.around * size[_WIDTH]
        and part.box.size[_UP] >= config.high * size[_UP]
        and part.box.size[_DEPTH] <= config.shallow * size[_UP]
        and covered_ratio(RayCaster(part.mesh), part.box, _DEPTH, _RAYS, asset.box.diagonal) <= config.solid
    )
    return max(frames, key=lambda part: float(np.prod(part.box.size[[_WIDTH, _UP]])), default=None)


def _boards(frame: Part, asset: Asset, config: BuildingDoorConfig) -> Iterator[Part]:
    """Yields the upright boards within a frame that end near the floor, the largest first."""
    rays = RayCaster(frame.mesh)
    stacked = _stacked([part for part in asset.parts if part is not frame], asset.box, config)
    for part in sorted(asset.parts, key=lambda part: -float(np.prod(part.box.size[[_WIDTH, _UP]]))):
        is_within = part is not frame and (_is_board(part, asset.box, config) or part.id in stacked)
        if is_within and _is_open_before(rays, part, asset.box.diagonal, config):
            yield part


def _stacked(parts: Sequence[Part], whole: Box, config: BuildingDoorConfig) -> set[str]:
    """Returns the two leaves of a door that is divided: alike in plan, one above the other, together as high as one."""
    halves = [part for part in parts if _is_half(part, whole, config)]
    near, floor = config.sill * whole.size[_UP], whole.low[_UP] + config.threshold * whole.size[_UP]
    found = set[str]()
    for low in (part for part in halves if part.box.low[_UP] <= floor):
        for high in (part for part in halves if abs(part.box.low[_UP] - low.box.high[_UP]) <= near):
            off = np.abs([high.box.low - low.box.low, high.box.high - low.box.high])[:, :_UP]
            is_alike = bool((off <= near).all())
            is_high = high.box.high[_UP] - low.box.low[_UP] >= config.leaf * whole.size[_UP]
            found |= {low.id, high.id} if is_alike and is_high else set()
    return found


def _is_half(part: Part, whole: Box, config: BuildingDoorConfig) -> bool:
    box, least = Box.around(part.mesh.vertices @ part_axes(part.mesh)), config.half * whole.size[_UP]
    thin = np.sort(box.size)[0] <= config.thin * np.sort(box.size)[1]
    return bool(thin and least <= part.box.size[_UP] < config.leaf * whole.size[_UP])


def _is_open_before(frame: RayCaster, leaf: Part, above: float, config: BuildingDoorConfig) -> bool:
    return covered_ratio(frame, leaf.box, _DEPTH, _RAYS, above) <= config.open


def _is_around(board: Part, boards: Sequence[Part], whole: Box, config: BuildingDoorConfig) -> bool:
    """Whether a board is a frame in which others stand, within another frame; a leaf has a rail below its pane."""
    most = board.box.low[_UP] + config.sill * whole.size[_UP]
    inner = [other for other in boards if other is not board and _within(other.box, board.box)]
    if not any(other.box.low[_UP] <= most for other in inner):
        return False
    rays = RayCaster(board.mesh)
    return all(_is_open_before(rays, other, whole.diagonal, config) for other in inner)


def _outermost(boards: Sequence[Part]) -> Iterator[Part]:
    """Yields boards, the largest first, without those that lie within another."""
    found = list[Part]()
    for part in boards:
        if not any(_within(part.box, one.box) for one in found):
            found.append(part)
    yield from found


def _is_beside(part: Part, leaf: Box, whole: Box, config: BuildingDoorConfig) -> bool:
    """Whether a part lies beside a leaf, seen from before it: small, on the floor or above, and no drawer in a case."""
    shared = np.minimum(part.box.high, leaf.high) - np.maximum(part.box.low, leaf.low)
    if part.label.is_movable or np.all(shared[[_WIDTH, _UP]] > config.touch * whole.size[_UP]):
        return False
    lies = part.box.high[_UP] <= whole.low[_UP] + config.threshold * whole.size[_UP]
    return bool(lies or part.box.low[_UP] >= leaf.high[_UP] or part.box.size.max() <= config.beside * whole.size[_UP])


def _is_board(part: Part, whole: Box, config: BuildingDoorConfig) -> bool:
    """Whether a part is an upright board that ends near the floor; one drawn ajar is measured along its own sides."""
    box = Box.around(part.mesh.vertices @ part_axes(part.mesh))
    upright = part.box.size[_UP] >= config.leaf * whole.size[_UP]
    thin = np.sort(box.size)[0] <= config.thin * np.sort(box.size)[1]
    return bool(upright and thin and part.box.low[_UP] <= whole.low[_UP] + config.threshold * whole.size[_UP])


def _within(box: Box, other: Box) -> bool:
    return bool(np.all(box.low[[_WIDTH, _UP]] >= other.low[[_WIDTH, _UP]]) and np.all(box.high <= other.high))


def _request(
    leaf: Part,
    on_it: Sequence[Part],
    door: FramedLeaves,
    predicted: JointRequest | None,
    asset: Asset,
    config: BuildingDoorConfig,
) -> JointRequest:
    frame, leaves = door.frame, door.leaves
    attached = tuple(part.id for part in on_it)
    shift = float(leaf.box.center[_WIDTH] - frame.box.center[_WIDTH])
    beyond = max(frame.box.low[_WIDTH] - leaf.box.low[_WIDTH], leaf.box.high[_WIDTH] - frame.box.high[_WIDTH])
    if len(leaves) == 1 and beyond > config.aside * leaf.box.size[_WIDTH]:
        axis = Axis(leaf.box.center, vec3(np.copysign(1.0, shift), 0.0, 0.0))
        wide = float(leaf.box.size[_WIDTH])
        return JointRequest(leaf.id, Slide.joint_type, axis, SOURCE, wide, (), attached, abs(shift))
    if len(leaves) == 1 and leaf.box.size[_WIDTH] >= config.garage:
        return turning_leaf(leaf, on_it, asset, Side.TOP, bool(nearer_to_back(leaf, frame.box, config.flush)))
    above = [
        k for k, other in enumerate(leaves) if abs(other.box.center[_WIDTH] - leaf.box.center[_WIDTH]) <= config.touch
    ]
    side = _hinge_side(leaf, door, [part for k in above for part in door.on_leaf[k]], predicted, config)
    whole = Box.enclosing(part.box for part in (frame, *door.inner_frames))  # the casing before it is part of it
    return turning_leaf(leaf, on_it, asset, side, _opens_backwards(leaf, whole, on_it, config))


def _hinge_side(
    leaf: Part, door: FramedLeaves, on_it: Sequence[Part], predicted: JointRequest | None, config: BuildingDoorConfig
) -> Side:
    """Returns the edge about which a leaf turns: away from its handle; without one that which can hang on something."""
    held = None if grasped_side(leaf, on_it) else door.held_side(leaf, config.near, config.level)
    return held or hinged_side(leaf, door.leaves, on_it, predicted)


def _opens_backwards(leaf: Part, frame: Box, on_it: Sequence[Part], config: BuildingDoorConfig) -> bool:
    """Whether a leaf opens away from the viewer: to the face of the frame that it is nearer to.

    In the middle of its frame it opens to the viewer, unless what it is grasped by is on the viewer's side alone: that
    is the outer side of an entrance.
    """
    at_back = nearer_to_back(leaf, frame, config.flush)
    if at_back is not None:
        return at_back
    low, high = leaf.box.low[_DEPTH], leaf.box.high[_DEPTH]
    before = any(one.box.low[_DEPTH] < low - config.flush * leaf.box.size[_DEPTH] for one in on_it)
    behind = any(one.box.high[_DEPTH] > high + config.flush * leaf.box.size[_DEPTH] for one in on_it)
    return before and not behind


def is_on_leaf(part: Part, leaf: Part, config: BuildingDoorConfig) -> bool:
    """Whether a part lies within the outline of a leaf, seen from before it, and close to it; a threshold does not."""
    width = float(leaf.box.size[_WIDTH])
    is_below = part.box.high[_UP] <= leaf.box.low[_UP] + config.touch * leaf.box.size[_UP]
    if is_below and part.box.size[_DEPTH] > leaf.box.size[_DEPTH]:
        return False
    room = width * np.array([config.threshold, config.before, config.threshold])
    return bool(np.all(part.box.low >= leaf.box.low - room) and np.all(part.box.high <= leaf.box.high + room))
