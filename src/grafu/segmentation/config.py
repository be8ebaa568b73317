"""From where on shells are fronts, what belongs to a front, and which objects hide some.

Inputs come in any unit: lengths are fractions of an object's largest side, or multiples of `near`, the length at which
something still touches. Other numbers are fractions of what their line states.
"""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.segmentation.surface_config import CreaseConfig, JoiningConfig
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True, slots=True)
class CandidateConfig:
    """Which shells could be the front of a door or a drawer.

    Raises:
        ValueError: if a number is not above 0.
    """

    near: float = 0.01
    """How far off something still touches, how far it may stand out (of its object's largest side)."""
    plate: float = 0.35
    """How thick a front is at most (of its shorter side)."""
    bowed: float = 0.7
    """How thick one is at most with its bulge, which does not count (of its shorter side) ..."""
    border: float = 0.1
    """... which is measured so far inside its border (of its sides) ..."""
    step: float = 0.35
    """... and changes by so much at most from one row or column to the next (of the bulge)."""
    upright: float = 1.5
    """How high the leaf of a door is at least that stands in its frame with nothing behind it (of its width) ..."""
    knob: float = 0.02
    """... how large a handle on it is at most (of its outline) ..."""
    aside: float = 0.3
    """... and how far beside the leaf's middle its middle is at least (of the leaf's width)."""
    least: float = 0.05
    """The shorter side of a front at least (of its object's largest side)."""
    most_narrow: float = 12.0
    """How many times as long as wide a front is at most."""
    full: float = 0.5
    """What a front's faces cover, unless it is a frame (of its outline)."""
    ring: float = 0.08
    """What a frame's faces cover (of its outline)."""
    solid: float = 0.8
    """What the faces of a drawer drawn as one body cover (of its outline) ..."""
    body: float = 0.6
    """... and how large it is at most (of its object's outline)."""
    beam: float = 5.0
    """What is so many times as long as high (ratio) ..."""
    square: float = 1.25
    """... and no deeper than so (of its height) is a beam and no such body, unless a handle sits on it: an apron."""
    handle: float = 0.1
    """A handle that tells that such a body is a drawer, whatever stands around it (of its outline)."""
    hidden: float = 0.3
    """How much of a front others may hide (of its outline)."""
    seen: float = 0.5
    """How much of it, or of what it holds, is seen (of its outline) ..."""
    before: float = 5.0
    """... which begins before it by so much at most: a handle, a moulding (multiple of `near`)."""
    room: float = 0.3
    """How deep what it closes is (of its shorter side)."""
    flank_reach: float = 5.0
    """How far beside such a body its case may stand (multiple of `near`) ..."""
    level: float = 0.5
    """... along how much of it (of its height and depth) ..."""
    larger: float = 1.1
    """... and how much larger one that it stands in is (of its outline)."""
    thick_plate: float = 0.5
    """How thick a front is that stands right before its case (of its shorter side) ..."""
    deeper: float = 2.0
    """... how deep that case is at least (of the front's thickness) ..."""
    backed: float = 0.9
    """... and what it covers (of the front's outline)."""
    recess: float = 0.25
    """How far behind its rim, and what lies around it, a front may be seen (of its object's depth) ..."""
    sunk: float = 0.1
    """... or else (of its shorter side): a recess is a compartment of its case."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class FrameConfig:
    """Which stiles, rails and panels are one framed front.

    Raises:
        ValueError: if a number is not above 0.
    """

    bar: float = 1.5
    """How many times as long as wide a stile or rail is at least."""
    deep: float = 2.0
    """How thick it is at most (of its width) ..."""
    thick: float = 0.1
    """... and (of its object's largest side)."""
    same: float = 0.004
    """How far the ends of one frame differ (of its object's largest side)."""
    gap: float = 0.0007
    """How far a panel may lie from its frame: inset fronts lie farther off (of its object's largest side)."""
    groove: float = 1.0
    """How far others reach into a bar (of its width): rails are lapped over stiles, panels end below their edges."""
    filled: float = 0.5
    """What the panels of a frame cover (of its inside)."""
    muntin: float = 1.5
    """How wide a bar that parts panels is at most (of the width of the frame's bars)."""
    strip: float = 2.5
    """How many times as long as wide a strip is that lies beside a front without a gap, and is a stile of it ..."""
    strip_area: float = 0.4
    """... and how large it is at most (of that front's outline)."""
    pane: float = 0.3
    """How thick a pane is at most that is another object (of the frame's thickness)."""
    set_back: float = 0.02
    """How far behind the face of a frame its panels lie at least (of its thickness)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class MemberConfig(ShortRepr):
    """Which of the candidates are fronts, and which shells belong to one: panes, liners, boards, handles.

    Raises:
        ValueError: if a number is not above 0.
    """

    nested: float = 0.5
    """What a larger plate covers of a smaller one where they are one front (of the smaller outline)."""
    apron_width: float = 0.5
    """A front that is as narrow as this on a board (of its width) ..."""
    apron_height: float = 0.6
    """... and as high as this (of its height) is that of a drawer in an apron."""
    whole: float = 0.8
    """A plate that covers so much may be fixed (of its object's outline) ..."""
    half: float = 0.5
    """... if the fronts on it cover so much of it ..."""
    inset: float = 0.2
    """... or that are inset in it, as thin as this (of its thickness) ..."""
    smaller: float = 0.9
    """... and each is smaller than this (of its outline)."""
    many: int = 3
    """So many fronts on a body show a case ..."""
    quarter: float = 0.25
    """... where they cover this much of it (of its outline): a row of kitchen units has a plinth and rails, too."""
    leaf: float = 0.15
    """A plate as thin as this (of its shorter side) moves, whatever lies on it, where handles stand on it alone ..."""
    beside: float = 0.2
    """... whose feet overlap what lies on it by less (of their outline)."""
    body: float = 0.35
    """A body is thicker than this (of its shorter side) ..."""
    unit: float = 0.97
    """... and one as high as wide with a plate on its face, smaller by so much (of its outline), is no drawer."""
    ring: float = 0.5
    """What covers less is a frame (of its outline)."""
    pane_area: float = 0.2
    """How large a pane in a frame is at least (of the frame's outline)."""
    pane: float = 0.6
    """How thick it is at most (of the frame's thickness) ..."""
    thin: float = 0.1
    """... or how thin it is in any frame (multiple of `near`)."""
    handle_side: float = 0.1
    """The shorter side of a handle (of its object's largest side)."""
    handle_area: float = 0.25
    """The outline of a handle (of its front's)."""
    handle_out: float = 0.25
    """How far a handle stands out at most (of its object's largest side) ..."""
    handle_least_out: float = 0.2
    """... and at least (multiple of `near`)."""
    handle_gap: float = 8.0
    """How far before its front a handle may begin (multiple of `near`)."""
    handle_touch: float = 0.5
    """How far apart the pieces of one handle still touch (multiple of `near`)."""
    thick_handle: float = 0.4
    """How thick a handle is (multiple of that gap): thinner ones are printed marks."""
    moulding: float = 0.95
    """How long a moulding is at least (of its front); it stands out by `near` at most, which a handle does not."""
    on_front: float = 0.6
    """How much of a handle lies on its front (of its outline)."""
    liner: float = 1.5
    """How far behind a front its liners lie, and how thick they are (of its thickness)."""
    liner_plate: float = 0.5
    """How thick a liner is at most (of its shorter side) ..."""
    seam: float = 0.1
    """... and how far it may leave its front's outline (multiple of `near`): stiles of a case behind it leave more."""
    side_width: float = 0.2
    """How thick the side of a drawer's box is at most (of the front's width) ..."""
    side_height: float = 0.3
    """... how high at least (of the front's height) ..."""
    low_side: float = 0.12
    """... or, where a bottom or a back joins both: a drawer for pans has sides of 84 mm behind a front of 400 mm ..."""
    side_depth: float = 2.0
    """... and how deep at least (of its thickness)."""
    walls: float = 1.5
    """What the faces of a drawer's box drawn as one body cover, its front wall and its back (of its outline)."""
    flat: float = 0.5
    """How thick what may be the lid of such a box is at most (of its shorter side) ..."""
    lid: float = 0.5
    """... and how wide at least (of the front's width): a case has one, a drawer has none."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class DivisionConfig:
    """Which objects are cut.

    Raises:
        ValueError: if a number is not above 0.
    """

    plate: float = 0.35
    """As thick as this an object is a plate (of its shorter side)."""
    filled: float = 0.6
    """What fronts in a plate cover (of its outline) ..."""
    apart: float = 0.3
    """... and where it is nothing but fronts: those of two pedestals lie far apart, handles cover less."""
    alike: float = 0.4
    """What the others have where several fronts are one plate (of the largest front's outline)."""
    board: float = 5.0
    """How many times as high as wide the boards of a panel are at least."""
    batten: float = 0.6
    """What a batten that holds a leaf's boards together, short of its edges, covers of each (of its width) ..."""
    batten_wide: float = 0.25
    """... how wide it is at most (of the boards' length) ..."""
    batten_thick: float = 3.0
    """... and how thick (multiple of the boards' thickness)."""
    panel: float = 0.1
    """What a fixed panel beside one front covers at least (of the plate's outline) ..."""
    beside: float = 0.1
    """... and how much of it the front may overlap (of its outline)."""
    flush: float = 0.2
    """How far inside an object's front a front of it lies (of the object's depth) ..."""
    flush_held: float = 0.8
    """... where a handle stands on it: the drawers behind the top of a desk ..."""
    around: float = 0.15
    """... unless nothing stands before it, as near as this (of its size): wall units above a worktop that is deeper."""
    lid: float = 0.4
    """How much of a case is closed from above (of its footprint)."""
    shallow: float = 0.1
    """How deep what is as thin as a plate is at least to be a shallow case (of its shorter side) ..."""
    deeper: float = 4.0
    """... and how many times as deep as the fronts before it are thick."""
    case_reach: float = 3.0
    """How far a case stands out of the fronts of a box at least (multiple of `near`)."""
    small: float = 0.02
    """A front's shorter side at least (of the whole's largest side)."""
    low: float = 0.025
    """The height of a front that a handle stands on at least (of its object's largest side): a table's drawers."""
    flattest: float = 16.0
    """... and how many times as wide as high it is at most: flat drawers for plans and drawings."""
    lowest: float = 0.02
    """The shorter side of a front in a column or row with others at least (of its object's largest side) ..."""
    level: float = 0.001
    """... which ends, and lies, as one of them does (of its object's largest side) ..."""
    slender: float = 8.0
    """... and is at most so many times as long as wide: plinths and cornices are longer."""
    plinth: float = 0.1
    """How high the only front of an object is at most, without a handle and at the floor, to be its plinth (of the
    object's height) ..."""
    floor: float = 0.02
    """... and how far it ends above the lowest point of all (of the object's height)."""
    single: float = 0.8
    """What an object's one front covers (of the object's outline)."""
    knobs: int = 4
    """So many handles on a strip are the knobs of a panel of controls ..."""
    strip: float = 2.5
    """... which is at least so many times as wide as high."""
    most_handles: int = 2
    """Handles drawn in one front: more are mouldings or slats."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, slots=True)
class SegmentationConfig(ShortRepr):
    """The thresholds of all steps."""

    candidates: CandidateConfig = CandidateConfig()
    """Of single shells."""
    frames: FrameConfig = FrameConfig()
    """Of framed fronts."""
    members: MemberConfig = MemberConfig()
    """Of whole fronts."""
    division: DivisionConfig = DivisionConfig()
    """Of objects that hide fronts."""
    creases: CreaseConfig = CreaseConfig()
    """Of fronts drawn on a surface."""
    joining: JoiningConfig = JoiningConfig()
    """Of objects that are one front."""
