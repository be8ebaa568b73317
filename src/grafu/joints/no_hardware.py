"""Joints without added hardware: doors on the hinges that are drawn, and the last resort where nothing finds room."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.components import connected_parts
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.hinge.search import DoorSearch
from grafu.joints.limits import PoseFunction
from grafu.joints.plan import JointRequest
from grafu.joints.rail.body_region import is_shallow
from grafu.joints.rail.search import DrawerSearch
from grafu.joints.report import Placement
from grafu.scene.scene import Scene
from grafu.vocabulary import MechanismClass

NO_HARDWARE = "none"
"""`Placement.template` of a joint without hardware."""
_NOTE = "no hinge or rail finds room: it moves without hardware"
DRAWN = "drawn"
"""`Placement.template` of a door on the hinges, or a column in the sleeve, that the input has."""
_DEPTHS = (0.0, 0.25, 0.5, 0.75, 1.0)  # of a door's thickness, from its front, at which an axis runs along its border
_POSES = 5  # from closed to open in which it must be near what stands around it

_Search = DoorSearch | DrawerSearch


@final
@dataclass(frozen=True, slots=True)
class _Barrel:
    """The barrel of a drawn hinge or a knuckle, in the border frame: its pin at (x, y), from `low` to `high`."""

    x: float
    y: float
    low: float
    high: float


def drawn_pin(search: DoorSearch) -> Axis | None:
    """Returns the common axis of round barrels along the door's border, shells of the door or of static parts.

    It is None where fewer than two lie on one line, where they are not spread along the border, and where hardware was
    chosen.
    """
    if str(search.request.choice):
        return None
    config = search.config.hinge.drawn
    barrels = [barrel for shell in _near_border(search) for barrel in _barrels(shell, search)]
    lines = [line for line in _lines(barrels, config.line) if len(line) > 1]
    least = config.spread * search.frame.length
    spread = [line for line in lines if max(b.high for b in line) - min(b.low for b in line) >= least]
    line = max(spread, key=len, default=None)
    return search.frame.axis_at(line[0].x, line[0].y) if line else None


def door_on_drawn_hinges(axis: Axis, search: DoorSearch) -> Placement | None:
    """Returns the joint about the pin of drawn hinges, which carry it; None where the door is not free about it."""
    placement = _about(axis, search)
    return None if placement is None else replace(placement, template=DRAWN, notes=())


def _near_border(search: DoorSearch) -> Iterator[TriangleMesh]:
    """Yields the shells near the door's border, of the door and all that rides on it and of static parts."""
    scene, frame = search.scene, search.frame
    reach = search.config.hinge.drawn.reach
    ids = [*scene.moving_bodies[search.request.moving].members, *(part.id for part in scene.static_parts)]
    for part in (scene.parts[name] for name in ids):
        box = Box.around(frame.to_border(part.box.corners()))
        if box.low[0] > reach or box.high[0] < -reach or len(part.mesh.faces) > search.config.carved_faces:
            continue
        yield from (shell for shell in connected_parts(part.mesh) if _is_at_border(shell, search, reach))


def _is_at_border(shell: TriangleMesh, search: DoorSearch, reach: float) -> bool:
    """Whether a shell lies within `reach` metres of the border line, all of it but its length."""
    frame, box = search.frame, Box.around(search.frame.to_border(shell.vertices))
    is_beside = box.low[0] >= -reach and box.high[0] <= reach
    is_level = box.low[1] >= -frame.thickness - reach and box.high[1] <= reach
    return bool(is_beside and is_level)


def _barrels(shell: TriangleMesh, search: DoorSearch) -> Iterator[_Barrel]:
    """Yields the shell as a barrel, if it is a cylinder along the border with the radius of a hinge's."""
    local = search.frame.to_border(shell.vertices)
    box = Box.around(local)
    radius = float(box.size[:2].max()) / 2
    config = search.config.hinge.drawn
    if not config.thinnest <= radius <= config.thickest or box.size[2] < radius:
        return
    x, y = float(box.center[0]), float(box.center[1])
    off = np.hypot(local[:, 0] - x, local[:, 1] - y)
    is_rim = off > config.cap * radius
    on_rim = np.abs(off[is_rim] - radius) <= (1 - config.round) * radius
    if len(on_rim) >= config.corners and np.count_nonzero(on_rim) >= config.round * len(on_rim):
        yield _Barrel(x, y, float(box.low[2]), float(box.high[2]))


def _lines(barrels: Sequence[_Barrel], within: float) -> list[list[_Barrel]]:
    """Returns the barrels that have one pin line, together."""
    lines: list[list[_Barrel]] = []
    for one in barrels:
        same = (line for line in lines if np.hypot(one.x - line[0].x, one.y - line[0].y) <= within)
        line = next(same, None)
        if line is None:
            lines.append([one])
        else:
            line.append(one)
    return lines


def door_without_hardware(search: DoorSearch) -> Placement | None:
    """Returns the joint about the axis as asked for, or one along the door's border; None where the door is not free.

    It is None too where hardware was chosen, and where the door would come away from all static parts.
    """
    frame = search.frame
    border = [frame.axis_at(0.0, -ratio * frame.thickness) for ratio in _DEPTHS]
    placements = (_about(axis, search) for axis in (search.request.axis, *border))
    return next((placement for placement in placements if placement is not None), None)


def _about(axis: Axis, search: DoorSearch) -> Placement | None:
    upper = search.widest(axis, search.most)
    in_way = search.bodies_in_the_way(axis, upper)
    if in_way or upper < search.config.restricted * search.wanted:
        return None
    return _joint(search, axis, axis.rotation, upper, ())


def drawer_without_hardware(search: DrawerSearch) -> Placement | None:
    """Returns the joint along the drawer's axis; None where it does not slide as far as a drawer should.

    It is None too for a single board, such as a front without a box, where hardware was chosen, where the drawer would
    come away from all static parts, and where only a guess states that it is a drawer: cases slide as freely.
    """
    frame, config = search.frame, search.config
    is_board = frame.width < config.no_hardware_width * frame.depth or is_shallow(frame, config.drawer)
    if is_board or not search.scene.parts[search.request.moving].label.is_movable:
        return None
    upper = search.travel(search.reach)
    wanted = min(search.request.reference or search.wanted, search.reach)
    if upper < config.restricted * wanted:
        return None
    return _joint(search, search.axis, search.motion, upper, search.bodies_in_the_way(upper))


def lift_without_hardware(search: DrawerSearch) -> Placement | None:
    """Returns the joint of a column that slides up or down in what guides it.

    It is None where hardware was chosen, where the column is not free, and where it would leave its guide.
    """
    wanted = min(search.request.reference or search.wanted, search.reach)
    upper = search.travel(wanted)
    if upper < search.config.restricted * wanted:
        return None
    joint = _joint(search, search.axis, search.motion, upper, ())
    return None if joint is None else replace(joint, template=DRAWN, notes=())


def _joint(
    search: _Search, axis: Axis, motion: PoseFunction, upper: float, in_way: tuple[str, ...]
) -> Placement | None:
    request, scene = search.request, search.scene
    near = search.config.no_hardware_gap * scene.extent
    if str(request.choice) or not _stays_near(scene, request, motion, upper, near):
        return None
    return Placement(
        axis=axis,
        upper=upper,
        mechanism=MechanismClass.NONE,
        template=NO_HARDWARE,
        mount=_nearest(scene, request, near),
        count=0,
        dynamic=(),
        static=(),
        in_way=in_way,
        notes=(_NOTE,),
    )


def _stays_near(scene: Scene, request: JointRequest, motion: PoseFunction, upper: float, near: float) -> bool:
    """Whether a moving body stays within a distance of what may hold it, in metres, from closed to open."""
    mesh, values = scene.moving_mesh(request.moving), np.linspace(0, upper, _POSES)
    return all(scene.is_near_static(mesh.transformed(motion(value)), near, request.holders) for value in values)


def _nearest(scene: Scene, request: JointRequest, near: float) -> str:
    """Returns a part within a distance, in metres, of those that may hold a moving body; a wanted mount first."""
    mesh = scene.moving_mesh(request.moving)
    may_hold = (obstacle.id for obstacle in scene.static_obstacles_of(request.holders))
    names = [name for name in may_hold if scene.is_near_static(mesh, near, (name,))]
    return min(names, key=lambda name: (name not in request.mounts, name), default="")
