"""The main doors of appliances, told by what their bodies are called: `refrigerator_body`, `dishwasher_3`."""

from collections.abc import Callable
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class ApplianceBodyConfig:
    """Which doors are those of an appliance.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    covered: float = 0.8
    """What the body covers of such a door at least, seen across the door (fraction of area) ..."""
    main: float = 0.25
    """... and what the door covers of the body: one of four equal ones, at least (the same)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def doors_of_bodies(
    asset: Asset,
    graph: FunctionalGraph,
    is_called: Callable[[str], bool],
    config: ApplianceBodyConfig = ApplianceBodyConfig(),
) -> set[str]:
    """Returns the doors before the body of an appliance, whose name `is_called` accepts; its pieces may be many parts.

    A kitchen with several such appliances has none: its doors cover too little of all of them together.
    """
    bodies = [
        part.box
        for part in asset.parts
        if part.labelled_by in ("name", "none", "prediction")
        and not part.label.is_movable
        and part.label is not PartLabel.HANDLE
        and is_called(part.source.name)
    ]
    if not bodies:
        return set()
    body = Box.enclosing(bodies)
    doors = [node for node in graph.nodes if node.label is PartLabel.DOOR]
    return {node.id for node in doors if _is_before(node.box, body, config)}


def _is_before(door: Box, body: Box, config: ApplianceBodyConfig) -> bool:
    across = np.delete(np.arange(3), door.thin_axis)
    shared = np.minimum(door.high, body.high)[across] - np.maximum(door.low, body.low)[across]
    area = float(np.prod(np.maximum(shared, 0.0)))
    return bool(
        area >= config.covered * np.prod(door.size[across]) and area >= config.main * np.prod(body.size[across])
    )
