"""Joints without added hardware: doors on the hinges that are drawn, and the last resort where nothing finds room."""

from dataclasses import replace

import numpy as np

from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation, transform_points
from grafu.joints.framed_leaves import SOURCE as BY_SHAPE
from grafu.joints.gaps import gap_growth
from grafu.joints.hinge.search import DoorSearch
from grafu.joints.limits import PoseFunction
from grafu.joints.plan import JointRequest, MotionRole
from grafu.joints.rack_guides import GUIDE, rack_guides
from grafu.joints.racks import SOURCE as SHOWN
from grafu.joints.racks import is_grid
from grafu.joints.rail.body_region import is_shallow
from grafu.joints.rail.in_case import is_in_case
from grafu.joints.rail.search import DrawerSearch, slides_in_its_plane
from grafu.joints.report import Placement
from grafu.joints.support_block import nearest_part
from grafu.scene.border import part_axes
from grafu.scene.scene import Scene
from grafu.vocabulary import MechanismClass, PartLabel

NO_HARDWARE = "none"
"""`Placement.template` of a joint without hardware."""
_NOTE = "no hinge or rail finds room: it moves without hardware"
DRAWN = "drawn"
"""`Placement.template` of a door on the hinges, or a column in the sleeve, that the input has."""
_STATED = frozenset({SHOWN, "annotation", "user"})  # sources of requests that are no guess
_TRAVELS = 6  # of a rack, from its widest down to the least that counts as open
_DEPTHS = tuple(k / 16 for k in range(17))  # of a door's thickness, from its front: an axis along its border each
_RAYS = 24  # along each side of a drawer seen from above
_POSES = 5  # from closed to open in which it must be near what stands around it

_Search = DoorSearch | DrawerSearch


def door_on_drawn_hinges(axis: Axis, search: DoorSearch) -> Placement | None:
    """Returns the joint about the pin of drawn hinges, which carry it; None where the door is not free about it.

    Doors that turn may be in its way where they are closed: of two leaves with a rebate, one opens first.
    """
    motions = search.scene.joint_motions
    placement = _about(axis, search, frozenset(name for name, motion in motions.items() if motion.kind.turns))
    return None if placement is None else replace(placement, template=DRAWN, notes=())


def door_without_hardware(search: DoorSearch) -> Placement | None:
    """Returns the joint about the axis as asked for, or one along the door's border; None where the door is not free.

    It is None too where hardware was chosen, and where the door would come away from all static parts.
    """
    frame = search.frame
    border = [frame.axis_at(0.0, -ratio * frame.thickness) for ratio in _DEPTHS]
    axes = sorted((search.request.axis, *border), key=search.sinks)
    placements = (_about(axis, search) for axis in axes)
    return next((placement for placement in placements if placement is not None), None)


def _about(axis: Axis, search: DoorSearch, opening_first: frozenset[str] = frozenset()) -> Placement | None:
    upper = search.widest(axis, search.most)
    in_way = search.bodies_in_the_way(axis, upper)
    waits = search.request.source == BY_SHAPE  # what shape tells to move waits for what lies over it
    may_wait = waits or opening_first.issuperset(in_way)
    if not may_wait or upper < search.config.restricted * search.wanted:
        return None
    return _joint(search, axis, axis.rotation, upper, in_way)


def support_without_hardware(search: DoorSearch) -> Placement | None:
    """Returns the joint of what swings out below a leaf, on the pin that the table has: as asked for, or on its border.

    So turn the seat and the lid of a toilet. It is None where hardware was chosen, where it is not free, and where it
    would come away from all static parts. The leaf, while it hangs, may be in its way.
    """
    frame = search.frame
    found: list[Placement] = []
    gap = search.config.rack_gap if search.request.role is MotionRole.SEAT else 0.0
    for axis in (search.request.axis, *(frame.axis_at(0.0, -ratio * frame.thickness) for ratio in _DEPTHS)):
        upper = search.widest(axis, search.wanted)
        if upper < search.config.restricted * search.wanted or (found and upper <= found[0].upper):
            continue
        joint = _joint(search, axis, axis.rotation, upper, search.bodies_in_the_way(axis, upper), gap)
        found = found if joint is None else [replace(joint, template=DRAWN, notes=())]
        if found and upper >= search.wanted:
            break
    return found[0] if found else None


def drawer_without_hardware(search: DrawerSearch) -> Placement | None:
    """Returns the joint along the drawer's axis; None where it does not slide as far as a drawer should.

    It is None too for a single board, such as a front without a box, unless it is a sliding door; where hardware was
    chosen, where the drawer would come away from all static parts, and where it has no handle, is no open box, stands
    in no case, and only a guess states that it is a drawer: cases slide as freely.
    """
    frame, config, part = search.frame, search.config, search.scene.parts[search.request.moving]
    is_board = slides_in_its_plane(part.mesh, frame.slide, config.drawer)
    if is_board and part.label is PartLabel.DOOR:
        return _sliding_door(search)
    is_stated = part.label.is_movable or search.request.source in _STATED  # a guess alone makes no grid a rack
    if search.request.role is MotionRole.BIN or (is_stated and is_grid(search.scene.moving_mesh(part.id))):
        return _rack(search)
    is_board = is_board or frame.width < config.no_hardware_width * frame.depth or is_shallow(frame, config.drawer)
    is_box = not is_board and is_open_box(search.scene.moving_mesh(part.id), config.no_hardware_open)
    stands = not is_board and not is_box and is_in_case(search.frame, search.static_rays)
    if is_board or not (stands or _is_sure(search, is_box)):
        return None
    upper = search.travel(search.reach)
    wanted = min(search.request.reference or search.wanted, search.reach)
    if upper < config.restricted * wanted:
        return None
    gap = config.no_hardware_box_gap if is_box or stands else config.no_hardware_gap
    return _joint(search, search.axis, search.motion, upper, search.bodies_in_the_way(upper), gap)


def is_open_box(mesh: TriangleMesh, least: float) -> bool:
    """Whether most of a drawer's middle shows a floor from above: a box with walls, whatever its front is.

    Args:
        mesh: the drawer, in metres, Z up.
        least: what of the rays from above meet it below its middle (fraction).
    """
    box = mesh.box
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    origins = np.column_stack([box.low[:2] + places * box.size[:2], np.full(len(places), box.high[2] + box.size[2])])
    depths = RayCaster(mesh).along(origins, np.array([0.0, 0.0, -1.0])) - box.size[2]
    return bool(np.mean(np.isfinite(depths) & (depths > box.size[2] / 2)) >= least)


def _rack(search: DrawerSearch) -> Placement | None:
    """Returns the joint of a rack or a bin, which runs on its own wheels and guides; they are seldom drawn.

    What stands too far off all static parts to be held by them gets guides at both its sides, if these have a place.
    """
    scene, request, config = search.scene, search.request, search.config
    wanted = min(request.reference or search.wanted, search.reach)
    upper = _guided_travel(search, search.travel(search.reach))
    if upper < config.restricted * wanted or str(request.choice):
        return None
    reach = config.rack_gap * scene.extent
    mount = _nearest(scene, request, reach)
    if not mount:
        return None
    joint = _without(search.axis, upper, mount, search.bodies_in_the_way(upper), DRAWN, ())
    if _stays_near(scene, request, search.motion, upper, config.no_hardware_gap * scene.extent):
        return joint
    guides, held = rack_guides(search, upper, reach)
    if not guides:
        return joint
    mount = nearest_part(guides[0], scene, request, config.block) or mount
    return replace(
        joint, upper=held, mechanism=MechanismClass.CENTRE, template=GUIDE, count=2, mount=mount, static=guides
    )


def _guided_travel(search: DrawerSearch, upper: float) -> float:
    """Returns how far a rack slides before it leaves what it runs beside; all the way if it does so at once."""
    scene, moving = search.scene, search.request.moving
    own = [MeshCollider(scene.moving_mesh(moving))]
    held = [obstacle.collider for obstacle in scene.static_obstacles_of(search.request.holders)]
    allowed = search.config.no_hardware_gap * scene.extent
    for travel in np.linspace(upper, search.config.restricted * upper, _TRAVELS):
        if gap_growth(own, held, search.motion, float(travel), is_slide=True) <= allowed:
            return float(travel)
    return upper


def _sliding_door(search: DrawerSearch) -> Placement | None:
    """Returns the joint of a sliding door in what guides it, which the model has: a track, a pocket, a frame."""
    if not _is_guided(search):
        return None
    wanted = min(search.request.reference or search.reach, search.reach)
    upper = search.travel(wanted)
    if upper < search.config.restricted * wanted:
        return None
    return _joint(search, search.axis, search.motion, upper, search.bodies_in_the_way(upper))


def _is_guided(search: DrawerSearch) -> bool:
    """Whether something static is near both edges of a leaf along its way, or both its faces."""
    scene, mesh = search.scene, search.scene.parts[search.request.moving].mesh
    axes, near = part_axes(mesh), search.config.no_hardware_gap * search.scene.extent
    local = Box.around(mesh.vertices @ axes)
    along = int(np.argmax(np.abs(search.axis.direction @ axes)))

    def is_near(axis: int, end: float) -> bool:
        low, high = local.low.copy(), local.high.copy()
        low[axis] = high[axis] = end
        side = TriangleMesh.box_mesh(Box(low, high)).transformed(from_rotation(axes))
        return scene.is_near_static(side, near, search.request.holders)

    return any(is_near(k, local.low[k]) and is_near(k, local.high[k]) for k in range(3) if k != along)


def _is_sure(search: DrawerSearch, is_box: bool) -> bool:
    """Whether the input states a drawer, or it is an open box or has a handle, and is not as wide as the furniture."""
    scene, moving = search.scene, search.scene.moving_bodies[search.request.moving]
    if scene.parts[moving.id].label.is_movable:
        return True
    across = int(np.argmin(np.abs(search.axis.direction[:2])))
    whole = Box.enclosing(part.box for part in scene.parts.values()).size[across]
    is_between = scene.parts[moving.id].box.size[across] < search.config.no_hardware_wide * whole
    return (is_box or len(moving.members) > 1) and bool(is_between)


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


def leaf_without_hardware(search: DrawerSearch) -> Placement | None:
    """Returns the joint of a leaf that makes a table longer, on the frame that the table has.

    It is None in the cases of `lift_without_hardware`. The leaf comes out as far as was asked for, whatever rails give.
    """
    wanted = search.request.reference or search.reach
    upper = search.travel(wanted)
    if upper < search.config.restricted * wanted:
        return None
    joint = _joint(search, search.axis, search.motion, upper, search.bodies_in_the_way(upper))
    return None if joint is None else replace(joint, template=DRAWN, notes=())


def _joint(
    search: _Search, axis: Axis, motion: PoseFunction, upper: float, in_way: tuple[str, ...], gap: float = 0.0
) -> Placement | None:
    request, scene = search.request, search.scene
    near = (gap or search.config.no_hardware_gap) * scene.extent
    if str(request.choice) or not _stays_near(scene, request, motion, upper, near):
        return None
    return _without(axis, upper, _nearest(scene, request, near), in_way, NO_HARDWARE, (_NOTE,))


def _without(
    axis: Axis, upper: float, mount: str, in_way: tuple[str, ...], template: str, notes: tuple[str, ...]
) -> Placement:
    return Placement(
        axis=axis,
        upper=upper,
        mechanism=MechanismClass.NONE,
        template=template,
        mount=mount,
        count=0,
        dynamic=(),
        static=(),
        in_way=in_way,
        notes=notes,
    )


def _stays_near(scene: Scene, request: JointRequest, motion: PoseFunction, upper: float, near: float) -> bool:
    """Whether a moving body stays within a distance of what may hold it, in metres, from closed to open."""
    body, holders = MeshCollider(scene.moving_mesh(request.moving)), scene.static_obstacles_of(request.holders)

    def is_near(value: float) -> bool:
        body.place(motion(value))
        path = Box.around(transform_points(motion(value), body.box.corners()))
        return any(body.is_within(near, holder.collider) for holder in holders.near(path, near))

    return all(is_near(float(value)) for value in np.linspace(0, upper, _POSES))


def _nearest(scene: Scene, request: JointRequest, near: float) -> str:
    """Returns a part within a distance, in metres, of those that may hold a moving body; a wanted mount first."""
    mesh = scene.moving_mesh(request.moving)
    may_hold = (obstacle.id for obstacle in scene.static_obstacles_of(request.holders).near(mesh.box, near))
    names = [name for name in may_hold if scene.is_near_static(mesh, near, (name,))]
    return min(names, key=lambda name: (name not in request.mounts, name), default="")
