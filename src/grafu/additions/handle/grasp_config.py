"""What counts as room for fingers, and as a grip. Lengths are metres on furniture of a common size (`scene.scale`)."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_at_most_one, require_positive, require_ratios
from grafu.visible import ShortRepr


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
class GripConfidences:
    """The confidence of each kind of grip that is geometry of the front itself, 0..1.

    Raises:
        ValueError: if one is not above 0, or above 1.
    """

    hooked: float = 0.95
    """Something stands out of the front, and fingers reach behind it."""
    pinched: float = 0.9
    """Something small stands out, and is taken between two fingers."""
    through: float = 0.9
    """A hole or slot goes through the front."""
    cut_out: float = 0.85
    """Fingers reach round the edge of a cut-out."""
    hollow: float = 0.8
    """A hollow takes fingers."""
    held_edge: float = 0.75
    """Fingers reach round the free edge that such a front is opened at."""
    other_edge: float = 0.6
    """Fingers reach round another free edge."""
    thin_edge: float = 0.7
    """A thin edge is free on both sides."""
    lip: float = 0.7
    """A lip stands out along a border."""
    channel: float = 0.7
    """A channel takes fingers."""
    finger_hole: float = 0.5
    """A small hole was drawn for a finger."""
    notch: float = 0.5
    """A notch was drawn for fingers, in which none finds room."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_at_most_one(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True)
class GraspConfig(ShortRepr):
    """What counts as room for fingers; see `grafu.scene.scene` for models in another scale.

    Raises:
        ValueError: if a number is not above 0, a fraction is not between 0 and 1, or a confidence is above 1.
    """

    gap: float = 0.012
    """Narrowest gap that fingers enter, and the least room behind what they pull at; a fingertip is 12 to 20 mm."""
    reach: float = 0.02
    """How deep fingers go in behind the face that they pull at, its own thickness counted in."""
    hook: float = 0.006
    """How far fingertips reach behind an edge, sideways, to pull at it: the lips of finger pulls are 6 to 10 mm."""
    pull: float = 0.8
    """Where behind an edge a fingertip pulls at it, as a fraction of `hook`."""
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
    shortest_notch: float = 0.03
    """The shortest such notch: half the width of three fingers."""
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
    inside: float = 0.9
    """Fraction of a hole or slot through a front that lies in its outline, at least: what reaches beyond is an edge."""
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
    confidences: GripConfidences = GripConfidences()
    """Confidences of what is geometry of the front itself."""
    relief: ReliefConfig = ReliefConfig()
    """The depth map that grips are looked for on."""
    fingers: FingerRoomConfig = FingerRoomConfig()
    """How edges and hollows are looked for on it."""

    def __post_init__(self) -> None:
        nested = ("confidences", "relief", "fingers")
        require_positive(self, *(name for name in self.__dataclass_fields__ if name not in nested))
        require_ratios(self, "lever", "small", "long_ratio", "local_ratio", "inside", "pull")
        require_at_most_one(self, "labelled", "unlabelled", "unattached")
