"""The hardware that was placed for a joint, and the outcome of each request: installed with its figures, or refused."""

from typing import final

from grafu.articulation.articulated_object import Visual
from grafu.articulation.slip import Slip
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.refusal import Refusal
from grafu.vocabulary import JointType, MechanismClass

LIFT_ARMS = "lift-arms"
"""`Installed.template` of a flap that rises upright, and of its arms."""


@final
@dataclass(frozen=True)
class Placement:
    """The hardware of one joint in the object frame at rest: rectified axis, opening (radians or metres), both ends.

    `in_way` names the moving bodies that the part meets at rest along its path, `struck_by` those that run into the
    hardware on theirs; `left_out` states which other hardware was left out, and why. `slip` is what the part is shown
    to do beside the joint's motion, where a linkage guides it.
    """

    axis: Axis
    upper: float
    mechanism: MechanismClass
    template: str
    mount: str
    count: int
    dynamic: tuple[Visual, ...]
    static: tuple[Visual, ...]
    in_way: tuple[str, ...]
    struck_by: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    slip: Slip | None = None


@final
@dataclass(frozen=True, slots=True)
class Clearance:
    """Material taken away so that a part can move: which part, how, and how much.

    `kind` states how: joined (it lay enclosed in the moving part and moves with it now), separated (shells of the
    moving part belong to the case and are static now; `amount` is the square root of their surface, `share` their
    fraction of the moving body's), closed (it was drawn ajar and was moved by `amount`), trimmed (pressed back by
    up to `amount`, `share` of a side), eased (shrunk on all sides by `amount`, `share` of the volume) or carved
    (cut out; `amount` is the square root of the surface that went, `share` the larger of `surface_share`, of what
    is seen of the part, and `volume_share`, of the volume of its pieces' convex hulls). Lengths are metres, angles
    radians.
    """

    part: str
    kind: str
    amount: float
    share: float
    why: str
    surface_share: float = 0.0
    volume_share: float = 0.0


@final
@dataclass(frozen=True)
class Installed:
    """A joint that was built, with what was measured on it.

    `wanted` is the opening that it should have: what was asked for, else what is usual, as far as its kind goes.
    `stays` is how many stays it has besides its hinges.
    """

    moving: str
    joint: str
    type: JointType
    mount: str
    mechanism: MechanismClass
    template: str
    count: int
    source: str
    initial_axis: Axis
    axis: Axis
    opening: float
    reference: float | None
    restricted: bool
    collision_share: float
    largest_gap: float
    after: tuple[str, ...] = ()
    clearances: tuple[Clearance, ...] = ()
    notes: tuple[str, ...] = ()
    left_out: tuple[str, ...] = ()
    wanted: float | None = None
    stays: int = 0


Outcome = Installed | Refusal


@final
@dataclass(frozen=True)
class RealizationReport:
    """One outcome per request, and all clearances."""

    outcomes: tuple[Outcome, ...] = ()
    timings: tuple[tuple[str, float], ...] = ()

    @property
    def installed(self) -> tuple[Installed, ...]:
        """The joints that were built."""
        return tuple(o for o in self.outcomes if isinstance(o, Installed))

    @property
    def skipped(self) -> tuple[Refusal, ...]:
        """The requests that were not built."""
        return tuple(o for o in self.outcomes if isinstance(o, Refusal))
