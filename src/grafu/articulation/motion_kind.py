"""The kinds of motion that a joint may have: a table with one row each, and what everyone asks of a row.

How a joint moves, in which unit its value counts and what formats call it is in its row; other code asks for `turns`,
`slides` or `moves` and does not compare types. It writes no file.
"""

from collections.abc import Callable, Mapping
from dataclasses import field
from math import degrees, radians
from types import MappingProxyType
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import ArticulationError
from grafu.geometry.arrays import Mat4, Points, Scalars, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import transform_points
from grafu.vocabulary import JointType, PartLabel

MotionFormat = Literal[
    "urdf", "mjcf", "usd", "usd drive", "blender", "particulate", "singapo", "partnet", "hssd", "sweethome"
]
"""Formats that have words of their own for a kind of motion."""
_A_LITTLE = 1e-3  # radians or metres: how far a joint is moved to see where a point sets off


@final
@dataclass(frozen=True, slots=True)
class ShownUnit:
    """How people read a joint's value: times `factor`, with so many digits, then the suffix."""

    factor: float
    digits: int
    suffix: str


@final
@dataclass(frozen=True, slots=True)
class MotionKind:
    """One kind of joint motion: a turn about the joint's axis, a shift along it, both at once, or none.

    Attributes:
        type: the word by which values and files name it.
        turn: radians turned about the axis for each unit of the joint's value, by the right-hand rule.
        shift: metres shifted along the axis for each unit of the joint's value.
        unit: the unit of the joint's value; empty where nothing moves.
        shown: the unit in which people read a value.
        verb: what a part with this joint does, for people.
        hardware: what such a joint runs on, for people.
        label: what a part that moves so is, where nothing else states it.
        words: what formats call it; the first word is written, all are read.
        limited: whether its joints have limits. The range of one without them is a full turn, for animations.
    """

    type: JointType
    turn: float
    shift: float
    unit: Literal["rad", "m", ""]
    shown: ShownUnit
    verb: str
    hardware: str
    label: PartLabel
    words: Mapping[MotionFormat, tuple[str, ...]] = field(default_factory=dict)
    limited: bool = True

    @property
    def turns(self) -> bool:
        """Whether it turns: its axis is a line in space, a mirror image of which has the other sense."""
        return self.turn != 0.0

    @property
    def slides(self) -> bool:
        """Whether it only shifts: of its axis the direction alone counts."""
        return self.shift != 0.0 and not self.turns

    @property
    def moves(self) -> bool:
        """Whether it moves at all."""
        return self.turns or self.shift != 0.0

    def transform(self, axis: Axis, value: float) -> Mat4:
        """Returns the 4x4 motion from rest at a joint value."""
        return self.along(axis)(value)

    def along(self, axis: Axis) -> Callable[[float], Mat4]:
        """Returns the function from a joint's value to its 4x4 motion from rest, on this axis."""
        if self.turns and self.shift:
            return lambda value: axis.shift(self.shift * value) @ axis.rotation(self.turn * value)
        if self.turns:
            return axis.rotation if self.turn == 1.0 else lambda value: axis.rotation(self.turn * value)
        return axis.shift if self.shift == 1.0 else lambda value: axis.shift(self.shift * value)

    def transforms(self, axis: Axis, values: Scalars) -> np.ndarray:
        """Returns the 4x4 motions from rest at many joint values, (n, 4, 4)."""
        motion = self.along(axis)
        return np.array([motion(float(value)) for value in values]).reshape(-1, 4, 4)

    def displacement(self, axis: Axis, points: Points, value: float) -> Points:
        """Returns by how much each point, (n, 3) in metres at rest, has moved at a joint value."""
        return transform_points(self.transform(axis, value), points) - points

    def sets_off(self, axis: Axis, point: Vec3, sense: float = 1.0) -> Vec3:
        """Returns the unit direction in which a point leaves rest; zero where it turns on the spot.

        A negative `sense` asks for the direction of negative values.
        """
        step = self.displacement(axis, point[None], sense * _A_LITTLE)[0]
        length = float(np.linalg.norm(step))
        return step / length if length > 1e-12 else np.zeros(3)

    def mapped_axis(self, axis: Axis, T: Mat4) -> Axis:
        """Returns a joint's axis mapped by T; a mirror image reverses the sense of what turns."""
        return axis.transformed(T, rotational=self.turns)

    def length_scale(self, scale: float) -> float:
        """Returns by what a joint's value grows where all lengths grow by `scale`: angles do not."""
        return scale if self.unit == "m" else 1.0

    def in_degrees(self, value: float) -> float:
        """Returns a value as formats state it that count angles in degrees; lengths stay metres."""
        return degrees(value) if self.unit == "rad" else value

    def from_degrees(self, value: float) -> float:
        """Returns a value that is stated in degrees, where it is an angle, in radians."""
        return radians(value) if self.unit == "rad" else value

    def worded(self, value: float) -> str:
        """Returns a value as people read it: `90°` or `12.5 cm`."""
        shown = self.in_degrees(value) if self.unit == "rad" else value * self.shown.factor
        return f"{shown:.{self.shown.digits}f}{self.shown.suffix}"

    def word(self, format_name: MotionFormat) -> str:
        """Returns what a format calls it.

        Raises:
            ArticulationError: if the format has no word for it.
        """
        if format_name not in self.words:
            raise ArticulationError(f"{format_name} cannot say a {self.type.value} joint; write another format")
        return self.words[format_name][0]


_DEGREES = ShownUnit(180.0 / np.pi, 0, "°")
_CENTIMETRES = ShownUnit(100.0, 1, " cm")
_ROWS = (
    MotionKind(
        JointType.FIXED,
        turn=0.0,
        shift=0.0,
        unit="",
        shown=ShownUnit(1.0, 0, ""),
        verb="is static",
        hardware="",
        label=PartLabel.UNKNOWN,
        words=MappingProxyType({"urdf": ("fixed",), "usd": ("FixedJoint",), "singapo": ("fixed",)}),
    ),
    MotionKind(
        JointType.REVOLUTE,
        turn=1.0,
        shift=0.0,
        unit="rad",
        shown=_DEGREES,
        verb="turns",
        hardware="hinge",
        label=PartLabel.DOOR,
        words=MappingProxyType(
            {
                "urdf": ("revolute", "continuous"),
                "mjcf": ("hinge",),
                "usd": ("RevoluteJoint",),
                "usd drive": ("angular",),
                "blender": ("ANGLE",),
                "particulate": ("revolute",),
                "singapo": ("revolute", "continuous"),
                "partnet": ("hinge",),
                "hssd": ("rotation", "hinge_rotation"),
                "sweethome": ("hinge",),
            }
        ),
    ),
    MotionKind(
        JointType.PRISMATIC,
        turn=0.0,
        shift=1.0,
        unit="m",
        shown=_CENTIMETRES,
        verb="slides",
        hardware="rail",
        label=PartLabel.DRAWER,
        words=MappingProxyType(
            {
                "urdf": ("prismatic",),
                "mjcf": ("slide",),
                "usd": ("PrismaticJoint",),
                "usd drive": ("linear",),
                "blender": ("DISTANCE",),
                "particulate": ("prismatic",),
                "singapo": ("prismatic",),
                "partnet": ("slider", "slider+"),
                "hssd": ("translation",),
                "sweethome": ("rail",),
            }
        ),
    ),
    MotionKind(
        JointType.CONTINUOUS,
        turn=1.0,
        shift=0.0,
        unit="rad",
        shown=_DEGREES,
        verb="turns",
        hardware="pin",
        label=PartLabel.MISC,
        words=MappingProxyType(
            {
                "urdf": ("continuous",),
                "mjcf": ("hinge",),
                "usd": ("RevoluteJoint",),
                "usd drive": ("angular",),
                "blender": ("ANGLE",),
                "particulate": ("revolute",),
                "singapo": ("continuous",),
            }
        ),
        limited=False,
    ),
)
MOTION_KINDS: Mapping[JointType, MotionKind] = MappingProxyType({row.type: row for row in _ROWS})
"""All kinds of motion by their type."""


def motion_kind(joint_type: JointType) -> MotionKind:
    """Returns the kind of motion of a joint type."""
    return MOTION_KINDS[joint_type]


def moving_kinds() -> tuple[MotionKind, ...]:
    """Returns all kinds that move."""
    return tuple(row for row in _ROWS if row.moves)


def kind_named(format_name: MotionFormat, word: str) -> MotionKind | None:
    """Returns the kind that moves and that a format calls by this word, the first of several; None: there is none."""
    return next((row for row in moving_kinds() if word in row.words.get(format_name, ())), None)
