"""Tolerances, sizes and counts of joints. Lengths marked (extent) are fractions of the object's largest side."""

from dataclasses import dataclass
from math import radians
from typing import final

from grafu.scene.checks import require_positive, require_ratios


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
    door_opening: float = radians(110)
    """How far a door may open at most; real butt hinges stop the leaf at about 110 degrees."""
    restricted: float = 0.7
    """An opening below this fraction of the reference is reported as restricted (design, section 5)."""
    trim: bool = True
    """Whether material may be taken away to give clearance."""
    max_trim: float = 0.02
    """Largest fraction of a side by which a moving part is made smaller (design, section 5)."""
    max_carve: float = 0.05
    """Largest fraction of a static part's volume or surface that is carved (design, section 5)."""
    max_carve_fitting: float = 0.6
    """The same of a drawn rail, bearing or hinge, told by its name: it lies hidden, and makes way for what works."""
    coarse_poses: int = 19
    """Poses in which candidates are compared."""
    fine_poses: int = 61
    """Poses in which the chosen motion is checked: more than the 50 of the paper's metric, and others than those."""
    rail_ratio: float = 0.9
    """Length of a rail over the drawer's body (supplement: 1 - beta, beta = 0.1)."""
    body_tolerance: float = 0.01
    """Tolerance of the drawer's body region around the median width (official 7.4: 10 mm), a fraction of the width."""

    def __post_init__(self) -> None:
        require_positive(self, "depth", "contact", "flush", "anchor", "bridge", "door_opening", "body_tolerance")
        require_ratios(self, "restricted", "max_trim", "max_carve", "max_carve_fitting", "rail_ratio")
        if min(self.coarse_poses, self.fine_poses) < 2:
            raise ValueError(f"poses must be at least 2: got {self.coarse_poses} and {self.fine_poses}")
