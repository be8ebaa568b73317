"""What a result must do in a simulator: pulls, times, and what counts as opened, closed and at rest."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios


@final
@dataclass(frozen=True, slots=True)
class CheckConfig:
    """Forces in newtons, lengths in metres, times in seconds, angles in radians.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    turning_pull: float = 20.0
    """A door is pulled with at most this ..."""
    sliding_pull: float = 30.0
    """... and a drawer with at most this, as tests of furniture do."""
    hand_speed: float = 0.3
    """A hand moves a grip no faster (m/s)."""
    longest_pull: float = 6.0
    """A pull takes at most so long."""
    opened: float = 0.9
    """A joint is open at this fraction of its range ..."""
    closed: float = 0.02
    """... and closed, or not moved, below this."""
    level: float = 0.5
    """Weight turns a joint whose axis has less than this along the vertical (of a unit direction)."""
    settling: float = 2.0
    """How long a piece is watched at rest."""
    still: float = 0.01
    """A free piece is at rest if it moves no farther than this ..."""
    tilt: float = 0.05
    """... and tilts no more than this."""
    cube: float = 0.05
    """The side of the cube that is dropped into drawers: a cup, or a robot's test object."""
    cube_density: float = 600.0
    """Its density, that of wood (kg/m3)."""
    room: float = 0.04
    """A drawer is hollow where rays from above go this far below its rim ..."""
    beside: float = 0.04
    """... all around a place, this far to each side."""
    rays: int = 24
    """How many rays to each side look into a drawer."""
    drop_height: float = 0.03
    """How far above the floor of a drawer the cube is let go."""
    falling: float = 1.5
    """How long it may take to come to rest."""
    friction: float = 0.5
    """The sliding friction of the floor."""
    frames: int = 48
    """Most frames of the clip."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "opened", "closed", "level")


DEFAULT_CHECK_CONFIG = CheckConfig()
