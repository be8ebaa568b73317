"""Wheels that carry a piece: they stand on a flat, and roll and swivel against friction that grows with the load.

A wheel that turned as easily as a knob would let a chest on casters roll away before its drawer moves. One that is
drawn with a corner at its lowest point would roll off that corner by itself; a tyre stands on a small flat.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.collision_clearance import Shapes, halved
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.counterbalance import GRAVITY
from grafu.articulation.floor_clearance import carrying_links, floor_below
from grafu.articulation.joint_dynamics import JointDynamics
from grafu.articulation.mass import MassProperties
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.solids import ConvexSolid


@final
@dataclass(frozen=True, slots=True)
class RollingConfig:
    """How a loaded wheel stands and rolls; lengths in metres.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    resistance: float = 0.03
    """A wheel resists rolling by this part of what it carries: small, hard wheels take 2 to 4 % (fraction)."""
    level: float = 0.1
    """The vertical part of a level axle at most (of a unit vector)."""
    flat: float = 0.0005
    """So much is cut off below, as a tyre gives way: a wheel of 24 sides and 10 cm is higher by that on a corner."""
    effort: float = 10.0
    """A motor may be this many times as strong as the friction that the load adds, as for other joints (factor)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "resistance", "level")


DEFAULT_ROLLING_CONFIG = RollingConfig()


def on_flats(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: RollingConfig = DEFAULT_ROLLING_CONFIG,
) -> Shapes:
    """Returns the shapes of each link, those of wheels that carry the piece cut level where they touch the floor.

    Shapes are in the object frame at rest.
    """
    floor = floor_below(shapes)
    found = dict(shapes)
    for wheel in _wheels(articulated, shapes, floor, config):
        cut = (_above(shape, floor + config.flat) for shape in shapes[wheel.child])
        found[wheel.child] = tuple(shape for shape in cut if shape is not None)
    return found


def with_load_on_wheels(
    articulated: ArticulatedObject,
    dynamics: Mapping[str, JointDynamics],
    masses: Mapping[str, MassProperties],
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: RollingConfig = DEFAULT_ROLLING_CONFIG,
) -> dict[str, JointDynamics]:
    """Returns the dynamics of each joint, with more friction in wheels that carry the piece and in their casters.

    All wheels carry the same. Nothing changes where the root stands on the floor by itself. Masses and shapes are those
    of all links by id, object frame at rest.
    """
    floor = floor_below(shapes)
    wheels, found = _wheels(articulated, shapes, floor, config), dict(dynamics)
    for wheel in wheels:
        load = GRAVITY * sum(held.mass for held in masses.values()) / len(wheels)
        radius = float(wheel.axis.point[2]) - floor
        for joint in (wheel, articulated.joint_of.get(wheel.parent)):
            if joint is not None and joint.id in found and not joint.kind.limited and radius > 0:
                found[joint.id] = _braked(found[joint.id], config.resistance * load * radius, config)
    return found


def _wheels(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    floor: float,
    config: RollingConfig,
) -> list[Joint]:
    """Returns the joints of what carries the piece and turns without end about a level axis."""
    carry = carrying_links(articulated, shapes, floor) - {articulated.root}
    joints = (articulated.joint_of[link] for link in sorted(carry))
    return [
        joint
        for joint in joints
        if joint.kind.turns and not joint.kind.limited and abs(float(joint.axis.direction[2])) <= config.level
    ]


def _above(shape: CollisionShape, height: float) -> CollisionShape | None:
    """Returns the part of a shape above a height (m); None: nothing is left."""
    points = corners_of(shape)
    if float(points[:, 2].min()) >= height:
        return shape
    solid = ConvexSolid.around(points)
    return None if solid is None else halved(solid, vec3(0.0, 0.0, -1.0), -height, 2)


def _braked(dynamics: JointDynamics, friction: float, config: RollingConfig) -> JointDynamics:
    """Returns dynamics with more friction (N m)."""
    more = config.effort * friction
    return replace(dynamics, friction=dynamics.friction + friction, effort=dynamics.effort + more)
