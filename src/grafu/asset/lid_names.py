"""Words that name lids and tops of cases alike (`Deckel`, `крышка`, `盖板`): what else is there tells them apart."""

from collections.abc import Sequence
from dataclasses import replace

from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.vocabulary import PartLabel

_WORD = "coverplate"  # the English word of `grafu.asset.languages` for all of them


def with_lids_by_name(parts: Sequence[Part]) -> tuple[Part, ...]:
    """Returns the parts with those as lids that are so named where no door or drawer is.

    Beside doors and drawers it is the top of their case, or a lid: that is left to its shape.
    """
    if any(part.label.is_movable for part in parts):
        return tuple(parts)
    return tuple(_lid(part) for part in parts)


def _lid(part: Part) -> Part:
    if part.label is not PartLabel.UNKNOWN or _WORD not in spoken(part.source.name):
        return part
    return replace(part, label=PartLabel.DOOR, labelled_by="name")
