"""A motion that the user states for one part; it replaces that of the motion source.

Sides are those of the object frame: the front looks along -Y, the left lies at -X, so they are one's own before it.
"""

from enum import StrEnum
from typing import final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.errors import OptionError, did_you_mean
from grafu.geometry.arrays import Mat3, Vec3, median, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.joints.rail.search import slides_in_its_plane
from grafu.joints.rail_config import DrawerConfig
from grafu.scene.border import part_axes
from grafu.vocabulary import MOTION_WORDS, JointType, PartLabel

_LEVEL = 1e-6  # metres: a face this near to the middle of the whole is in the middle
_BOARD = 0.25  # a front that tilts and is thicker than this, over its next side, has its bin in its mesh
OLD_FIXED = "not"
"""The word of earlier versions for `fixed`; saved settings are still read."""


class Moves(StrEnum):
    """Whether a part moves, and how."""

    FIXED = "fixed"  # it gets no joint, whatever its label
    TURNS = "turns"
    SLIDES = "slides"
    FOLDS = "folds"  # one of two leaves that are hinged to one another
    LIFTS = "lifts"  # arms lift it upright, parallel to itself
    TILTS = "tilts"  # it turns about its lower edge with the bin behind it, and stops well before it is level

    @classmethod
    def _missing_(cls, value: object) -> "Moves | None":
        return cls.FIXED if value == OLD_FIXED else None  # as settings of earlier versions spell it


class Side(StrEnum):
    """A side of the object."""

    LEFT = "left"
    RIGHT = "right"
    FRONT = "front"
    BACK = "back"
    TOP = "top"
    BOTTOM = "bottom"


DIRECTIONS: dict[Side, Vec3] = {
    Side.LEFT: vec3(-1.0, 0.0, 0.0),
    Side.RIGHT: vec3(1.0, 0.0, 0.0),
    Side.FRONT: vec3(0.0, -1.0, 0.0),
    Side.BACK: vec3(0.0, 1.0, 0.0),
    Side.TOP: vec3(0.0, 0.0, 1.0),
    Side.BOTTOM: vec3(0.0, 0.0, -1.0),
}


FOLD_SIDES = (Side.LEFT, Side.RIGHT, Side.TOP)
"""The sides that two leaves can fold to."""


@final
@dataclass(frozen=True, slots=True)
class MotionChoice:
    """How one part moves.

    `side` is the border that a part turns about, or the side that it slides to (None: the front), or the one that two
    leaves fold to. What turns opens outwards, away from the object's middle, unless `inwards`.

    Raises:
        ValueError: if a part that turns has no side, one that does not turn opens inwards, a leaf folds to a side
            that is neither left nor right nor the top, or the side of what tilts or lifts is not its own.
    """

    moves: Moves
    side: Side | None = None
    inwards: bool = False

    def __post_init__(self) -> None:
        if self.moves is Moves.TURNS and self.side is None:
            raise ValueError("`MotionChoice.side` must name the border that a part turns about: got none")
        if self.moves is Moves.FOLDS and self.side not in FOLD_SIDES:
            raise ValueError(f"`MotionChoice.side` must be left, right or top for a leaf that folds: got {self.side}")
        if self.moves in _BORDERS and self.side is not _BORDERS[self.moves]:
            border = _BORDERS[self.moves]
            raise ValueError(f"`MotionChoice.side` must be {border} for a front that {self.moves}: got {self.side}")
        if self.moves is not Moves.TURNS and self.inwards:
            raise ValueError(f"`MotionChoice.inwards` is for parts that turn: got it for one that moves {self.moves}")
        if self.moves is Moves.FIXED and self.side is not None:
            raise ValueError(f"`MotionChoice.side` must be None for a fixed part: got {self.side}")

    @property
    def type(self) -> JointType:
        """The type of joint."""
        return _TYPES[self.moves]


_TYPES: dict[Moves, JointType] = {
    Moves.FIXED: JointType.FIXED,
    Moves.TURNS: JointType.REVOLUTE,
    Moves.SLIDES: JointType.PRISMATIC,
    Moves.FOLDS: JointType.REVOLUTE,
    Moves.LIFTS: JointType.REVOLUTE,
    Moves.TILTS: JointType.REVOLUTE,
}
_BORDERS = {Moves.TILTS: Side.BOTTOM, Moves.LIFTS: Side.TOP}
FIXED = MotionChoice(Moves.FIXED)

TURNING_SIDES = ("left", "right", "top", "bottom", "front", "back")
"""The borders that a part can turn about, as words."""
_CHOICES: dict[str, MotionChoice] = dict(
    zip(
        MOTION_WORDS,
        (
            *(MotionChoice(Moves.TURNS, Side(side)) for side in (*TURNING_SIDES, "top", "bottom")),
            MotionChoice(Moves.TILTS, Side.BOTTOM),
            MotionChoice(Moves.LIFTS, Side.TOP),
            *(MotionChoice(Moves.SLIDES, side) for side in (None, None, Side.LEFT, Side.RIGHT, Side.TOP)),
            *(MotionChoice(Moves.FOLDS, side) for side in FOLD_SIDES),
            FIXED,
        ),
        strict=True,
    )
)


def choice_in_words(word: str) -> MotionChoice:
    """Returns the choice that one of `MOTION_WORDS` states.

    Raises:
        OptionError: if it is another word.
    """
    if word == OLD_FIXED:
        raise OptionError("`not` is called `fixed` now: use fixed")
    if word not in _CHOICES:
        near = did_you_mean(word, MOTION_WORDS)
        raise OptionError(f"must be one of {', '.join(MOTION_WORDS)}: got {word!r}{near}")
    return _CHOICES[word]


def label_of_motion(part: Part, choice: MotionChoice, drawers: DrawerConfig = DrawerConfig()) -> PartLabel:
    """Returns the category of a part that moves so: an upright board that slides along itself is a door, too.

    A level board that slides to the left or right, and is no drawer, is the leaf of a table: that has none of its own.
    """
    if choice.moves is Moves.FIXED or (choice.side in (Side.LEFT, Side.RIGHT) and _is_leaf(part, choice)):
        return part.label
    if motion_kind(choice.type).turns or slides_in_its_plane(part.mesh, _direction(choice), drawers):
        return PartLabel.DOOR
    return PartLabel.DRAWER


def _is_leaf(part: Part, choice: MotionChoice) -> bool:
    size = part.box.size
    level = part.box.thin_axis == int(np.argmax(DIRECTIONS[Side.TOP])) and size.min() < _BOARD * median(size)
    return choice.moves is Moves.SLIDES and bool(level) and not part.label.is_movable


def axis_of_motion(part: Part, choice: MotionChoice, whole: Box) -> Axis:
    """Returns the initial axis of a part that moves; `whole` is the box of the object. Positive opens.

    It follows the part's own sides where the part stands turned about Z.

    Raises:
        OptionError: if a part is to turn about what is no border of it.
    """
    axes = part_axes(part.mesh)
    local = Box.around(part.mesh.vertices @ axes)
    side = _own_side(axes, _direction(choice))
    if choice.moves is Moves.SLIDES:
        return Axis(axes @ local.center, side)
    if choice.moves is Moves.TILTS and local.size[local.thin_axis] > _BOARD * median(local.size):
        opens = _own_side(axes, DIRECTIONS[Side.FRONT])  # the bin is part of its mesh
    else:
        thin = axes[:, local.thin_axis]
        if abs(float(side @ thin)) > 0.5:
            raise OptionError(f"`{part.id}` must turn about one of its borders: its {choice.side} is a broad face")
        opens = _outwards(thin, axes @ local.center - whole.center) * (-1.0 if choice.inwards else 1.0)
    half = np.abs(axes.T @ side) @ local.half
    depth = float(np.abs(axes.T @ opens) @ local.half)
    return Axis(axes @ local.center + half * side + depth * opens, np.cross(-side, opens))


def motion_as_choice(mesh: TriangleMesh, joint_type: JointType, axis: Axis, whole: Box) -> MotionChoice | None:
    """Returns the choice that comes nearest to how a part moves; None where it turns about no border of its own.

    `mesh` is the part closed, `axis` that of its joint, positive opens; `whole` is the box of the object.
    """
    if motion_kind(joint_type).slides:
        return MotionChoice(Moves.SLIDES, side_towards(axis.direction))
    axes = part_axes(mesh)
    local = Box.around(mesh.vertices @ axes)
    along = int(np.argmax(np.abs(axes.T @ axis.direction)))
    if along == local.thin_axis:
        return None
    wide = axes[:, 3 - along - local.thin_axis]
    center = axes @ local.center
    side = wide * np.copysign(1.0, float(wide @ (axis.point - center)))
    opens = np.cross(axis.direction, -side)
    outwards = _outwards(axes[:, local.thin_axis], center - whole.center)
    return MotionChoice(Moves.TURNS, side_towards(side), inwards=float(opens @ outwards) < 0)


def side_towards(direction: Vec3) -> Side:
    """Returns the side of the object that a direction points to most."""
    return max(DIRECTIONS, key=lambda side: float(DIRECTIONS[side] @ direction))


def _direction(choice: MotionChoice) -> Vec3:
    return DIRECTIONS[choice.side or Side.FRONT]


def _own_side(axes: Mat3, direction: Vec3) -> Vec3:
    """Returns the part's own axis that is nearest to a direction, pointing that way."""
    ratios = axes.T @ direction
    k = int(np.argmax(np.abs(ratios)))
    return np.asarray(axes[:, k] * np.sign(ratios[k]))


def _outwards(normal: Vec3, from_middle: Vec3) -> Vec3:
    """Returns a broad face's normal, away from the middle of the whole; in the middle, the front's or the upper one."""
    away = float(normal @ from_middle)
    if abs(away) < _LEVEL:
        away = float(normal @ vec3(0.0, -1.0, 0.5))
    return normal if away >= 0 else -normal
