"""What is named after a fitting of a door or drawer, but is one: `drawer_lock` is the drawer with the lock."""

from collections.abc import Sequence
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
class NamedFittingConfig:
    """When such a part is a door or drawer.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    alike: float = 0.05
    """How much its sides differ from those of another door or drawer at most (fraction of that one's)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_named_fittings(
    parts: tuple[Part, ...], config: NamedFittingConfig = NamedFittingConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts with fittings as doors or drawers that have the size of one, along each axis, and notes."""
    found = {part.id: label for part in parts if (label := _label(part, parts, config)) is not None}
    notes = [f"{p.source.name} is as large as a {found[p.id].value}: taken for one" for p in parts if p.id in found]
    made = (replace(p, label=found[p.id], labelled_by="shape") if p.id in found else p for p in parts)
    return tuple(made), notes


def _label(part: Part, parts: Sequence[Part], config: NamedFittingConfig) -> PartLabel | None:
    sense = sense_of(part.source.name)
    if part.label is not PartLabel.MISC or not sense.is_fitting or sense.mention is None:
        return None
    size = part.box.size
    sizes = (other.box.size for other in parts if other.label is sense.mention)
    is_alike = any(bool(np.all(np.abs(size - other) <= config.alike * other)) for other in sizes)
    return sense.mention if is_alike else None
