"""Places the two rails of one drawer: mounts, heights and thicknesses tried in order, judged by sweeping real meshes.

One rail is fitted, the other is its exact mirror image (supplement, eq. rail mirror); support blocks bridge what
remains between a rail and the wall.
"""

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import from_rotation, reflection
from grafu.realization.limits import in_the_way, is_free, swept_box
from grafu.realization.placement import Placement, nearest_part
from grafu.realization.rail.body_region import BodyRegion, DrawerFrame
from grafu.realization.rail.hold import held_rail
from grafu.realization.rail.search import DrawerSearch
from grafu.realization.rail.spots import RailSpot, find_walls, rail_spots
from grafu.realization.scene import Obstacle
from grafu.templates.template import Gallery, RailModel

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
    mount = search.request.choice.mount
    is_on_mount = not mount
    for side, T in zip(("left", "right"), _poses(spot, region, search.frame), strict=True):
        held = held_rail(template, T, side, search)
        if held is None:
            return None
        static += held.static
        dynamic += held.dynamic
        is_on_mount = is_on_mount or held.is_on_mount
    if not is_on_mount or _in_the_way(static, dynamic, upper, search):
        return None
    return Placement(
        axis=search.axis,
        upper=upper,
        mechanism=model.mechanism,
        template=model.id,
        mount=mount or nearest_part(static[0], search.scene, search.request.mounts),
        count=2,
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=search.bodies_in_the_way(upper),
    )


def _poses(spot: RailSpot, region: BodyRegion, frame: DrawerFrame) -> tuple[Mat4, Mat4]:
    """Returns T_object_template of the left rail and of its mirror image across the drawer's sagittal plane."""
    left = frame.T_object_drawer @ from_rotation(np.eye(3), vec3(spot.x, spot.y, spot.z))
    middle = frame.to_object(vec3(region.middle, 0.0, 0.0)[None])[0]
    return left, reflection(middle, frame.rotation[:, 0]) @ left


def _in_the_way(static: list[Visual], dynamic: list[Visual], upper: float, search: DrawerSearch) -> bool:
    """Whether rails or blocks cut into the other side's parts on the way, or into other moving bodies at rest."""
    depth = search.config.depth * search.scene.unit
    motion = search.motion
    fixed = merge_meshes([v.mesh for v in static])
    if not is_free(search.body, motion, upper, [Obstacle("rail", MeshCollider(fixed))], 12):
        return True
    moving = merge_meshes([v.mesh for v in dynamic])
    body = SweptBody(moving, depth, np.asarray(search.frame.rotation))
    if not is_free(body, motion, upper, in_the_way(search.obstacles, swept_box(moving.box, motion, upper)), 12):
        return True
    return _cuts_neighbours(fixed, depth, search) or _cuts_neighbours(moving, depth, search)


def _cuts_neighbours(mesh: TriangleMesh, depth: float, search: DrawerSearch) -> bool:
    """Whether hardware at rest cuts into another moving body at rest."""
    body = SweptBody(mesh, depth, np.asarray(search.frame.rotation))
    body.place(np.eye(4))
    return any(body.penetrates(o.collider) for o in in_the_way(search.neighbours, mesh.box))
