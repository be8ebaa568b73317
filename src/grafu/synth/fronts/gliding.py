"""Fronts that slide, fold, rise or pull out, and bins: what fills an opening, as values. They build no geometry."""

from math import radians
from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.synth.fronts.hold import EMPTY, USUAL, Grip, HandleStyle, Hold, Inside
from grafu.synth.fronts.leaf_style import CURVED, LeafStyle, Side, check_grip

LEAVES = {"bypass": (2, 3), "barn": (1,), "pocket": (1,), "shutter": (1,)}


@final
@dataclass(frozen=True, slots=True)
class Sliding:
    """Doors that slide along the front or up, metres.

    "bypass" leaves stand in the opening, in two planes, and lap each other by `lap`; the left one is the front one if
    `left_first`. A "barn" door hangs on a rail before the case and closes its left half or, slid, its right one. A
    "pocket" door closes one half of the opening (the left one if `left_first`) and slides behind a board that closes
    the other; a "shutter" closes the lower half and goes up behind the board above it. A `pane` is 6 mm of glass
    without a frame. `track` is the height of the rails above and below (0: none are drawn), of a barn door that of its
    rail.

    Raises:
        ValueError: if there are not two or three leaves that pass one another, or one of another kind, a leaf is
            curved, or one that is not a slab has a grip.
    """

    kind: Literal["bypass", "barn", "pocket", "shutter"] = "bypass"
    leaves: int = 2
    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    shelves: int = 0
    inside: Inside = EMPTY
    hold: Hold = USUAL
    grip: Grip = "none"
    lap: float = 0.03
    left_first: bool = True
    pane: bool = False
    track: float = 0.0

    def __post_init__(self) -> None:
        if self.leaves not in LEAVES[self.kind] or self.leaf in CURVED:
            raise ValueError(
                f"`Sliding` has two or three flat leaves, of other kinds one: got {self.leaves} {self.leaf}"
            )
        check_grip(self.grip, self.leaf)


@final
@dataclass(frozen=True, slots=True)
class Folding:
    """Two leaves that fold to a `side`, the top where they fold up; `opening` is the outer one's, radians.

    Raises:
        ValueError: if a leaf is curved or the side is the bottom, or a leaf that is not a slab has a grip.
    """

    side: Side = "left"
    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    opening: float = radians(85)
    shelves: int = 0
    inside: Inside = EMPTY
    hold: Hold = USUAL
    grip: Grip = "none"

    def __post_init__(self) -> None:
        if self.side == "bottom" or self.leaf in CURVED:
            raise ValueError(f"`Folding` has flat leaves that fold to a side or up: got {self.leaf}, {self.side}")
        check_grip(self.grip, self.leaf)


@final
@dataclass(frozen=True, slots=True)
class Lift:
    """A flap that arms beside the walls lift upright, as parallel lifts do: it follows them.

    The arms point `angle` radians below the horizontal at rest, and end no further above it, where they clear the top.
    They are as long as lifts the flap by up to `rise`, from pivots so far (`start`) above the opening's floor, both as
    fractions of its height. A `rod` may join them.

    Raises:
        ValueError: if a leaf is curved, one that is not a slab has a grip, or the arms do not end within the opening.
    """

    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    angle: float = radians(75)
    rise: float = 0.85
    start: float = 0.12
    rod: bool = True
    hold: Hold = USUAL
    grip: Grip = "none"

    def __post_init__(self) -> None:
        if self.leaf in CURVED:
            raise ValueError(f"`Lift` has a flat leaf: got {self.leaf}")
        if not (self.start > 0 and self.rise > 0 and self.start + self.rise / 2 < 0.9):
            raise ValueError(f"the arms of a `Lift` must end within its opening: got {self.start}, {self.rise}")
        check_grip(self.grip, self.leaf)


@final
@dataclass(frozen=True, slots=True)
class PullOut:
    """A front that comes out with what is behind it: a rack of `number` trays, or so many bins behind one another.

    `travel` is the fraction of the room's depth that it comes out.

    Raises:
        ValueError: if there is nothing behind it, its leaf is curved, or one that is not a slab has a grip.
    """

    load: Literal["trays", "bins"] = "trays"
    number: int = 2
    leaf: LeafStyle = "slab"
    handle: HandleStyle = "bar-round"
    travel: float = 0.8
    hold: Hold = USUAL
    grip: Grip = "none"
    runner: bool = False

    def __post_init__(self) -> None:
        if self.number < 1 or self.leaf in CURVED:
            raise ValueError(f"`PullOut` has a flat leaf and something behind it: got {self.leaf}, {self.number}")
        check_grip(self.grip, self.leaf)


@final
@dataclass(frozen=True, slots=True)
class WasteBins:
    """Bins beside each other that slide out of an opening: `tall` and `deep` over its room, on `runners` or not.

    Raises:
        ValueError: if there is no bin, or a fraction is not between 0 and 1.
    """

    number: int = 1
    tall: float = 0.6
    deep: float = 0.85
    runners: bool = True
    travel: float = 0.7

    def __post_init__(self) -> None:
        if self.number < 1 or not all(0 < ratio < 1 for ratio in (self.tall, self.deep, self.travel)):
            raise ValueError(f"`WasteBins` needs bins and fractions between 0 and 1: got {self}")
