"""Is a fitted hinge in anything's way, and does it hold on to both of its parts.

What cuts into parts is no hinge at all; one that another door or drawer would run into is returned with their names.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.joints.config import BlockConfig
from grafu.joints.hinge.candidates import FittedHinge, PinCandidate
from grafu.joints.hinge.neighbours import Neighbour
from grafu.joints.hinge_config import FootingConfig, HingeConfig
from grafu.joints.limits import PoseFunction, in_the_way, is_free, swept_box
from grafu.joints.support_block import METAL, Footing, block, resting_width, shortest_bridge
from grafu.scene.border import BorderFrame
from grafu.scene.obstacles import Obstacle
from grafu.scene.reads import Read, note_box
from grafu.scene.scene import Scene
from grafu.templates.template import SnapPlane

_POSES = 11

FLOOR = "the floor"
"""What strikes a hinge that reaches below what the furniture stands on; no part has this name."""
PACKED, HANGING, LOOSE = "a thick block", "a leaf in the air", "a disc beside what carries it"
"""What speaks against a hinge as if others struck it: a block too thick, too little below a leaf, a pivot too wide."""
ONE_END = "a disc at one end alone"
"""The same of a door that a pivot carries at one of its ends, and nothing at the other."""
FLAWS = frozenset((FLOOR, PACKED, HANGING, LOOSE, ONE_END))
WEAK = frozenset((LOOSE, ONE_END))  # worse than all other flaws: it hardly carries a door
OF_PLACE = frozenset((PACKED, HANGING))  # the same for all templates of a class


@final
@dataclass(frozen=True, eq=False)
class HingeSite:
    """What hinge hardware is tested against: the door, static parts, the other moving bodies and their motions.

    `holders` are the parts that alone may hold it (empty: any); `beside` is the door's moving hardware placed so far.
    """

    moving: str
    frame: BorderFrame
    door: TriangleMesh
    door_body: SweptBody
    scene: Scene
    static_rays: RayCaster
    door_rays: RayCaster
    obstacles: tuple[Obstacle, ...]
    neighbours: tuple[Neighbour, ...]
    motion: PoseFunction
    upper: float
    depth: float
    anchor: float
    reach: float
    config: HingeConfig
    block: BlockConfig
    holders: tuple[str, ...] = ()
    beside: tuple[TriangleMesh, ...] = ()


@final
@dataclass(frozen=True)
class InstalledHinge:
    """One hinge with its support blocks, found to hold on both sides and to cut into no part.

    `struck_by` names the other moving bodies that would run into it along their path, and its own where its ends cut
    into one another; besides, what speaks against it (`FLAWS`). `packed` is the length of its longest support block.
    """

    static: tuple[Visual, ...]
    dynamic: tuple[Visual, ...]
    struck_by: tuple[str, ...] = ()
    packed: float = 0.0

    @property
    def static_meshes(self) -> list[TriangleMesh]:
        """The meshes of the static end."""
        return [visual.mesh for visual in self.static]

    @property
    def dynamic_meshes(self) -> list[TriangleMesh]:
        """The meshes of the moving end."""
        return [visual.mesh for visual in self.dynamic]


def install(hinge: FittedHinge, pin: PinCandidate, site: HingeSite) -> InstalledHinge | None:
    """Returns the hinge anchored on both sides; None where it finds no hold or gets in the way."""
    dynamic = _anchored_dynamic(hinge, site)
    static = _anchored_static(hinge, pin, site) if dynamic else None
    if static is None or dynamic is None:
        return None
    found = judged_hinge(InstalledHinge(static.visuals, dynamic.visuals, packed=max(static.block, dynamic.block)), site)
    return found and replace(found, struck_by=(*found.struck_by, *_flaws(found, hinge, pin, site)))


def _flaws(installed: InstalledHinge, hinge: FittedHinge, pin: PinCandidate, site: HingeSite) -> Iterator[str]:
    """Yields what speaks against a hinge on its own parts."""
    footing = site.config.footing
    if installed.packed > footing.thickest:
        yield PACKED
    if resting_leaf(hinge, pin, site) < hinge.template.size.leaf:
        yield HANGING


def resting_leaf(hinge: FittedHinge, pin: PinCandidate, site: HingeSite) -> float:
    """Returns how wide the leaves may be, at most as they are, for enough of each to lie on its part; 0: none."""
    T, size = hinge.T_object_template, hinge.template.size
    pin_line = Axis(T[:3, 3], T[:3, 2])
    ends = [(hinge.template.dynamic.snap, site.door_rays)]
    ends += [] if pin.inset else [(hinge.template.static.snap, site.static_rays)]
    return min(resting_width(snap.transformed(T), pin_line, size, rays, site.config.footing) for snap, rays in ends)


def judged_hinge(hinge: InstalledHinge, site: HingeSite) -> InstalledHinge | None:
    """Returns the hinge and what would hit it; None if an end cuts into the other side or a body at rest."""
    static, dynamic = hinge.static_meshes, hinge.dynamic_meshes
    if _static_in_the_way(static, site) or _dynamic_in_the_way(dynamic, site):
        return None
    struck_by = [n.id for n in site.neighbours if n.runs_into(*static) or _strikes_closed(n, dynamic, site)]
    if _blocks_itself(hinge, site):
        struck_by.append(site.moving)
    if min(float(mesh.box.low[2]) for mesh in (*static, *dynamic)) < site.scene.floor - site.depth:
        struck_by.append(FLOOR)
    return replace(hinge, struck_by=tuple(struck_by))


def _blocks_itself(hinge: InstalledHinge, site: HingeSite) -> bool:
    """Whether a support block of one end cuts into the other end; without blocks the template keeps them apart."""
    static, dynamic = hinge.static_meshes, hinge.dynamic_meshes
    pairs = [(static, dynamic[1:]), (static[1:], dynamic[:1])]
    return any(
        not is_free(_body(moving, site), site.motion, site.upper, _standing(still), _POSES)
        for still, moving in pairs
        if still and moving
    )


def _body(meshes: list[TriangleMesh], site: HingeSite) -> SweptBody:
    return SweptBody(merge_meshes(meshes), site.depth, pieces=meshes)


def _standing(meshes: list[TriangleMesh]) -> list[Obstacle]:
    return [Obstacle("hinge", MeshCollider(mesh)) for mesh in meshes]


def _strikes_closed(neighbour: Neighbour, dynamic: list[TriangleMesh], site: HingeSite) -> bool:
    """Whether a neighbour runs into the moving end while the door is closed, though not into the door itself."""
    return neighbour.runs_into(*dynamic) and not neighbour.runs_into(site.door)


def _static_in_the_way(static: list[TriangleMesh], site: HingeSite) -> bool:
    """Whether the door, another moving body at rest, or other hardware cuts into the static hardware."""
    if not is_free(site.door_body, site.motion, site.upper, _standing(static), 2 * _POSES):
        return True
    body = _body(static, site)
    body.place(np.eye(4))
    box = Box.enclosing(mesh.box for mesh in static)
    hardware = (o.collider for o in (*in_the_way(site.scene.static_hardware, box), *site.scene.obstacles_behind))
    if any(body.penetrates(other) for other in (*_at_rest_near(site, box), *hardware)):
        return True
    return any(neighbour.is_wedged_by(static) for neighbour in site.neighbours)


def _dynamic_in_the_way(dynamic: list[TriangleMesh], site: HingeSite) -> bool:
    """Whether the moving hardware cuts into static parts somewhere, or into other moving bodies at rest."""
    together = [*dynamic, *site.beside]  # on one door no hinge gets out of the way alone
    body = _body(together, site)
    box = Box.enclosing(mesh.box for mesh in together)
    near = in_the_way(site.obstacles, swept_box(box, site.motion, site.upper))
    if not is_free(body, site.motion, site.upper, near, _POSES):
        return True
    body.place(np.eye(4))
    behind = (obstacle.collider for obstacle in site.scene.obstacles_behind)
    return any(body.penetrates(other) for other in (*_at_rest_near(site, box), *behind))


def _at_rest_near(site: HingeSite, box: Box) -> list[MeshCollider]:
    """Returns the other moving bodies at rest whose boxes meet a box."""
    note_box(Read.BODIES, box)
    return [neighbour.at_rest for neighbour in site.neighbours if neighbour.box.overlaps(box)]


@final
@dataclass(frozen=True)
class _Hold:
    """One end of a hinge with what bridges it to its part, and how long that block is (metres)."""

    visuals: tuple[Visual, ...]
    block: float = 0.0


def _anchored_static(hinge: FittedHinge, pin: PinCandidate, site: HingeSite) -> _Hold | None:
    """Returns the static end with what bridges it to the static body; None where nothing is in reach."""
    if pin.inset:
        tongue = _tongue(hinge, pin, site)
        held = site.scene.is_near_static(tongue.mesh, site.anchor, site.holders)
        return _Hold((hinge.static, tongue)) if held else None
    if site.scene.is_near_static(hinge.static.mesh, site.anchor, site.holders):
        return _Hold((hinge.static,))
    snap = hinge.template.static.snap.transformed(hinge.T_object_template)
    return _bridged(hinge.static, snap, site.static_rays, site)


def _anchored_dynamic(hinge: FittedHinge, site: HingeSite) -> _Hold | None:
    """Returns the dynamic end with what bridges it to the door; None where the door is out of reach."""
    if MeshCollider(hinge.dynamic.mesh).is_within(site.anchor, MeshCollider(site.door)):
        return _Hold((hinge.dynamic,))
    reach = min(site.config.footing.door_reach * site.frame.width, site.reach)
    snap = hinge.template.dynamic.snap.transformed(hinge.T_object_template)
    return _bridged(hinge.dynamic, snap, site.door_rays, replace(site, reach=reach))


def _bridged(end: Visual, snap: SnapPlane, target: RayCaster, site: HingeSite) -> _Hold | None:
    """Returns an end with the shortest support block that reaches the target."""
    bridge = shortest_bridge(_footings(end, snap, site.frame, site.config.footing), target, site.reach, site.block)
    if bridge is None:
        return None
    footing, length = bridge
    return _Hold((end, block("support_hinge", footing, length, site.block, METAL)), length)


def _footings(end: Visual, snap: SnapPlane, frame: BorderFrame, config: FootingConfig) -> Iterator[Footing]:
    """Yields the snap rectangle looking along its normal, then the leaf's own sides looking inwards and sideways."""
    yield Footing(np.asarray(snap.center), np.asarray(snap.normal), config.snap * snap.u, config.snap * snap.v)
    local = frame.to_border(end.mesh.vertices)
    low, high = local.min(axis=0), local.max(axis=0)
    half = (high - low) / 2 * config.side
    center = (low + high) / 2
    for direction in (vec3(0.0, -1.0, 0.0), vec3(-1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 0.0, -1.0)):
        k = int(np.argmax(np.abs(direction)))
        i, j = [a for a in range(3) if a != k]
        start = frame.to_object((center + direction * half[k])[None])[0]
        u, v = (frame.rotation[:, axis] * max(float(half[axis]), config.thinnest) for axis in (i, j))
        yield Footing(start, frame.rotation @ direction, u, v)


def _tongue(hinge: FittedHinge, pin: PinCandidate, site: HingeSite) -> Visual:
    """Returns the strip that carries an inset leaf on through the seam into what stands behind the door."""
    frame, config = site.frame, site.config
    size = hinge.template.size
    leaf = frame.to_border(hinge.static.mesh.vertices)
    start, end = float(leaf[:, 1].min()) + config.lap, -frame.thickness - config.tongue
    z = float(leaf[:, 2].min() + leaf[:, 2].max()) / 2
    u = frame.direction(0.0, 0.0, config.footing.tongue * size.length)
    v = frame.direction(config.footing.tongue * size.thickness, 0.0, 0.0)
    center = frame.to_object(vec3(pin.x - size.thickness / 2, start, z)[None])[0]
    foot = Footing(center, frame.direction(0.0, -1.0, 0.0), u, v)
    return block("support_hinge", foot, max(start - end, config.lap), site.block, METAL)
