"""The physics of an object, computed once for all formats: frames, masses, shapes, resistance of joints."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import field
from functools import partial
from typing import TypeVar, final
from weakref import finalize

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.build_material import MassConfig
from grafu.articulation.collision_clearance import ShapeClearanceConfig, cleared
from grafu.articulation.collision_shapes import (
    CollisionShape,
    CollisionShapeConfig,
    as_many_as_allowed,
    box_of,
    chosen_shapes,
    corners_of,
    shapes_of,
)
from grafu.articulation.finger_room import FingerRoomCutConfig, with_finger_room
from grafu.articulation.floor_clearance import FloorConfig, off_floor
from grafu.articulation.joint_dynamics import DynamicsConfig, JointDynamics, joint_dynamics
from grafu.articulation.kinematics import link_origins
from grafu.articulation.level_feet import LevelFeetConfig, level_feet
from grafu.articulation.mass import MassProperties, mass_of_link, moments_of, moments_of_box
from grafu.articulation.open_together import met_at_rest, near_at_rest
from grafu.articulation.rolling_wheels import RollingConfig, on_flats, with_load_on_wheels
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.budget import WhileTimeLasts, present_budget, within
from grafu.visible import ShortRepr

T = TypeVar("T")


@final
@dataclass(frozen=True, slots=True)
class PhysicsConfig(ShortRepr):
    """How masses, collision shapes and the resistance of joints are found."""

    mass: MassConfig = field(default_factory=MassConfig)
    collision: CollisionShapeConfig = field(default_factory=CollisionShapeConfig)
    clearance: ShapeClearanceConfig = field(default_factory=ShapeClearanceConfig)
    fingers: FingerRoomCutConfig = field(default_factory=FingerRoomCutConfig)
    floor: FloorConfig = field(default_factory=FloorConfig)
    feet: LevelFeetConfig = field(default_factory=LevelFeetConfig)
    dynamics: DynamicsConfig = field(default_factory=DynamicsConfig)
    rolling: RollingConfig = field(default_factory=RollingConfig)


DEFAULT_PHYSICS_CONFIG = PhysicsConfig()
_MASSES, _PIECES, _CLEARANCE, _CONTACTS = 0.2, 0.25, 0.4, 0.2  # of the time that is left as each begins
_NO_TIME = "there was no time for more"


@final
@dataclass(frozen=True, slots=True)
class PhysicsModel:
    """The physics of an object at rest, in the object frame; tables by the ids of links and of moving joints.

    `origins` is where the frame of each link stands, parallel to the object frame. `touching` names the pairs of links
    whose shapes meet at rest all the same. `notes` state which shapes were left out, and what was found more simply,
    because there was no time (then it is `simplified`).
    """

    origins: Mapping[str, Vec3]
    masses: Mapping[str, MassProperties]
    shapes: Mapping[str, tuple[CollisionShape, ...]]
    dynamics: Mapping[str, JointDynamics]
    touching: tuple[tuple[str, str], ...]
    notes: tuple[str, ...] = ()
    simplified: bool = False


_LATEST: dict[int, tuple[PhysicsConfig, PhysicsModel]] = {}
"""What was found last of each object that is still in use, by its `id`: formats are written one after another.

Objects compare by content, which is to read all their meshes.
"""


def physics_of(articulated: ArticulatedObject, config: PhysicsConfig = DEFAULT_PHYSICS_CONFIG) -> PhysicsModel:
    """Returns the physics of an object. Asked again for the same object, it answers at once.

    What the budget in force does not hold is found in a simpler way: masses and shapes from boxes around parts.
    """
    known = _LATEST.get(id(articulated))
    if known is None:
        finalize(articulated, _LATEST.pop, id(articulated), None)
    if known is None or known[0] != config or (known[1].simplified and present_budget().is_unlimited):
        known = (config, _found(articulated, config))
        _LATEST[id(articulated)] = known
    return known[1]


def physics_known(articulated: ArticulatedObject) -> PhysicsModel | None:
    """Returns the physics that was found last of an object; None: there is none yet."""
    known = _LATEST.get(id(articulated))
    return None if known is None else known[1]


def _found(articulated: ArticulatedObject, config: PhysicsConfig) -> PhysicsModel:
    notes: list[str] = []
    measured = WhileTimeLasts(_MASSES, moments_of, moments_of_box)
    masses = {link.id: mass_of_link(link, config.mass, measured) for link in articulated.links}
    of_part = WhileTimeLasts(_PIECES, shapes_of, box_of)
    chosen = {link.id: chosen_shapes(link, config.collision, of_part) for link in articulated.links}
    drawn = {link: kept for link, (kept, _) in chosen.items()}
    left_out = {link: left for link, (_, left) in chosen.items()}
    if measured.spared:
        notes.append(f"{_parts(measured.spared)} got the mass of boards all over the box around: {_NO_TIME}")
    if of_part.spared:
        notes.append(f"{_parts(of_part.spared)} collide as one box each: {_NO_TIME}")
    shapes = within(
        _CLEARANCE,
        lambda: off_floor(articulated, cleared(articulated, drawn, config.clearance), config.floor),
        partial(_noted, notes, "collision shapes were not cut back where joints make them meet", drawn),
    )
    shapes = within(
        _CONTACTS,
        partial(with_finger_room, shapes, articulated.grasps, config.fingers),
        partial(_noted, notes, "collision shapes were not cut where fingers go", shapes),
    )
    for link in articulated.links:  # a shape that is cut around a finger comes in pieces
        shapes[link.id], left = as_many_as_allowed(shapes[link.id], link, config.collision)
        left_out[link.id] += left
    shapes = on_flats(articulated, shapes, config.rolling)
    shapes, short_feet = level_feet(articulated, masses, shapes, config.feet)
    touching = within(
        _CONTACTS,
        partial(met_at_rest, articulated, shapes),
        lambda why: _noted(notes, "what is near at rest does not collide", near_at_rest(articulated, shapes), why),
    )
    dynamics = {
        joint.id: joint_dynamics(articulated, joint, masses, config.dynamics) for joint in articulated.moving_joints
    }
    dynamics = with_load_on_wheels(articulated, dynamics, masses, shapes, config.rolling)
    too_many = [note for link, left in left_out.items() for note in _left_out(link, left, config.collision)]
    told = (*too_many, *([short_feet] if short_feet else []), *notes)
    return PhysicsModel(link_origins(articulated), masses, shapes, dynamics, touching, told, bool(notes))


def _noted(notes: list[str], what: str, found: T, why: str) -> T:
    notes.append(f"{what}: {why}")
    return found


def _left_out(link: str, left: Sequence[CollisionShape], config: CollisionShapeConfig) -> Iterator[str]:
    """Yields a note where one of the shapes that are left out is large enough to be missed."""
    if any(np.linalg.norm(np.ptp(corners_of(shape), axis=0)) > config.noticed for shape in left):
        most = f"{config.most_shapes} shapes are kept"
        yield f"{link} does not collide where it is smallest: {most}, {len(left):,} are left out"


def _parts(count: int) -> str:
    return f"{count:,} part{'s' if count > 1 else ''}"
