"""Parts that are named after doors and drawers alike (`door_and_drawers`): their shape tells which of them each is."""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.labels import sense_of
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class EitherKindConfig:
    """When such a part is a drawer.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    low: float = 0.8
    """A drawer's front is as low as this at most (fraction of its width): doors of base units are higher."""
    plate: float = 0.35
    """A front is as thick as this at most (fraction of its next side)."""

    def __post_init__(self) -> None:
        require_ratios(self, "low", "plate")


def with_either_kind(parts: tuple[Part, ...], config: EitherKindConfig = EitherKindConfig()) -> tuple[Part, ...]:
    """Returns the parts, Z up, with unlabelled upright plates that are so named as doors or drawers."""
    return tuple(_labelled(part, config) for part in parts)


def _labelled(part: Part, config: EitherKindConfig) -> Part:
    if part.label is not PartLabel.UNKNOWN or not sense_of(part.source.name).is_either:
        return part
    size = part.box.size
    across, height = float(max(size[0], size[1])), float(size[2])
    if float(size.min()) > config.plate * float(np.sort(size)[1]) or height <= float(size.min()):
        return part
    label = PartLabel.DRAWER if height <= config.low * across else PartLabel.DOOR
    return replace(part, label=label, labelled_by="name")
