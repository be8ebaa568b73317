"""The sizes and places of handles. Lengths are metres on furniture of a common size (`grafu.scene.scene`)."""

from typing import Literal, final, get_args

from grafu.additions.grip.config import GripProfile
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_not_negative, require_positive, require_ratios
from grafu.visible import ShortRepr

NO_HANDLE = "none"
"""`HandleChoice.style` of a front that gets nothing."""
ANY_GRIP = "grip"
"""... and of one that gets whichever grip fits."""
MOST_HANDLES = 4
"""Most handles that one front may get."""


@final
@dataclass(frozen=True)
class HandleTrials(ShortRepr):
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
    levels: tuple[float, ...] = (0.5, 0.7, 0.82, 0.3, 0.9, 0.18)
    """Heights on a drawer after the usual one, as fractions of its front's height."""
    drawer_shifts: tuple[float, ...] = (0.0, 0.08, -0.08, 0.2, -0.2)
    """Distances aside from the middle of a drawer, as fractions of its front's width."""
    most_spots: int = 60
    """Places for one size before the next size is tried."""
    most_blocked: int = 150
    """Places in which something was in the way before a front is refused."""

    def __post_init__(self) -> None:
        require_positive(self, "most_spots", "most_blocked")
        sizes = (*self.lengths, *self.protrusions, *self.insets, *self.levels)
        sizes = (*sizes, *(size for _, *own in self.spare for size in own))
        if not all(size > 0 for size in sizes):
            raise ValueError(f"sizes, insets and levels in `HandleTrials` must be above 0: got {sizes}")


@final
@dataclass(frozen=True)
class HandleConfig(ShortRepr):
    """Which handles are added, how large, and where; see `grafu.scene.scene` for models of another scale.

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
    """Drawer fronts higher than this have their handle in the upper part ..."""
    from_top: float = 0.08
    """... this far below the upper edge, metres ..."""
    from_top_ratio: float = 0.28
    """... and at least this fraction of the front's height."""
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
    """How deep a handle may touch something, metres."""
    both: float = 0.65
    """Fraction of a drawer's width that two handles take at most."""
    inset_ratio: float = 0.2
    """Fraction of a front's side within which a handle lies from the free edge, where there is room for more."""
    free: float = 0.7
    """A predicted place counts from this fraction of a front's side on, beginning at the edge that is held."""
    from_end: float = 0.1
    """From the end of a door to the near end of its handle, metres ..."""
    from_end_ratio: float = 0.15
    """... and at most this fraction of the door's height."""
    tall_end_ratio: float = 0.25
    """From the end of a tall door to the middle of its handle at least, a fraction of the door's height."""
    end_inset_ratio: float = 0.4
    """From the free edge to the near end of a level bar on a door, a fraction of the usual inset."""
    central: float = 0.15
    """A handle this near to the middle of another door (fraction of its height) is at the same fraction on this one."""
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
        require_positive(self, "from_top")
        require_ratios(self, "both", "inset_ratio", "free", "bar_ratio", "lid", "from_top_ratio")
        require_ratios(self, "from_end_ratio", "tall_end_ratio", "end_inset_ratio", "central")
        require_not_negative(self, "length", "margin", "weak")
        if not 0 <= self.count <= MOST_HANDLES:
            raise ValueError(f"`HandleConfig.count` must be in 0..{MOST_HANDLES}: got {self.count}")
        if self.poses < 2:
            raise ValueError(f"`HandleConfig.poses` must be at least 2: got {self.poses}")


@final
@dataclass(frozen=True, slots=True)
class HandleChoice:
    """What one door or drawer is grasped by, whatever the others get.

    `style` is a handle template, a recessed grip (`grip`, `groove`, `edge`, `hole`), `none`, or empty for the style of
    the others; `count` and `offset` are those of `HandleConfig`, `length` metres (0: as it suits). Handles of the input
    stay beside it unless it `replaces` them. Of a recessed grip, `width` lies across the gripped edge, `depth` is that
    of a groove, metres (0: as it suits), and `profile` has sharp corners or rounded ones (empty: as the others).

    Raises:
        ValueError: if the count is not in 0..`MOST_HANDLES`, a length is negative, or there is no such profile.
    """

    style: str = ""
    count: int = 0
    offset: tuple[float, float] = (0.0, 0.0)
    length: float = 0.0
    replaces: bool = True
    width: float = 0.0
    depth: float = 0.0
    profile: GripProfile | Literal[""] = ""

    def __post_init__(self) -> None:
        if not 0 <= self.count <= MOST_HANDLES:
            raise ValueError(f"`HandleChoice.count` must be in 0..{MOST_HANDLES}: got {self.count}")
        for name in ("length", "width", "depth"):
            if not getattr(self, name) >= 0:
                raise ValueError(f"`HandleChoice.{name}` must not be negative: got {getattr(self, name)}")
        if self.profile not in ("", *get_args(GripProfile)):
            wanted = ", ".join(get_args(GripProfile))
            raise ValueError(f"`HandleChoice.profile` must be one of {wanted}, or empty: got {self.profile!r}")
