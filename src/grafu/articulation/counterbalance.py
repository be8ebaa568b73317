"""What holds a lid or a flap where it is put: dry friction where the part is light, else a spring that carries it.

Gas stays and spring hinges do this in furniture. The spring between two bodies stands for all of them: of zero free
length, from a point straight above the axis to the centre of mass, its torque is exactly the opposite of gravity's at
any opening. Formats that know only springs about a joint get the straight line that is nearest to this torque. It
writes no file and moves nothing.
"""

from math import pi
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Joint
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Scalars, Vec3, freeze_arrays, vec3
from grafu.geometry.config_checks import require_positive

GRAVITY = 9.81


@final
@dataclass(frozen=True, slots=True)
class CounterbalanceConfig:
    """Which joints are held against gravity, and how.

    Raises:
        ValueError: if a number is not above 0.
    """

    level: float = 0.2
    """An axis counts as level up to this upright component of its direction (cosine) ..."""
    pull: float = 12.0
    """... friction alone holds what still opens and closes when pulled with this force at its far edge (newtons)."""
    margin: float = 1.2
    """Friction over the torque that it must hold (factor)."""
    height: float = 2.0
    """How far above the axis the spring hangs, over the distance of the centre of mass from it (factor)."""
    samples: int = 61
    """At how many values of the joint its torque is computed."""
    furthest: float = 2.0 * pi
    """Largest angle at which a spring about a joint may be without torque (radians): PhysX allows no more."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_COUNTERBALANCE_CONFIG = CounterbalanceConfig()


@final
@dataclass(frozen=True, slots=True)
class JointSpring:
    """A spring about a joint: `stiffness` (N m/rad), without torque at `target` (radians), beside `friction` (N m)."""

    stiffness: float
    target: float
    friction: float


@final
@dataclass(frozen=True, eq=False, slots=True)
class Counterbalance(ArrayValue):
    """A spring of zero free length and `stiffness` (N/m) from `anchor`, on the parent, to `center`, on the child.

    Both are points in the object frame at rest. `friction` (N m) is what the joint has beside it. `spring` is what
    replaces it where only joints have springs: None where the torque that is needed grows as the joint opens, as that
    of a flap that is lifted does.
    """

    anchor: Vec3
    center: Vec3
    stiffness: float
    friction: float = 0.0
    spring: JointSpring | None = None

    def __post_init__(self) -> None:
        if not self.stiffness > 0:
            raise ValueError(f"`Counterbalance.stiffness` must be above 0: got {self.stiffness}")
        freeze_arrays(self)


@final
@dataclass(frozen=True, slots=True)
class Holding:
    """How a joint is held: its dry friction (N m), and the spring that carries what friction cannot."""

    friction: float
    counterbalance: Counterbalance | None = None


def held(
    joint: Joint,
    mass: float,
    center: Vec3,
    reach: float,
    friction: tuple[float, float],
    config: CounterbalanceConfig = DEFAULT_COUNTERBALANCE_CONFIG,
) -> Holding:
    """Returns what holds a joint that turns about a level axis; of any other joint, the friction that it has.

    `mass` (kg) with its `center` is all that moves with the joint, `reach` (m) the distance of its far edge from the
    axis, `friction` (N m) what brakes it, without and with what keeps gravity from opening it.
    """
    braking, friction_alone = friction
    as_it_is = Holding(friction_alone)
    if not joint.kind.turns or not joint.kind.limited or abs(joint.axis.direction[2]) > config.level:
        return as_it_is
    values = np.linspace(joint.limits.lower, joint.limits.upper, config.samples)
    torque = gravity_torque(joint, mass, center, values)
    needed = config.margin * float(np.abs(torque).max())
    if needed <= friction_alone:
        return as_it_is
    if (
        needed + float(np.abs(torque).max()) <= config.pull * reach
    ):  # it can be lifted against both, to open or to close
        return Holding(needed)
    arm = joint.axis.distance_to(center)
    anchor = joint.axis.closest_point(center) + vec3(0.0, 0.0, config.height * arm)
    stiffness = GRAVITY * mass / (config.height * arm)
    spring = _spring(values, torque, braking, config)
    return Holding(friction_alone, Counterbalance(anchor, center, stiffness, braking, spring))


def gravity_torque(joint: Joint, mass: float, center: Vec3, values: Scalars) -> Scalars:
    """Returns gravity's torque (N m) towards open at values (radians) of a joint that turns."""
    d = joint.axis.direction
    arm = mass * (center - joint.axis.point)
    weight = vec3(0.0, 0.0, -GRAVITY)
    level, turned = float(d @ np.cross(arm, weight)), float(d @ np.cross(np.cross(d, arm), weight))
    angles = joint.kind.turn * values
    return level * np.cos(angles) + turned * np.sin(angles)


def _spring(values: Scalars, torque: Scalars, friction: float, config: CounterbalanceConfig) -> JointSpring | None:
    """Returns the spring that balances gravity at rest, so that it opens nothing, and best everywhere else."""
    opening = values - values[0]
    change = torque - torque[0]
    stiffness = float(change @ opening) / float(opening @ opening) if opening[-1] > 0 else 0.0
    if stiffness <= 0:
        return None
    target = float(values[0]) - float(torque[0]) / stiffness
    if abs(target) > config.furthest:
        return None
    rest = torque - stiffness * (values - target)
    return JointSpring(stiffness, target, max(friction, config.margin * float(np.abs(rest).max())))
