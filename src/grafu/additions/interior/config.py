"""What an interior is made of, and how small a compartment may be.

Lengths are metres on furniture of usual size; a model in another scale gets panels in its own (`grafu.scene.scene`).
"""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios
from grafu.joints.config import RealizationConfig
from grafu.scene.scale import metre_on
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class RoomConfig:
    """What makes free space a compartment: walls, openings, doors and drawers around it.

    Raises:
        ValueError: if a number is not above 0, or a fraction is not between 0 and 1.
    """

    thin: float = 0.15
    """Fraction of its next longer side below which a part is thin: a board, a frame, a door leaf."""
    frame: float = 0.35
    """Fraction of its outline that a frame covers at least to count as a wall."""
    wall_cells: int = 10
    """Cells beyond a side within which its wall must be: brackets stand before it, or it runs askew."""
    walled: float = 0.4
    """Fraction of a side that cells of walls take at least: less than `wall_ratio` of rays, since cells see less."""
    taken: float = 0.5
    """Fraction of a face that is open to a room that was taken, from which on a space is no room of its own."""
    closed_cells: float = 0.65
    """Fraction of a face that cells of walls take at least for it to be no opening."""
    closed: float = 0.6
    """Fraction of a face that rays find walls on at least for it to be no opening."""
    door: float = 0.3
    """Fraction of an opening that moving bodies cover at least where floor or ceiling is missing."""
    drawer: float = 0.5
    """Fraction of a face that one drawer takes at least to close it."""
    drawer_cells: float = 3.0
    """Cells between a box of free cells and such a drawer: what a drawer takes is counted in whole cells."""
    wall_part: float = 0.1
    """Fraction of the hits on a face that makes a part one of its walls."""
    before: float = 0.05
    """Fraction of a compartment's sides by which a moving body overlaps them at least to be in its opening."""
    arm: float = 0.8
    """Fraction of the face between two compartments that is free at least for them to be arms of one."""
    arm_cells: int = 16
    """Cells between two such compartments at most: a post in the corner draws one back."""
    most: int = 60
    """Most compartments of one object; a pigeonhole desk has fewer."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(
            self,
            "thin",
            "frame",
            "walled",
            "taken",
            "closed_cells",
            "closed",
            "door",
            "drawer",
            "wall_part",
            "before",
            "arm",
        )


@final
@dataclass(frozen=True)
class CarouselConfig:
    """The sizes of a carousel: round trays with rims on a post.

    Raises:
        ValueError: if a number is not above 0.
    """

    post: float = 0.0125
    """Radius of the post."""
    floor: float = 0.008
    """Thickness of a tray."""
    rim: float = 0.05
    """Height of its rim above its underside, ..."""
    wall: float = 0.006
    """... and how thick that is."""
    lift: float = 0.02
    """From the floor of a compartment to the lowest tray."""
    play: float = 0.001
    """Between the post and what is above and below it."""
    clear: float = 0.008
    """Between a tray and the walls around it."""
    least_radius: float = 0.12
    """Of a tray; smaller ones hold nothing."""
    least_pitch: float = 0.12
    """Smallest distance between two trays: a rim and a cup."""
    tried: tuple[float, ...] = (1.0, 0.94, 0.88, 0.82, 0.76)
    """Fractions of the largest radius that are tried until no door is stopped (ratios)."""

    def __post_init__(self) -> None:
        require_positive(self, *(name for name in self.__dataclass_fields__ if name != "tried"))


@final
@dataclass(frozen=True)
class InteriorConfig(ShortRepr):
    """The sizes of panels, and of compartments worth furnishing.

    Raises:
        ValueError: if a length is not positive, or a fraction is not in 0..1.
    """

    thickness: float = 0.018
    """Of shelves and dividers; the commonest board, and the authors'."""
    inset: float = 0.02
    """From the front of the compartment (the inner face of its doors): room for what doors carry inside."""
    deepest_inset: float = 0.4
    """Fraction of a compartment's depth up to which a panel is set back to clear a door's swing or a hinge."""
    least_side: float = 0.1
    """Smallest width, height and depth of a compartment worth furnishing; smaller holds nothing that needs a shelf."""
    least_pitch: float = 0.09
    """Smallest clear distance between two panels: a flat hand and a stack of plates."""
    shelf_pitch: float = 0.34
    """Clear height that `auto` aims at between shelves; real ones stand 0.25 to 0.4 apart."""
    divider_pitch: float = 0.55
    """Clear width that `auto` aims at between dividers in low, wide compartments ..."""
    doors_pitch: float = 1.5
    """... and so many times as much behind doors, which are dividers enough for most (ratio)."""
    low: float = 2.5
    """A compartment that is at least so many times as wide as high is low and wide (ratio)."""
    slim: float = 1.5
    """`auto` leaves a compartment empty that is narrower than this, over `least_side` (ratio)."""
    hanging_height: float = 1.05
    """Free height that shirts on hangers need; wardrobes keep it."""
    most_panels: int = 8
    """Most panels that `auto` puts into one compartment."""
    touch: float = 0.0015
    """Farthest that a wall may lie from a panel's edge and still carry it."""
    carried: float = 0.35
    """Fraction of each half of a panel's end that must touch the wall: pins at front and back hold a shelf."""
    wall_ratio: float = 0.5
    """Fraction of a compartment's side that must be wall (rails and posts of open frames are less)."""
    cells: int = 110
    """Cells along the object's longest side in which compartments are looked for."""
    hanging_depth: float = 0.42
    """Least depth and width of a compartment for clothes: hangers are 0.42 to 0.45 wide."""
    hat: float = 0.3
    """Least height that a shelf above hanging clothes leaves above itself."""
    alike: float = 0.7
    """Fraction of the smaller side by which two compartments of one column overlap: things in one make it narrower."""
    between: float = 3.5
    """Panel thicknesses that may lie between two compartments of one column."""
    hint_reach: float = 0.5
    """Fraction of a compartment's least side: a hint that is farther away means another compartment."""
    insets: int = 5
    """Depths at which a panel is tried."""
    nudges: tuple[float, ...] = (0.0, 0.12, -0.12, 0.25, -0.25)
    """Places at which a panel is tried, as fractions of the space to the next one: out of the way of a hinge."""
    back_ratio: float = 0.3
    """Fraction of the rays towards the back that make it a wall."""
    askew_cells: float = 12.0
    """Cells beyond a compartment's side up to which a panel's end follows a wall that runs askew."""
    wider: float = 0.05
    """Fraction by which a room is larger at a panel's level than its box before the panel takes the room's outline."""
    slit: float = 0.012
    """Width of slits and tongues that an outline leaves out: gaps around doors, a groove."""
    rests: float = 0.35
    """Fraction of such an outline that lies at walls at least."""
    poses: int = 41
    """Poses from closed to wide open in which a panel must be clear of what moves."""
    depth: float = RealizationConfig().depth
    """How deep a panel may touch something, as a fraction of the object's largest side: as in the sweeps of joints."""
    carousel: CarouselConfig = CarouselConfig()
    """The sizes of carousels."""
    rooms: RoomConfig = RoomConfig()
    """What makes free space a compartment."""

    def __post_init__(self) -> None:
        lengths = ("thickness", "least_side", "least_pitch", "shelf_pitch", "divider_pitch", "hanging_height", "touch")
        require_positive(self, *lengths, "most_panels", "cells", "hanging_depth", "hat", "between", "hint_reach")
        require_positive(self, "doors_pitch", "low", "slim", "insets", "askew_cells", "poses", "depth", "slit", "wider")
        require_ratios(self, "alike", "back_ratio", "rests")
        require_not_negative(self, "inset")
        for name in ("deepest_inset", "carried", "wall_ratio"):
            if not 0 <= getattr(self, name) <= 1:
                raise ValueError(f"`InteriorConfig.{name}` must be in 0..1: got {getattr(self, name)}")

    def sizes(self, extent: float) -> "Sizes":
        """Returns the lengths for an object whose largest side is `extent` metres."""
        metre = metre_on(extent)
        return Sizes(
            thickness=metre * self.thickness,
            inset=metre * self.inset,
            least_side=metre * self.least_side,
            least_pitch=metre * self.least_pitch,
            shelf_pitch=metre * self.shelf_pitch,
            divider_pitch=metre * self.divider_pitch,
            hanging_height=metre * self.hanging_height,
            hanging_depth=metre * self.hanging_depth,
            hat=metre * self.hat,
            touch=metre * self.touch,
            cell=extent / self.cells,
        )


@final
@dataclass(frozen=True, slots=True)
class Sizes:
    """The lengths of `InteriorConfig` in metres for one object; `cell` is the side of a cell."""

    thickness: float
    inset: float
    least_side: float
    least_pitch: float
    shelf_pitch: float
    divider_pitch: float
    hanging_height: float
    hanging_depth: float
    hat: float
    touch: float
    cell: float
