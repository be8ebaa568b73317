"""What interiors are asked for, and how the command spells it: none, auto, predicted, or `shelves=2,dividers=1`."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import final

MOST_PANELS = 20
"""Most panels of one kind in one compartment; more is a typing error."""
SPELLING = (
    f"`none`, `auto`, `predicted`, `shelves=N`, `dividers=N` or `shelves=N,dividers=N` with N from 0 to {MOST_PANELS}"
)
ITEM = re.compile(r"(shelves|dividers)=(\d{1,4})")


class InteriorKind(StrEnum):
    """Who decides what a compartment gets."""

    NONE = "none"  # nothing is added
    AUTO = "auto"  # its size does
    PREDICTED = "predicted"  # the completed graph does: its new shelves and dividers
    COUNTED = "counted"  # the user does: so many of each


@final
@dataclass(frozen=True, slots=True)
class InteriorRequest:
    """What every compartment is to get; the counts are of `counted` alone, existing shelves and dividers included.

    Raises:
        ValueError: if a count is not in 0..20, or a kind other than `counted` has one.
    """

    kind: InteriorKind
    shelves: int = 0
    dividers: int = 0

    def __post_init__(self) -> None:
        if not (0 <= self.shelves <= MOST_PANELS and 0 <= self.dividers <= MOST_PANELS):
            raise ValueError(
                f"`InteriorRequest` must count 0 to {MOST_PANELS} of each: got {self.shelves}, {self.dividers}"
            )
        if self.kind is not InteriorKind.COUNTED and (self.shelves or self.dividers):
            raise ValueError(f"only `counted` requests count shelves and dividers: got {self}")

    def __str__(self) -> str:
        if self.kind is not InteriorKind.COUNTED:
            return self.kind.value
        counts = (("shelves", self.shelves), ("dividers", self.dividers))
        return ",".join(f"{name}={count}" for name, count in counts if count) or "shelves=0"


NOTHING = InteriorRequest(InteriorKind.NONE)
AUTO = InteriorRequest(InteriorKind.AUTO)
PREDICTED = InteriorRequest(InteriorKind.PREDICTED)
NO_CHOICES: Mapping[int, "CompartmentChoice"] = MappingProxyType({})


@final
@dataclass(frozen=True, slots=True)
class CompartmentChoice:
    """What one compartment is to get, whatever is asked for the others; sizes are metres (None: as everywhere).

    Raises:
        ValueError: if a count is not in 0..20, or a size is not positive.
    """

    shelves: int = 0
    dividers: int = 0
    thickness: float | None = None
    inset: float | None = None

    def __post_init__(self) -> None:
        if not (0 <= self.shelves <= MOST_PANELS and 0 <= self.dividers <= MOST_PANELS):
            raise ValueError(f"`CompartmentChoice` must count 0 to {MOST_PANELS}: got {self.shelves}, {self.dividers}")
        if (self.thickness is not None and not self.thickness > 0) or not (self.inset or 0.0) >= 0:
            raise ValueError(f"`CompartmentChoice` needs sizes above 0: got {self.thickness}, {self.inset}")


def parse_interior(text: str) -> InteriorRequest:
    """Returns the request that a word of the command line spells.

    Raises:
        ValueError: if it spells none; the message is one line that states what was given and what is expected.
    """
    word = text.strip().lower().replace(" ", "")
    if word in (InteriorKind.NONE, InteriorKind.AUTO, InteriorKind.PREDICTED):
        return InteriorRequest(InteriorKind(word))
    found = [ITEM.fullmatch(item) for item in word.split(",")]
    counts = {match[1]: int(match[2]) for match in found if match}
    if None in found or len(counts) < len(found) or max(counts.values()) > MOST_PANELS:
        raise ValueError(f"`interior` must be {SPELLING}: got {text!r}")
    return InteriorRequest(InteriorKind.COUNTED, counts.get("shelves", 0), counts.get("dividers", 0))
