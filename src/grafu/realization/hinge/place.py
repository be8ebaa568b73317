"""Places the hinges of one door: a search over pins, classes and templates, judged by sweeping real meshes.

The best by (free through the wanted opening, out of its neighbours' way, class preference C > F > P, nearness to the
initial axis) is taken, and its pin becomes the rectified axis.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from math import radians
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual
from grafu.geometry.axis import Axis
from grafu.geometry.intersection import MeshCollider, MovingBody
from grafu.geometry.raycast import RayCaster
from grafu.realization.config import RealizationConfig
from grafu.realization.hinge.border import BorderFrame, border_frame, part_axes
from grafu.realization.hinge.candidates import PinCandidate, Tolerances, pin_candidates
from grafu.realization.hinge.fit import barrel_radius, fit_hinge, hinge_count, hinge_heights, hinge_size
from grafu.realization.hinge.hardware import InstalledHinge, Site, install
from grafu.realization.hinge.survey import survey
from grafu.realization.limits import all_blockers, free_opening, in_the_way, motion_about, swept_box, widest_free
from grafu.realization.plan import JointRequest
from grafu.realization.scene import Obstacle, Scene
from grafu.templates.template import Gallery, HingeModel
from grafu.vocabulary import JointType, MechanismClass

_HEIGHT_SHIFTS = (0.0, 0.04, -0.04, 0.08, -0.08, 0.12, -0.12)
_ENOUGH = 3  # once this many makeshift pins have been tried with hardware, more will not help


@final
@dataclass(frozen=True)
class HingePlacement:
    """The hinges of one door: rectified axis, opening, and hardware in the object frame at rest."""

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
@dataclass(frozen=True)
class _Judged:
    """A pin with what the sweep of the bare door says of it."""

    pin: PinCandidate
    axis: Axis
    free: float
    neighbours: tuple[str, ...]
    rank: tuple[float, int, int, float]


@final
@dataclass(frozen=True, eq=False)
class DoorSearch:
    """One door's search: what it may hit, and how far it is wanted to open."""

    request: JointRequest
    scene: Scene
    config: RealizationConfig
    frame: BorderFrame
    body: MovingBody
    obstacles: tuple[Obstacle, ...]
    neighbours: tuple[Obstacle, ...]
    wanted: float

    @property
    def depth(self) -> float:
        """The tolerated penetration in metres."""
        return self.config.depth * self.scene.unit

    @cached_property
    def pins(self) -> "list[_Judged]":
        """All pins, best first."""
        return _judged_pins(self)

    @cached_property
    def static_rays(self) -> RayCaster:
        """The static body around the door, prepared for rays."""
        box = self.scene.parts[self.request.moving].box
        return RayCaster(self.scene.static_mesh_near(box, 0.25 * float(box.size.max())))


def door_search(request: JointRequest, scene: Scene, config: RealizationConfig) -> DoorSearch:
    """Returns the search for one request."""
    part = scene.parts[request.moving]
    frame = border_frame(part.mesh, request.axis)
    others = scene.other_movers(request.moving)
    wanted = min(request.reference or radians(90), config.door_opening)
    return DoorSearch(
        request,
        scene,
        config,
        frame,
        scene.moving_body(request.moving, config.depth * scene.unit, part_axes(part.mesh)),
        scene.static_obstacles + scene.static_hardware,
        others,
        max(wanted, radians(30)),
    )


def place_hinges(search: DoorSearch, gallery: Gallery) -> HingePlacement | None:
    """Returns the best placement that works; None where no pin can be given hardware."""
    tried = 0
    for judged in search.pins:
        if judged.free < 0.3 * search.wanted or tried > _ENOUGH:
            break
        tried += judged.pin.preference > 3
        placed = _with_hardware(judged, search, gallery)
        if placed is not None:
            return placed
    return None


def free_share(search: DoorSearch) -> float:
    """Returns how much of the wanted opening the best pin leaves free, without hardware, in 0..1."""
    return max((j.free for j in search.pins), default=0.0) / search.wanted


def best_bare_axis(search: DoorSearch) -> Axis:
    """Returns the axis of the best pin whether or not it is free: what clearance is made for."""
    return search.pins[0].axis


def _judged_pins(search: DoorSearch) -> list[_Judged]:
    """Returns all pins, best first; makeshift ones are swept only where no class opens freely."""
    tol = _tolerances(search)
    pins = pin_candidates(search.frame, survey(search.frame, search.static_rays, 4 * tol.contact), tol)
    ruled = [_judge(pin, search) for pin in pins if pin.preference < 4]
    clean = [j for j in ruled if j.free >= search.wanted and not j.neighbours]
    makeshift = [] if clean else [_judge(pin, search) for pin in pins if pin.preference >= 4]
    return sorted([*ruled, *makeshift], key=lambda j: j.rank)


def _tolerances(search: DoorSearch) -> Tolerances:
    unit = search.scene.unit
    return Tolerances(search.config.contact * unit, search.config.flush * unit, barrel_radius(search.frame))


def _judge(pin: PinCandidate, search: DoorSearch) -> _Judged:
    axis = search.frame.axis_at(pin.x, pin.y)
    motion = motion_about(axis, JointType.REVOLUTE)
    box = swept_box(search.scene.moving_mesh(search.request.moving).box, motion, search.wanted)
    poses = search.config.coarse_poses
    free, share = free_opening(search.body, motion, search.wanted, in_the_way(search.obstacles, box), poses)
    neighbours = all_blockers(search.body, motion, search.wanted, in_the_way(search.neighbours, box), poses)
    rank = (
        round(1.0 - free / search.wanted, 2) + round(share, 2),
        len(neighbours),
        pin.preference,
        search.request.axis.distance_to(axis.point),
    )
    return _Judged(pin, axis, free, neighbours, rank)


def _with_hardware(judged: _Judged, search: DoorSearch, gallery: Gallery) -> HingePlacement | None:
    """Returns the placement of the first template of the pin's class whose hinges all fit; None where none does."""
    count = hinge_count(search.frame.length)
    for model in gallery.hinges_of(judged.pin.mechanism):
        size = hinge_size(model, search.frame, judged.pin, count)
        if size is None:
            continue
        upper = _opening(judged.axis, model.build(size).range, search)
        site = _site(judged, upper, search)
        hinges = _installed(model, judged.pin, site, count, search)
        if hinges:
            return _placement(judged, model, upper, hinges, search)
    return None


def _opening(axis: Axis, template_range: float, search: DoorSearch) -> float:
    """Returns the widest opening free of the static body, at most the template's and the configured one."""
    motion = motion_about(axis, JointType.REVOLUTE)
    reach = min(template_range, search.config.door_opening)
    box = swept_box(search.scene.moving_mesh(search.request.moving).box, motion, reach)
    return widest_free(search.body, motion, reach, in_the_way(search.obstacles, box), search.config.fine_poses)


def _site(judged: _Judged, upper: float, search: DoorSearch) -> Site:
    door = search.scene.moving_mesh(search.request.moving)
    box = search.scene.parts[search.request.moving].box
    unit = search.scene.unit
    others = tuple(o for o in search.neighbours if o.collider.box.overlaps(box, 0.1 * unit))
    return Site(
        frame=search.frame,
        door=door,
        door_body=search.body,
        scene=search.scene,
        static_rays=search.static_rays,
        obstacles=tuple(in_the_way(search.obstacles, box.grown(0.2 * unit))),
        neighbours=others,
        motion=motion_about(judged.axis, JointType.REVOLUTE),
        upper=upper,
        depth=search.depth,
        anchor=search.config.anchor * unit,
        reach=search.config.bridge * unit,
    )


def _installed(
    model: HingeModel, pin: PinCandidate, site: Site, count: int, search: DoorSearch
) -> list[InstalledHinge]:
    """Returns one hinge per height, each shifted along the pin where its place is taken; empty where one finds none."""
    size = hinge_size(model, search.frame, pin, count)
    if size is None:
        return []
    hinges: list[InstalledHinge] = []
    for z in hinge_heights(search.frame.length, count):
        shifts = (s * search.frame.length for s in _HEIGHT_SHIFTS)
        tries = (install(fit_hinge(model, size, search.frame, pin, z + shift), pin, site) for shift in shifts)
        placed = next((hinge for hinge in tries if hinge is not None), None)
        if placed is None:
            return []
        hinges.append(placed)
    return hinges


def _placement(
    judged: _Judged, model: HingeModel, upper: float, hinges: list[InstalledHinge], search: DoorSearch
) -> HingePlacement:
    part = search.request.moving
    static = [_named(v, part, k) for k, hinge in enumerate(hinges) for v in hinge.static]
    dynamic = [_named(v, part, k) for k, hinge in enumerate(hinges) for v in hinge.dynamic]
    return HingePlacement(
        axis=judged.axis,
        upper=upper,
        mechanism=judged.pin.mechanism,
        template=model.id,
        mount=nearest_part(static[0], search.scene, search.request.mounts),
        count=len(hinges),
        dynamic=tuple(dynamic),
        static=tuple(static),
        in_way=judged.neighbours,
    )


def _named(visual: Visual, part: str, index: int) -> Visual:
    """Returns the visual under a name that is unique in the object: kind, part, index, end."""
    kind, _, end = visual.name.partition("_")
    return replace(visual, name=f"{kind}_{part}_{index}_{end}")


def nearest_part(hardware: Visual, scene: Scene, mounts: tuple[str, ...]) -> str:
    """Returns the id of the static part that hardware sits on; a wanted mount wins a draw."""
    collider = MeshCollider(hardware.mesh)
    near = [o for o in scene.static_obstacles if o.collider.box.overlaps(collider.box, 0.05 * scene.unit)]
    ranked = sorted((round(collider.distance(o.collider), 4), o.id not in mounts, o.id) for o in near)
    return ranked[0][2] if ranked else ""
