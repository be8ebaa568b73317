"""The thresholds of the decode, each with its reason. It decides nothing."""

from typing import final

from grafu.completion.config import MisnamedConfig
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.visible import ShortRepr
from grafu.vocabulary import PartLabel

# The parts that a completion may invent: a door or a side that is not there is not missing.
ADDABLE: tuple[PartLabel, ...] = (
    PartLabel.HANDLE,
    PartLabel.SHELF,
    PartLabel.TOP_PANEL,
    PartLabel.DIVIDER,
    PartLabel.BOTTOM_PANEL,
    PartLabel.BACK_PANEL,
)


@final
@dataclass(frozen=True, slots=True)
class ColumnConfig(ShortRepr):
    """Which doors stand right above each other, and which of them follows another; numbers are ratios.

    Raises:
        ValueError: if a number is not above 0.
    """

    unsure: float = 0.75
    """A door whose likelier side is less likely than this, of both sides, takes that of the surest one of its column.
    Of 56 such pairs of doors of synthetic furniture 54 hang on one side (900 pieces)."""
    tied: float = 0.1
    """A column whose surest door does not prefer a side by more than this, of both sides, hangs on the right: so are
    refrigerators delivered, which often have a grip across the whole width."""
    aligned: float = 0.05
    """How far their sides, and their planes, are apart at most (fraction of the width)."""
    between: float = 0.25
    """How far one is above the other at most (fraction of the lower height)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class OverlayConfig(ShortRepr):
    """When a front lies on a panel, which is then no front itself.

    Raises:
        ValueError: if a number is not above 0.
    """

    least: float = 0.2
    """Least area of the front (fraction of the panel's) ..."""
    most: float = 0.9
    """... and its greatest: the front of a drawer is as large as what is behind it."""
    spare: float = 0.02
    """How far the front may stand out of the panel's outline, and a handle out of the front's (fraction)."""
    before: float = 0.005
    """How far the front may reach into the panel (fraction of the object's largest side)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class HeldFrontsConfig(ShortRepr):
    """When a body that stands on the floor is the case of fronts at its face, and no front itself.

    Raises:
        ValueError: if a number is not above 0.
    """

    face: float = 0.1
    """How far a front's face lies from that of the body at most (fraction of the body's depth) ..."""
    thin: float = 0.3
    """... and how thick the front is at most (fraction of that depth)."""
    spare: float = 0.01
    """How far a front may stand out of the body's outline (fraction of the object's largest side)."""
    least: float = 0.25
    """What the fronts cover at least, two or more side by side (fraction of the body's outline)."""
    shared: float = 0.1
    """What two such fronts share at most (fraction of the smaller one's outline)."""
    floor: float = 0.02
    """How high above the lowest point such a body ends at most (fraction of the object's largest side)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class HeldPlateConfig(ShortRepr):
    """When an unlabelled plate that a handle sits on is a door or drawer.

    Raises:
        ValueError: if a number is not above 0.
    """

    handle: float = 0.8
    """Least probability of the handle."""
    possible: float = 0.05
    """Least probability of a door or drawer."""
    thin: float = 0.35
    """Greatest thickness of the plate (fraction of its shorter other side)."""
    face: float = 0.2
    """How far the plate lies behind a face of the whole at most, handles counted in (fraction of its depth)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class FactConfig(ShortRepr):
    """From which probability on something is stated of the whole piece.

    Raises:
        ValueError: if a number is not above 0.
    """

    rides: float = 0.95
    """A part moves as one with a door or drawer ..."""
    ajar: float = 0.8
    """... a door or drawer is drawn open ..."""
    piece: float = 0.8
    """... and the piece is of a kind."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class RegularConfig(ShortRepr):
    """When a row of shelves is regular, so that one is missing where a gap is a multiple of the others.

    Lengths are fractions of the object's largest side. Of 200 synthetic pieces (seed 990001) none that is whole gets a
    shelf by it, while of those that lack half of their shelves 9 of 10 that it states were missing.

    Raises:
        ValueError: if a number is not above 0.
    """

    aligned: float = 0.03
    """How far the outlines of shelves of one row are apart at most."""
    slack: float = 0.01
    """How far the board above or below a row may reach into it."""
    least: float = 0.04
    """Smallest clear height between two shelves: less holds nothing."""
    most: int = 2
    """Shelves that one gap may lack: a higher one is meant so."""
    several: float = 0.05
    """How far a gap may be from a multiple of the pitch where three shelves or more are left (fraction of it) ..."""
    pair: float = 0.02
    """... and where two are: two gaps of one to two are often meant so."""
    thin: float = 0.3
    """How thick a shelf is at most (fraction of its shorter level side)."""
    flat: float = 0.5
    """The same of what closes a row above or below: a drawer is none ..."""
    covers: float = 0.4
    """... and the least part of a shelf's plan that it covers (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class DecodeConfig:
    """How scores become a graph. Lengths are fractions of the object's largest side, probabilities in 0..1.

    Raises:
        ValueError: if a number is negative, or a probability above 1.
    """

    fires: float = 0.5
    """A free slot adds a part from this probability of existence on (the authors' threshold)."""

    addable: float = 0.5
    """... and where the labels that may be added have at least this probability together."""

    rounds: int = 8
    """How often free slots are asked again, and once more for every four doors and drawers."""

    overlap: float = 0.3
    """A new part that shares this much of the union with a part of its own label is that part again."""

    reach: float = 0.15
    """A mount or parent farther away is not asked where nearer ones are: no hinge bridges that."""

    grasp: float = 0.08
    """A door or drawer farther than this from a handle is not its: a bar stands off by the length of its posts."""
    at_side: float = 0.25
    """What lies behind a door is inside the body where the middle of the door is at least this far from that of all
    supports, along its thin axis (fraction of their size along it); leaves of buildings have two faces."""

    least_edge: float = 0.02
    """Below this probability of every hinge (or rail), nothing that the network sees carries a part: it moves as a
    rule finds, or is refused with the reason."""

    sure: float = 0.5
    """Below this probability of every hinge the rule decides how a door hangs: with sides missing from real cabinets
    the network was right about 2 of 22 such doors, the rule about all. On whole furniture it is above 0.9."""

    unseen: float = 0.2
    """An added handle hangs no door on a border less likely before than this (fraction of the likeliest)."""

    slides: float = 0.5
    """A door slides in its own plane from this probability of a slide on, if that of a hinge is lower."""
    other_motion: float = 0.5
    """What is neither door, drawer nor handle slides or turns from this probability of such an edge on."""

    nested: float = 0.6
    """A door may hang on another door from this probability of a hinge between them on."""

    second_rail: float = 0.3
    """The rail on a drawer's other flank is taken from this probability on."""

    flank: float = 0.25
    """How far within a drawer's box a carrier may lie and still be on its flank (fraction of the drawer's width)."""

    wide: float = 1.3
    """How much wider than high such a front is at least."""
    columns: ColumnConfig = ColumnConfig()
    """Of doors right above each other."""

    strip: float = 0.02
    """Least second side of a door or drawer without a label (fraction of the object's largest side): the slimmest of
    278 real ones has 0.063, of 1,280 synthetic ones 0.024."""

    button: float = 0.04
    """Least largest side of one (the same fraction): what is smaller is a button or a knob. Of 131 real ones the least
    has 0.19."""

    overlay: OverlayConfig = OverlayConfig()
    """Of fronts that lie on panels."""
    held_fronts: HeldFrontsConfig = HeldFrontsConfig()
    """Of bodies with fronts at their face."""

    held: HeldPlateConfig = HeldPlateConfig()
    """Of plates that handles sit on."""
    regular: RegularConfig = RegularConfig()
    """Of shelves that are missing from regular rows."""
    facts: FactConfig = FactConfig()
    """Of what is stated of the whole piece."""

    edge_for_label: float = 0.2
    """What remains of the probability that an unlabelled part is a door, drawer or handle if no part can carry it."""

    no_parent: float = 0.8
    """A handle is decoration from this probability of no parent on, if no edge states otherwise."""

    misnamed: MisnamedConfig = MisnamedConfig()
    """Of names that the network overrules."""
    some_parent: float = 0.05
    """The chance of being a handle's parent that remains to each door and drawer, where no edge states it."""

    least_half: float = 0.005
    """Half a side of a new part at least (the authors' 0.005 of the object): thinner is an error of the regression."""

    slack: float = 0.01
    """How far boxes are grown before they are compared: thin boards seldom overlap exactly. A handle that is farther
    than this behind a door is not its."""

    mirror: bool = True
    """Whether the last result is the mean of two passes, on the graph and on its mirror image across X. It costs one
    pass; 160 synthetic models (seed 990001) gained 0.018 of hinge F1 with labels and 0.012 without, 0.006 of joints."""

    def __post_init__(self) -> None:
        ratios = (
            self.fires,
            self.addable,
            self.overlap,
            self.least_edge,
            self.second_rail,
            self.edge_for_label,
            self.flank,
            self.some_parent,
            self.at_side,
            self.strip,
            self.button,
            self.other_motion,
            self.unseen,
        )
        if not all(0.0 <= ratio <= 1.0 for ratio in (*ratios, self.sure, self.slides, self.nested, self.no_parent)):
            raise ValueError(f"the probabilities of a DecodeConfig must be in 0..1: got {self}")
        if min(self.rounds, self.reach, self.grasp, self.least_half, self.slack) < 0:
            raise ValueError(f"counts, lengths and powers of a DecodeConfig must not be negative: got {self}")
