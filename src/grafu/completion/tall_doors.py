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
from grafu.graph.motion import face_to_border, level_axis, signed_axis

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class TallDoorConfig:
    """From when on a door is too high to drop or lift.

    Raises:
        ValueError: if a number is not above 0.
    """

    tall: float = 1.5
    """Its height over its width at least: doors of dishwashers have 1.2 ..."""
    slim: float = 1.8
    """... and those of slim ones up to this ..."""
    sure: float = 0.9
    """... which drop where that is predicted with this score."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_tall_doors(
    completion: GraphCompletion, asset: Asset, config: TallDoorConfig = TallDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which high doors that would drop or lift hang on a side, the likelier one.

    A door still opens to the same face. Leaves that fold stay as they are predicted.
    """
    graph, given = completion.completed, {part.id for part in asset.parts}

    def is_tall(door: str) -> bool:
        box = graph.node(door).box
        return door in given and _ratio(box) >= (
            config.slim if _surely_drops(door, box, completion, config) else config.tall
        )

    return hung_on_sides(completion, is_tall)


def _surely_drops(door: str, box: Box, completion: GraphCompletion, config: TallDoorConfig) -> bool:
    decision = completion.decision(door, "border")
    lower = face_to_border(box.thin_axis, signed_axis(_UP, positive=False))
    return decision is not None and decision.choice == str(lower) and decision.score >= config.sure


def _ratio(box: Box) -> float:
    """Returns the height of an upright door over its width."""
    level = level_axis(box.thin_axis)
    return float(box.size[_UP] / max(float(box.size[level]), 1e-12))
