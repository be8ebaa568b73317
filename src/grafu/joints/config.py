"""Tolerances, sizes and counts of joints. Lengths marked (extent) are fractions of the object's largest side."""

from dataclasses import dataclass
from math import radians
from typing import final

from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios


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

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class TimeConfig:
    """Which fraction of the time that is left each step of realization may take.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    expecting: float = 0.15
    """For what joints that are not built yet are expected to do (fraction)."""
    building: float = 0.8
    """For building all joints, and once more where that is needed (fraction)."""
    hard_joint: float = 8.0
    """How many times an even part of the time a hard joint may take (ratio)."""
    most_of_joint: float = 0.5
    """Most that one joint of several may take (fraction)."""
    least_of_joint: float = 0.05
    """Least that a joint may take: of very many joints some are built, rather than none (fraction)."""
    ordering: float = 0.5
    """For the order in which joints open; the rest is for measuring them (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "hard_joint")
        require_ratios(self, "expecting", "building", "most_of_joint", "least_of_joint", "ordering")

    def of_joint(self, left: int) -> float:
        """Returns the fraction of the time left that the first of `left` joints may take."""
        return 1.0 if left <= 1 else min(self.most_of_joint, max(self.least_of_joint, self.hard_joint / left))


@final
@dataclass(frozen=True)
class DrawerConfig:
    """What counts as a drawer, as a front without a container, and as a sliding door.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    shallow: float = 0.15
    """What is less deep than this fraction of its smaller side is a front without a container."""
    thickest_board: float = 0.03
    """What is less deep than this is a board, however low it is (metres)."""
    slat: float = 0.1
    """Depth of such a board, at most this fraction of its longer side: low fronts are thick for their height."""
    shortest: float = 0.3
    """A body shorter than this fraction of the drawer's depth is no container (official 7.4)."""
    flat: float = 0.2
    """A sliding door is thinner than this fraction of its smaller side, and slides nearly along its plane."""
    stands_out: float = 1e-3
    """How far an attached part may stand out and still count as behind a drawer's front side (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, "thickest_board", "stands_out")
        require_ratios(self, "shallow", "slat", "shortest", "flat")


@final
@dataclass(frozen=True)
class RailConfig:
    """Sizes of rails and of the dividers that carry them.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    thinnest: float = 0.0025
    """Thickness below which rails are inset into the flank and the wall by what is missing (metres)."""
    lowest: float = 0.004
    """Least height of a rail, where the flank is as high (metres)."""
    common: float = 0.0127
    """Thickness of most ball-bearing slides (metres)."""
    dynamic_reach: float = 0.86
    """Fraction of a rail's thickness that its moving member takes, from the drawer's side."""
    most_inset: float = 0.5
    """Fraction of a rail's thickness that is inset at most: deeper, its static member would cut into the drawer."""
    divider: float = 0.016
    """Thickness of a divider where there is room for it (metres)."""
    thinnest_divider: float = 0.003
    """Thickness below which a divider carries nothing (metres)."""
    divider_air: float = 0.001
    """Distance between a divider and what stands behind it (metres)."""
    deeper: float = 3.0
    """A shallow drawer before a space so many times as deep is a front with its pull, not a container (ratio)."""
    travel: float = 0.77
    """Fraction of the depth that a drawer travels: what rails over 0.9 of a body travel with a lap of 15 %."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "dynamic_reach", "most_inset", "travel")


@final
@dataclass(frozen=True)
class HingeConfig:
    """Sizes of hinges that are not templates, and what is tried where usual ones do not fit.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    slim: float = 0.5
    """Barrel radius of a slim hinge, a fraction of what suits the door."""
    looser: float = 4.0
    """Seams and steps for a class that is forced, over the usual ones (ratio): support blocks bridge what remains."""
    disc_inset: float = 0.0015
    """How deep a pivot's disc is inset into its own part (metres)."""
    plate: float = 0.002
    """Thickness of a plate beside a door's end (metres)."""
    plate_play: float = 0.001
    """Distance between the door's end and the plate (metres)."""
    plate_reach: float = 0.025
    """How far the plate reaches behind the door's back, and how far inwards the case may stand there (metres)."""
    two_up_to: float = 0.9
    """Longest door that hangs on two hinges (metres): cabinet makers put 2 up to 0.9 m, 3 up to 1.5, 4 up to 2.1."""
    one_more_per: float = 0.6
    """Length beyond that for each further hinge (metres)."""
    length_ratio: float = 0.12
    """Longest hinge, a fraction of its door's length along the axis (official 7.3)."""
    radius_ratio: float = 0.22
    """Largest barrel radius, a fraction of the door's thickness."""
    radius: float = 0.0036
    """Barrel radius of a common 60 mm butt hinge (metres): none is larger."""
    smallest: float = 0.001
    """Smallest barrel radius (metres)."""
    tongue: float = 0.02
    """How deep the tongue of an inset leaf reaches into what stands behind the door (metres)."""
    lap: float = 0.002
    """How far the tongue overlaps the leaf that it extends (metres)."""
    inside: float = 0.1
    """An axis nearer to a side than this fraction of the part runs along its border."""
    chunky: float = 0.45
    """A part thicker than this fraction of its width is no door panel."""
    drawn_reach: float = 0.06
    """How far from the door's border the barrel of a drawn hinge lies at most (metres on furniture of usual size)."""
    drawn_line: float = 0.0015
    """Barrels nearer to one line than this turn about one pin (metres on furniture of usual size)."""
    drawn_spread: float = 0.3
    """Fraction of the border's length over which the barrels that carry a door are spread at least."""
    thinnest_drawn: float = 0.0015
    """Smallest radius of the barrel of a drawn hinge (metres on furniture of usual size)."""
    thickest_drawn: float = 0.02
    """Largest radius of the barrel of a drawn hinge (metres on furniture of usual size)."""
    nearly: float = 0.05
    """A pin that leaves this fraction of the wanted opening blocked is still as good as free."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "slim", "length_ratio", "radius_ratio", "inside", "chunky", "nearly")


@final
@dataclass(frozen=True)
class RealizationConfig:
    """What realization may do, and how exact it is.

    Raises:
        ValueError: if a number is not above 0, a fraction not between 0 and 1, or there are fewer than two poses.
    """

    depth: float = 0.0004
    """Penetration that counts as a touch (extent): 0.4 mm on one metre; the official swing test warns at 0.5."""
    contact: float = 0.012
    """Widest seam across which two faces count as contacting (extent); official: 10 mm."""
    flush: float = 0.006
    """Largest step between two faces that count as flush (extent); official: 4 mm."""
    anchor: float = 0.001
    """Farthest that hardware may be from what it is mounted on before a support block bridges the gap (extent)."""
    bridge: float = 0.6
    """Longest support block (extent)."""
    chosen_reach: float = 0.1
    """Longest block (extent) that bridges the gap to a chosen mount: what stands farther off does not carry it."""
    door_opening: float = radians(110)
    """How far a door may open at most; real butt hinges stop the leaf at about 110 degrees."""
    restricted: float = 0.7
    """An opening below this fraction of the reference is reported as restricted (design, section 5)."""
    trim: bool = True
    """Whether material may be taken away to give clearance."""
    max_trim: float = 0.02
    """Largest fraction of a side by which a moving part is made smaller (design, section 5)."""
    max_hidden_trim: float = 0.013
    """By how much a piece behind a drawer's front is made smaller at most, where that is more (metres on furniture of
    usual size): its sides are not seen, and runners take as much."""
    max_back_trim: float = 0.005
    """By how much a door's back, which lies on what it closes, is pressed at most, where that is more (metres on
    furniture of usual size)."""
    no_hardware_width: float = 0.25
    """What slides without rails is at least this wide over its depth: a drawer, and no side of one."""
    thinnest_front: float = 0.003
    """What ends so far behind a drawer's front is hidden by it (metres on furniture of usual size)."""
    max_carve: float = 0.05
    """Largest fraction of a static part's volume or surface that is carved (design, section 5)."""
    max_carve_hidden: float = 0.6
    """The same of a part of which at most `max_carve_seen` of its surface goes that is seen from outside, while all is
    closed; and of a drawn rail, bearing or hinge, told by its name."""
    max_carve_seen: float = 0.005
    """Largest fraction of a part's surface that counts as hardly seen."""
    coarse_poses: int = 19
    """Poses in which candidates are compared."""
    fine_poses: int = 61
    """Poses in which the chosen motion is checked: more than the 50 of the paper's metric, and others than those."""
    rail_ratio: float = 0.9
    """Length of a rail over the drawer's body (supplement: 1 - beta, beta = 0.1)."""
    body_tolerance: float = 0.01
    """Tolerance of the drawer's body region around the median width (official 7.4: 10 mm), a fraction of the width."""
    least_opening: float = 0.3
    """An opening below this fraction of the wanted one is no motion."""
    carved_faces: int = 400_000
    """A static part of more faces is not carved: every attempt would take hundreds of megabytes."""
    no_hardware_gap: float = 0.005
    """Widest gap (extent) to static parts at which a door or drawer moves without hardware: wider ones come loose."""
    kept: float = 0.4
    """Fraction of its own thickness that a trimmed piece keeps at least."""
    rail: RailConfig = RailConfig()
    """Of drawers' rails."""
    hinge: HingeConfig = HingeConfig()
    """Of doors' hinges and pivots."""
    drawer: DrawerConfig = DrawerConfig()
    """Of what counts as a drawer."""
    plan: PlanConfig = PlanConfig()
    """Of requests."""
    time: TimeConfig = TimeConfig()
    """Of the time that steps may take."""

    def __post_init__(self) -> None:
        require_positive(
            self, "depth", "contact", "flush", "anchor", "bridge", "chosen_reach", "door_opening", "body_tolerance"
        )
        require_positive(self, "no_hardware_gap", "carved_faces")
        require_not_negative(self, "max_hidden_trim", "max_back_trim", "thinnest_front")
        require_ratios(
            self,
            "restricted",
            "max_trim",
            "max_carve",
            "max_carve_hidden",
            "max_carve_seen",
            "rail_ratio",
            "least_opening",
            "kept",
        )
        require_ratios(self, "no_hardware_width")
        if min(self.coarse_poses, self.fine_poses) < 2:
            raise ValueError(f"poses must be at least 2: got {self.coarse_poses} and {self.fine_poses}")
