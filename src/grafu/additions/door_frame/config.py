"""The frame that a door of a building gets where none is drawn."""

from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.visible import ShortRepr


@final
@dataclass(frozen=True)
class DoorFrameConfig(ShortRepr):
    """Lengths are metres on furniture of usual size; see `at_scale` for models in another scale.

    Raises:
        ValueError: if a length is not above 0.
    """

    LENGTHS = ("width", "depth", "gap")
    width: float = 0.06
    """Width of the jambs and height of the head, seen from the front."""
    depth: float = 0.1
    """Depth of the frame, from the front face of the leaf backwards; the leaf's own thickness where that is more."""
    gap: float = 0.003
    """Gap between the frame and what moves, as joiners leave it."""

    def __post_init__(self) -> None:
        require_positive(self, *self.LENGTHS)
