"""Words for people: the colours of a verdict, the fixed list of faults, numbers and lists."""

from collections.abc import Iterable
from enum import StrEnum
from typing import Literal

from grafu.joints.report import LIFT_ARMS
from grafu.vocabulary import MechanismClass

Grasp = Literal["handle", "recess", "edge", "itself", "driven", "none"]
"""What a hand or a drive moves a part by."""


class Colour(StrEnum):
    """A traffic light."""

    GREEN = "green"  # every door and drawer works
    YELLOW = "yellow"  # it works, with something to look at
    RED = "red"  # something does not work


class FaultKind(StrEnum):
    """The kind of a fault: what a user should know of a part or of the whole."""

    NO_JOINT = "no joint"  # a door or drawer, or another part that was to move, has no joint
    COLLIDES = "collides"  # it cuts into something along its path
    LOOSE = "comes loose"  # a gap opens between it and what carries it
    SHUT = "does not open"  # it opens so little that it is no motion
    RESTRICTED = "restricted"  # it opens less than it should
    GUESSED = "guessed"  # how it moves, or that it does, was a guess that is not sure
    NO_GRASP = "no grasp"  # it cannot be grasped
    CARVED = "carved"  # more of a part was cut away than should be
    NOTED = "note"  # its hardware is not what it should be, or the budget allowed a simpler way only
    NOT_BUILT = "not built"  # something else that was asked for
    NOTHING_MOVES = "nothing moves"  # no part is a door or a drawer

    @property
    def colour(self) -> Colour:
        """How bad it is: red where a part does not work, else yellow."""
        works = self not in (FaultKind.NO_JOINT, FaultKind.COLLIDES, FaultKind.LOOSE, FaultKind.SHUT)
        return Colour.YELLOW if works else Colour.RED


def counted(count: int, what: str) -> str:
    """Returns `1 hinge`, `2 hinges`."""
    endings = {"s": what, "lf": f"{what[:-1]}ves", "x": f"{what}es"}
    plural = next((plural for ending, plural in endings.items() if what.endswith(ending)), f"{what}s")
    return f"{count} {what if count == 1 else plural}"


def listed(words: Iterable[str]) -> str:
    """Returns `a`, `a and b`, `a, b and c`."""
    known = list(words)
    return " and ".join([", ".join(known[:-1]), known[-1]] if len(known) > 1 else known)


def percent(ratio: float) -> str:
    """Returns a fraction as a percentage; never 0 % above nothing, never 100 % below all."""
    if 0 < ratio < 0.005:
        return "under 1 %"
    return "over 99 %" if 0.995 <= ratio < 1 else f"{100 * ratio:.0f} %"


def piece_words(kind: str, score: float) -> str:
    """Returns what the whole piece is, such as `wall cabinet (97 %)`."""
    return f"{kind} ({percent(score)})"


def hardware_in_words(count: int, template: str, mechanism: MechanismClass) -> str:
    """Returns what a joint runs on, such as `2 × butt (contact)`."""
    if template == "drawn":
        return "the hardware of the input"
    if template == LIFT_ARMS:
        return f"{count} × lift arms"
    return "no hardware" if mechanism is MechanismClass.NONE else f"{count} × {template} ({mechanism.in_words})"


def cut_in_words(kind: str) -> str:
    """Returns the kind of a clearance in the report for people: `shrunk` where the report has `eased`."""
    return "shrunk" if kind == "eased" else kind
