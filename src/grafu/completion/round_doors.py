"""Round doors hang on their left or right side: that of a washing machine neither drops nor lifts.

Vertices tell their shape. It builds nothing.
"""

from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.completion.rehang import hung_on_sides
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import GraphCompletion
from grafu.graph.motion import plane_axes


@final
@dataclass(frozen=True, slots=True)
class RoundDoorConfig:
    """When a door is round.

    Raises:
        ValueError: if a number is not above 0.
    """

    square: float = 0.9
    """Least ratio of the sides of the box around it."""
    corner: float = 1.55
    """How far it reaches into the corners of that box at most: the sum of the distances from the middle along both
    sides, each over the half side. A circle has 1.41, a square 2."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_round_doors(
    completion: GraphCompletion, asset: Asset, config: RoundDoorConfig = RoundDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which upright round doors that would drop or lift hang on a side, the likelier one.

    A door still opens to the same face. Where no score tells the sides apart, it hangs on the left.
    """
    given = {part.id: part for part in asset.parts}
    return hung_on_sides(completion, lambda door: door in given and is_round(given[door], config))


def is_round(part: Part, config: RoundDoorConfig = RoundDoorConfig()) -> bool:
    """Whether the outline of a part, seen across its thin side, is a circle, more or less."""
    box = part.box
    axes = list(plane_axes(box.thin_axis))
    half = box.half[axes]
    if half.min() < config.square * half.max() or half.min() <= 0:
        return False
    reach = np.abs(part.mesh.vertices[:, axes] - box.center[axes]) / half
    return float(reach.sum(axis=1).max()) <= config.corner
