"""Tolerances, sizes and counts of joints.

Lengths are metres on furniture of usual size (see `at_scale`); those marked (extent) are fractions of the object's
largest side, because the measures that they answer to are (docs/metrics.md).
"""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios
from grafu.joints.clearance_config import ClearanceConfig
from grafu.joints.fold_config import FoldConfig
from grafu.joints.hinge_config import HingeConfig
from grafu.joints.lever_config import LeverConfig
from grafu.joints.plan import PlanConfig
from grafu.joints.rail_config import ClosingConfig, DrawerConfig, RailConfig
from grafu.joints.stay_config import StayConfig
from grafu.joints.wide_door_config import WideDoorConfig
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class LiftConfig:
    """What counts as a lifting column in its sleeve; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("off_floor", "gap", "tube")
    slim: float = 0.4
    """Largest level side of a column (fraction of its height)."""
    tall: float = 0.3
    """Least height of a column (fraction of the whole): what is shorter is a screw through the boards of a seat."""
    off_floor: float = 0.02
    """How high above the floor a column ends at least (metres): its sleeve stands on the floor."""
    engaged: float = 0.4
    """Fraction of a column's height along which its sleeve's walls stand at least."""
    out: float = 0.05
    """Fraction of its height by which a column stands out of its sleeve at least."""
    faces: float = 0.5
    """Fraction of a column's side before which a wall of its sleeve stands at least."""
    gap: float = 0.012
    """How far a wall of the sleeve stands off the column, or reaches into it, at most (metres)."""
    tube: float = 0.025
    """How far a tube reaches beyond the column in it at most, gap and wall together (metres)."""
    travel: float = 0.85
    """How far a column comes out (fraction of what of it stands in its sleeve)."""
    covers: float = 0.4
    """Fraction of the plan that a part on lifting columns covers at least: a desk's top."""

    def __post_init__(self) -> None:
        require_positive(self, "off_floor", "gap", "tube")
        require_ratios(self, "slim", "tall", "engaged", "out", "faces", "travel", "covers")


@final
@dataclass(frozen=True)
class SmallPartConfig:
    """What counts as a knob, a button, a wheel or a caster; lengths are metres on furniture of usual size.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("knob", "wheel", "touching", "room", "press", "off_floor")
    knob: tuple[float, float] = (0.01, 0.09)
    """Smallest and largest side of a knob or a button (metres) ..."""
    of_piece: tuple[float, float] = (0.1, 0.2)
    """... and that of a knob, and of what is called a button, over the object's largest side, where that is more."""
    wheel: tuple[float, float] = (0.02, 0.25)
    """Smallest and largest diameter of a wheel (metres)."""
    round: float = 0.88
    """Least area of a circular outline (fraction of the circle around it): a ten-cornered one has 0.94."""
    stout: float = 0.25
    """Least ratio of a knob's length and diameter, either way round: a flat disc and a rod are no knobs."""
    middle: float = 0.5
    """Fraction of a knob's width within which it must be held at one end, and nothing may be before the other."""
    pointer: float = 1.5
    """How far a mark or a pointer may reach from the axis of a knob (in radii of its widest round piece)."""
    parallel: float = 0.999
    """Least cosine of the angle between the axes of two pieces of one knob."""
    touching: float = 0.002
    """Pieces nearer than this touch; what a knob stands on is so near to its end, or passes through it (metres)."""
    room: float = 0.05
    """Before a knob nothing stands as near as this (metres): fingers must get there."""
    press: float = 0.003
    """How far a button is pressed (metres)."""
    sunk: float = 0.6
    """Most of a knob that is pressed flat where it is sunk into what it stands on (fraction of its length)."""
    off_floor: float = 0.01
    """How high above the lowest point a wheel may end (metres)."""
    fork: float = 2.5
    """Largest side of what holds a wheel, and how far it may lie from it (in diameters of the wheel)."""
    beside: float = 0.15
    """How far beside a wheel the cheeks of its fork stand at most (in diameters of the wheel)."""
    stem: float = 0.1
    """The axis of a caster goes through the middle of the upper end of its fork (fraction of its height)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "round", "stout", "middle", "parallel", "sunk", "stem")


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
class BlockConfig:
    """When a support block rests on a surface, and how it holds there.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("lap", "near")
    face: float = 0.9
    """Fraction of the block's face over which rays are spread."""
    rays: int = 3
    """How many of them must meet the surface."""
    rest: float = 0.1
    """The block ends where this fraction of the rays that meet it have done so: not all of its face need rest on it."""
    lap: float = 2e-4
    """How deep a block is inset at both ends, so that it holds (metres)."""
    near: float = 0.1
    """Static parts farther from a piece of hardware than this do not carry it (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "face", "rest")


@final
@dataclass(frozen=True)
class RealizationConfig(ShortRepr):
    """What realization may do, and how exact it is.

    Raises:
        ValueError: if a number is not above 0, a fraction not between 0 and 1, or there are fewer than two poses.
    """

    LENGTHS = (
        *("contact", "flush", "anchor", "bridge", "hinge_bridge", "chosen_reach"),
        *("max_hidden_trim", "max_back_trim", "thinnest_front"),
    )
    depth: float = 0.0004
    """Penetration that counts as a touch (extent, as the paper measures it): 0.4 mm on one metre; official: 0.5."""
    contact: float = 0.012
    """Widest seam across which two faces count as contacting (metres); official: 10 mm."""
    flush: float = 0.002
    """Largest step between two faces that count as flush (metres); official: 4 mm."""
    anchor: float = 0.001
    """Farthest that hardware may be from what it is mounted on before a support block bridges the gap (metres)."""
    bridge: float = 0.6
    """Longest support block of a rail (metres)."""
    hinge_bridge: float = 0.15
    """Longest support block of a hinge (metres): beyond that a door rather moves without hardware."""
    chosen_reach: float = 0.1
    """Longest block that bridges the gap to a chosen mount: what stands farther off does not carry it (metres)."""
    door_opening: float = radians(110)
    """How far a door may open at most; real butt hinges stop the leaf at about 110 degrees."""
    lid_opening: float = radians(95)
    """How far a level lid may open at most: past upright, so that it stays open."""
    level_axis: float = 0.5
    """Largest vertical part of an axis's direction at which it counts as level."""
    upright: float = 0.7
    """Least vertical part of a leaf's direction, from its axis to its far side, at which it is a flap, and no lid."""
    sloping: float = 0.2
    """Thickness of a board that may slope as it is closed, such as the front of a desk, over its size (fraction)."""
    rising: float = 0.3
    """Least vertical part of a sloping board's direction, upwards from its axis, at which it is a front and no lid."""
    short: float = 0.01
    """How far short of a collision a limit stays (fraction of the opening that was asked for)."""
    restricted: float = 0.7
    """An opening below this fraction of the reference is reported as restricted."""
    waits: float = 0.5
    """A joint that opens less beside an open neighbour still waits for it where that is this fraction of the reference
    at least, and before the closed one it opens by no more than this fraction of that."""
    trim: bool = True
    """Whether material may be taken away to give clearance."""
    max_trim: float = 0.02
    """Largest fraction of a side by which a moving part is made smaller."""
    max_hidden_trim: float = 0.013
    """The same of a piece behind a drawer's front, where that is more (metres): its sides are not seen."""
    max_back_trim: float = 0.005
    """The same of a door's back, which lies on what it closes (metres)."""
    no_hardware_width: float = 0.25
    """What slides without rails is at least this wide over its depth: a drawer, and no side of one."""
    no_hardware_wide: float = 0.97
    """What is as wide as this over the furniture is no drawer between its sides, where only a guess states one."""
    thinnest_front: float = 0.003
    """What ends so far behind a drawer's front is hidden by it (metres)."""
    max_carve: float = 0.05
    """Largest fraction of a static part's volume or surface that is carved."""
    max_carve_last: float = 0.1
    """The same where nothing else frees a path."""
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
    """Tolerance of the drawer's body region around the median width (the authors: 10 mm), a fraction of the width."""
    least_opening: float = 0.3
    """An opening below this fraction of the wanted one is no motion."""
    carved_faces: int = 400_000
    """A static part of more faces is not carved: every attempt would take hundreds of megabytes."""
    no_hardware_gap: float = 0.005
    """Widest gap (extent) to static parts at which a door or drawer moves without hardware: wider ones come loose."""
    no_hardware_open: float = 0.4
    """What of a drawer without a handle of its own shows a floor below its middle from above: a case does not ..."""
    no_hardware_box_gap: float = 0.02
    """... and the widest gap (extent) to what such a box runs between without hardware."""
    rack_gap: float = 0.05
    """How far a rack, whose wheels and guides are seldom drawn, stands off what carries it at most (extent); so far a
    toilet's seat and lid come from what their pin is on."""
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
    lift: LiftConfig = LiftConfig()
    """Of lifting columns."""
    fold: FoldConfig = FoldConfig()
    """Of doors that fold."""
    stay: StayConfig = StayConfig()
    """Of stays on lids and flaps."""
    wide_doors: WideDoorConfig = WideDoorConfig()
    """Of doors that open wider for what is behind them."""
    small: SmallPartConfig = SmallPartConfig()
    """Of knobs, buttons, wheels and casters."""
    lever: LeverConfig = LeverConfig()
    """Of levers of doors."""
    block: BlockConfig = BlockConfig()
    """Of support blocks."""
    clearance: ClearanceConfig = ClearanceConfig()
    """Of the play of what is trimmed and carved."""
    closing: ClosingConfig = ClosingConfig()
    """Of drawers that are drawn open."""
    time: TimeConfig = TimeConfig()
    """Of the time that steps may take."""

    def __post_init__(self) -> None:
        require_positive(
            self, "depth", "contact", "flush", "anchor", "bridge", "chosen_reach", "door_opening", "body_tolerance"
        )
        require_positive(self, "hinge_bridge", "lid_opening", "no_hardware_gap", "rack_gap", "carved_faces")
        require_positive(self, "no_hardware_box_gap")
        require_not_negative(self, "max_hidden_trim", "max_back_trim", "thinnest_front")
        require_ratios(self, "level_axis", "upright", "sloping", "rising", "short", "restricted", "waits", "max_trim")
        require_ratios(self, "max_carve", "max_carve_last", "max_carve_hidden")
        require_ratios(self, "max_carve_seen", "rail_ratio", "least_opening", "kept")
        require_ratios(self, "no_hardware_width", "no_hardware_wide", "no_hardware_open")
        if min(self.coarse_poses, self.fine_poses) < 2:
            raise ValueError(f"poses must be at least 2: got {self.coarse_poses} and {self.fine_poses}")
