"""The words of a verdict: its three colours, and the closed list of what can be amiss, each with how bad it is."""

from enum import StrEnum


class Colour(StrEnum):
    """A traffic light."""

    GREEN = "green"  # every door and drawer works
    YELLOW = "yellow"  # it works, with something to look at
    RED = "red"  # something does not work


class FaultKind(StrEnum):
    """What can be amiss."""

    STILL = "stands still"  # a door or drawer, or another part that was to move, has no joint
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
        works = self not in (FaultKind.STILL, FaultKind.COLLIDES, FaultKind.LOOSE, FaultKind.SHUT)
        return Colour.YELLOW if works else Colour.RED
