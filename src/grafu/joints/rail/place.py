"""Places the two rails of one drawer: mounts, heights and thicknesses tried in order, judged by sweeping real meshes.

One rail is fitted, the other is its exact mirror image (supplement, eq. rail mirror); support blocks bridge what
remains between a rail and the wall.

What holds one rail of a pair: what it touches, or a support that bridges the gap to the case and to the drawer.

A support is a block to whatever is nearest, a slab to the wall beside the rail, or an upright board along it, as was
chosen.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import from_rotation, reflection, translation
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import in_the_way, is_free, swept_box
from grafu.joints.plan import Supports
from grafu.joints.rail.body_region import BodyRegion, DrawerFrame
from grafu.joints.rail.search import DrawerSearch
from grafu.joints.rail.spots import RailSpot, flank_gaps, rail_spots
from grafu.joints.rail_footing_config import RailFootingConfig
from grafu.joints.report import Placement
from grafu.joints.support_block import Footing, block, nearest_part, shortest_bridge
from grafu.scene.obstacles import Obstacle
from grafu.templates.template import Gallery, RailModel, RailTemplate, TemplateEnd
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class HeldRail:
    """One rail's static and dynamic end with their supports; `is_on_mount`: whether the chosen mount carries it."""

    static: tuple[Visual, ...]
    dynamic: tuple[Visual, ...]
    is_on_mount: bool


def held_rail(template: RailTemplate, T: Mat4, side: str, search: DrawerSearch) -> HeldRail | None:
    """Returns one rail at a pose with what holds it; None where nothing that may hold it is in reach."""
    name = f"{search.request.moving}_{side}"
    static, dynamic = template.static.transformed(T), template.dynamic.transformed(T)
    carried = _carried(f"{name}_dynamic", dynamic, T, search)
    if carried is None:
        return None
    mount = search.request.choice.mount
    on_mount = _fixed(f"{name}_static", static, T, search, (mount,)) if mount else None
    fixed = on_mount or _fixed(f"{name}_static", static, T, search, search.request.carriers)
    return None if fixed is None else HeldRail(fixed, carried, on_mount is not None)


def _fixed(
    name: str, end: TemplateEnd, T: Mat4, search: DrawerSearch, holders: tuple[str, ...]
) -> tuple[Visual, ...] | None:
    """Returns a rail's static end fixed to the case, or to some of its parts; None where it is out of reach."""
    rail = _visual(f"rail_{name}", end)
    if search.scene.is_near_static(end.mesh, search.config.anchor, holders):
        return (rail,)
    if search.request.choice.supports is Supports.NONE:
        return None
    if not holders and _meets_divider(end, search):
        return (rail,)
    walls = search.walls_of(holders) if holders else search.static_rays
    is_chosen = holders == (search.request.choice.mount,)
    reach = search.config.chosen_reach if is_chosen else search.config.bridge
    blocks = search.config.block
    if search.request.choice.supports is Supports.DIVIDER:
        found = _divider(end, T, walls, reach, search.config)
    else:
        footings = _footings(end, T, search.config.rail.footing)
        found = shortest_bridge([next(footings)] if _is_slab(search) else footings, walls, reach, blocks)
    return None if found is None else (rail, block(f"support_{name}", *found, blocks))


def _meets_divider(end: TemplateEnd, search: DrawerSearch) -> bool:
    """Whether dividers were chosen and one that was built for another drawer stands right behind a rail."""
    if search.request.choice.supports is not Supports.DIVIDER:
        return False
    near = search.config.anchor
    around = search.scene.static_hardware.near(Box.around(end.snap.center[None]), near)
    boards = (o for o in around if o.id.startswith("support_"))
    rail = MeshCollider(end.mesh)
    return any(
        board.collider.box.grown(near).contains(end.snap.center[None]).all() and rail.is_within(near, board.collider)
        for board in boards
    )


def _carried(name: str, end: TemplateEnd, T: Mat4, search: DrawerSearch) -> tuple[Visual, ...] | None:
    """Returns a rail's dynamic end fixed to the drawer; None where it is out of reach."""
    rail = _visual(f"rail_{name}", end)
    if MeshCollider(end.mesh).is_within(search.config.anchor, MeshCollider(search.mesh)):
        return (rail,)
    if search.request.choice.supports is Supports.NONE:
        return None
    config, blocks = search.config.rail.footing, search.config.block
    reach = config.drawer_reach * search.frame.width
    bridge = shortest_bridge(_dynamic_footings(end, T, config), RayCaster(search.mesh), reach, blocks)
    return None if bridge is None else (rail, block(f"support_{name}", *bridge, blocks))


def _is_slab(search: DrawerSearch) -> bool:
    return search.request.choice.supports is Supports.SLAB


def _visual(name: str, end: TemplateEnd) -> Visual:
    return Visual(name, end.surfaces, VisualRole.HARDWARE, PartLabel.MISC)


def _divider(
    end: TemplateEnd, T: Mat4, walls: RayCaster, reach: float, realization: RealizationConfig
) -> tuple[Footing, float] | None:
    """Returns the foot of an upright board behind a rail and its height: from what is below to what is above.

    Where one of the two is out of reach it ends with the rail there; None where both are, or a wall leaves no room.
    """
    snap = end.snap
    config, blocks = realization.rail, realization.block
    side = config.footing.wall
    room = Footing(snap.center, snap.normal, side * snap.u, side * snap.v).gap(walls, reach, blocks)
    thickness = min(config.divider, room - config.divider_air)
    if thickness < config.thinnest_divider:
        return None
    up, back = T[:3, 2], T[:3, 1]
    outward = np.asarray(snap.normal)
    heights, lengths = end.mesh.vertices @ up, end.mesh.vertices @ back
    half = float(np.ptp(heights)) / 2
    v = side * back * float(np.ptp(lengths)) / 2
    middle = snap.center + outward * thickness / 2
    middle = middle + up * (float(heights.min() + half) - float(middle @ up))
    middle = middle + back * (float(lengths.min() + np.ptp(lengths) / 2) - float(middle @ back))
    gaps = [Footing(middle, sign * up, outward * thickness / 2, v).gap(walls, reach, blocks) for sign in (-1.0, 1.0)]
    if not np.isfinite(gaps).any():
        return None
    below, above = (gap if np.isfinite(gap) else half for gap in gaps)
    return Footing(middle - below * up, up, outward * thickness / 2, v), below + above


def _footings(end: TemplateEnd, T: Mat4, config: RailFootingConfig) -> Iterator[Footing]:
    """Yields the static snap plane looking at the wall, then the rail looking up, down and to the back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, config.wall * snap.u, config.wall * snap.v)
    looks = (("up", 1.0, "back", "outward"), ("up", -1.0, "back", "outward"), ("back", 1.0, "up", "outward"))
    yield from _looking(end, T, looks, config.side)


def _dynamic_footings(end: TemplateEnd, T: Mat4, config: RailFootingConfig) -> Iterator[Footing]:
    """Yields the dynamic snap plane looking at the drawer, then the rail's front end looking at the front's back."""
    snap = end.snap
    yield Footing(snap.center, snap.normal, config.side * snap.u, config.side * snap.v)
    yield from _looking(end, T, (("back", -1.0, "up", "outward"),), config.side)


def _looking(
    end: TemplateEnd, T: Mat4, looks: tuple[tuple[str, float, str, str], ...], ratio: float
) -> Iterator[Footing]:
    """Yields rectangles on a rail's sides, measured along its own axes: direction, its sense, and their two sides.

    They take a fraction of the sides, `ratio`.
    """
    middle, reach = np.zeros(3), {}
    for name, axis in (("outward", end.snap.normal), ("back", T[:3, 1]), ("up", T[:3, 2])):
        along = end.mesh.vertices @ axis
        middle = middle + axis * (along.min() + along.max()) / 2
        reach[name] = axis * (along.max() - along.min()) / 2
    for name, sign, first, second in looks:
        towards = sign * reach[name]
        direction = towards / np.linalg.norm(towards)
        yield Footing(middle + towards, direction, ratio * reach[first], ratio * reach[second])


def place_rails(search: DrawerSearch, gallery: Gallery) -> Placement | None:
    """Returns the first placement whose rails hold on both sides and are in nothing's way; None where none does."""
    region = search.region
    if region is None:
        return None
    flank = search.config.rail.flank
    gaps = flank_gaps(search.frame, region, search.static_rays, flank.reach * search.scene.extent, flank)
    choice = search.request.choice
    for model in gallery.rails:
        if choice.mechanism not in (None, model.mechanism) or not choice.takes(model.id):
            continue
        for spot in rail_spots(model, region, gaps, search.config.rail_ratio, search.config.rail):
            placed = _with_hardware(model, spot, region, search)
            if placed is not None:
                return placed
    return None


def _with_hardware(model: RailModel, spot: RailSpot, region: BodyRegion, search: DrawerSearch) -> Placement | None:
    """Returns the placement of both rails at a spot; None where one finds no hold or gets in the way."""
    template = model.build(spot.size)
    upper = search.travel(search.reach if search.is_leaf else search.reach_on(template))
    if upper < search.config.least_opening * search.wanted:
        return None
    track = _track(template, model, upper) if search.is_leaf else template.static
    static: list[Visual] = []
    dynamic: list[Visual] = []
    mount = search.request.choice.mount
    is_on_mount = not mount
    for side, T in zip(("left", "right"), _poses(spot, region, search.frame), strict=True):
        held = held_rail(template, T, side, search)
        if held is None:
            return None
        rail, *supports = held.static  # a support holds a track where the leaf is closed: it would cross the next leaf
        static += [replace(rail, surfaces=track.transformed(T).surfaces), *supports]
        dynamic += held.dynamic
        is_on_mount = is_on_mount or held.is_on_mount
    if not is_on_mount or _in_the_way(static, dynamic, upper, search):
        return None
    return Placement(
        axis=search.axis,
        upper=upper,
        mechanism=model.mechanism,
        template=model.id,
        mount=mount or nearest_part(static[0], search.scene, search.request, search.config.block),
        count=2,
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=search.bodies_in_the_way(upper),
    )


def _track(template: RailTemplate, model: RailModel, travel: float) -> TemplateEnd:
    """Returns a static end as long as the moving end, and as far as that travels before it."""
    size = template.size
    track = model.build(replace(size, length=size.length + travel)).static
    return track.transformed(translation(vec3(0.0, -travel / 2, 0.0)))


def _poses(spot: RailSpot, region: BodyRegion, frame: DrawerFrame) -> tuple[Mat4, Mat4]:
    """Returns T_object_template of the left rail and of its mirror image across the drawer's sagittal plane."""
    left = frame.T_object_drawer @ from_rotation(np.eye(3), vec3(spot.x, spot.y, spot.z))
    middle = frame.to_object(vec3(region.middle, 0.0, 0.0)[None])[0]
    return left, reflection(middle, frame.rotation[:, 0]) @ left


def _in_the_way(static: list[Visual], dynamic: list[Visual], upper: float, search: DrawerSearch) -> bool:
    """Whether rails or blocks cut into the other side's parts along the path, or into other moving bodies at rest."""
    depth, poses = search.config.depth * search.scene.extent, search.config.rail.poses
    motion = search.motion
    fixed, moving = [v.mesh for v in static], [v.mesh for v in dynamic]
    if not is_free(search.body, motion, upper, [Obstacle("rail", MeshCollider(mesh)) for mesh in fixed], poses):
        return True
    body, box = _of_pieces(moving, depth, search), Box.enclosing([mesh.box for mesh in moving])
    if not is_free(body, motion, upper, in_the_way(search.obstacles, swept_box(box, motion, upper)), poses):
        return True
    return _cuts_neighbours(fixed, depth, search) or _cuts_neighbours(moving, depth, search)


def _of_pieces(meshes: list[TriangleMesh], depth: float, search: DrawerSearch) -> SweptBody:
    """Returns rails with their blocks as one body; each piece is asked about elsewhere, too, and prepared once."""
    return SweptBody(merge_meshes(meshes), depth, np.asarray(search.frame.rotation), meshes)


def _cuts_neighbours(meshes: list[TriangleMesh], depth: float, search: DrawerSearch) -> bool:
    """Whether hardware at rest cuts into another moving body at rest."""
    near = in_the_way(search.neighbours, Box.enclosing([mesh.box for mesh in meshes]))
    if not near:
        return False
    body = _of_pieces(meshes, depth, search)
    body.place(np.eye(4))
    return any(body.penetrates(o.collider) for o in near)
