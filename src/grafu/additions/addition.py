"""A part that the input did not have, as a step of the additions returns it."""

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import final

from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Addition:
    """A new part at rest in the object frame, why it was added, and in which style (a template's id, an outline).

    `part.rides_on` is the door or drawer that it is fixed to; None: it is static.
    """

    part: Part
    why: str
    style: str = ""


def added_part(part_id: str, label: PartLabel, surfaces: Sequence[Surface], rides_on: str | None = None) -> Part:
    """Returns a part that the input did not have."""
    return Part(part_id, label, tuple(surfaces), PartSource(""), "added", rides_on)


def free_ids(stem: str, count: int, taken: Collection[str]) -> tuple[str, ...]:
    """Returns `count` ids that no part has: the stem itself if one is enough and it is free, else with numbers."""
    if count == 1 and stem not in taken:
        return (stem,)
    found: list[str] = []
    number = 1
    while len(found) < count:
        if (name := f"{stem}_{number}") not in taken:
            found.append(name)
        number += 1
    return tuple(found)
