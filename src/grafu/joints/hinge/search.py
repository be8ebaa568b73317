"""One door's search: its pins, and what a sweep of the door without hardware states about each. It installs nothing."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property
from math import pi
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.joints.config import RealizationConfig
from grafu.joints.hinge.candidates import (
    PIVOTS,
    PinCandidate,
    Tolerances,
    barrel_radius,
    concealed_pins,
    hinge_count,
    makeshift_pins,
    ruled_pins,
    turns_about_itself,
)
from grafu.joints.hinge.hardware import InstalledHinge
from grafu.joints.hinge.judged import JudgedPin
from grafu.joints.hinge.most_opening import most_opening
from grafu.joints.hinge.neighbours import Neighbour, neighbours_of
from grafu.joints.hinge.pivot_pins import fold_pin, inner_pivots, pivot_pins
from grafu.joints.hinge.survey import BorderSurvey, survey
from grafu.joints.limits import all_blockers, free_opening, in_the_way, sweep, swept_box, widest_above, widest_free
from grafu.joints.plan import CUP, PIVOT, JointRequest
from grafu.scene.border import BorderFrame, border_frame, part_axes, without_handle
from grafu.scene.obstacles import Obstacles
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True, eq=False)
class DoorSearch:
    """What one door may hit, how far it is wanted to open, and how far it opens at most (radians)."""

    request: JointRequest
    scene: Scene
    config: RealizationConfig
    frame: BorderFrame
    body: SweptBody
    obstacles: Obstacles
    neighbours: Obstacles
    wanted: float
    most: float

    @property
    def depth(self) -> float:
        """The tolerated penetration in metres."""
        return self.config.depth * self.scene.extent

    @property
    def box(self) -> Box:
        """The box of the door and all that rides on it, at rest."""
        return self.scene.moving_mesh(self.request.moving).box

    @cached_property
    def static_rays(self) -> RayCaster:
        """The static body around the door, of which what alone may hold it, prepared for rays."""
        return RayCaster(self.carriers)

    @cached_property
    def carriers(self) -> TriangleMesh:
        """The static body around the door that may carry it: all of it, or the parts that alone may hold it."""
        box = self.scene.parts[self.request.moving].box
        reach = self.config.hinge.carriers * float(box.size.max())
        return self.scene.static_mesh_near(box, reach, self.request.holders)

    @cached_property
    def door_rays(self) -> RayCaster:
        """The door and all that rides on it, prepared for rays."""
        return RayCaster(self.scene.moving_mesh(self.request.moving))

    @cached_property
    def bodies_around(self) -> tuple[Neighbour, ...]:
        """The other moving bodies, with and their motions, as built or as expected."""
        return neighbours_of(self.request.moving, self.scene, self.depth)

    @cached_property
    def installed(self) -> dict[tuple[object, ...], InstalledHinge | None]:
        """Hinges as they were installed, None where one finds no hold, by all that makes them; not a value."""
        return {}

    @cached_property
    def ruled(self) -> list[JudgedPin]:
        """The pins of the hinge classes that the surroundings allow, best first."""
        if turns_about_itself(self.frame, self.request.axis, self.config.hinge):
            return []
        return self._judged(self._allowed)

    @cached_property
    def others(self) -> list[JudgedPin]:
        """Pivots and makeshift pins, best first."""
        tol, config = self._tolerances, self.config.hinge
        slim = [fold_pin(self.config.fold)] if self.request.on_pivots else []
        pivots = pivot_pins(self.frame, self.request.axis, tol, config)
        return self._judged([*slim, *pivots, *makeshift_pins(self.frame, tol, config.pin)])

    @cached_property
    def inner(self) -> list[JudgedPin]:
        """The pivots further inside the door that leave it free, in the order tried; none of what has its own axis."""
        pins = inner_pivots(self.frame, self.request.axis, self._tolerances, self.config.hinge)
        return [judged for judged in map(self._judge, filter(self._is_left, pins)) if judged.is_clear]

    @cached_property
    def slim(self) -> list[JudgedPin]:
        """The pins of the hinge classes for barrels of half the size, best first: they keep within narrow seams."""
        if turns_about_itself(self.frame, self.request.axis, self.config.hinge):
            return []
        tol = replace(
            self._tolerances, radius=max(self.config.hinge.slim * self._tolerances.radius, self.config.hinge.smallest)
        )
        return self._judged(self._ruled_pins(tol))

    @property
    def expected_axis(self) -> Axis:
        """The axis of the first hinge class about which the door, without hardware, is free; else the requested one."""
        if turns_about_itself(self.frame, self.request.axis, self.config.hinge):
            return self.request.axis
        if self.request.on_pivots:
            pivots = (other.axis for other in self.others if other.pin.is_pivot and other.is_clear)
            if (axis := next(pivots, None)) is not None:
                return axis
        judged = (self._judge(pin) for pin in self._allowed)
        return next((j.axis for j in judged if j.is_clear), self.request.axis)

    @property
    def count(self) -> int:
        """How many hinges the door is to have."""
        return self.request.choice.count or hinge_count(self.frame.length, self.config.hinge)

    @property
    def has_pins(self) -> bool:
        """Whether any pin is left to try."""
        return any(True for _ in self.in_order())

    @cached_property
    def _allowed(self) -> list[PinCandidate]:
        return self._ruled_pins(self._tolerances)

    def _ruled_pins(self, tol: Tolerances) -> list[PinCandidate]:
        """Returns the pins of the classes that the surroundings allow; of a forced class, over wider seams at need."""
        forced = self.request.choice.mechanism
        pins = ruled_pins(self.frame, self._survey(tol), tol, self.config.hinge.pin)
        if forced is None:
            return pins
        looser = self.config.hinge.looser
        wider = replace(tol, contact=looser * tol.contact, flush=looser * tol.flush)
        of_class = [pin for pin in pins if pin.mechanism is forced]
        more = ruled_pins(self.frame, self._survey(wider), wider, self.config.hinge.pin)
        return of_class or [pin for pin in more if pin.mechanism is forced]

    def _survey(self, tol: Tolerances) -> BorderSurvey:
        config = self.config.hinge.survey
        found = survey(self.frame, self.static_rays, config.reach * tol.contact, config)
        return replace(found, meets=self._meets(tol.contact))

    def _meets(self, seam: float) -> bool:
        """Whether another moving body, closed, stands within a seam, metres, beside the hinge border."""
        frame = self.frame
        corners = [(x, y, z) for x in (-seam, 0.0) for y in (-frame.thickness, 0.0) for z in (-0.5, 0.5)]
        beside = Box.around(frame.to_object(np.array(corners) * (1.0, 1.0, frame.length)))
        return self.scene.is_another_beside(self.request.moving, beside)

    @property
    def _tolerances(self) -> Tolerances:
        radius = barrel_radius(self.frame, self.config.hinge) * self.request.choice.scale
        return Tolerances(self.config.contact, self.config.flush, radius)

    def in_order(self) -> Iterator[JudgedPin]:
        """Yields all pins that the request's choice leaves, in the order of `_all_in_order`."""
        if self.request.choice.template == CUP:
            return iter(self.concealed)
        return (judged for judged in self._all_in_order() if self._is_left(judged.pin))

    @cached_property
    def concealed(self) -> list[JudgedPin]:
        """The axes of a door on concealed hinges, nearest to its true motion first."""
        pins = concealed_pins(self.frame, self.config.hinge.concealed)
        return [] if self.request.coupling or self.request.parent else [self._judge(pin) for pin in pins]

    def _is_left(self, pin: PinCandidate) -> bool:
        choice = self.request.choice
        if pin.is_pivot:
            return choice.mechanism is None and choice.takes(PIVOT) and not choice.count
        return choice.mechanism in (None, pin.mechanism) and choice.template != PIVOT

    def _all_in_order(self) -> Iterator[JudgedPin]:
        """Yields all pins: those of a hinge class that leave the door free, slim ones, pivots, then everything by rank.

        What is no board turns about the axis that was asked for, if anything can carry it there. So does the outer leaf
        of two that fold, or near it. Inset leaves come after the pivots, except between doors that meet.
        """
        slim = (judged for judged in self.slim if not judged.pin.inset)
        first = [judged for judged in (*self.ruled, *slim) if judged.is_clear and judged.pin.preference < PIVOTS]
        if turns_about_itself(self.frame, self.request.axis, self.config.hinge):
            first = [judged for judged in self.others if judged.pin.is_pivot]
        if not self.request.on_pivots:
            yield from first  # most doors need no others
        pivots = [judged for judged in self.others if judged.is_clear and judged.pin.is_pivot and judged not in first]
        yield from (*pivots, *first) if self.request.on_pivots else pivots
        rest = (j for j in (*self.ruled, *self.slim, *self.others) if j not in first and j not in pivots)
        yield from sorted(rest, key=lambda j: j.rank)

    def best(self) -> JudgedPin:
        """Returns the best pin by the sweep alone."""
        return next(self.in_order())

    def free_ratio(self) -> float:
        """Returns the fraction of the wanted opening, 0..1, that the door without hardware turns about its best pin."""
        best = self.best()
        return min(best.free, self.widest(best.axis, self.wanted)) / self.wanted

    def to_clear(self) -> JudgedPin:
        """Returns the pin to make clearance for where none is free: of a hinge class, or the axis as asked for."""
        pivots = [judged for judged in self.others if judged.pin.is_pivot]
        return min(self.ruled or pivots, key=lambda judged: judged.rank)

    def met_at_rest(self) -> tuple[str, ...]:
        """Returns what the door cuts into before it has moved at all."""
        return sweep(self.body, self.best().axis.rotation, 0.0, in_the_way(self.obstacles, self.box), 1).blockers

    def widest(self, axis: Axis, reach: float) -> float:
        """Returns the widest opening about an axis, at most `reach`, that is free of the static body and the floor."""
        motion, reach = axis.rotation, self._above_floor(axis, reach)
        near = in_the_way(self.obstacles, swept_box(self.box, motion, reach))
        return widest_free(self.body, motion, reach, near, self.config.fine_poses, self.config.short)

    def _above_floor(self, axis: Axis, reach: float) -> float:
        """Returns the widest opening at which nothing of the door is below the floor, deeper than what is tolerated.

        Upright axes keep its height, and what follows the leaf that carries it is raised by that.
        """
        is_carried = self.request.coupling is not None and bool(self.request.parent)
        if is_carried or abs(float(axis.direction[2])) > self.config.level_axis:
            return reach
        mesh = self.scene.moving_mesh(self.request.moving)
        return widest_above(mesh, axis, reach, self.scene.floor - self.depth, self.config.coarse_poses)

    def sinks(self, axis: Axis) -> bool:
        """Whether the door, open about an axis as far as wanted, lies lower than what is to carry it there."""
        if self.request.rests is None:
            return False
        raised = self.scene.parts[self.request.moving].mesh.transformed(axis.rotation(self.wanted))
        return float(raised.box.low[2]) < self.request.rests - self.depth

    def bodies_in_the_way(self, axis: Axis, reach: float) -> tuple[str, ...]:
        """Returns the other moving bodies, at rest, that the door runs into about an axis."""
        near = in_the_way(self.neighbours, swept_box(self.box, axis.rotation, reach))
        return all_blockers(self.body, axis.rotation, reach, near, self.config.coarse_poses)

    def _judged(self, pins: list[PinCandidate]) -> list[JudgedPin]:
        return sorted((self._judge(pin) for pin in pins), key=lambda judged: judged.rank)

    def _judge(self, pin: PinCandidate) -> JudgedPin:
        axis = self.frame.axis_at(pin.x, pin.y)
        motion = axis.rotation
        box = swept_box(self.box, motion, self.wanted)
        poses = self.config.coarse_poses
        free, ratio = free_opening(self.body, motion, self.wanted, in_the_way(self.obstacles, box), poses)
        above = self._above_floor(axis, self.wanted)
        stopped = free if above >= self.config.restricted * self.wanted else min(free, above)
        neighbours = self.bodies_in_the_way(axis, self.wanted)
        shortfall = round(1.0 - stopped / self.wanted, 2) + round(ratio, 2) + float(self.sinks(axis))
        rank = (shortfall, len(neighbours), pin.preference, self.request.axis.distance_to(axis.point))
        is_clear = shortfall <= self.config.hinge.nearly and not neighbours
        return JudgedPin(pin, axis, min(free, above), neighbours, rank, is_clear)


def door_search(
    request: JointRequest, scene: Scene, config: RealizationConfig, ignored: tuple[str, ...] = ()
) -> DoorSearch:
    """Returns the search for one request; what is `ignored` does not count as an obstacle."""
    part = scene.parts[request.moving]
    around, drawn = config.hinge.survey, border_frame(part.mesh, request.axis)
    frame = without_handle(drawn, part.mesh, around.front, around.rounding)
    most = most_opening(request, frame, part.mesh, config)
    wanted = min(request.reference or config.hinge.usual_opening, most)
    return DoorSearch(
        request,
        scene,
        config,
        frame,
        scene.swept_body(request.moving, config.depth * scene.extent, part_axes(part.mesh)),
        scene.still_obstacles.without(ignored),
        scene.other_bodies(request.moving),
        max(wanted, min(config.hinge.least_opening, request.stop or pi)),
        most,
    )
