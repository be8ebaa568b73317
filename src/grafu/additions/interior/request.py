"""What interiors are asked for, and how the command spells it: none, auto, predicted, or `shelves=2,dividers=1`.

Shelves may slope down to the front (`shelves=3,angle=20deg`), as those of shoe cabinets do. `carousel=2` asks for round
trays on a post instead.
"""

import re
from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType
from typing import final

from grafu.dataclass import dataclass

MOST_PANELS = 20
"""Most panels of one kind in one compartment; more is a typing error."""
MOST_TRAYS = 8
"""Most trays of a carousel."""
MOST_ANGLE = 45.0
"""Steepest slope of shelves, degrees: things slide off steeper ones whatever holds them."""
SPELLING = (
    f"`none`, `auto`, `predicted`, `shelves=N`, `dividers=N` or `shelves=N,dividers=N` with N from 0 to {MOST_PANELS}, "
    f"shelves also with `angle=DEG` from 0 to {MOST_ANGLE:g}, or `carousel=N` with N from 1 to {MOST_TRAYS}"
)
ITEM = re.compile(r"(shelves|dividers)=(\d{1,4})")
TRAYS = re.compile(r"carousel=(\d{1,4})")
ANGLE = re.compile(r"angle=(\d{1,2}(?:\.\d{1,6})?)(?:deg)?")


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

    The front edges of shelves lie lower by `angle_deg`. With `trays` there is a carousel of so many, and nothing else.

    Raises:
        ValueError: if a count is not in 0..20 (of trays 0..8), a kind other than `counted` has one, there are trays and
            shelves, or the angle has no shelf or is not in 0..45.
    """

    kind: InteriorKind
    shelves: int = 0
    dividers: int = 0
    angle_deg: float = 0.0
    trays: int = 0

    def __post_init__(self) -> None:
        if not 0 <= self.trays <= MOST_TRAYS or (self.trays and (self.shelves or self.dividers)):
            raise ValueError(f"`InteriorRequest.trays` must be 0 to {MOST_TRAYS}, without panels: got {self}")
        if not 0 <= self.angle_deg <= MOST_ANGLE or (self.angle_deg and not self.shelves):
            raise ValueError(
                f"`InteriorRequest.angle_deg` must be 0 to {MOST_ANGLE:g}, of shelves: got {self.angle_deg}"
            )
        if not (0 <= self.shelves <= MOST_PANELS and 0 <= self.dividers <= MOST_PANELS):
            raise ValueError(
                f"`InteriorRequest` must count 0 to {MOST_PANELS} of each: got {self.shelves}, {self.dividers}"
            )
        if self.kind is not InteriorKind.COUNTED and (self.shelves or self.dividers or self.trays):
            raise ValueError(f"only `counted` requests count shelves and dividers: got {self}")

    def __str__(self) -> str:
        if self.kind is not InteriorKind.COUNTED:
            return self.kind.value
        if self.trays:
            return f"carousel={self.trays}"
        counts = (("shelves", self.shelves), ("dividers", self.dividers))
        words = [f"{name}={count}" for name, count in counts if count]
        if self.angle_deg:
            words.append(f"angle={self.angle_deg:g}deg")
        return ",".join(words) or "shelves=0"


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
    if (stated := TRAYS.fullmatch(word)) and 1 <= int(stated[1]) <= MOST_TRAYS:
        return InteriorRequest(InteriorKind.COUNTED, trays=int(stated[1]))
    items = word.split(",")
    angles = [match for match in map(ANGLE.fullmatch, items) if match]
    found = [ITEM.fullmatch(item) for item in items if not ANGLE.fullmatch(item)]
    counts = {match[1]: int(match[2]) for match in found if match}
    angle = float(angles[0][1]) if angles else 0.0
    is_sound = None not in found and len(counts) == len(found) > 0 and len(angles) <= 1
    if (
        not is_sound
        or max(counts.values()) > MOST_PANELS
        or angle > MOST_ANGLE
        or (angles and not counts.get("shelves"))
    ):
        raise ValueError(f"`interior` must be {SPELLING}: got {text!r}")
    return InteriorRequest(InteriorKind.COUNTED, counts.get("shelves", 0), counts.get("dividers", 0), angle)
