"""What was asked for and not made, and why: one value, with reasons from one fixed list.

docs/report.md is drawn from the two lists.
"""

from dataclasses import replace
from enum import StrEnum
from typing import Final, final

from grafu.dataclass import dataclass


class Asked(StrEnum):
    """What was asked for."""

    JOINT = "joint"  # that a part moves
    SMALL_JOINT = "small joint"  # that a knob, a button or a wheel moves by itself
    TOP = "top"
    BOARD = "carcass board"  # a back or a bottom
    DRAWER_BOX = "drawer box"
    GRASP = "grasp"  # a handle or a recessed grip
    INTERIOR = "interior"  # shelves and dividers
    ADDITIONS = "additions"  # several of these at once


class Reason(StrEnum):
    """Why something was not made: a short word, and the same in one plain sentence."""

    sentence: str

    def __new__(cls, word: str, sentence: str) -> "Reason":
        """Makes a member whose value is the word."""
        made = str.__new__(cls, word)
        made._value_ = word
        made.sentence = sentence
        return made

    # of a joint
    NO_FACING_SURFACES = "no facing surfaces", "No static part is near enough to carry a hinge or a rail."
    BLOCKED = "blocked", "The part cannot move freely: other parts block its path."
    NO_MOTION = "no motion", "How the part moves is not known."
    REJECTED = "rejected", "The user fixed the part."
    UNSUPPORTED = "unsupported motion", "Motions of this kind are not built."
    CARRIES = "carries others", "A guess states that the part moves, but other parts stand on it alone."
    UNLIKELY = "unlikely", "A guess states that the part moves, but it is weak, or the part has another shape."
    # of anything
    TOO_COMPLEX = "too complex", "The work would take more time or memory than its part of the budget."
    NO_ROOM = "no room", "There is too little room for it between other parts."
    # of what is added
    IN_THE_WAY = "in the way", "Something else is in its place, or moves through it."
    NO_SUPPORT = "no support", "Nothing is there that could carry it."
    NOT_MISSING = "not missing", "Nothing of the kind is missing."
    NOTHING_REPLACED = "nothing replaced", "No part is found that could be replaced."
    NOT_CLEAR = "not clear", "The existing parts do not show how large it should be."
    TOO_SMALL = "too small", "The front is too small for it."
    NO_GROUND = "no ground", "The front has no even, solid place for the foot of a handle."
    UNEVEN = "uneven", "The surface where it would be is uneven, or open."
    NO_THICKNESS = "no thickness", "The front is a thin sheet, in which no groove can be cut."
    TOO_THIN = "too thin", "The front is too thin: no wall would be left behind a groove."
    TOO_THICK = "too thick", "The front is too thick: a hole or a notch would not come out behind it."
    GLASS = "glass", "The front can be seen through there, and glass is not carved."
    TAKEN = "taken", "Handles, hinges or rails are in that place."
    NO_FINGER_ROOM = "no finger room", "Fingers would have no room: something is directly in front of it or behind it."
    WOULD_BREAK = "would break", "The front would come apart, or change its outline."
    OTHER_STYLE = "other style", "There is no room for the style that was chosen; another one was used."
    NO_COMPARTMENT = "no compartment", "There is no such space between walls."
    UNSUITABLE = "unsuitable", "Furniture of this kind takes no such part."
    FEWER = "fewer", "There is room for fewer than were asked for."


OF_GUESSES: Final = (Reason.CARRIES, Reason.UNLIKELY)
"""Why parts that were only guessed to move stay static: no joint of theirs is missing."""


@final
@dataclass(frozen=True, slots=True)
class Refusal:
    """Something that was asked for and not made.

    `part` is the id of the part that it was for, or what was to be added ("top panel", "shelf of compartment 2"); it is
    empty where only the caller knows. `why` states in words what was found (empty: the reason's sentence states all).
    """

    part: str
    reason: Reason
    why: str = ""
    what: Asked = Asked.JOINT

    def of(self, part: str, what: Asked) -> "Refusal":
        """Returns the same refusal of something else."""
        return replace(self, part=part, what=what)

    def __str__(self) -> str:
        return self.why or self.reason.sentence
