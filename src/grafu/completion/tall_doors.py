"""Doors that are much higher than wide hang on their left or right side: they neither drop nor lift.

Dropped, such a leaf would reach farther out than any user stands before it. It builds nothing.
"""

from typing import final

from grafu.asset.part import Asset
from grafu.completion.rehang import hung_on_sides
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import GraphCompletion
from grafu.graph.motion import plane_axes

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class TallDoorConfig:
    """From when on a door is too high to drop or lift.

    Raises:
        ValueError: if a number is not above 0.
    """

    tall: float = 1.5
    """Its height over its width at least: doors of dishwashers have 1.2."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_tall_doors(
    completion: GraphCompletion, asset: Asset, config: TallDoorConfig = TallDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which high doors that would drop or lift hang on a side, the likelier one.

    A door still opens to the same face. Leaves that fold stay as they are predicted.
    """
    graph, given = completion.completed, {part.id for part in asset.parts}
    return hung_on_sides(completion, lambda door: door in given and _is_tall(graph.node(door).box, config))


def _is_tall(box: Box, config: TallDoorConfig) -> bool:
    level = next(axis for axis in plane_axes(box.thin_axis) if axis != _UP)
    return bool(box.size[_UP] >= config.tall * box.size[level])
