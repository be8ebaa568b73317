"""What every simulator must be told of an object, found once for all formats: frames, masses, shapes, resistance.

It knows no file format.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import final
from weakref import WeakKeyDictionary

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.collision_clearance import ClearanceConfig, cleared
from grafu.articulation.collision_shapes import CollisionConfig, CollisionShape, collision_shapes
from grafu.articulation.dynamics import DynamicsConfig, JointDynamics, joint_dynamics
from grafu.articulation.link_frames import link_origins
from grafu.articulation.mass import MassConfig, MassProperties, mass_of_link
from grafu.articulation.open_together import met_at_rest
from grafu.geometry.arrays import Vec3


@final
@dataclass(frozen=True, slots=True)
class PhysicsConfig:
    """How masses, collision shapes and the resistance of joints are found."""

    mass: MassConfig = field(default_factory=MassConfig)
    collision: CollisionConfig = field(default_factory=CollisionConfig)
    clearance: ClearanceConfig = field(default_factory=ClearanceConfig)
    dynamics: DynamicsConfig = field(default_factory=DynamicsConfig)


DEFAULT_PHYSICS_CONFIG = PhysicsConfig()


@final
@dataclass(frozen=True, slots=True)
class PhysicsModel:
    """The physics of an object at rest, in the object frame; tables by the ids of links and of moving joints.

    `origins` is where the frame of each link stands, parallel to the object frame. `touching` names the pairs of links
    whose shapes meet at rest all the same.
    """

    origins: Mapping[str, Vec3]
    masses: Mapping[str, MassProperties]
    shapes: Mapping[str, tuple[CollisionShape, ...]]
    dynamics: Mapping[str, JointDynamics]
    touching: tuple[tuple[str, str], ...]


_LATEST: WeakKeyDictionary[ArticulatedObject, tuple[PhysicsConfig, PhysicsModel]] = WeakKeyDictionary()
"""What was found last of each object that is still in use: several formats are written one after another."""


def physics_of(articulated: ArticulatedObject, config: PhysicsConfig = DEFAULT_PHYSICS_CONFIG) -> PhysicsModel:
    """Returns the physics of an object. Asked again for the same object, it answers at once."""
    known = _LATEST.get(articulated)
    if known is None or known[0] != config:
        known = (config, _found(articulated, config))
        _LATEST[articulated] = known
    return known[1]


def _found(articulated: ArticulatedObject, config: PhysicsConfig) -> PhysicsModel:
    masses = {link.id: mass_of_link(link, config.mass) for link in articulated.links}
    drawn = {link.id: collision_shapes(link, config.collision) for link in articulated.links}
    shapes = cleared(articulated, drawn, config.clearance)
    dynamics = {
        joint.id: joint_dynamics(articulated, joint, masses, config.dynamics) for joint in articulated.moving_joints
    }
    return PhysicsModel(link_origins(articulated), masses, shapes, dynamics, met_at_rest(articulated, shapes))
