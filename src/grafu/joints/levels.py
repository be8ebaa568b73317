"""All joints of a plan: those on the static body first, then those on moving bodies, each level in its carrier's view.

A joint on a moving body is built in the closed pose of that body. Where it is blocked there, it is tried with that body
open, and then waits for it. One that follows another is swept together with it. What gets no joint of its own moves
with its carrier.
"""

from collections.abc import Mapping, Sequence
from dataclasses import field, replace
from functools import partial
from typing import final

from grafu.articulation.articulated_object import Coupling
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4
from grafu.geometry.budget import within
from grafu.geometry.transform import invert
from grafu.joints.build import Built
from grafu.joints.build_all import build_fairly
from grafu.joints.config import RealizationConfig
from grafu.joints.corner_leaves import room_in_corner
from grafu.joints.coupled import Coupled
from grafu.joints.fold_track import NO_TRACK, with_track
from grafu.joints.measuring import Figures, Measured, measure_all
from grafu.joints.nesting import above, brought_back, riding, seen_from
from grafu.joints.order import BuiltJoint, Meetings, OpeningOrder, order_joints, stand_aside
from grafu.joints.plan import JointRequest, MotionRole
from grafu.joints.wide_doors import OrderedJoints, with_wide_doors
from grafu.processes.cache import Cache
from grafu.refusal import Refusal
from grafu.scene.scene import Scene
from grafu.templates.template import Gallery


@final
@dataclass(frozen=True, eq=False)
class Levels:
    """What was built so far: the joints by moving body with figures and orders, the whole scene, and what was refused.

    `parent_of` is by moving body the one that carries it ("": the static body), `couplings` by the one that follows
    how it does; `notes` are on single joints.
    """

    scene: Scene
    built: Mapping[str, Built] = field(default_factory=dict)
    figures: Mapping[str, Figures] = field(default_factory=dict)
    orders: Mapping[str, OpeningOrder] = field(default_factory=dict)
    skipped: tuple[Refusal, ...] = ()
    parent_of: Mapping[str, str] = field(default_factory=dict)
    couplings: Mapping[str, Coupling] = field(default_factory=dict)
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def with_level(self, measured: Measured, scene: Scene, parent: str) -> "Levels":
        """Returns these with what was built on one body; `scene` is the whole one."""
        built = {one.request.moving: one for one in measured.built}
        return replace(
            self,
            scene=scene,
            built={**self.built, **built},
            figures={**self.figures, **measured.figures},
            orders={**self.orders, **{name: measured.orders[name] for name in built}},
            skipped=(*self.skipped, *measured.skipped),
            parent_of={**self.parent_of, **dict.fromkeys(built, parent)},
        )

    def noted(self, moving: str, note: str) -> "Levels":
        """Returns these with a note on one joint."""
        return replace(self, notes={**self.notes, moving: (*self.notes.get(moving, ()), note)})


@final
@dataclass(frozen=True)
class Builder:
    """What builds joints: templates, tolerances, and what is known of earlier runs."""

    gallery: Gallery
    config: RealizationConfig
    cache: Cache

    def all_levels(self, requests: Sequence[JointRequest], scene: Scene) -> Levels:
        """Returns the joints of all requests that can be built, and why the others cannot."""
        parent_of = {request.moving: request.parent for request in requests}
        first = [request for request in requests if not request.parent]
        nested = sorted((r for r in requests if r.parent), key=lambda r: len(list(above(r.moving, parent_of))))
        view = seen_from("", [r.moving for r in first], scene, parent_of) if nested else scene
        measured = self._level(first, view)
        whole = brought_back(measured.scene, view, "", scene) if nested else measured.scene
        levels = Levels(scene, parent_of=parent_of).with_level(measured, whole, "")
        for request in nested:
            levels = self._with_nested(levels, request)
        for request in requests:
            levels = self._with_coupling(levels, request)
        for request in requests:
            levels = self._with_leaf(levels, request)
        return levels

    def _level(self, requests: Sequence[JointRequest], scene: Scene) -> Measured:
        """Returns the joints of one body that were built, ordered and measured in its view."""
        built, failed, scene = build_fairly(requests, scene, self.gallery, self.config, self.cache)
        order = partial(self._orders, scene, Meetings(scene))
        usual = OrderedJoints(tuple(built), order(built))
        wider = partial(with_wide_doors, usual, scene, self.gallery.at_scale(scene.metre), order, self.config)
        made = within(self.config.wide_doors.time, wider, lambda _: usual)
        measured = measure_all(made.built, made.orders, scene, self.config, self.cache)
        return replace(measured, skipped=(*failed, *measured.skipped))

    def _orders(self, scene: Scene, meetings: Meetings, built: Sequence[Built]) -> Mapping[str, OpeningOrder]:
        work = partial(_orders, meetings)
        order = partial(self.cache.value, "order", work, tuple(built), scene, self.config)
        return within(self.config.time.ordering, order, partial(_without_order, built))

    def _with_nested(self, levels: Levels, request: JointRequest) -> Levels:
        """Returns the levels with a joint on a moving body, or on what carries that where it has no joint itself."""
        moving = request.moving
        carrier = next((body for body in above(moving, levels.parent_of) if body in levels.built), "")
        levels = replace(levels, parent_of={**levels.parent_of, moving: carrier})
        tries = self._tries(levels, request, carrier)
        found = [one for one in tries if moving in one.built]
        if not found:
            return _riding(tries[0], moving, carrier)
        return max(found, key=lambda one: round(one.built[moving].placement.upper / one.built[moving].wanted, 2))

    def _tries(self, levels: Levels, request: JointRequest, carrier: str) -> list[Levels]:
        """Returns what is built of one request: coupled to what carries it, else with that closed, else also open."""
        moving = request.moving
        if request.coupling is not None and request.coupling.leader in above(moving, levels.parent_of):
            coupled = self._with_coupling(self._tried(levels, request, carrier, is_alone=True), request)
            if moving in coupled.couplings:
                return [coupled]
        closed = self._tried(levels, request, carrier)
        made = closed.built.get(moving)
        is_wide = made is not None and made.placement.upper >= self.config.restricted * made.wanted
        if is_wide or not carrier:
            return [closed]
        opener = levels.built[carrier]
        T = opener.request.kind.along(opener.placement.axis)(levels.orders[carrier].upper)
        opened = self._tried(levels, request, carrier, T)
        if moving not in opened.built:
            return [closed]
        order = opened.orders[moving]
        after = replace(order, after=(*order.after, carrier))
        return [closed, replace(opened, orders={**opened.orders, moving: after})]

    def _tried(
        self,
        levels: Levels,
        request: JointRequest,
        carrier: str,
        T_others_carrier: Mat4 | None = None,
        is_alone: bool = False,
    ) -> Levels:
        """Returns the levels with one joint built in its carrier's view, which T opens; without it where none fits."""
        scene, moving = levels.scene, request.moving
        T = None if T_others_carrier is None else invert(T_others_carrier)
        beside = [
            name for name, parent in levels.parent_of.items() if parent == carrier and name in scene.moving_bodies
        ]
        bodies = [name for name in beside if carrier or name == moving or name in levels.built]
        view = seen_from(carrier, bodies, scene, levels.parent_of, T, is_alone)
        if is_alone and request.role in (MotionRole.INNER, MotionRole.LOWER):
            view = replace(view, behind=scene.static_parts)
        carriers = scene.moving_bodies[carrier].members if carrier else ()
        measured = self._level([replace(request, carriers=carriers)], view)
        whole = brought_back(measured.scene, view, carrier, scene, T_others_carrier) if measured.built else scene
        return levels.with_level(measured, whole, carrier)

    def _with_coupling(self, levels: Levels, request: JointRequest) -> Levels:
        """Returns the levels in which a joint follows its leader; a note states why where it cannot."""
        moving, coupling = request.moving, request.coupling
        if coupling is None or moving not in levels.built or moving in levels.couplings:
            return levels
        if coupling.leader not in levels.built:
            return levels.noted(moving, f"does not follow {coupling.leader}, which has no joint")
        pair = Coupled(levels.built[moving], coupling, levels.built, levels.couplings, levels.parent_of, levels.scene)
        leader, own = levels.orders[coupling.leader], levels.orders[moving]
        upper = pair.common_opening(leader.upper, own.upper, self.config)
        wanted = min(levels.built[coupling.leader].wanted, leader.upper)
        if not pair.starts_within(own.upper):
            why = f"closed, that would put it at {coupling.value(0.0):.3g}"
            return levels.noted(moving, f"does not follow {coupling.leader}: {why}")
        if upper < self.config.least_opening * wanted:
            return levels.noted(moving, f"does not follow {coupling.leader}: together they would hardly open")
        if upper < self.config.restricted * wanted:
            levels = levels.noted(coupling.leader, f"opens as far as {moving} can follow")
        return _joined(levels, moving, coupling, upper)

    def _with_leaf(self, levels: Levels, request: JointRequest) -> Levels:
        """Returns the levels with what the second leaf of a folding door needs: a track, or room in a corner."""
        if request.role is MotionRole.INNER and request.moving in levels.couplings:
            return self._with_track(levels, request.moving)
        if request.role is MotionRole.CORNER and levels.parent_of.get(request.moving):
            return self._with_room(levels, request.moving)
        return levels

    def _with_room(self, levels: Levels, moving: str) -> Levels:
        """Returns the levels in which a leaf in a corner opens as far as the one that it carries clears the case."""
        carrier = levels.parent_of[moving]
        first, second = levels.orders[carrier], levels.orders[moving]
        upper = room_in_corner(
            levels.scene, (levels.built[carrier], levels.built[moving]), (first.upper, second.upper), self.config
        )
        if upper >= first.upper:
            return levels
        noted = levels.noted(carrier, f"opens as far as {moving} clears the case, however far that is open")
        return replace(noted, orders={**levels.orders, carrier: replace(first, upper=upper)})

    def _with_track(self, levels: Levels, moving: str) -> Levels:
        """Returns the levels with a track for a leaf that folds and follows another; a note states where none fits."""
        leader = levels.couplings[moving].leader
        pair, upper = (levels.built[leader], levels.built[moving]), levels.orders[leader].upper
        scene = with_track(levels.scene, *pair, upper, self.config)
        return levels.noted(moving, NO_TRACK) if scene is None else replace(levels, scene=scene)


def _riding(levels: Levels, moving: str, carrier: str) -> Levels:
    """Returns the levels in which a part without a joint moves with its carrier; its refusal states it."""
    rides = f"; it moves with {carrier}" if carrier else ""
    told = tuple(replace(r, why=f"{r.why}{rides}") if r.part == moving else r for r in levels.skipped)
    parent_of = {
        body: carrier if parent == moving else parent for body, parent in levels.parent_of.items() if body != moving
    }
    return replace(levels, scene=riding(moving, carrier, levels.scene), skipped=told, parent_of=parent_of)


def _joined(levels: Levels, moving: str, coupling: Coupling, upper: float) -> Levels:
    """Returns the levels in which a joint follows its leader, which opens up to `upper`; both wait for the same."""
    orders, couplings = dict(levels.orders), {**levels.couplings, moving: coupling}
    pair = (moving, coupling.leader)
    waits = [*orders[coupling.leader].after, *orders[moving].after]
    apart = tuple(dict.fromkeys(name for name in waits if name not in pair))
    leader = coupling.leader
    orders[leader] = replace(orders[leader], upper=upper)
    while leader in couplings:
        upper = couplings[leader].leader_value(upper)
        leader = couplings[leader].leader
        orders[leader] = replace(orders[leader], upper=max(upper, 0.0))
    orders[leader] = replace(orders[leader], after=apart)
    orders[moving] = OpeningOrder((), coupling.value(orders[coupling.leader].upper), orders[moving].note)
    return replace(levels, orders=orders, couplings=couplings)


def _orders(meetings: Meetings, built: Sequence[Built], _: Scene, config: RealizationConfig) -> dict[str, OpeningOrder]:
    movings = [_built_joint(b, config.hinge.usual_opening) for b in built]
    return stand_aside(order_joints(movings, meetings, config), movings, meetings, config)


def _built_joint(built: Built, wide: float) -> BuiltJoint:
    """Returns a joint with the opening that it keeps: `wide` (radians) of what turns, where nothing was chosen."""
    placement = built.placement
    motion = built.request.kind.along(placement.axis)
    turns = built.request.kind.turns
    least = wide if turns and built.request.choice.opening is None else placement.upper
    return BuiltJoint(built.request.moving, motion, placement.upper, least, placement.in_way)


def _without_order(built: Sequence[Built], why: str) -> dict[str, OpeningOrder]:
    """Returns for each moving body an order without waiting; a note states that neighbours may meet, and why."""
    note = f"whether it must wait for its neighbours was not found out: {why}"
    return {b.request.moving: OpeningOrder((), b.placement.upper, note) for b in built}
