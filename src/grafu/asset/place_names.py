"""Names that state a place or a material alone (`front`, `left`, `mirror`), held against shapes. It reads no files.

A single `front` is a fixed board, unless a handle sits on it alone; several are the fronts of doors and drawers
(`A1_front1`, `A1_front2`). A `left` and
a `right` are the sides of a case where they stand opposite each other; two plates beside each other are two doors.
What is called a `frame` is that of a door where a handle sits on it, and on no door or drawer; so is a mirror or a pane
of glass a door where a handle sits on it alone, and what is called a bar and is as wide as a leaf.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import final

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.vocabulary import PartLabel

_FRONTS = (("front",), ("fronts",))
_BOARDS = {"front", "fronts", "fascia"}
_FIXED = {"false", "fixed", "blind", "dummy", "frame"}
_SIDES = (("left",), ("right",))
_FRAMES = (("frame",), ("frames",))
_PANES = {"mirror", "glass", "pane"}


@final
@dataclass(frozen=True, slots=True)
class PlaceNamesConfig:
    """Which parts that are called by a place lie beside each other.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    plate: float = 0.25
    """Largest thickness of a plate (fraction of its next side)."""
    touch: float = 0.01
    """How far a handle may stand off the frame that it sits on (fraction of the frame's largest side)."""

    leaf: float = 0.4
    """How wide a plate called a bar is at least to be no bar (fraction of its length)."""

    filled: float = 0.6
    """Leaves in a frame take this much of its outline at least (fraction)."""

    def __post_init__(self) -> None:
        require_ratios(self, "plate", "touch", "leaf", "filled")


def with_place_names(
    parts: tuple[Part, ...], config: PlaceNamesConfig = PlaceNamesConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts, those without a label whose names state a place and no more than that, and notes on that."""
    fronts = [part for part in parts if _is_called(part, _FRONTS, PartLabel.FACE_FRAME)]
    opened = {part.id for part in fronts} if len(fronts) > 1 else set()
    boards = [part for part in parts if _is_front_board(part)]
    opened |= {part.id for part in boards if _is_held(part, parts, config, alone=True)}
    sides = [part for part in parts if _is_called(part, _SIDES, PartLabel.SIDE_PANEL)]
    leaves = _beside_each_other([part for part in sides if _is_plate(part, config)])
    opened |= leaves and leaves | {part.id for part in sides if not _is_plate(part, config)}
    frames = [part for part in parts if _is_called(part, _FRAMES, PartLabel.FACE_FRAME)]
    held = {p.id for p in frames if _is_held(p, parts, config) and not _is_around_leaves(p, parts, config)}
    opened_by = [part for part in parts if _is_pane(part) or _is_wide_bar(part, config)]
    held |= {part.id for part in opened_by if _is_held(part, parts, config, alone=True)}
    found = (replace(p, label=PartLabel.UNKNOWN, labelled_by="none") if p.id in opened else p for p in parts)
    found = (replace(p, label=PartLabel.DOOR, labelled_by="shape") if p.id in held else p for p in found)
    notes = [f"{p.source.name} is a door: a handle sits on it" for p in parts if p.id in held]
    notes += [f"{p.source.name} states a place alone: its shape decides what it is" for p in parts if p.id in opened]
    return tuple(found), notes


def _is_called(part: Part, names: Sequence[tuple[str, ...]], label: PartLabel) -> bool:
    return part.labelled_by == "name" and part.label is label and spoken(part.source.name) in names


def _is_front_board(part: Part) -> bool:
    """Whether a name tells of a board in front, and not that it is fixed: `front_panel`, `fascia_2`."""
    said = {*spoken(part.source.name)}
    is_frame = part.labelled_by == "name" and part.label is PartLabel.FACE_FRAME
    return is_frame and bool(said & _BOARDS) and not said & _FIXED


def _is_plate(part: Part, config: PlaceNamesConfig) -> bool:
    sides = np.sort(part.box.size)
    return bool(sides[0] <= config.plate * sides[1])


def _is_pane(part: Part) -> bool:
    return part.labelled_by == "name" and part.label is PartLabel.MISC and bool(_PANES & {*spoken(part.source.name)})


def _is_wide_bar(part: Part, config: PlaceNamesConfig) -> bool:
    """Whether a name tells of a bar, and the part is as wide as a leaf: the frame of a door, called by its rails."""
    sides = np.sort(part.box.size)
    is_bar = part.labelled_by == "name" and part.label is PartLabel.BAR
    return is_bar and bool(sides[1] >= config.leaf * sides[2])


def _is_held(part: Part, parts: Sequence[Part], config: PlaceNamesConfig, alone: bool = False) -> bool:
    """Whether a handle sits on a plate and on no door or drawer; `alone`: on nothing else."""
    reach = config.touch * float(part.box.size.max())
    handles = [p.box for p in parts if p.label is PartLabel.HANDLE and p.box.overlaps(part.box, reach)]
    near = [p for p in parts if p is not part and (p.label.is_movable or (alone and p.label is not PartLabel.HANDLE))]
    free = [box for box in handles if not any(box.overlaps(other.box, reach) for other in near)]
    return bool(free) and _is_plate(part, config)


def _is_around_leaves(frame: Part, parts: Sequence[Part], config: PlaceNamesConfig) -> bool:
    """Whether several plates without a label, side by side, fill the outline of a frame: it is that of a window."""
    axis, box = frame.box.thin_axis, frame.box
    across = [k for k in range(3) if k != axis]
    inside = [
        p.box
        for p in parts
        if p is not frame and p.label is PartLabel.UNKNOWN and p.box.thin_axis == axis and _is_plate(p, config)
    ]
    inside = [
        b for b in inside if (b.low[across] >= box.low[across]).all() and (b.high[across] <= box.high[across]).all()
    ]
    apart = all(a.axis_gaps(b)[across].max() >= 0 for a, b in combinations(inside, 2))
    area = sum(float(np.prod(b.size[across])) for b in inside)
    return len(inside) > 1 and apart and area >= config.filled * float(np.prod(box.size[across]))


def _beside_each_other(plates: Sequence[Part]) -> set[str]:
    """Returns which plates called `left` lie in one plane with one called `right`, and those."""
    found: set[str] = set()
    for one in plates:
        across = one.box.thin_axis
        for other in plates:
            is_pair = spoken(one.source.name) != spoken(other.source.name) and other.box.thin_axis == across
            if is_pair and one.box.axis_gaps(other.box)[across] < 0:
                found |= {one.id, other.id}
    return found
