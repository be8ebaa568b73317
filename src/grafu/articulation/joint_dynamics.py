"""How joints resist: damping, dry friction, effort and velocity, from what moves with them.

Values follow the moving mass, so that a small door neither sticks nor flies: a joint pushed and let go slows down with
a time constant of a quarter of a second, needs a newton or more at its far edge, stays closed against gravity, and
opens within three seconds when it is pulled with 20 N. Lids and flaps are held where they are put.
"""

from collections.abc import Mapping
from dataclasses import field, replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.catch import Catch, CatchConfig, catch_of
from grafu.articulation.counterbalance import GRAVITY, Counterbalance, CounterbalanceConfig, Holding, held
from grafu.articulation.coupled_weight import coupled_center
from grafu.articulation.mass import MassProperties
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True, slots=True)
class JointDynamics:
    """Damping (N m s/rad or N s/m), dry friction and greatest effort (N m or N), greatest velocity (rad/s or m/s).

    `inertia` (kg m2, or kg) is what moves, about the axis or along it. `counterbalance` is the spring that carries a
    lid or a flap too heavy to be held by friction, for formats with springs. `catch` is what keeps it closed.
    """

    damping: float
    friction: float
    effort: float
    velocity: float
    inertia: float
    counterbalance: Counterbalance | None = None
    catch: Catch | None = None

    @property
    def friction_with_spring(self) -> float:
        """The dry friction where the counterbalance carries the weight: only what brakes (N m, or N)."""
        return self.friction if self.counterbalance is None else self.counterbalance.friction


@final
@dataclass(frozen=True, slots=True)
class DynamicsConfig:
    """How joints resist.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    settling: float = 0.25
    """A moving joint that is let go loses most of its speed to damping in this time (s)."""
    pull: float = 20.0
    """With this force at its far edge people open a door or a drawer (N) ..."""
    opened: float = 1.5
    """... and damping alone lets it open in this time: getting under way takes as long again (s)."""
    runaway: float = 3.0
    """The same force drives a light joint no faster than this many times its greatest velocity (factor)."""
    quickest: float = 0.01
    """Damping stops nothing faster than this (s): PyBullet, which takes 240 explicit steps a second, would explode."""
    touch: float = 1.0
    """No joint moves under less force at its far edge (N): a knob, a wheel or a button stays as it is left."""
    hinge_braking: float = 2.0
    """Friction of a hinge brakes a swing by this (rad/s2) ..."""
    rail_friction: float = 0.03
    """... that of a rail is this part of the weight, as ball-bearing slides have ..."""
    braking_ratio: float = 0.25
    """... but neither takes more than this part of the pull: hinges and slides for heavy leaves run easier."""
    holding: float = 1.5
    """Friction over what keeps gravity from moving the joint (factor)."""
    hinge_velocity: float = 3.0
    """As fast as people swing a door (rad/s)."""
    rail_velocity: float = 1.0
    """As fast as people pull a drawer (m/s)."""
    counterbalance: CounterbalanceConfig = field(default_factory=CounterbalanceConfig)
    """How lids and flaps are held."""
    catch: CatchConfig = field(default_factory=CatchConfig)
    """How strong catches are."""

    def __post_init__(self) -> None:
        require_positive(self, *(set(self.__dataclass_fields__) - {"counterbalance", "catch"}))
        require_ratios(self, "rail_friction", "braking_ratio")


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
    carried = [masses[link] for link in _carried(articulated, joint.child)]
    if joint.kind.turns:
        return _caught(articulated, joint, _turning(articulated, joint, masses, carried, config), config)
    return _caught(articulated, joint, _sliding(joint, carried, config), config)


def _caught(
    articulated: ArticulatedObject, joint: Joint, dynamics: JointDynamics, config: DynamicsConfig
) -> JointDynamics:
    """Returns the dynamics with the joint's catch, which the greatest effort overcomes, too."""
    limits = joint.limits.lower, joint.limits.upper
    arms = (_reach(articulated, joint), _grip_arm(articulated, joint)) if joint.kind.turns else (1.0, 1.0)
    resists = config.pull, dynamics.friction
    catch = catch_of(joint.catch, joint.kind.turns, limits, arms, *resists, config.catch)
    return dynamics if catch is None else replace(dynamics, effort=dynamics.effort + catch.effort, catch=catch)


def _turning(
    articulated: ArticulatedObject,
    joint: Joint,
    masses: Mapping[str, MassProperties],
    carried: list[MassProperties],
    config: DynamicsConfig,
) -> JointDynamics:
    inertia, gravity, most = _about_axis(joint, carried)
    reach = _reach(articulated, joint)
    braking = _braking(config.hinge_braking * inertia, reach, config)
    unheld = max(gravity, 0.0) if joint.kind.limited else most  # without a stop, gravity turns it either way
    both = braking, braking + config.holding * unheld
    holding = _held(articulated, joint, masses, both, reach, config.counterbalance)
    effort = 2.0 * most + 10.0 * holding.friction
    damping = _damping(joint, inertia, reach, braking, config.hinge_velocity, config)
    return JointDynamics(
        damping, holding.friction, effort, config.hinge_velocity, inertia, counterbalance=holding.counterbalance
    )


def _sliding(joint: Joint, carried: list[MassProperties], config: DynamicsConfig) -> JointDynamics:
    mass = sum(m.mass for m in carried)
    weight = GRAVITY * mass
    gravity = -weight * float(joint.axis.direction[2])
    braking = _braking(config.rail_friction * weight, 1.0, config)
    friction = braking + config.holding * max(gravity, 0.0)
    damping = _damping(joint, mass, 1.0, braking, config.rail_velocity, config)
    return JointDynamics(damping, friction, 2.0 * weight + 10.0 * friction, config.rail_velocity, mass)


def _braking(usual: float, arm: float, config: DynamicsConfig) -> float:
    """Returns the friction that brakes a joint pulled at an arm (m; 1 for a slide), N m or N."""
    most = config.braking_ratio * config.pull * arm
    return max(min(usual, most), config.touch * arm) if arm > 0 else usual


def _damping(
    joint: Joint, inertia: float, arm: float, braking: float, velocity: float, config: DynamicsConfig
) -> float:
    """Returns damping: inertia over the settling time, more for light joints, less for what would open too slowly."""
    usual = inertia / config.settling
    if arm <= 0:
        return usual
    light = min(config.pull * arm / (config.runaway * velocity), inertia / config.quickest)
    distance = joint.limits.range if joint.kind.limited else velocity * config.opened
    heavy = (config.pull * arm - braking) * config.opened / distance if distance > 0 else usual
    return min(max(usual, light), heavy)


def _reach(articulated: ArticulatedObject, joint: Joint) -> float:
    """Returns the distance of the child's far edge from the axis (m)."""
    vertices = articulated.link(joint.child).mesh.vertices
    return float(joint.axis.distances_to(vertices).max()) if len(vertices) else 0.0


def _grip_arm(articulated: ArticulatedObject, joint: Joint) -> float:
    """Returns the least distance of a grip of the child from the axis (m); without one, that of its far edge."""
    grips = (joint.axis.distance_to(grasp.position) for grasp in articulated.grasps if grasp.link == joint.child)
    return min(grips, default=_reach(articulated, joint))


def _carried(articulated: ArticulatedObject, link: str) -> list[str]:
    below = [joint.child for joint in articulated.joints if joint.parent == link]
    return [link, *(far for near in below for far in _carried(articulated, near))]


def _held(
    articulated: ArticulatedObject,
    joint: Joint,
    masses: Mapping[str, MassProperties],
    friction: tuple[float, float],
    reach: float,
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
    return Holding(friction[1]) if center is None else held(joint, mass, center, reach, friction, config)


def _about_axis(joint: Joint, carried: list[MassProperties]) -> tuple[float, float, float]:
    """Returns the inertia about the axis, gravity's torque towards open at rest, and its greatest in any pose."""
    d = joint.axis.direction
    inertia = sum(float(d @ m.inertia @ d) + m.mass * joint.axis.distance_to(m.center) ** 2 for m in carried)
    arm = sum(m.mass * (m.center - joint.axis.point) for m in carried)
    torque = np.cross(arm, [0.0, 0.0, -GRAVITY])
    reach = float(np.linalg.norm(np.cross(arm, d)))
    level = float(np.linalg.norm(d[:2]))  # gravity turns a level axis fully, an upright one not at all
    return inertia, float(torque @ d), GRAVITY * reach * level
