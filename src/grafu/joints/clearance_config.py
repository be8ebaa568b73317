"""How much play a path gets, and what of a drawer or a leaf belongs to the case or the frame."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class ClearanceConfig:
    """How much play is given where material is taken away.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = ("beside", "lapped", "fitting")
    play: float = 2.5
    """Distance to what a path is freed from (in tolerated penetrations)."""
    touching: float = 0.9
    """What is nearer than this touches, where what touches is pressed back as well (fraction of `play`)."""
    enclosed: float = 2.0
    """How far what lies enclosed in a moving part may stand out of it (in tolerated penetrations)."""
    fitting: float = 0.09
    """A part of no category that a door is drawn sunk into is a fitting of its hinge where all of it is no farther from
    the pin than this, and no side longer than twice this (metres)."""
    beside: float = 0.001
    """Static parts whose boxes are nearer to a drawer's than this are walls that it may touch (metres)."""
    shells: int = 64
    """Parts of more shells than this are not separated from shells that belong to the case."""
    frame: float = 0.05
    """Smallest shell that may be a frame around the others (fraction of the area of its part)."""
    sides: int = 3
    """On so many sides at least a frame reaches beyond the others."""
    sliver: float = 0.02
    """Shells smaller than this are slivers (fraction of the area of the moving body) ..."""
    slivers: float = 0.1
    """... if all of them in one part are no more than this."""
    inside: float = 0.5
    """Slivers of which more than this lies within the outline of the rest are pieces of it (fraction)."""
    lapped: float = 0.02
    """How far the edges of a leaf reach into the frame around it at most, where they are cut off (metres)."""
    through: float = 0.5
    """Along how much of a leaf's thickness its frame reaches at least (fraction): less where it lies on its frame."""

    channel: float = 0.03
    """How far a wall reaches into the channel of a drawer that is drawn into it, at most, where that is cut free
    (extent): each of two parts that were made apart is off by about 0.01 of the piece, and a shape
    that is sampled by as much again ..."""
    rim: float = 0.03
    """... and how much of the wall's surface may go that is seen while all is closed (fraction): the rim before which
    the front lies is as wavy as the rest ..."""
    sections: int = 64
    """... into how many sections the drawer is parted along its way ..."""
    points: int = 4000
    """... and on how many points of the wall this is measured, besides its vertices."""
    seam: float = 0.3
    """Until it has turned so far, the free edge of a leaf may run into the leaf that it meets (radians)."""
    parallel: float = 0.999
    """The pins of two leaves that meet are parallel to this (cosine) ..."""
    meeting: float = 0.5
    """... and their edges lie beside each other along this much of the shorter one (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "play", "enclosed", "beside", "shells", "sides", "lapped", "seam", "fitting")
        require_positive(self, "sections", "points")
        require_ratios(self, "touching", "frame", "sliver", "slivers", "inside", "through", "parallel", "meeting")
        require_ratios(self, "channel", "rim")
