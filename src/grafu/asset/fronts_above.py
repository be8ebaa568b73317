"""Which way is up where no name tells it: not the way that doors and drawers with handles face.

Coordinates are the input's; directions are spelled like `-Y`. No label and no joint is asked.
"""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.asset.part import Part
from grafu.asset.standing import vector
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive
from grafu.segmentation.lids import count_held_fronts


@final
@dataclass(frozen=True, slots=True)
class FrontsAboveConfig:
    """When fronts show that another direction is up.

    Raises:
        ValueError: if a number is not above 0.
    """

    least: int = 2
    """Plates with handles that would face up or down at least: a chest has one lid, and one thing may stand on a table.
    There are no fewer of them than face the other level sides: things that stand on floors and beds look like handles,
    and more fronts face aside there."""
    most: int = 600
    """Parts at most: of larger scenes names or formats tell how they stand."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


_DEFAULT: Final = FrontsAboveConfig()


def has_fronts_above(parts: Sequence[Part], up: str, other: str, config: FrontsAboveConfig = _DEFAULT) -> bool:
    """Whether fronts with handles would face up or down, and with `other` up none would.

    Args:
        parts: the parts, in the input's coordinates.
        up: the direction that is up by the format.
        other: the direction that is up in formats of the other kind.
        config: how many fronts show it.
    """
    if len(parts) > config.most or up[1] == other[1]:
        return False
    above, beside = vector(up), vector(other)
    meshes = [part.mesh for part in parts]

    def count(towards: np.ndarray, upwards: np.ndarray) -> int:
        axes = np.stack([np.cross(upwards, towards), upwards, towards])
        return count_held_fronts(meshes, axes=axes)

    across, both = np.cross(above, beside), (1.0, -1.0)
    found = sum(count(sense * above, beside) for sense in both)
    if found < config.least or any(count(sense * beside, above) for sense in both):
        return False
    return found >= sum(count(sense * across, beside) for sense in both)
