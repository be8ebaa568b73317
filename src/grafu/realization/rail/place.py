"""Places the two rails of one drawer: mounts, heights and thicknesses tried in order, judged by sweeping real meshes.

One rail is fitted, the other is its exact mirror image (supplement, eq. rail mirror); support blocks bridge what remains
between a rail and the wall.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.intersection import MeshCollider, MovingBody
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation, reflection
from grafu.realization.config import RealizationConfig
from grafu.realization.hinge.border import part_axes
from grafu.realization.limits import in_the_way, is_free, motion_about, sweep, swept_box, widest_free
from grafu.realization.plan import JointRequest
from grafu.realization.rail.body_region import BodyRegion, DrawerFrame, body_region, drawer_frame
from grafu.realization.rail.spots import RailSpot, find_walls, front_only_region, rail_spots
from grafu.realization.scene import Obstacle, Scene
from grafu.realization.support_block import Footing, block, shortest_bridge
from grafu.templates.template import Gallery, RailModel, RailTemplate, TemplateEnd
from grafu.vocabulary import JointType, MechanismClass, PartLabel


@final
@dataclass(frozen=True)
class RailPlacement:
    """The rails of one drawer: axis, travel, and hardware in the object frame at rest."""

    axis: Axis
    upper: float
    mechanism: MechanismClass
    template: str
    mount: str
    count: int
    dynamic: tuple[Visual, ...]
    static: tuple[Visual, ...]
    in_way: tuple[str, ...]


@final
@dataclass(frozen=True, eq=False)
class DrawerSearch:
    """One drawer's search: its frame, what it may hit, and how far it is wanted to open."""

    request: JointRequest
    scene: Scene
    config: RealizationConfig
    frame: DrawerFrame
    body: MovingBody
    obstacles: tuple[Obstacle, ...]
    neighbours: tuple[Obstacle, ...]
    wanted: float

    @property
    def mesh(self) -> TriangleMesh:
        """The drawer without what rides on it."""
        return self.scene.parts[self.request.moving].mesh

    @property
    def axis(self) -> Axis:
        """The sliding axis through the drawer's middle."""
        return Axis(self.mesh.box.center, self.frame.slide)

    @cached_property
    def static_rays(self) -> RayCaster:
        """The static body around the drawer, prepared for rays."""
        box = self.mesh.box
        return RayCaster(self.scene.static_mesh_near(box, 0.5 * float(box.size.max())))

    @cached_property
    def region(self) -> BodyRegion | None:
        """The container's region; None where the drawer is only a front."""
        return body_region(self.mesh, self.frame, self.config.body_tolerance)


def drawer_search(request: JointRequest, scene: Scene, config: RealizationConfig) -> DrawerSearch | None:
    """Returns the search for one request; None where the drawer would slide up or down."""
    mesh = scene.parts[request.moving].mesh
    frame = drawer_frame(mesh, np.asarray(request.axis.direction))
    if frame is None:
        return None
    others = scene.other_movers(request.moving)
    body = scene.moving_body(request.moving, config.depth * scene.unit, part_axes(mesh))
    wanted = min(request.reference or frame.depth, 0.75 * frame.depth)
    obstacles = scene.static_obstacles + scene.static_hardware
    return DrawerSearch(request, scene, config, frame, body, obstacles, others, max(wanted, 1e-3))


def place_rails(search: DrawerSearch, gallery: Gallery) -> RailPlacement | None:
    """Returns the first placement whose rails hold on both sides and are in nothing's way; None where none does."""
    near = search.static_rays
    for model in gallery.rails:
        region = _region(search, model)
        if region is None:
            continue
        walls = find_walls(search.frame, region, near, 0.25 * search.scene.unit)
        for spot in rail_spots(model, region, walls, search.config.rail_share):
            placed = _with_hardware(model, spot, region, search)
            if placed is not None:
                return placed
    return None


def free_travel(search: DrawerSearch) -> float:
    """Returns the share of the wanted travel that the bare drawer slides freely, 0..1."""
    return _travel(search, search.wanted) / search.wanted


def _region(search: DrawerSearch, model: RailModel) -> BodyRegion | None:
    """Returns the container's region, or the one behind a front that has no container."""
    if search.region is not None:
        return search.region
    reach = 1.5 * search.scene.unit
    thickness = model.natural.thickness
    return front_only_region(search.frame, search.frame.depth, search.static_rays, reach, thickness)


def _travel(search: DrawerSearch, reach: float) -> float:
    motion = motion_about(search.axis, JointType.PRISMATIC)
    box = swept_box(search.scene.moving_mesh(search.request.moving).box, motion, reach)
    return widest_free(search.body, motion, reach, in_the_way(search.obstacles, box), search.config.fine_poses)


def _with_hardware(model: RailModel, spot: RailSpot, region: BodyRegion, search: DrawerSearch) -> RailPlacement | None:
    """Returns the placement of both rails at a spot; None where one finds no hold or gets in the way."""
    template = model.build(spot.size)
    upper = _travel(search, template.range)
    static: list[Visual] = []
    dynamic: list[Visual] = []
    for side, T in zip(("left", "right"), _poses(spot, region, search.frame), strict=True):
        held = _anchored(template, T, side, search)
        if held is None:
            return None
        static += held[0]
        dynamic += held[1]
    if _in_the_way(static, dynamic, upper, search):
        return None
    return RailPlacement(
        axis=search.axis,
        upper=upper,
        mechanism=model.mechanism,
        template=model.id,
        mount=_mount(static[0], search),
        count=2,
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=_doors_in_the_way(search, upper),
    )


def _poses(spot: RailSpot, region: BodyRegion, frame: DrawerFrame) -> tuple[Mat4, Mat4]:
    """Returns T_object_template of the left rail and of its mirror image across the drawer's sagittal plane."""
    left = frame.T_object_drawer @ from_rotation(np.eye(3), vec3(spot.x, spot.y, spot.z))
    middle = frame.to_object(vec3(region.middle, 0.0, 0.0)[None])[0]
    return left, reflection(middle, frame.rotation[:, 0]) @ left


def _anchored(
    template: RailTemplate, T: Mat4, side: str, search: DrawerSearch
) -> tuple[list[Visual], list[Visual]] | None:
    """Returns one rail's static and dynamic visuals with the blocks that bridge gaps; None where nothing is in reach."""
    name = search.request.moving
    anchor = search.config.anchor * search.scene.unit
    static, dynamic = template.static.transformed(T), template.dynamic.transformed(T)
    held_static = [_visual(f"rail_{name}_{side}_static", static)]
    held_dynamic = [_visual(f"rail_{name}_{side}_dynamic", dynamic)]
    if search.scene.distance_to_static(static.mesh, anchor) > anchor:
        bridge = shortest_bridge(_footings(static, T), search.static_rays, search.config.bridge * search.scene.unit)
        if bridge is None:
            return None
        held_static.append(block(f"support_{name}_{side}_static", *bridge))
    if MeshCollider(dynamic.mesh).distance(MeshCollider(search.mesh)) > anchor:
        footing = Footing(dynamic.snap.center, dynamic.snap.normal, 0.9 * dynamic.snap.u, 0.9 * dynamic.snap.v)
        gap = footing.gap(RayCaster(search.mesh), 0.2 * search.frame.width)
        if not np.isfinite(gap):
            return None
        held_dynamic.append(block(f"support_{name}_{side}_dynamic", footing, gap))
    return held_static, held_dynamic


def _visual(name: str, end: TemplateEnd) -> Visual:
    return Visual(name, end.surfaces, VisualRole.HARDWARE, PartLabel.MISC)


def _footings(end: TemplateEnd, T: Mat4) -> Iterator[Footing]:
    """Yields the static snap plane looking at the wall, then the rail looking up, down and to the back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, 0.98 * snap.u, 0.98 * snap.v)
    low, high = end.mesh.box.low, end.mesh.box.high
    center, half = (low + high) / 2, (high - low) / 2
    outward, back, up = snap.normal, T[:3, 1], vec3(0.0, 0.0, 1.0)
    reach = {id(v): float(np.abs(v) @ half) for v in (outward, back, up)}
    for direction, others in ((up, (back, outward)), (-up, (back, outward)), (back, (up, outward))):
        along = back if direction is back else up
        start = center + direction * reach[id(along)]
        u, v = (0.9 * reach[id(o)] * o for o in others)
        yield Footing(start, direction, u, v)


def _in_the_way(static: list[Visual], dynamic: list[Visual], upper: float, search: DrawerSearch) -> bool:
    """Whether rails or blocks cut into the other side's parts on the way, or into other movers at rest."""
    depth = search.config.depth * search.scene.unit
    motion = motion_about(search.axis, JointType.PRISMATIC)
    fixed = merge_meshes([v.mesh for v in static])
    if not is_free(search.body, motion, upper, [Obstacle("rail", MeshCollider(fixed))], 12):
        return True
    moving = merge_meshes([v.mesh for v in dynamic])
    body = MovingBody(moving, depth, np.asarray(search.frame.rotation))
    if not is_free(body, motion, upper, in_the_way(search.obstacles, swept_box(moving.box, motion, upper)), 12):
        return True
    return _cuts_neighbours(fixed, depth, search) or _cuts_neighbours(moving, depth, search)


def _cuts_neighbours(mesh: TriangleMesh, depth: float, search: DrawerSearch) -> bool:
    """Whether hardware at rest cuts into another mover at rest."""
    body = MovingBody(mesh, depth, np.asarray(search.frame.rotation))
    body.place(np.eye(4))
    return any(body.penetrates(o.collider) for o in in_the_way(search.neighbours, mesh.box))


def _doors_in_the_way(search: DrawerSearch, upper: float) -> tuple[str, ...]:
    """Returns the other movers, at rest, that the drawer runs into."""
    motion = motion_about(search.axis, JointType.PRISMATIC)
    box = swept_box(search.scene.moving_mesh(search.request.moving).box, motion, upper)
    return sweep(search.body, motion, upper, in_the_way(search.neighbours, box), 13).blockers


def _mount(rail: Visual, search: DrawerSearch) -> str:
    """Returns the static part nearest to a rail; a wanted mount wins a draw."""
    collider = MeshCollider(rail.mesh)
    near = [o for o in search.scene.static_obstacles if o.collider.box.overlaps(collider.box, 0.1 * search.scene.unit)]
    ranked = sorted((round(collider.distance(o.collider), 4), o.id not in search.request.mounts, o.id) for o in near)
    return ranked[0][2] if ranked else ""
