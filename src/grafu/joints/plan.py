"""What is asked for: joints to build, with initial axes, and choices about them. The requester makes no difference."""

from collections.abc import Iterable, Sequence, Set
from dataclasses import replace
from enum import StrEnum
from math import isfinite, radians
from typing import final

from grafu.articulation.articulated_object import Coupling
from grafu.articulation.motion_kind import MotionKind, motion_kind
from grafu.dataclass import dataclass
from grafu.geometry.axis import Axis
from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios
from grafu.refusal import Refusal
from grafu.vocabulary import JointType, MechanismClass

PIVOT = "pivot"
"""The template of a door that is carried by discs at its ends; it is of no gallery."""
CUP = "cup"
"""The template of a door on concealed hinges; it is of no class."""
SCALES = (0.25, 4.0)
"""Least and largest factor by which a user may change the size of hinges."""
MOST_HINGES = 12
"""Most hinges that a user may ask for on one door."""


class Supports(StrEnum):
    """What holds a rail that touches no wall, and what bridges the gap to its drawer."""

    AUTO = "auto"  # the shortest block to whatever stands there
    NONE = "none"  # nothing: rails stand only where they touch both sides
    SLAB = "slab"  # a slab as large as the rail, out to the wall beside it
    DIVIDER = "divider"  # an upright board along the rail, from what stands below to what stands above


class MotionRole(StrEnum):
    """What a part is within a mechanism that is built in a way of its own, such as a folding door."""

    NONE = "none"  # an ordinary door or drawer
    OUTER = "outer"  # of a folding door: it turns on pivots, if they find room, and carries the inner leaf
    INNER = "inner"  # of a folding door: it follows the outer leaf, and runs in a track above it
    CORNER = "corner"  # of a folding door: it hangs on another leaf in an inner corner, and turns by itself
    LOWER = "lower"  # of two leaves that fold up: it follows the leaf above it
    EXTENSION = "extension"  # it makes a table longer, and slides on what the table has
    BIN = "bin"  # it stands behind a door, and slides out on what is there
    SUPPORT = "support"  # it carries a table's raised leaf, and swings or slides out on what the table has
    SEAT = (
        "seat"  # of a toilet, or its lid: both turn about one pin, on what the toilet has where that leaves both free
    )
    LIFTED = "lifted"  # arms lift it upright where they find room


@final
@dataclass(frozen=True)
class PlanConfig:
    """How stated and predicted motions become requests.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    play: float = 0.25
    """A limit on the other side of the drawn pose below this fraction of the wider one is play, not motion."""
    beyond: float = 0.05
    """How far what a moving part carries may stand out of its outline (fraction of the moving part's side)."""
    carried_area: float = 0.5
    """Largest outline of what a moving part carries, over its own (fraction of the area)."""
    nearer_border: float = 0.2
    """A chosen mount this much nearer to a door's other border carries it there (fraction of the door's width)."""
    rack: float = 0.15
    """What slides and is no drawer is a rack or a basket from this size on (fraction of the object's largest side)."""
    other_direction: float = 0.01
    """Least probability of another direction for which it is tried where the likeliest one is blocked ..."""
    other_directions: int = 2
    """... and how many of them are tried."""
    short_turn: float = radians(1.0)
    """A note states that a door opens by more than this less than was chosen (radians) ..."""
    short_slide: float = 0.002
    """... or a drawer, in metres as they are chosen."""

    def __post_init__(self) -> None:
        require_positive(self, "short_turn", "short_slide")
        require_not_negative(self, "other_directions")
        require_ratios(self, "play", "beyond", "carried_area", "nearer_border", "rack", "other_direction")


@final
@dataclass(frozen=True, slots=True)
class JointChoice:
    """What is decided about one joint; what is left as it is here, the search decides.

    `mechanism` and `template` narrow it to one class or template (an id; `PIVOT` for discs at the ends, `CUP` for
    concealed hinges), `scale` multiplies the size of hinges, `count` is their number (0: by the door's height),
    `flipped` hangs the door on its opposite border, `opening` is the widest opening (radians or metres), `mount` the
    part that must carry the joint (of the two rails of a drawer, at least one), `supports` what holds rails where they
    touch no wall.

    Raises:
        ValueError: if `scale` is not within `SCALES`, `count` not in 0..`MOST_HINGES`, or `opening` not above 0.
    """

    mechanism: MechanismClass | None = None
    template: str = ""
    scale: float = 1.0
    count: int = 0
    flipped: bool = False
    opening: float | None = None
    mount: str = ""
    supports: Supports = Supports.AUTO

    def __post_init__(self) -> None:
        least, largest = SCALES
        if not least <= self.scale <= largest:
            raise ValueError(f"`JointChoice.scale` must be in {least:g}..{largest:g}: got {self.scale}")
        if not 0 <= self.count <= MOST_HINGES:
            raise ValueError(f"`JointChoice.count` must be in 0..{MOST_HINGES}: got {self.count}")
        if self.opening is not None and not (isfinite(self.opening) and self.opening > 0):
            raise ValueError(f"`JointChoice.opening` must be above 0: got {self.opening}")
        if self.mechanism is MechanismClass.NONE:
            raise ValueError("`JointChoice.mechanism` must be a class of hinges or rails: got none")
        if self.template in (PIVOT, CUP) and self.mechanism is not None:
            raise ValueError(f"pivots and cup hinges are of no class: got {self.mechanism}")

    def __str__(self) -> str:
        words = (f"class {self.mechanism}" if self.mechanism else "", self.template, "flipped" * self.flipped)
        sizes = (f"{self.count} of them" if self.count else "", f"scale {self.scale:g}" if self.scale != 1.0 else "")
        mount = f"on `{self.mount}`" if self.mount else ""
        held = f"supports: {self.supports}" if self.supports is not Supports.AUTO else ""
        return ", ".join(word for word in (*words, *sizes, mount, held) if word)

    def takes(self, template: str) -> bool:
        """Whether hardware of this template may be built."""
        return self.template in ("", template)


AUTOMATIC = JointChoice()
"""Nothing is decided: the search is free."""


@final
@dataclass(frozen=True)
class JointRequest:
    """One joint to build.

    `axis` is an initial guess in the object frame; positive motion along or about it opens. `reference` is the
    opening that was asked for (radians or metres; None: as far as the mechanism goes). `mounts` are the static parts
    that should carry it, best first; empty leaves the choice to the geometry. `attached` move with the part (handles).
    `source` states where the motion came from. `drawn_at` is the joint value at which the input draws the part: where
    it is not 0 the part is drawn ajar, and is closed before anything is built. `choice` narrows the search for
    hardware.

    `parent` is the moving part that carries the joint ("": the static body); the part is among what is `attached` to
    it. With a `coupling` the joint follows that of another part, which it names; both count values from closed.
    `carriers` are the parts that alone may hold the hardware (empty: every static part). `role` states what it is
    within a mechanism. What turns opens no further than `stop` (radians; None: as far as such a thing does), unless the
    user chose an opening. Open, it is to lie no lower than `rests` (metres; None: anywhere): on what carries it.

    Raises:
        ValueError: if nothing moves, it is carried by or follows itself, or `stop` is not above 0.
    """

    moving: str
    type: JointType
    axis: Axis
    source: str
    reference: float | None = None
    mounts: tuple[str, ...] = ()
    attached: tuple[str, ...] = ()
    drawn_at: float = 0.0
    choice: JointChoice = AUTOMATIC
    parent: str = ""
    coupling: Coupling | None = None
    carriers: tuple[str, ...] = ()
    role: MotionRole = MotionRole.NONE
    stop: float | None = None
    rests: float | None = None

    def __post_init__(self) -> None:
        if not self.kind.moves:
            raise ValueError(f"`JointRequest.type` must be one that moves: got {self.type} for {self.moving}")
        if self.moving in (self.parent, self.coupling and self.coupling.leader):
            raise ValueError(f"`parent` and the leader must be other parts: got {self.moving}")
        if self.stop is not None and not self.stop > 0:
            raise ValueError(f"`JointRequest.stop` must be above 0: got {self.stop} for {self.moving}")

    @property
    def kind(self) -> MotionKind:
        """How it moves, and what everyone asks about it."""
        return motion_kind(self.type)

    @property
    def on_pivots(self) -> bool:
        """Whether discs at its ends are tried before hinges: it is the outer leaf of a pair that folds."""
        return self.role is MotionRole.OUTER

    @property
    def holders(self) -> tuple[str, ...]:
        """The parts that alone may hold the hardware: the chosen mount, else its carriers; empty: every static part."""
        return (self.choice.mount,) if self.choice.mount else self.carriers


@final
@dataclass(frozen=True)
class DrawnArms:
    """Parts of the input that lift the `flap` or hold it open, arms or stays: they move as it does, and block nothing.

    Arms that lift it upright turn about `on_case` and carry it at `on_flap` (object frame, positive opens; None: they
    do not), by up to `upper` radians.
    """

    flap: str
    parts: tuple[str, ...]
    on_case: Axis | None = None
    on_flap: Axis | None = None
    upper: float = 0.0


@final
@dataclass(frozen=True)
class RealizationPlan:
    """Everything to build on one asset; `refused` are the movable parts for which no joint is requested.

    The parts of `arms` are of the mechanisms of lids and flaps, and are left out while these are built.
    """

    joints: tuple[JointRequest, ...] = ()
    refused: tuple[Refusal, ...] = ()
    arms: tuple[DrawnArms, ...] = ()

    @property
    def left_out(self) -> frozenset[str]:
        """The parts of the input that are no obstacles: drawn arms and stays."""
        return frozenset(part for drawn in self.arms for part in drawn.parts)

    def with_attached(self, pairs: Iterable[tuple[str, str]]) -> "RealizationPlan":
        """Returns the plan in which more parts move with moving parts: of each pair the moving part, then the other."""
        riding: dict[str, list[str]] = {}
        for moving, part_id in pairs:
            riding.setdefault(moving, []).append(part_id)
        joints = tuple(replace(r, attached=(*r.attached, *riding.get(r.moving, ()))) for r in self.joints)
        return replace(self, joints=joints)


def moved_instead(plan: RealizationPlan, own: Set[str], requests: Sequence[JointRequest]) -> RealizationPlan:
    """Returns the plan in which the parts `own` move as requested, and in no other way; none of them rides on others.

    What rode on them still does, and what was refused of them is not any more.
    """
    riding = {r.moving: tuple(name for name in r.attached if name not in own) for r in plan.joints}
    others = (replace(r, attached=riding[r.moving]) for r in plan.joints if r.moving not in own)
    made = (replace(r, attached=riding.get(r.moving, ())) for r in requests)
    refused = tuple(r for r in plan.refused if r.part not in own)
    return replace(plan, joints=(*others, *made), refused=refused)
