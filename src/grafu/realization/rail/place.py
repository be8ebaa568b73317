"""Places the two rails of one drawer: mounts, heights and thicknesses tried in order, judged by sweeping real meshes.

One rail is fitted, the other is its exact mirror image (supplement, eq. rail mirror); support blocks bridge what
remains between a rail and the wall.
"""

from collections.abc import Iterator

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.intersection import MeshCollider, MovingBody
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.transform import from_rotation, reflection
from grafu.realization.limits import in_the_way, is_free, swept_box
from grafu.realization.placement import Placement, nearest_part
from grafu.realization.rail.body_region import BodyRegion, DrawerFrame
from grafu.realization.rail.search import DrawerSearch
from grafu.realization.rail.spots import RailSpot, find_walls, rail_spots
from grafu.realization.scene import Obstacle
from grafu.realization.support_block import Footing, block, shortest_bridge
from grafu.templates.template import Gallery, RailModel, RailTemplate, TemplateEnd
from grafu.vocabulary import PartLabel

_LEAST_SHARE = 0.3  # a travel below this share of the wanted one is no motion


def place_rails(search: DrawerSearch, gallery: Gallery) -> Placement | None:
    """Returns the first placement whose rails hold on both sides and are in nothing's way; None where none does."""
    region = search.region
    if region is None:
        return None
    walls = find_walls(search.frame, region, search.static_rays, 0.25 * search.scene.unit)
    choice = search.request.choice
    for model in gallery.rails:
        if choice.mechanism not in (None, model.mechanism) or not choice.takes(model.id):
            continue
        for spot in rail_spots(model, region, walls, search.config.rail_share):
            placed = _with_hardware(model, spot, region, search)
            if placed is not None:
                return placed
    return None


def _with_hardware(model: RailModel, spot: RailSpot, region: BodyRegion, search: DrawerSearch) -> Placement | None:
    """Returns the placement of both rails at a spot; None where one finds no hold or gets in the way."""
    template = model.build(spot.size)
    upper = search.travel(template.range)
    if upper < _LEAST_SHARE * search.wanted:
        return None
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
    return Placement(
        axis=search.axis,
        upper=upper,
        mechanism=model.mechanism,
        template=model.id,
        mount=nearest_part(static[0], search.scene, search.request.mounts),
        count=2,
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=search.movers_in_the_way(upper),
    )


def _poses(spot: RailSpot, region: BodyRegion, frame: DrawerFrame) -> tuple[Mat4, Mat4]:
    """Returns T_object_template of the left rail and of its mirror image across the drawer's sagittal plane."""
    left = frame.T_object_drawer @ from_rotation(np.eye(3), vec3(spot.x, spot.y, spot.z))
    middle = frame.to_object(vec3(region.middle, 0.0, 0.0)[None])[0]
    return left, reflection(middle, frame.rotation[:, 0]) @ left


def _anchored(
    template: RailTemplate, T: Mat4, side: str, search: DrawerSearch
) -> tuple[list[Visual], list[Visual]] | None:
    """Returns one rail's static and dynamic visuals with the blocks that bridge gaps; None if out of reach."""
    name = search.request.moving
    anchor = search.config.anchor * search.scene.unit
    static, dynamic = template.static.transformed(T), template.dynamic.transformed(T)
    held_static = [_visual(f"rail_{name}_{side}_static", static)]
    held_dynamic = [_visual(f"rail_{name}_{side}_dynamic", dynamic)]
    if not search.scene.is_near_static(static.mesh, anchor):
        bridge = shortest_bridge(_footings(static, T), search.static_rays, search.config.bridge * search.scene.unit)
        if bridge is None:
            return None
        held_static.append(block(f"support_{name}_{side}_static", *bridge))
    if MeshCollider(dynamic.mesh).distance(MeshCollider(search.mesh)) > anchor:
        bridge = shortest_bridge(_dynamic_footings(dynamic, T), RayCaster(search.mesh), 0.2 * search.frame.width)
        if bridge is None:
            return None
        held_dynamic.append(block(f"support_{name}_{side}_dynamic", *bridge))
    return held_static, held_dynamic


def _visual(name: str, end: TemplateEnd) -> Visual:
    return Visual(name, end.surfaces, VisualRole.HARDWARE, PartLabel.MISC)


def _footings(end: TemplateEnd, T: Mat4) -> Iterator[Footing]:
    """Yields the static snap plane looking at the wall, then the rail looking up, down and to the back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, 0.98 * snap.u, 0.98 * snap.v)
    yield from _looking(end, T, (("up", 1.0, "back", "outward"), ("up", -1.0, "back", "outward")))
    yield from _looking(end, T, (("back", 1.0, "up", "outward"),))


def _dynamic_footings(end: TemplateEnd, T: Mat4) -> Iterator[Footing]:
    """Yields the dynamic snap plane looking at the drawer, then the rail's front end looking at the front's back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, 0.9 * snap.u, 0.9 * snap.v)
    yield from _looking(end, T, (("back", -1.0, "up", "outward"),))


def _looking(end: TemplateEnd, T: Mat4, looks: tuple[tuple[str, float, str, str], ...]) -> Iterator[Footing]:
    """Yields rectangles on a rail's sides, measured along its own axes: direction, its sense, and their two sides."""
    middle, reach = np.zeros(3), {}
    for name, axis in (("outward", end.snap.normal), ("back", T[:3, 1]), ("up", T[:3, 2])):
        along = end.mesh.vertices @ axis
        middle = middle + axis * (along.min() + along.max()) / 2
        reach[name] = axis * (along.max() - along.min()) / 2
    for name, sign, first, second in looks:
        towards = sign * reach[name]
        direction = towards / np.linalg.norm(towards)
        yield Footing(middle + towards, direction, 0.9 * reach[first], 0.9 * reach[second])


def _in_the_way(static: list[Visual], dynamic: list[Visual], upper: float, search: DrawerSearch) -> bool:
    """Whether rails or blocks cut into the other side's parts on the way, or into other movers at rest."""
    depth = search.config.depth * search.scene.unit
    motion = search.motion
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
