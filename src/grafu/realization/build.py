"""Builds one joint on a scene: clearance where it is needed, then hinges or rails, then what was measured on it."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import final

from grafu.geometry.arrays import Mat3
from grafu.geometry.axis import Axis
from grafu.realization.clearance.make import make_clearance
from grafu.realization.clearance.path import Path
from grafu.realization.config import RealizationConfig
from grafu.realization.hinge.border import part_axes
from grafu.realization.hinge.place import place_hinges
from grafu.realization.hinge.search import door_search
from grafu.realization.limits import motion_about
from grafu.realization.placement import Placement
from grafu.realization.plan import JointRequest
from grafu.realization.rail.place import place_rails
from grafu.realization.rail.search import drawer_search
from grafu.realization.report import Clearance, Skipped, SkipReason
from grafu.realization.scene import Scene
from grafu.templates.template import Gallery
from grafu.vocabulary import JointType, PartLabel


@final
@dataclass(frozen=True, eq=False)
class Built:
    """One joint with its hardware, and the scene that holds it."""

    request: JointRequest
    placement: Placement
    scene: Scene
    clearances: tuple[Clearance, ...]
    wanted: float


def build_joint(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Skipped:
    """Returns the joint as built, or why it could not be."""
    return _BUILDERS[request.type](request, scene, gallery, config)


def _build_door(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Skipped:
    search = door_search(request, scene, config)
    clearances: tuple[Clearance, ...] = ()
    share = search.best().free / search.wanted
    if share < 1.0:
        axis, axes = search.to_clear().axis, part_axes(scene.parts[request.moving].mesh)
        cleared, clearances = _cleared(request, scene, axis, axes, search.wanted, config)
        again = door_search(request, cleared, config)
        if again.best().free / again.wanted > share:
            search, scene = again, cleared
        else:
            clearances = ()
    placement = place_hinges(search, gallery)
    if placement is None:
        return _skipped(request, search.best().free / search.wanted)
    return _built(request, placement, scene, clearances, search.wanted)


def _build_drawer(request: JointRequest, scene: Scene, gallery: Gallery, config: RealizationConfig) -> Built | Skipped:
    search = drawer_search(request, scene, config)
    if search is None:
        return Skipped(request.moving, SkipReason.UNSUPPORTED, "it slides up or down; rails carry level drawers")
    if scene.parts[request.moving].label is PartLabel.DOOR and search.frame.depth > 2 * search.mesh.box.size.min():
        return Skipped(request.moving, SkipReason.UNSUPPORTED, "a sliding door; only hinged doors are built")
    clearances: tuple[Clearance, ...] = ()
    share = search.free_share()
    if share < 1.0:
        axes = part_axes(search.mesh)
        cleared, clearances = _cleared(request, scene, search.axis, axes, search.reach, config)
        again = drawer_search(request, cleared, config)
        if again is not None and again.free_share() > share:
            search, scene = again, cleared
        else:
            clearances = ()
    placement = place_rails(search, gallery)
    if placement is None:
        return _skipped(request, search.free_share())
    return _built(request, placement, scene, clearances, search.wanted)


_BUILDERS: dict[JointType, Callable[[JointRequest, Scene, Gallery, RealizationConfig], Built | Skipped]] = {
    JointType.REVOLUTE: _build_door,
    JointType.PRISMATIC: _build_drawer,
}


def _cleared(
    request: JointRequest, scene: Scene, axis: Axis, axes: Mat3, reach: float, config: RealizationConfig
) -> tuple[Scene, tuple[Clearance, ...]]:
    turns = request.type is JointType.REVOLUTE
    path = Path(request.moving, motion_about(axis, request.type), reach, axes, turns)
    cleared = make_clearance(scene, path, config)
    return cleared.scene, cleared.clearances


def _skipped(request: JointRequest, free: float) -> Skipped:
    """Returns why nothing was built: what blocks the part, or the lack of a place for hardware."""
    if free < 0.3:
        detail = "it cannot move freely about any candidate axis, not even with the clearance allowed"
        return Skipped(request.moving, SkipReason.BLOCKED, detail)
    detail = "no mechanism finds a hold on both sides without cutting into parts"
    return Skipped(request.moving, SkipReason.NO_ROOM, detail)


def _built(
    request: JointRequest, placement: Placement, scene: Scene, clearances: tuple[Clearance, ...], wanted: float
) -> Built:
    scene = scene.with_hardware(request.moving, placement.dynamic, placement.static)
    return Built(request, placement, replace(scene), clearances, wanted)
