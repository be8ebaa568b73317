"""The physics of an object, computed once for all formats: frames, masses, shapes, resistance.

A joint resists by damping and friction, and has an effort and velocity. Values follow the moving mass, so that a small
door neither sticks nor flies: a joint pushed and let go slows down with a time constant of a quarter of a second, needs
a few newtons at the handle, and stays closed against gravity. Lids and flaps are held where they are put.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import partial
from typing import TypeVar, final
from weakref import WeakKeyDictionary

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.collision_clearance import ShapeClearanceConfig, cleared
from grafu.articulation.collision_shapes import (
    CollisionShape,
    CollisionShapeConfig,
    box_of,
    collision_shapes,
    shapes_of,
)
from grafu.articulation.counterbalance import GRAVITY, Counterbalance, CounterbalanceConfig, Holding, held
from grafu.articulation.coupled_weight import coupled_center
from grafu.articulation.kinematics import link_origins
from grafu.articulation.mass import MassConfig, MassProperties, mass_of_link, moments_of, moments_of_box
from grafu.articulation.open_together import met_at_rest, near_at_rest
from grafu.geometry.arrays import Vec3
from grafu.geometry.budget import WhileTimeLasts, present_budget, within
from grafu.visible import ShortRepr

T = TypeVar("T")


@final
@dataclass(frozen=True, slots=True)
class JointDynamics:
    """Damping (N m s/rad or N s/m), dry friction and greatest effort (N m or N), greatest velocity (rad/s or m/s).

    `counterbalance` is the spring that carries a lid or a flap too heavy to be held by friction, for formats with
    springs.
    """

    damping: float
    friction: float
    effort: float
    velocity: float
    counterbalance: Counterbalance | None = None

    @property
    def friction_with_spring(self) -> float:
        """The dry friction where the counterbalance carries the weight: only what brakes (N m, or N)."""
        return self.friction if self.counterbalance is None else self.counterbalance.friction


@final
@dataclass(frozen=True, slots=True)
class DynamicsConfig:
    """How joints resist.

    `settling` (s) is how long a moving joint takes to lose most of its speed to damping alone. Friction of a hinge
    brakes a swing by `hinge_braking` (rad/s2); that of a rail is `rail_friction` of the weight, as ball-bearing slides
    have. `holding` times what keeps gravity from opening the joint is added. Velocities are what people open furniture
    with. `counterbalance` states how lids and flaps are held.
    """

    settling: float = 0.25
    hinge_braking: float = 2.0
    rail_friction: float = 0.03
    holding: float = 1.5
    hinge_velocity: float = 3.0
    rail_velocity: float = 1.0
    counterbalance: CounterbalanceConfig = field(default_factory=CounterbalanceConfig)


DEFAULT_DYNAMICS_CONFIG = DynamicsConfig()


def joint_dynamics(
    articulated: ArticulatedObject,
    joint: Joint,
    masses: Mapping[str, MassProperties],
    config: DynamicsConfig = DEFAULT_DYNAMICS_CONFIG,
) -> JointDynamics:
    """Returns the dynamics of a moving joint; `masses` are those of all links by id, object frame at rest.

    What hangs on the child moves with it and is counted in.
    """
    links = _carried(articulated, joint.child)
    carried = [masses[link] for link in links]
    weight = GRAVITY * sum(m.mass for m in carried)
    if joint.kind.turns:
        inertia, pull, most = _about_axis(joint, carried)
        braking = config.hinge_braking * inertia
        both = braking, braking + config.holding * max(pull, 0.0)
        holding = _held(articulated, joint, masses, both, config.counterbalance)
        effort = 2.0 * most + 10.0 * holding.friction
        damping = inertia / config.settling
        return JointDynamics(damping, holding.friction, effort, config.hinge_velocity, holding.counterbalance)
    pull = -weight * float(joint.axis.direction[2])
    friction = config.rail_friction * weight + config.holding * max(pull, 0.0)
    damping = weight / GRAVITY / config.settling
    return JointDynamics(damping, friction, 2.0 * weight + 10.0 * friction, config.rail_velocity)


def _carried(articulated: ArticulatedObject, link: str) -> list[str]:
    below = [joint.child for joint in articulated.joints if joint.parent == link]
    return [link, *(far for near in below for far in _carried(articulated, near))]


def _held(
    articulated: ArticulatedObject,
    joint: Joint,
    masses: Mapping[str, MassProperties],
    friction: tuple[float, float],
    config: CounterbalanceConfig,
) -> Holding:
    """Returns what holds a joint that turns; one that follows another keeps its friction, and so does its leader.

    A leader about a level axis is held where all weight acts at one point of its child, as with arms that lift a flap.
    """
    links = _carried(articulated, joint.child)
    mass = sum(masses[link].mass for link in links)
    if joint.coupling is not None or not mass > 0:
        return Holding(friction[1])
    center: Vec3 | None = sum((masses[k].mass * masses[k].center for k in links), start=np.zeros(3)) / mass
    if any(other.coupling is not None and other.coupling.leader == joint.id for other in articulated.joints):
        is_level = abs(float(joint.axis.direction[2])) <= config.level
        center = coupled_center(articulated, joint, links, masses) if is_level else None
    if center is None:
        return Holding(friction[1])
    vertices = articulated.link(joint.child).mesh.vertices
    reach = float(joint.axis.distances_to(vertices).max()) if len(vertices) else 0.0
    return held(joint, mass, center, reach, friction, config)


def _about_axis(joint: Joint, carried: list[MassProperties]) -> tuple[float, float, float]:
    """Returns the inertia about the axis, gravity's torque towards open at rest, and its greatest in any pose."""
    d = joint.axis.direction
    inertia = sum(float(d @ m.inertia @ d) + m.mass * joint.axis.distance_to(m.center) ** 2 for m in carried)
    arm = sum(m.mass * (m.center - joint.axis.point) for m in carried)
    torque = np.cross(arm, [0.0, 0.0, -GRAVITY])
    reach = float(np.linalg.norm(np.cross(arm, d)))
    level = float(np.linalg.norm(d[:2]))  # gravity turns a level axis fully, an upright one not at all
    return inertia, float(torque @ d), GRAVITY * reach * level


@final
@dataclass(frozen=True, slots=True)
class PhysicsConfig(ShortRepr):
    """How masses, collision shapes and the resistance of joints are found."""

    mass: MassConfig = field(default_factory=MassConfig)
    collision: CollisionShapeConfig = field(default_factory=CollisionShapeConfig)
    clearance: ShapeClearanceConfig = field(default_factory=ShapeClearanceConfig)
    dynamics: DynamicsConfig = field(default_factory=DynamicsConfig)


DEFAULT_PHYSICS_CONFIG = PhysicsConfig()
_MASSES, _PIECES, _CLEARANCE, _CONTACTS = 0.2, 0.25, 0.4, 0.2  # of the time that is left as each begins
_NO_TIME = "there was no time for more"


@final
@dataclass(frozen=True, slots=True)
class PhysicsModel:
    """The physics of an object at rest, in the object frame; tables by the ids of links and of moving joints.

    `origins` is where the frame of each link stands, parallel to the object frame. `touching` names the pairs of links
    whose shapes meet at rest all the same. `notes` state what was found in a simpler way, because there was no time.
    """

    origins: Mapping[str, Vec3]
    masses: Mapping[str, MassProperties]
    shapes: Mapping[str, tuple[CollisionShape, ...]]
    dynamics: Mapping[str, JointDynamics]
    touching: tuple[tuple[str, str], ...]
    notes: tuple[str, ...] = ()


_LATEST: WeakKeyDictionary[ArticulatedObject, tuple[PhysicsConfig, PhysicsModel]] = WeakKeyDictionary()
"""What was found last of each object that is still in use: several formats are written one after another."""


def physics_of(articulated: ArticulatedObject, config: PhysicsConfig = DEFAULT_PHYSICS_CONFIG) -> PhysicsModel:
    """Returns the physics of an object. Asked again for the same object, it answers at once.

    What the budget in force does not hold is found in a simpler way: masses and shapes from boxes around parts.
    """
    known = _LATEST.get(articulated)
    if known is None or known[0] != config or (known[1].notes and present_budget().is_unlimited):
        known = (config, _found(articulated, config))
        _LATEST[articulated] = known
    return known[1]


def _found(articulated: ArticulatedObject, config: PhysicsConfig) -> PhysicsModel:
    notes: list[str] = []
    measured = WhileTimeLasts(_MASSES, moments_of, moments_of_box)
    masses = {link.id: mass_of_link(link, config.mass, measured) for link in articulated.links}
    of_part = WhileTimeLasts(_PIECES, shapes_of, box_of)
    drawn = {link.id: collision_shapes(link, config.collision, of_part) for link in articulated.links}
    if measured.spared:
        notes.append(f"{_parts(measured.spared)} got the mass of boards all over the box around: {_NO_TIME}")
    if of_part.spared:
        notes.append(f"{_parts(of_part.spared)} collide as one box each: {_NO_TIME}")
    shapes = within(
        _CLEARANCE,
        partial(cleared, articulated, drawn, config.clearance),
        partial(_noted, notes, "collision shapes were not cut back where joints make them meet", drawn),
    )
    touching = within(
        _CONTACTS,
        partial(met_at_rest, articulated, shapes),
        lambda why: _noted(notes, "what is near at rest does not collide", near_at_rest(articulated, shapes), why),
    )
    dynamics = {
        joint.id: joint_dynamics(articulated, joint, masses, config.dynamics) for joint in articulated.moving_joints
    }
    return PhysicsModel(link_origins(articulated), masses, shapes, dynamics, touching, tuple(notes))


def _noted(notes: list[str], what: str, found: T, why: str) -> T:
    notes.append(f"{what}: {why}")
    return found


def _parts(count: int) -> str:
    return f"{count:,} part{'s' if count > 1 else ''}"
