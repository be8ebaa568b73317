"""Drawers drawn as a front and the boards of their box, apart: the box goes with its front, and both slide out.

The boards may touch the case that they stand in, as models without clearances have them, so contacts do not tell them
from it. What does: they begin right behind the front, well within its outline, are a bottom between two sides, open
from above, and stand between walls. They are found by boxes and rays, so fronts turned about Z stay as predicted.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, depths_below, stands_between_walls
from grafu.graph.edges import Slide
from grafu.joints.behind_fronts import is_within_outline
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a front with a drawer's box behind it: the box shows that it slides."""
_WIDTH, _DEPTH, _UP = 0, 1, 2
_OUT = vec3(0.0, -1.0, 0.0)
_RAYS = 16  # along each side of an outline


@final
@dataclass(frozen=True)
class BoxBehindConfig:
    """What counts as the box of a drawer behind its front; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("clear", "reach", "slack", "beside")
    plate: float = 0.25
    """Greatest thickness of a front (fraction of its shorter other side): what is thicker has a box of its own."""
    out: float = 0.9
    """From this cosine on to the direction that it faces a front slides out."""
    clear: float = 0.006
    """The box stays this far within the outline of its front (metres): what comes nearer to it is the case."""
    reach: float = 0.02
    """How far behind the front its boards begin at most (metres)."""
    slack: float = 0.002
    """How far a board may stand out of the outline of those that begin there (metres)."""
    beside: float = 0.06
    """How far beside the box a wall of the case stands at most (metres)."""
    along: float = 0.5
    """Along how much of its depth such walls stand at least (fraction)."""
    wall: float = 0.5
    """Boards of a box that are this high are its walls (fraction of the highest one's)."""
    deep: float = 0.4
    """Least depth of the box (fraction of the depth of the whole)."""
    wide: float = 0.6
    """Least width of the box (fraction of the front's) ..."""
    tall: float = 0.35
    """... and its least height (fraction of the front's)."""
    open: float = 0.5
    """What of its outline, seen from above, is open down to its lower half at least (fraction)."""
    floor: float = 0.7
    """What of its outline, seen from above, has a bottom at least (fraction)."""
    walls: float = 0.7
    """What of its outline, seen from its sides, is covered at least (fraction)."""
    front: float = 0.3
    """What of its middle a front of its own covers at most, where the part before it was to turn (fraction)."""
    middle: float = 0.6
    """How wide and high this middle is (fraction of the box)."""

    def __post_init__(self) -> None:
        require_positive(self, "clear", "reach", "slack", "beside")
        require_ratios(
            self, "plate", "out", "along", "deep", "wide", "tall", "open", "floor", "walls", "wall", "front", "middle"
        )


def with_boxes_behind(
    plan: RealizationPlan, asset: Asset, settled: Collection[str] = (), config: BoxBehindConfig = BoxBehindConfig()
) -> RealizationPlan:
    """Returns the plan in which a front with the box of a drawer behind it slides out with that box.

    A front that turns does so where the box has no front of its own: that of a tray behind a door stays in the case.
    Boards of a box that were guessed to move by themselves do not. `settled` are the parts whose motions the user
    states.
    """
    config = at_scale(config, metre_on(asset.extent))
    made = {request.moving: request for request in plan.joints}
    for request in plan.joints:
        if request.moving in settled or request.moving not in made or not _may_have_box(request, asset, config):
            continue
        box = _box_of(request, asset, made, config)
        if not box:
            continue
        own = [name for part in box if part in made for name in made[part].attached]
        made = {name: _without(other, box) for name, other in made.items() if name not in box}
        made[request.moving] = _sliding(request, asset, (*box, *(name for name in own if name not in box)))
    return replace(plan, joints=tuple(made[r.moving] for r in plan.joints if r.moving in made))


def _without(request: JointRequest, gone: Collection[str]) -> JointRequest:
    """Returns a request without what moves with another part now."""
    if not set(request.attached) & set(gone):
        return request
    return replace(request, attached=tuple(name for name in request.attached if name not in gone))


def _may_have_box(request: JointRequest, asset: Asset, config: BoxBehindConfig) -> bool:
    """Whether a request moves a plate that faces -Y, alone: it turns, or slides out."""
    front = asset.part(request.moving).box
    plate = front.size[_DEPTH] <= config.plate * min(front.size[_WIDTH], front.size[_UP])
    out = not request.kind.slides or float(request.axis.direction @ _OUT) >= config.out
    return bool(plate and out and not request.parent and request.coupling is None)


def _box_of(
    request: JointRequest, asset: Asset, made: Mapping[str, JointRequest], config: BoxBehindConfig
) -> tuple[str, ...]:
    """Returns the ids of the parts that are the box behind a front, in order; none where there is no such box."""
    own, front = {request.moving, *request.attached}, asset.part(request.moving).box
    others = {part.id: part.box for part in asset.parts if part.id not in own and _is_loose(part.id, asset, made)}
    within = {name: box for name, box in others.items() if _is_behind(box, front, config)}
    starts = [box for box in within.values() if box.low[_DEPTH] - front.high[_DEPTH] <= config.reach]
    boards = [box for box in starts if box.size[_DEPTH] >= config.deep * asset.box.size[_DEPTH]]
    if not boards or not _fills(hull := Box.enclosing(boards), front, config):
        return ()
    around = Box(np.minimum(hull.low, (np.inf, front.low[_DEPTH], np.inf)), hull.high).grown(config.slack)
    through = {name: box for name, box in others.items() if is_within_outline(box, front, config.clear)}  # screws, too
    inside = {name: box for name, box in through.items() if around.contains(box.corners()).all()}
    on_case = _on_case(inside, [box for name, box in others.items() if name not in inside], boards, config)
    held = tuple(name for name in inside if name not in on_case)
    mesh = merge_meshes([asset.part(name).mesh for name in held])
    walls = [asset.part(name) for name in others if name not in held]
    is_box = _is_box(mesh, config) and _stands_between(mesh.box, walls, config)
    has_front = is_box and request.kind.turns and _front_ratio(mesh, config) > config.front
    return held if is_box and not has_front else ()


def _on_case(
    inside: Mapping[str, Box], around: Sequence[Box], boards: Sequence[Box], config: BoxBehindConfig
) -> set[str]:
    """Returns the parts beside the walls of a box that lie on the case and not on it: the outer profiles of rails."""
    height = config.wall * max(box.size[_UP] for box in boards)
    walls = Box.enclosing(box for box in boards if box.size[_UP] >= height)
    found = set[str]()
    for name, box in inside.items():
        beside = max(walls.low[_WIDTH] - box.high[_WIDTH], box.low[_WIDTH] - walls.high[_WIDTH])
        if beside > config.slack and any(other.gap(box) <= config.slack for other in around):
            found.add(name)
    return found


def _is_loose(name: str, asset: Asset, made: Mapping[str, JointRequest]) -> bool:
    """Whether a part stays, or moves on its own by a mere guess and may be a board of something else."""
    part = asset.part(name)
    return part.label is PartLabel.UNKNOWN if name in made else not part.label.is_movable


def _is_behind(box: Box, front: Box, config: BoxBehindConfig) -> bool:
    return bool(is_within_outline(box, front, config.clear) and box.low[_DEPTH] >= front.high[_DEPTH] - config.slack)


def _fills(hull: Box, front: Box, config: BoxBehindConfig) -> bool:
    """Whether what begins behind a front is as wide and high as the box of a drawer."""
    wide, tall = config.wide * front.size[_WIDTH], config.tall * front.size[_UP]
    return bool(hull.size[_WIDTH] >= wide and hull.size[_UP] >= tall)


def _is_box(mesh: TriangleMesh, config: BoxBehindConfig) -> bool:
    """Whether boards are open from above down to their lower half, with a bottom, and closed at both sides."""
    rays, box = RayCaster(mesh), mesh.box
    if not (box.size > 0).all():
        return False
    above = float(box.size.max())
    depths = depths_below(rays, box, _UP, _RAYS, above)
    deep = np.isfinite(depths) & (depths >= float(box.size[_UP]) / 2)
    if float(deep.mean()) < config.open or float(np.isfinite(depths).mean()) < config.floor:
        return False
    near = float(box.size[_WIDTH]) / 2
    sides = (depths_below(RayCaster(one), box, _WIDTH, _RAYS, above) for one in (mesh, _mirrored(mesh, _WIDTH)))
    return all(float((side <= near).mean()) >= config.walls for side in sides)


def _mirrored(mesh: TriangleMesh, axis: int) -> TriangleMesh:
    """Returns a mesh with its two ends along an axis exchanged, in its own box."""
    vertices = mesh.vertices.copy()
    vertices[:, axis] = mesh.box.low[axis] + mesh.box.high[axis] - vertices[:, axis]
    return TriangleMesh(vertices, mesh.faces[:, ::-1])


def _stands_between(box: Box, others: Sequence[Part], config: BoxBehindConfig) -> bool:
    """Whether walls of other parts stand close to a box at its left and at its right, along much of its depth."""
    around = box.grown(config.beside)
    near = [part.mesh for part in others if part.box.overlaps(around)]
    if not near:
        return False
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = [(axis, box.low[axis] + steps * box.size[axis]) for axis in (_DEPTH, _UP)]
    reach = float(box.half[_WIDTH]) + config.beside
    both = stands_between_walls(RayCaster(merge_meshes(near)).along, box.center, places[0], places[1], reach)
    return float(both.mean()) >= config.along


def _front_ratio(mesh: TriangleMesh, config: BoxBehindConfig) -> float:
    """Returns what of the middle of a box is closed right behind the part before it (fraction)."""
    box = mesh.box
    middle = Box.from_center(box.center, box.half * np.array([config.middle, 1.0, config.middle]))
    depths = depths_below(RayCaster(_mirrored(mesh, _DEPTH)), middle, _DEPTH, _RAYS, float(box.size.max()))
    return float((depths <= config.reach + config.slack).mean())


def _sliding(request: JointRequest, asset: Asset, box: tuple[str, ...]) -> JointRequest:
    """Returns the request of a front as that of the drawer that it is, with its box."""
    attached = (*request.attached, *box)
    if request.kind.slides:
        return replace(request, attached=attached)
    axis = Axis(asset.part(request.moving).box.center, _OUT)
    return JointRequest(request.moving, Slide.joint_type, axis, SOURCE, attached=attached, choice=request.choice)
