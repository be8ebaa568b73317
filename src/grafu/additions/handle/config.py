"""Room for fingers, and the sizes and places of handles. Lengths are metres on furniture of a common size."""

from dataclasses import dataclass
from typing import final

from grafu.scene.checks import require_not_negative, require_positive, require_ratios

NO_HANDLE = "none"
"""`HandleChoice.style` of a front that gets nothing."""
ANY_GRIP = "grip"
"""... and of one that gets whichever grip fits."""


@final
@dataclass(frozen=True)
class ReliefConfig:
    """The depth map of a front that grasps are looked for on.

    Raises:
        ValueError: if a length is not above 0, or `plane` is no fraction.
    """

    cell: float = 0.005
    """Least side of a cell: a fingertip covers two, metres."""
    coarse_cell: float = 0.009
    """Greatest side of a cell where a large front has many, metres."""
    margin: float = 0.036
    """Width around the front that is looked at: three fingers' thickness, metres."""
    lead: float = 0.09
    """Distance before the front at which rays start: beyond any grip, metres."""
    foot_lead: float = 0.05
    """Distance before the front at which rays to the place of a handle's foot start, metres."""
    behind: float = 0.1
    """Depth behind the front's plane up to which anything matters to fingers, metres."""
    plane: float = 0.15
    """Fraction of the area that lies no deeper than the front's plane: a grip that stands out covers less."""
    before: float = 0.002
    """Depth behind a front's foremost plane up to which what ends there stands before it, metres."""
    body: float = 0.04
    """Depth behind the plane within which the front's outline is taken, metres."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "plane")


@final
@dataclass(frozen=True)
class FingerRoomConfig:
    """How edges and hollows are looked for on the depth map of a front.

    Raises:
        ValueError: if a length is not above 0.
    """

    level: float = 0.004
    """Distance between the depths at which a finger is tried, metres."""
    edge: float = 0.001
    """Distance before an edge at which it counts as met, metres."""
    tip: float = 0.015
    """Distance that a fingertip behind an edge may lie from the edge's inner face, metres."""
    through: float = 0.06
    """Depth behind the front's plane: what is seen beyond it is seen through a hole, metres."""
    steep: float = 0.014
    """Width within which the wall of a hollow rises, metres."""
    flat: float = 0.003
    """Difference in depth over the floor of a hollow, metres."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class GraspConfig:
    """What counts as room for fingers; see `grafu.scene.scale` for models in another scale.

    Raises:
        ValueError: if a number is not above 0, a fraction is not between 0 and 1, or a confidence is above 1.
    """

    gap: float = 0.012
    """Narrowest gap that fingers enter, and the least room behind what they pull at; a fingertip is 12 to 20 mm."""
    reach: float = 0.02
    """How deep fingers go in behind the face that they pull at, its own thickness counted in."""
    hook: float = 0.006
    """How far fingertips reach behind an edge, sideways, to pull at it: the lips of finger pulls are 6 to 10 mm."""
    length: float = 0.06
    """Width of three fingers: the shortest edge that is pulled at."""
    knob: float = 0.012
    """The smallest thing that stands out and is taken between two fingers: knobs are 13 to 40 mm wide."""
    stub: float = 0.009
    """How far a small thing must stand out at least to be taken between two fingers."""
    lip: float = 0.025
    """The widest lip along a front's border; ledges that are wider are mouldings."""
    hole: float = 0.018
    """The narrowest finger hole."""
    thickest: float = 0.06
    """The thickest edge that fingers reach round."""
    hollow: float = 0.008
    """The shallowest channel along an edge; inside the face, where frames have sunk panels, it is `deep_hollow`."""
    deep_hollow: float = 0.013
    """The shallowest hollow inside a face."""
    widest_hollow: float = 0.05
    """The widest channel or hollow: wider ones are sunk panels."""
    notch: float = 0.004
    """The shallowest notch in a border that was drawn as a grip, though no finger finds room in it."""
    longest_notch: float = 0.16
    """The longest such notch: longer ones are profiles or rebates."""
    pinch: float = 0.045
    """The thickest thing that is taken between thumb and fingers."""
    lever: float = 0.5
    """Fraction of the distance from the hinge to the free edge beyond which a door can be pulled open."""
    small: float = 0.3
    """Fraction of the front's two sides multiplied: an unlabelled part that is larger is no handle."""
    sits: float = 0.006
    """How far a handle that is not attached may be from the front that it sits on, metres."""
    stands_out: float = 0.008
    """Distance before the front's plane from which on something is a grip of its own, metres."""
    long_ratio: float = 0.6
    """Fraction of a front's side: an edge as long as this is long enough, however small the front."""
    local_ratio: float = 0.5
    """Fraction of a front's side: what is longer is a profile, a moulding or a rebate, made for looks."""
    smallest_hole: float = 0.007
    """Width of the smallest hole that was drawn for a finger: screws and shelf pins are no holes, metres."""
    held: float = 0.02
    """Depth behind the front's plane at which fingers hold what is seen through, metres."""
    most_holes: int = 2
    """Most small holes of a front: more are a lattice or louvres."""
    labelled: float = 1.0
    """Confidence of a handle that is labelled as one and attached."""
    unlabelled: float = 0.8
    """Confidence of a small part without a category that sticks out of a front."""
    unattached: float = 0.6
    """Confidence of a handle that sits on a front and is not attached to it."""
    relief: ReliefConfig = ReliefConfig()
    """The depth map that grips are looked for on."""
    fingers: FingerRoomConfig = FingerRoomConfig()
    """How edges and hollows are looked for on it."""

    def __post_init__(self) -> None:
        require_positive(self, *(name for name in self.__dataclass_fields__ if name not in ("relief", "fingers")))
        require_ratios(self, "lever", "small", "long_ratio", "local_ratio")
        for name in ("labelled", "unlabelled", "unattached"):
            if getattr(self, name) > 1:
                raise ValueError(f"`GraspConfig.{name}` must be at most 1: got {getattr(self, name)}")


@final
@dataclass(frozen=True)
class HandleTrials:
    """Which sizes and places are tried in turn where a handle does not fit, the usual one first.

    Raises:
        ValueError: if a size is not above 0, or fewer than one place is looked at.
    """

    lengths: tuple[float, ...] = (1.0, 0.65, 0.4)
    """Lengths, as fractions of the wanted one."""
    protrusions: tuple[float, ...] = (1.0, 0.7)
    """Protrusions, as fractions of the wanted one: between a drawer and the door before it there is little room."""
    spare: tuple[tuple[str, float, float], ...] = (
        ("knob-round", 1.0, 1.0),
        ("bar-strip", 0.6, 0.75),
        ("knob-flat", 0.75, 0.7),
        ("cup-slim", 0.7, 0.8),
    )
    """Templates that are tried last, each with its length and protrusion as fractions of its natural ones."""
    insets: tuple[float, ...] = (1.0, 0.7, 1.4, 0.5, 1.9)
    """Distances from the free edge, as fractions of the usual one."""
    shifts: tuple[float, ...] = (0.0, 0.12, -0.12, 0.25, -0.25)
    """Distances along the edge from the usual place, as fractions of the front's side."""
    most_spots: int = 60
    """Places for one size before the next size is tried."""
    most_blocked: int = 150
    """Places in which something was in the way before a front is refused."""

    def __post_init__(self) -> None:
        require_positive(self, "most_spots", "most_blocked")
        sizes = (*self.lengths, *self.protrusions, *self.insets, *(size for _, *own in self.spare for size in own))
        if not all(size > 0 for size in sizes):
            raise ValueError(f"sizes and insets in `HandleTrials` must be above 0: got {sizes}")


@final
@dataclass(frozen=True)
class HandleConfig:
    """Which handles are added, how large, and where; see `grafu.scene.scale` for models of another scale.

    Raises:
        ValueError: if a length or fraction is out of its range, or there are fewer than two poses.
    """

    style: str = ""
    """Id of a handle template; empty: like the model's other handles, or `default` where it has none."""
    default: str = "bar-round"
    """Style where nothing else is said: the commonest on bought furniture."""
    finish: str = ""
    """Name of a metal finish; empty: that of the model's other handles, or brushed steel."""
    length: float = 0.0
    """Length of bars; 0: by the size of the fronts, the same all over one piece of furniture."""
    inset: float = 0.045
    """From the free edge to the handle's middle, at most a fifth of the front: half a stile of a framed door."""
    reach_height: float = 1.0
    """Above the floor, where hands find the handles of tall doors."""
    tall: float = 1.2
    """Doors at least this high are tall."""
    short: float = 0.45
    """Doors up to this height have their handle at half height."""
    wide: float = 0.9
    """Drawers wider than this take two handles."""
    high: float = 0.25
    """Drawer fronts higher than this have their handle in the upper part."""
    most: float = 0.5
    """Largest fraction of the front's side that a handle takes along it."""
    margin: float = 0.006
    """What a handle keeps from the border of its front."""
    weak: float = 0.65
    """Confidence below which an edge does for a handle only where no other front of the model has or gets one."""
    poses: int = 25
    """Poses from closed to wide open in which a handle must be clear."""
    count: int = 0
    """How many handles a front gets, at equal parts of its longer side; 0: one, or two on wide drawers."""
    offset: tuple[float, float] = (0.0, 0.0)
    """By how much handles are moved from their usual places, metres: to the front's right, and up."""
    least: float = 0.012
    """The smallest handle, metres: what is smaller is nothing to hold."""
    uneven: float = 0.0008
    """How much the surface under a foot may differ from a plane, metres."""
    steepest: float = 0.35
    """Most that the surface under a foot may slope, metres per metre: about 20 degrees."""
    foot_depth: float = 0.0006
    """Distance from the foot plane within which vertices belong to a foot, metres."""
    touch: float = 0.0002
    """How deep a handle may touch something, as a fraction of the object's largest side."""
    both: float = 0.65
    """Fraction of a drawer's width that two handles take at most."""
    inset_ratio: float = 0.2
    """Fraction of a front's side within which a handle lies from the free edge, where there is room for more."""
    from_end: float = 0.1
    """From the end of a door to the near end of its handle, metres."""
    knob: float = 0.05
    """Handles that are no longer than this either way are knobs, metres ..."""
    knob_ratio: float = 1.7
    """... where they are no longer than this, over their shorter side."""
    bar_ratio: float = 0.3
    """Length of a bar, as a fraction of the fronts' longer sides ..."""
    shortest_bar: float = 0.096
    """... but no shorter than this, metres ..."""
    longest_bar: float = 0.32
    """... and no longer than this, metres."""
    lid: float = 0.7
    """Upright part of a front's up direction below which the front is a lid (ratio)."""
    trials: HandleTrials = HandleTrials()
    """Which sizes and places are tried in turn."""

    def __post_init__(self) -> None:
        require_positive(self, "inset", "reach_height", "tall", "short", "wide", "high", "most")
        require_positive(self, "least", "uneven", "steepest", "foot_depth", "touch", "from_end")
        require_positive(self, "knob", "knob_ratio", "shortest_bar", "longest_bar")
        require_ratios(self, "both", "inset_ratio", "bar_ratio", "lid")
        require_not_negative(self, "length", "margin", "weak")
        if not 0 <= self.count <= 4:
            raise ValueError(f"`HandleConfig.count` must be in 0..4: got {self.count}")
        if self.poses < 2:
            raise ValueError(f"`HandleConfig.poses` must be at least 2: got {self.poses}")


@final
@dataclass(frozen=True, slots=True)
class HandleChoice:
    """What one door or drawer is grasped by, whatever the others get.

    `style` is a handle template, a recessed grip (`grip`, `groove`, `edge`, `hole`), `none`, or empty for the style of
    the others; `count` and `offset` are those of `HandleConfig`, `length` metres (0: as it suits). Handles of the input
    stay beside it unless it `replaces` them.

    Raises:
        ValueError: if the count is not in 0..4, or the length is negative.
    """

    style: str = ""
    count: int = 0
    offset: tuple[float, float] = (0.0, 0.0)
    length: float = 0.0
    replaces: bool = True

    def __post_init__(self) -> None:
        if not 0 <= self.count <= 4:
            raise ValueError(f"`HandleChoice.count` must be in 0..4: got {self.count}")
        if not self.length >= 0:
            raise ValueError(f"`HandleChoice.length` must not be negative: got {self.length}")
