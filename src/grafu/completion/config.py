"""The thresholds of the rule-based baseline, each with its reason. It decides nothing."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True, slots=True)
class GuessConfig(ShortRepr):
    """What the rule takes for a door, a drawer or a handle where a part has no label.

    Lengths are fractions of the object's largest side, because graphs come in any unit; other numbers are ratios of
    sides, and the fractions of one box that another covers.

    Raises:
        ValueError: if a number is not above 0.
    """

    with_handle: float = 0.8
    """Confidence of a front that has a handle."""
    without_handle: float = 0.5
    """Confidence of one that has none."""
    plate: float = 0.07
    """Thickest door (length)."""
    least_side: float = 0.1
    """Narrowest front (length)."""
    plate_ratio: float = 2.5
    """A door's shorter side is at least so many times its thickness."""
    least_depth: float = 0.12
    """Shallowest drawer (length)."""
    heights: tuple[float, float] = (0.03, 0.55)
    """Lowest and highest drawer (length)."""
    skin: float = 0.1
    """How far behind the outermost face a front may lie (length)."""
    handle: float = 0.08
    """Second largest side of a handle at most (length) ..."""
    longest_handle: float = 0.6
    """... and its largest side (length)."""
    touch: float = 0.01
    """How far off something still touches (length)."""
    slab: float = 0.08
    """A lower box without a handle may be a thick panel (length)."""
    centred: tuple[float, float] = (0.15, 0.3)
    """How far from the middle of a drawer's front its handle lies at most, sideways and upwards (of half the side)."""
    wide: float = 1.2
    """Such a plate is at least so many times as wide as high."""
    inside: float = 0.95
    """Fraction of a part's extents that lies in the outline of what holds or carries it."""
    held: tuple[float, float] = (0.05, 0.9)
    """Volume of a part that a case holds, over its own."""
    case: tuple[float, float] = (0.85, 0.6)
    """Footprint of a case, over the object's, and its height, over the object's."""
    in_frame: tuple[float, float] = (0.99, 0.97)
    """Of a plate in a face frame: the fraction of its sides in the frame's outline, and its sides over the frame's."""
    flanked: float = 0.5
    """Fraction of a box's height and depth along which something stands beside its flank."""
    handle_widths: tuple[float, float] = (0.9, 0.6)
    """Sides of a handle over its front's at most: on the front, and elsewhere, where posts and battens are commoner."""
    door_ratios: tuple[float, float] = (4.0, 12.0)
    """A door without a handle is at most so many times as wide as high, and as high as wide."""
    covered: float = 0.3
    """Fraction of a front's outline: where one part before it covers more, it does not open."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class DoorRuleConfig:
    """From where on the baseline's votes on doors count. The weights stand in the functions that vote.

    Raises:
        ValueError: if a number is not above 0.
    """

    reach: float = 0.1
    """Parts farther from a border carry nothing there (fraction of the object's largest side)."""
    near: float = 0.02
    """Distance at which a carrier's nearness has fallen to 1 / e (fraction of the object's largest side)."""
    clear: float = 0.3
    """From here on a handle's offset is meant (fraction of the door's half side)."""
    slight: float = 0.12
    """Below this a handle sits in the middle (fraction of the door's half side)."""
    edge: float = 0.5
    """Beyond this a handle sits at the upper or lower edge (fraction of the door's half height)."""
    upright: float = 0.7
    """Width over height below which a door with its handle at such an edge is no flap."""
    wide: float = 1.3
    """Width over height from which on a door with its handle above or below the middle is a flap."""
    plain: float = 1.5
    """Width over height from which on it can be nothing else."""
    wide_in_row: float = 1.8
    """The same as `wide` for doors of a row, which often have their handles there."""
    very_wide: float = 2.2
    """Width over height from which on a door without a handle is a flap."""
    stands_out: float = 0.1
    """A handle that stands out farther on one side, by this fraction of its own depth, shows where the front is."""
    nearer_end: float = 0.1
    """A door nearer to one end of the body, by this fraction of its width, hangs there."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class DrawerRuleConfig:
    """How near a part must be to carry a drawer's rail. Lengths are fractions of the object's largest side.

    Raises:
        ValueError: if a number is not above 0.
    """

    reach: float = 0.15
    """Parts farther from a flank carry no rail."""
    near: float = 0.03
    """Distance at which a carrier's nearness has fallen to 1 / e."""
    least_flank: float = 0.05
    """Fraction of a drawer's flank beside which a carrier stands at least, and its least score."""
    inside: float = 0.05
    """Depth in the body at which a face's vote for being the front has fallen to 1 / e."""
    face: float = 0.8
    """Fraction of the drawer's half side: a part between that and its face blocks it by half."""
    behind_front: float = 0.25
    """Fraction of the drawer's width by which a carrier may lie within it: overlaid fronts are wider than the box."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class RowConfig:
    """Which doors stand in one row, and which slide past each other.

    Raises:
        ValueError: if a number is not above 0.
    """

    shared_height: float = 0.8
    """Height that two doors of a row share at least (fraction of each height)."""
    seam: float = 0.25
    """Widest seam between them (fraction of the narrower width)."""
    in_line: float = 0.02
    """How far apart their planes are, where that is more than the thickness (fraction of a door's largest side)."""
    panel_height: float = 0.6
    """Height along which a panel behind their seam stands at least (fraction of the door's height) ..."""
    panel_width: float = 0.3
    """... and its width at most (fraction of the door's width) ..."""
    panel_near: float = 0.1
    """... and how far from the seam its middle lies at most (fraction of the mean width)."""
    lap_height: float = 0.9
    """Height that doors share at least that slide past each other (fraction of each height)."""
    lap: tuple[float, float] = (0.02, 0.6)
    """How far they lap, at least and at most (fraction of the narrower width)."""
    planes: tuple[float, float] = (0.6, 3.0)
    """Distance of their planes: at least over the smaller thickness, at most over the larger."""
    in_two_planes: float = 1.2
    """Distance over the thickness from which on doors that merely meet slide, and are no pair that swings, ..."""
    shared_depth: float = 0.5
    """... if the depths of the two share at most this (fraction of the smaller thickness): the box of a door that is
    drawn ajar is deep, and its middle is far from the plane of a closed door, which lies within that depth."""
    sheet: float = 1e-3
    """What is thinner is drawn without thickness (fraction of its largest side) ..."""
    thick: float = 0.01
    """... and counts as thick as this (the same fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class MisnamedConfig:
    """When a network's answer overrules what a part is by its name alone.

    Raises:
        ValueError: if a number is not above 0, or above 1.
    """

    front: float = 0.8
    """What is only named a door is a drawer from this probability on, and the other way round. Of 300 synthetic pieces
    it corrects 4 of 5 misnamed fronts, of 250 real ones 20, and no other; the highest that is wrong has 0.69."""
    still: float = 0.85
    """What is only named a part that stays, such as a face frame, is a door or drawer from this probability on if a bar
    touches it that touches no door or drawer. Of 2,000 synthetic pieces it corrects 32 parts, all rightly; of 630 other
    models one, rightly."""
    bar: float = 2.0
    """A handle this many times as long as it is wide is a bar: panels of controls have knobs."""
    bare: float = 0.95
    """Without a bar it is one from this probability on, if it is seen from the front and has no row of knobs. The
    network is as sure of a few hidden boards, and of the panels of ovens ..."""
    seen: float = 0.3
    """... so this much of it must be seen from the front (fraction) ..."""
    knobs: int = 2
    """... and so many of its handles are knobs at most ..."""
    held: float = 0.5
    """... and it holds less of any other door or drawer (fraction of the other's box): supports of slides are around a
    drawer."""
    panel: float = 0.97
    """What is only named a door or drawer is a side, back or bottom panel from this probability on if no handle touches
    it. Of 3,000 synthetic pieces it corrects 34, all rightly, of 614 other models one, rightly."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        if max(self.front, self.still, self.bare, self.seen, self.held, self.panel) > 1.0:
            raise ValueError(f"the probabilities and fractions of a MisnamedConfig must be at most 1: got {self}")


@final
@dataclass(frozen=True, slots=True)
class RuleConfig(ShortRepr):
    """The thresholds of the rule-based baseline."""

    handle_reach: float = 0.05
    """A handle farther from every door and drawer belongs to none (fraction of the object's largest side) ..."""
    handle_apart: float = 0.01
    """... and so does one farther than this that stands beside all of them: none of 212 real handles does."""
    guess: GuessConfig = GuessConfig()
    """Of labels for parts without one."""
    doors: DoorRuleConfig = DoorRuleConfig()
    """Of hinges."""
    rows: RowConfig = RowConfig()
    """Of doors side by side."""
    drawers: DrawerRuleConfig = DrawerRuleConfig()
    """Of rails."""

    def __post_init__(self) -> None:
        require_positive(self, "handle_reach", "handle_apart")
