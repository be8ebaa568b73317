"""What realization is asked to build: joints with initial axes. It cannot tell who asked."""

from dataclasses import dataclass
from typing import final

from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType


@final
@dataclass(frozen=True)
class JointRequest:
    """One joint to build.

    `axis` is an initial guess in the object frame; positive motion along or about it opens. `reference` is the
    opening that was asked for (radians or metres; None: as far as the mechanism goes). `mounts` are the static parts
    that should carry it, best first; empty leaves the choice to the geometry. `riders` move with the part (handles).
    `source` says where the motion came from. `drawn_at` is the joint value at which the input draws the part: where it
    is not 0 the part is drawn ajar, and is closed before anything is built.
    """

    moving: str
    type: JointType
    axis: Axis
    source: str
    reference: float | None = None
    mounts: tuple[str, ...] = ()
    riders: tuple[str, ...] = ()
    drawn_at: float = 0.0

    def __post_init__(self) -> None:
        if self.type is JointType.FIXED:
            raise ValueError(f"`JointRequest.type` must be revolute or prismatic: got {self.type} for {self.moving}")


@final
@dataclass(frozen=True)
class Refusal:
    """A movable part for which no motion could be stated, and why, in words."""

    part: str
    why: str


@final
@dataclass(frozen=True)
class RealizationPlan:
    """Everything to build on one asset."""

    joints: tuple[JointRequest, ...] = ()
    refused: tuple[Refusal, ...] = ()
