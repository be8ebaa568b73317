"""Racks of dishwashers and ovens: wire baskets and grids behind a door that drops. They slide out once it is open."""

from collections.abc import Mapping
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.labels import sense_of
from grafu.asset.part import ROBOTS, Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale, require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.geometry.shells import shell_numbers
from grafu.geometry.touching import near_pairs
from grafu.graph.functional_graph import FunctionalGraph, joined_groups
from grafu.joints.behind_fronts import groups_within, is_within_outline, sliding_out, static_boxes
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

SOURCE = "rule"
"""`JointRequest.source` of a rack: its shape and the door before it show that it slides."""
_UP, _DEPTH = 2, 1
_RAYS = 24  # along each side of an outline


@final
@dataclass(frozen=True)
class RackConfig:
    """What counts as a rack behind a door that drops; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("clear", "touching")
    level: float = 0.9
    """From this cosine on to the horizontal a door's axis is level."""
    lower: float = 0.25
    """A door drops whose axis lies in this lower part of it (fraction of its height)."""
    clear: float = 0.01
    """A rack stays this far within the outline of its door (metres): what comes nearer to it is the body."""
    wide: float = 0.6
    """Least width of a rack (fraction of the door's)."""
    deep: float = 0.4
    """Least depth of a rack (fraction of the depth of the whole)."""
    touching: float = 0.002
    """Wires this near to one another touch (metres)."""
    whole: float = 0.8
    """Least height of what touches (fraction of the rack's): rows of supports above one another are no basket."""
    flat: float = 0.05
    """Greatest height of a flat grid (fraction of its shorter other side)."""
    covered: float = 0.6
    """What of its outline a grid covers at most, seen from above and, unless it is flat, from its sides (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "clear", "touching")
        require_ratios(self, "level", "lower", "wide", "deep", "flat", "covered", "whole")


def with_racks(
    plan: RealizationPlan, asset: Asset, graph: FunctionalGraph, config: RackConfig = RackConfig()
) -> RealizationPlan:
    """Returns the plan in which racks behind doors that drop slide out; joints of doors and drawers stay as they are.

    A rack of several parts takes the place of joints of these that were predicted.
    """
    doors = [asset.part(r.moving).box for r in plan.joints if _drops(r, asset.part(r.moving).box, config)]
    if not doors:
        return plan
    config = at_scale(config, metre_on(asset.extent))
    fronts = tuple(request for request in plan.joints if graph.node(request.moving).label.is_movable)
    static = static_boxes(asset, {part for request in fronts for part in (request.moving, *request.attached)})
    found = {rack.moving: rack for door in doors for rack in _racks(door, static, asset, graph, config)}
    taken = {part for rack in found.values() for part in (rack.moving, *rack.attached)}
    kept = tuple(request for request in plan.joints if request in fronts or request.moving not in taken)
    refused = tuple(refusal for refusal in plan.refused if refusal.part not in found)
    return replace(plan, joints=(*kept, *found.values()), refused=refused) if found else plan


def is_grid(mesh: TriangleMesh, config: RackConfig = RackConfig()) -> bool:
    """Whether a body is a grid: most of it is open, seen from above, and from all sides unless it is flat."""
    box = mesh.box
    if not (box.size > 0).all():
        return False
    rays, flat = RayCaster(mesh), box.size[_UP] <= config.flat * box.size[:_UP].min()
    above = float(box.size.max())
    depths = (depths_below(rays, box, along, _RAYS, above) for along in ((_UP,) if flat else range(3)))
    return all(float(np.isfinite(one).mean()) <= config.covered for one in depths)


def _drops(request: JointRequest, door: Box, config: RackConfig) -> bool:
    """Whether a door at the front turns about its lower edge."""
    level = request.kind.turns and abs(float(request.axis.direction[0])) >= config.level
    low = float(request.axis.point[_UP] - door.low[_UP]) <= config.lower * float(door.size[_UP])
    return bool(level and low and door.thin_axis == _DEPTH)


def _racks(
    door: Box, static: Mapping[str, Box], asset: Asset, graph: FunctionalGraph, config: RackConfig
) -> list[JointRequest]:
    within = {name for name, box in static.items() if is_within_outline(box, door, config.clear)}
    inside = sorted(name for name in within if not _is_runner_of_body(asset.part(name), within, graph))
    found = []
    for group in groups_within(inside, graph):
        parts = [asset.part(name) for name in group]
        box = Box.enclosing(part.box for part in parts)
        wide = box.size[0] >= config.wide * door.size[0]
        deep = box.size[_DEPTH] >= config.deep * asset.box.size[_DEPTH]
        mesh = merge_meshes([part.mesh for part in parts])
        is_one = (len(parts) == 1 and _is_link(parts[0], asset)) or hangs_together(mesh, config)
        if wide and deep and is_grid(mesh, config) and is_one:
            found.append(sliding_out(parts, SOURCE))
    return found


def _is_runner_of_body(part: Part, within: set[str], graph: FunctionalGraph) -> bool:
    """Whether a part is called a rail or the like and touches what is no rack's, such as a wall: it stays there."""
    return sense_of(part.source.name).is_fitting and not within >= set(graph.neighbours[part.id])


def _is_link(part: Part, asset: Asset) -> bool:
    """Whether a part is all of one link of a robot description, which is rigid: its wires may be drawn apart."""
    link = part.source.link
    others = (p for p in asset.parts if p is not part and p.label is not PartLabel.HANDLE)
    return asset.kind in ROBOTS and bool(link) and all(other.source.link != link for other in others)


def hangs_together(mesh: TriangleMesh, config: RackConfig = RackConfig()) -> bool:
    """Whether the shells of a rack that touch one another have nearly its whole height: no supports are drawn in it."""
    number = shell_numbers(mesh)
    boxes = [Box.around(mesh.triangles[number == k].reshape(-1, 3)) for k in range(int(number.max()) + 1)]
    touching: dict[str, list[str]] = {str(k): [] for k in range(len(boxes))}
    for i, j in near_pairs(boxes, config.touching):
        touching[str(i)].append(str(j))
        touching[str(j)].append(str(i))
    groups = (Box.enclosing(boxes[int(k)] for k in group) for group in joined_groups(touching))
    return bool(max(float(box.size[_UP]) for box in groups) >= config.whole * mesh.box.size[_UP])
