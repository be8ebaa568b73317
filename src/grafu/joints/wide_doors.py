"""Doors that open wider than usual, since what slides out behind them would hit them: those of refrigerators.

A thick door that stands open at 110 degrees still covers some of what it closed. Where it is free to turn farther, and
its hinges let it, it opens as little wider as what is behind it needs, and the order states it.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from math import degrees, pi
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.swept_body import SweptBody
from grafu.joints.build import Built
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import PoseFunction, blockers_at, in_the_way, swept_box
from grafu.joints.order import OpeningOrder
from grafu.joints.plan import AUTOMATIC
from grafu.scene.border import part_axes
from grafu.scene.obstacles import Obstacle
from grafu.scene.scene import Scene
from grafu.templates.template import Gallery

Orders = Mapping[str, OpeningOrder]


@final
@dataclass(frozen=True, eq=False)
class OrderedJoints:
    """The joints of one level as built, and the order they open in."""

    built: tuple[Built, ...]
    orders: Orders

    @property
    def opened(self) -> float:
        """How much of what was asked for the joints open, together: at most their number."""
        return sum(min(self.orders[one.request.moving].upper / one.wanted, 1.0) for one in self.built)

    def short(self, config: RealizationConfig) -> tuple[Built, ...]:
        """Returns what slides and opens too little."""
        slides = (one for one in self.built if one.request.kind.slides)
        return tuple(o for o in slides if self.orders[o.request.moving].upper < config.restricted * o.wanted)


def doors_in_the_way(joints: OrderedJoints, config: RealizationConfig) -> tuple[Built, ...]:
    """Returns the doors that something behind them hits, though they stand open, as it slides out: upright ones alone.

    Doors for which something was decided, or that follow another, stay as they are; so do those that stop early.
    """
    met = {name for one in joints.short(config) for name in one.placement.in_way}
    return tuple(one for one in joints.built if one.request.moving in met and _may_open_wider(one, config))


def with_wide_doors(
    joints: OrderedJoints,
    scene: Scene,
    gallery: Gallery,
    order: Callable[[Sequence[Built]], Orders],
    config: RealizationConfig,
) -> OrderedJoints:
    """Returns the joints in which doors open wider where that lets what is behind them slide out, else `joints`.

    Args:
        joints: as they are built with the usual openings.
        scene: what holds them.
        gallery: the templates of their hinges.
        order: orders joints.
        config: the tolerances.
    """
    doors = doors_in_the_way(joints, config)
    widest = {one.request.moving: _widest(one, scene, gallery, config) for one in doors}
    best = joints
    for opening in config.wide_doors.openings:
        wide = {name: min(opening, most) for name, most in widest.items()}
        if all(one.placement.upper >= wide[one.request.moving] for one in doors):
            continue
        built = tuple(_opened(one, wide.get(one.request.moving, 0.0)) for one in joints.built)
        found = OrderedJoints(built, order(built))
        if found.opened > best.opened + config.wide_doors.gain:
            best = found
        if not found.short(config):
            break
    return best if best is joints else _noted(best, widest, config)


def _may_open_wider(door: Built, config: RealizationConfig) -> bool:
    request, axis = door.request, door.placement.axis
    is_free = request.choice == AUTOMATIC and request.coupling is None and request.stop is None
    is_upright = abs(float(axis.direction[2])) > config.upright
    return request.kind.turns and is_free and is_upright and door.placement.upper >= config.hinge.usual_opening


def _opened(one: Built, upper: float) -> Built:
    """Returns a joint that opens up to `upper`, if that is wider."""
    return replace(one, placement=replace(one.placement, upper=max(one.placement.upper, upper)))


def _widest(door: Built, scene: Scene, gallery: Gallery, config: RealizationConfig) -> float:
    """Returns how far a door turns, radians, before it, or its hardware, hits what it does not touch closed."""
    reach = min(config.wide_doors.openings[-1], _range(door.placement.template, gallery))
    free, motion = door.placement.upper, door.placement.axis.rotation
    bodies = list(_bodies(door, scene, motion, reach, config))
    at_rest = [{*blockers_at(body, motion(0.0), obstacles)} for body, obstacles in bodies]
    for value in np.arange(free, reach, config.wide_doors.step)[1:]:
        hits = (
            not {*blockers_at(body, motion(value), near)} <= known
            for (body, near), known in zip(bodies, at_rest, strict=True)
        )
        if any(hits):
            break
        free = float(value)
    return free


def _bodies(
    door: Built, scene: Scene, motion: PoseFunction, reach: float, config: RealizationConfig
) -> Iterator[tuple[SweptBody, Sequence[Obstacle]]]:
    """Yields the door and all that stands near its path, then its hardware and all of that but other hardware."""
    moving = door.request.moving
    depth, axes = config.depth * scene.extent, part_axes(scene.parts[moving].mesh)
    others = scene.other_bodies(moving)
    path = swept_box(scene.body_box(moving), motion, reach)
    yield (
        scene.swept_body(moving, depth, axes),
        [*in_the_way(scene.still_obstacles, path), *in_the_way(others, path)],
    )
    if pieces := [visual.mesh for visual in scene.hardware_of(moving) if visual.swing is None]:
        near = [*in_the_way(scene.static_obstacles, path), *in_the_way(others, path)]
        yield SweptBody(merge_meshes(pieces), depth, axes), near


def _range(template: str, gallery: Gallery) -> float:
    """Returns how far hinges of a template turn, radians; pivots and what is drawn turn by half a turn."""
    hinges = {model.id: model.build(model.natural).range for model in gallery.hinges if model.id == template}
    cups = {model.id: model.range for model in gallery.concealed}
    return {**hinges, **cups}.get(template, pi)


def _noted(joints: OrderedJoints, doors: Mapping[str, float], config: RealizationConfig) -> OrderedJoints:
    """Returns the joints with a note on each door that opens wider than doors do."""
    orders = {
        name: replace(order, note=_note(order.upper)) if name in doors and order.upper > config.door_opening else order
        for name, order in joints.orders.items()
    }
    return replace(joints, orders=orders)


def _note(upper: float) -> str:
    return f"opens by {degrees(upper):.0f} degrees: at less it stands before what slides out behind it"
