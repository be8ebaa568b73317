"""What moves as one in a scene, and how it moves."""

from typing import final

from grafu.articulation.motion_kind import MotionKind, motion_kind
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType


@final
@dataclass(frozen=True)
class MovingBody:
    """What moves as one: the part's id, then those that ride on it."""

    id: str
    members: tuple[str, ...]


@final
@dataclass(frozen=True)
class JointMotion:
    """How a moving body moves: about or along `axis`, from rest to `upper` (radians or metres).

    `is_built` states that its joint stands; else it is what must be expected of a joint that is yet to be built.
    `after` names the moving bodies that must be wide open before it can move.
    """

    axis: Axis
    type: JointType
    upper: float
    is_built: bool = True
    after: tuple[str, ...] = ()

    @property
    def kind(self) -> MotionKind:
        """How it moves, and what everyone asks about it."""
        return motion_kind(self.type)
