"""The thresholds of the decode, each with its reason. It decodes nothing."""

from dataclasses import dataclass
from typing import final

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

    least_edge: float = 0.02
    """Below this probability of every hinge (or rail), nothing that the network sees carries a part: it moves as a
    rule finds, or is refused with the reason."""

    sure: float = 0.5
    """Below this probability of every hinge the rule decides how a door hangs: with sides missing from real cabinets
    the network was right about 2 of 22 such doors, the rule about all. On whole furniture it is above 0.9."""

    second_rail: float = 0.3
    """The rail on a drawer's other flank is taken from this probability on."""

    outward: float = 0.5
    """Power of a rule's score of where the front of a door or drawer is, in the choice of its direction of opening;
    the reported scores stay the network's. 0 leaves it out."""

    edge_for_label: float = 0.2
    """What remains of the probability that an unlabelled part is a door, drawer or handle if no part can carry it."""

    no_parent: float = 0.8
    """A handle is decoration from this probability of no parent on, if no edge states otherwise."""

    mirror: bool = True
    """Whether the last result is the mean of two passes, on the graph and on its mirror image across X. It costs one
    pass, and 160 synthetic models (seed 990001) gained 0.018 of hinge F1 with labels and 0.012 without, 0.006 of
    joints.
    """

    def __post_init__(self) -> None:
        ratios = (self.fires, self.addable, self.overlap, self.least_edge, self.second_rail, self.edge_for_label)
        if not all(0.0 <= ratio <= 1.0 for ratio in (*ratios, self.sure, self.no_parent)):
            raise ValueError(f"the probabilities of a DecodeConfig must be in 0..1: got {self}")
        if min(self.rounds, self.reach, self.grasp, self.outward) < 0:
            raise ValueError(f"`rounds`, `reach`, `grasp` and `outward` must not be negative: got {self}")
