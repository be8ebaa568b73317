"""The seat of a toilet: a plate with an opening in its middle that is named a seat. It turns as its lid does.

The seats of chairs and benches are closed in the middle, and stay.
"""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.names import singular, spoken
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.raycast import RayCaster, depths_below
from grafu.vocabulary import PartLabel

_SEAT = "seat"


@final
@dataclass(frozen=True, slots=True)
class RingSeatConfig:
    """When a seat is that of a toilet.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or `rays` not above 0.
    """

    thin: float = 0.3
    """Its thickness is at most this (fraction of its next side), as that of a plate is."""
    middle: float = 0.3
    """The middle of its plan, this wide along each side (fraction of that), is open ..."""
    around: float = 0.3
    """... and of the whole of it this much is closed at least (fraction)."""
    rays: int = 24
    """Rays along each side of its plan."""

    def __post_init__(self) -> None:
        require_ratios(self, "thin", "middle", "around")
        require_positive(self, "rays")


def with_ring_seats(parts: tuple[Part, ...], config: RingSeatConfig = RingSeatConfig()) -> tuple[Part, ...]:
    """Returns the parts with rings that are named seats as doors: they are hinged, as lids are."""
    return tuple(
        replace(part, label=PartLabel.DOOR, labelled_by="name") if _is_seat(part) and is_ring(part, config) else part
        for part in parts
    )


def _is_seat(part: Part) -> bool:
    said = [singular(word) for word in spoken(part.source.name)]
    is_free = part.label in (PartLabel.UNKNOWN, PartLabel.MISC) and part.labelled_by != "user"
    return is_free and said[-1:] == [_SEAT]


def is_ring(part: Part, config: RingSeatConfig = RingSeatConfig()) -> bool:
    """Whether a part is a plate with an opening in its middle."""
    box, thin = part.box, part.box.thin_axis
    if box.size[thin] > config.thin * np.sort(box.size)[1]:
        return False
    depths = depths_below(RayCaster(part.mesh), box, thin, config.rays, float(box.size.max()))
    closed = np.isfinite(depths).reshape(config.rays, config.rays)
    edge = round(config.rays * (1 - config.middle) / 2)
    return not closed[edge:-edge, edge:-edge].any() and float(closed.mean()) >= config.around
