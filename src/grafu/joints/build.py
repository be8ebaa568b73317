"""Builds one joint on a scene: clearance where it is needed, then hinges or rails, then the outcome.

A part that keeps cutting into its neighbours at rest, because clearance is not allowed or would cost too much, still
gets its joint; what it cuts into is left out of account, and the report states in how many poses it collides.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.config_checks import at_scale
from grafu.joints.clearance.at_rest import trimmed_at_rest
from grafu.joints.clearance.carve import Path, obstruction
from grafu.joints.clearance.in_frame import leaf_in_frame
from grafu.joints.clearance.make import make_clearance
from grafu.joints.clearance.seam import trimmed_at_seam
from grafu.joints.clearance.trim import trim
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_hinges import drawn_pin
from grafu.joints.hinge.place import concealed_instead, pivoted_within, place_hinges
from grafu.joints.hinge.search import DoorSearch, door_search
from grafu.joints.no_hardware import (
    door_on_drawn_hinges,
    door_without_hardware,
    drawer_without_hardware,
    leaf_without_hardware,
    lift_without_hardware,
    support_without_hardware,
)
from grafu.joints.plan import JointRequest, MotionRole
from grafu.joints.rail.place import place_rails
from grafu.joints.rail.search import DrawerSearch, beside_rack, drawer_search
from grafu.joints.report import Clearance, Placement
from grafu.refusal import Reason, Refusal
from grafu.scene.border import border_frame, part_axes
from grafu.scene.scene import JointMotion, Scene
from grafu.templates.template import Gallery
from grafu.vocabulary import JointType

_Found = tuple[Placement, Scene, tuple[Clearance, ...]]
_ON_WHAT_IS_THERE = (MotionRole.SUPPORT, MotionRole.SEAT)
"""What turns without hardware where it is free so: hinges of its own would set seat and lid apart."""


@final
@dataclass(frozen=True, eq=False)
class Built:
    """One joint with its hardware, and the scene that holds it; `wanted` is the opening that was asked for."""

    request: JointRequest
    placement: Placement
    scene: Scene
    clearances: tuple[Clearance, ...]
    wanted: float


def build_joint(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Refusal:
    """Returns the joint as built, or why it could not be.

    An opening that was chosen, or that follows from a leader's, may be wider than doors have by default.
    """
    opening = request.choice.opening if request.coupling is None else request.reference
    if opening is not None and request.kind.turns:
        config = replace(config, door_opening=max(config.door_opening, opening))
    metre = scene.metre
    return _BUILDERS[request.type](request, scene, gallery.at_scale(metre), at_scale(config, metre))


def _build_door(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Refusal:
    pressed, lap = _at_rest(request, scene, request.axis, config.hinge.usual_opening, config)
    moved = replace(request, axis=_on_edge(request, scene, pressed)) if lap else request
    pressed, seam = trimmed_at_seam(moved, pressed, config) if config.trim else (pressed, ())
    built = _door_built(moved, pressed, gallery, config)
    if isinstance(built, Refusal):
        return built
    return replace(built, request=request, clearances=(*lap, *seam, *built.clearances))


def _on_edge(request: JointRequest, before: Scene, after: Scene) -> Axis:
    """Returns the axis of a door whose border was pressed back: as far from the border as before."""
    old, new = (border_frame(scene.parts[request.moving].mesh, request.axis) for scene in (before, after))
    across = old.direction(1.0, 0.0, 0.0)
    point = request.axis.point + across * float((new.origin - old.origin) @ across)
    return replace(request.axis, point=point)


def _door_built(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Refusal:
    search = door_search(request, scene, config)
    if not search.has_pins:
        return Refusal(request.moving, Reason.NO_ROOM, f"what stands around it allows no {request.choice}")
    swung = support_without_hardware(search) if request.role in _ON_WHAT_IS_THERE else None
    drawn = (swung, scene, ()) if swung else _on_drawn_hinges(search)
    if drawn is not None:
        return _built(request, drawn, search.wanted)
    is_blocked = search.best().free < search.wanted
    found = _cleared(search) if is_blocked else (search, ())
    placement = _hinged(found[0], gallery)
    if not is_blocked and not _is_wide(placement, search) and search.free_ratio() < 1.0:
        again = _cleared(search)  # something blocks it between the poses in which pins were compared
        wider = None if again[0] is search else _hinged(again[0], gallery)
        found, placement = (again, wider) if _is_wide(wider, search) else (found, placement)
    search, clearances = found
    placement = _past_slides(placement, search, gallery) or door_without_hardware(search)
    if placement is None:
        return _skipped(request, search.best().free / search.wanted, search.scene, config)
    return _built(request, (placement, search.scene, clearances), search.wanted)


def _on_drawn_hinges(search: DoorSearch) -> _Found | None:
    """Returns the joint on the hinges that are drawn, if any, with clearance made for the door where it needs some.

    If other parts block it most of the way about their pin, nothing is cut for it.
    """
    pin = drawn_pin(search)
    if pin is None:
        return None
    placement = door_on_drawn_hinges(pin.axis, search)
    if placement is not None:
        return placement, search.scene, ()
    path, config = _path(search.request, search.scene, pin.axis, search.wanted), search.config
    if obstruction(search.scene, path, config, pin.parts).ratio > config.hinge.drawn.blocked:
        return None
    cleared = make_clearance(search.scene, path, config, pin.parts)
    placement = door_on_drawn_hinges(pin.axis, door_search(search.request, cleared.scene, config))
    return (placement, cleared.scene, cleared.clearances) if placement else None


def _is_wide(placement: Placement | None, search: DoorSearch) -> bool:
    return placement is not None and placement.upper >= search.config.restricted * search.wanted


def _cleared(search: DoorSearch) -> tuple[DoorSearch, tuple[Clearance, ...]]:
    """Returns the search in the scene with clearance made for the door, if it opens wider there; else as it was."""
    if search.config.trim and (fitted := _fitted(search)):
        return fitted
    axis = search.to_clear().axis
    again, clearances = _cleared_about(axis, search)
    is_behind = search.request.axis.distance_to(axis.point) > search.frame.thickness / 2
    if is_behind and again.free_ratio() < search.config.least_opening:
        again, clearances = _cleared_about(search.request.axis, search)
    is_wider = again.best().free > search.best().free or again.free_ratio() > search.free_ratio()
    if search.config.trim and (again if is_wider else search).met_at_rest():
        found = _fitted(search, sides=1)
        if found is not None:
            return found
    return (again, clearances) if is_wider else (search, ())


def _cleared_about(axis: Axis, search: DoorSearch) -> tuple[DoorSearch, tuple[Clearance, ...]]:
    """Returns the search in the scene in which a door has the clearance that it needs to turn about an axis."""
    cleared = make_clearance(search.scene, _path(search.request, search.scene, axis, search.wanted), search.config)
    again = door_search(search.request, cleared.scene, search.config) if cleared.clearances else search
    return again, cleared.clearances


def _fitted(search: DoorSearch, sides: int = 2) -> tuple[DoorSearch, tuple[Clearance, ...]] | None:
    """Returns the search in the scene with a leaf cut to the opening of its frame; None where that does not free it."""
    request, config = search.request, search.config
    axes = part_axes(search.scene.parts[request.moving].mesh)
    for scene, clearances in leaf_in_frame(search.scene, request.moving, axes, search.met_at_rest(), config, sides):
        again = door_search(request, scene, config)
        if again.best().free >= config.restricted * again.wanted and not again.met_at_rest():
            return again, clearances
    return None


def _hinged(search: DoorSearch, gallery: Gallery) -> Placement | None:
    return place_hinges(search, gallery) or _despite_doors(search, gallery)


def _past_slides(placement: Placement | None, search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns a placement that no neighbour that slides runs into, hidden or without hardware; else as it was.

    A door beside it may turn about another axis when it is built; a drawer has one way, and would be blocked.
    """
    motions = search.scene.joint_motions
    struck = [name for name in (placement.struck_by if placement else ()) if name in motions]
    if not any(motions[name].kind.slides and not motions[name].is_built for name in struck):
        return placement
    hidden = (partial(concealed_instead, search, gallery), partial(pivoted_within, search))
    others = (find() for find in (*hidden, partial(door_without_hardware, search)))
    return next((other for other in others if other is not None and not other.struck_by), placement)


def _despite_doors(search: DoorSearch, gallery: Gallery) -> Placement | None:
    """Returns a placement that leaves out of account what the door cuts into at rest."""
    met = search.met_at_rest()
    return place_hinges(door_search(search.request, search.scene, search.config, met), gallery) if met else None


def _build_drawer(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Refusal:
    search = drawer_search(request, scene, config)
    if search is None:
        return Refusal(request.moving, Reason.UNSUPPORTED, "it slides askew, neither level nor upright")
    scene, lap = _at_rest(request, scene, search.axis, search.reach, config)
    search = (drawer_search(request, scene, config) or search) if lap else search
    clearances = lap
    if (ratio := search.free_ratio()) < 1.0:
        cleared = make_clearance(scene, _path(request, scene, search.axis, search.reach), config)
        again = drawer_search(request, cleared.scene, config)
        if again is not None and _is_freer(again, search, ratio):
            search, scene, clearances = again, cleared.scene, (*lap, *cleared.clearances)
    placement = _guided(search, gallery)
    found = (placement, scene, clearances) if placement else _with_play(search, gallery, clearances)
    if found is None and (beside := beside_rack(search)) is not None and (placement := _guided(beside, gallery)):
        return _built(request, (placement, scene, clearances), request.reference or beside.wanted)
    free = None if found else drawer_without_hardware(search)
    found = (free, scene, clearances) if free else found
    if found is None:
        return _skipped(request, search.free_ratio(), scene, config)
    return _built(request, found, request.reference or search.wanted)


def _is_freer(again: DrawerSearch, search: DrawerSearch, ratio: float) -> bool:
    """Whether a drawer slides farther than `ratio`, as before, or meets less at rest: a rail beside it may be left."""
    return again.free_ratio() > ratio or set(again.met_at_rest()) < set(search.met_at_rest())


def _guided(search: DrawerSearch, gallery: Gallery) -> Placement | None:
    """Returns the rails, or what a column, the leaf of a table and its support run in, which need none."""
    if search.request.role in (MotionRole.EXTENSION, MotionRole.SUPPORT):
        return leaf_without_hardware(search)
    return lift_without_hardware(search) if search.is_column else place_rails(search, gallery)


def _with_play(search: DrawerSearch, gallery: Gallery, clearances: tuple[Clearance, ...]) -> _Found | None:
    """Returns rails for a drawer trimmed where it touches its walls, else ones that leave out what it cuts into."""
    request, scene, config = search.request, search.scene, search.config
    if config.trim:
        walls = [o.id for o in scene.static_obstacles.near(search.mesh.box, config.clearance.beside)]
        walls += [o.id for o in scene.static_hardware.near(search.mesh.box, 0.0)]  # of a neighbour without a gap
        path = _path(request, scene, search.axis, search.reach)
        cleared, trimmed = trim(scene, path, walls, config, touching=True)
        again = drawer_search(request, cleared, config) if trimmed else None
        placement = _guided(again, gallery) if again else None
        if placement is not None:
            return placement, cleared, (*clearances, *trimmed)
    met = search.met_at_rest()
    despite = drawer_search(request, scene, config, met) if met else None
    placement = _guided(despite, gallery) if despite else None
    return (placement, scene, clearances) if placement else None


_BUILDERS: dict[JointType, Callable[[JointRequest, Scene, Gallery, RealizationConfig], Built | Refusal]] = {
    JointType.REVOLUTE: _build_door,
    JointType.PRISMATIC: _build_drawer,
}


def _path(request: JointRequest, scene: Scene, axis: Axis, reach: float) -> Path:
    axes = part_axes(scene.parts[request.moving].mesh)
    return Path(request.moving, request.kind.along(axis), reach, axes, request.kind.turns)


def _at_rest(
    request: JointRequest, scene: Scene, axis: Axis, reach: float, config: RealizationConfig
) -> tuple[Scene, tuple[Clearance, ...]]:
    """Returns the scene with the part pressed back from other moving bodies, where material may be removed."""
    return trimmed_at_rest(scene, _path(request, scene, axis, reach), config) if config.trim else (scene, ())


def _skipped(request: JointRequest, free: float, scene: Scene, config: RealizationConfig) -> Refusal:
    """Returns why nothing was built: nothing to hold it, what blocks it, or the lack of a place for hardware."""
    box = scene.parts[request.moving].box
    what = f"mechanism as chosen ({request.choice})" if str(request.choice) else "mechanism"
    held_by = scene.static_obstacles_of(request.holders)
    if not held_by.near(box, config.contact):
        detail = f"no static part is near enough to carry a {what}"
        return Refusal(request.moving, Reason.NO_FACING_SURFACES, detail)
    if free < config.least_opening:
        detail = "it cannot move freely about any candidate axis, not even with the clearance allowed"
        return Refusal(request.moving, Reason.BLOCKED, detail)
    detail = f"no {what} finds a hold on both sides without cutting into parts"
    return Refusal(request.moving, Reason.NO_ROOM, detail)


def _built(request: JointRequest, found: _Found, wanted: float) -> Built:
    placement, scene, clearances = found
    most = request.choice.opening
    if most is not None:
        placement, wanted = replace(placement, upper=min(placement.upper, most)), min(wanted, most)
    joint_motion = JointMotion(placement.axis, request.type, placement.upper)
    with_joint = scene.with_joint(request.moving, joint_motion, placement.dynamic, placement.static)
    return Built(request, placement, with_joint, clearances, wanted)
