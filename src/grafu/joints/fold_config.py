"""Which leaves fold, how far, and the track above them. Lengths are metres on furniture of usual size (`at_scale`)."""

from math import radians
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True)
class FoldConfig:
    """Which leaves fold as a pair or hang in a corner, and how.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    LENGTHS = (
        "seam",
        "corner",
        "flush",
        "pivot",
        "pivot_edge",
        "track",
        "strip",
        "least",
        "play",
        "room",
        "bearing",
        "widest_gap",
    )
    thin: float = 0.3
    """Greatest thickness of a leaf (fraction of its shorter other side): a handle may be part of its mesh."""
    width: float = 0.05
    """How much narrower than the other the one leaf of a pair may be (fraction of the wider)."""
    seam: float = 0.012
    """Widest seam between two leaves of one plane, and how far they may lap there (metres)."""
    corner: float = 0.03
    """Widest gap between two leaves that meet in a corner, and how far they may lap there (metres)."""
    flush: float = 0.004
    """Largest step between the backs of two leaves of one plane (metres)."""
    level: float = 0.02
    """Largest step between the upper or the lower ends of two leaves (fraction of their height)."""
    askew: float = 0.02
    """Largest cosine or sine by which two leaves depart from one plane, or from a right angle."""
    opening: float = radians(88)
    """How far the outer leaf of a pair opens at most (radians); the inner one turns back by twice as much."""
    corner_opening: float = radians(85)
    """How far the second leaf in a corner is wanted to turn on the first (radians): it then lies before it."""
    beyond: float = 0.1
    """How far above and below a corner's leaves nothing stands between them (fraction of their height)."""
    pivot: float = 0.002
    """Radius of the outer leaf's pivots (metres): slim ones stand close to its outer edge ..."""
    pivot_edge: float = 0.0008
    """... this far from it (metres): as far the inner leaf's free edge departs from the plane that it is guided in."""
    track: float = 0.012
    """Width of the track above a pair (metres)."""
    strip: float = 0.002
    """Thickness of the track, at most half of the gap that it lies in (metres)."""
    least: float = 0.0005
    """Least gap above the leaves that a track under what stands there takes (metres)."""
    play: float = 0.001
    """Distance between the leaf's upper end and a track that nothing stands above (metres)."""
    room: float = 0.02
    """How far above the leaf's upper end the track may be fixed to what stands there (metres)."""
    bearing: float = 0.002
    """Radius of the guide that runs in the track (metres)."""
    widest_gap: float = 0.03
    """How far behind the track the case may stand that holds it (metres)."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "thin", "width", "level", "askew", "beyond")
