"""Leaves that are drawn in several boards: strips along all four sides of an infill, and thin fields on a panel.

It looks at labels and boxes, in any frame of axes. What fills its frame without a seam is no door in a face frame: a
door is as thick as the frame that it hangs in. What lies on a panel is no door on it: a door is no thinner, and seldom
in its middle.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.asset.part import Part
from grafu.asset.pieces import in_words, with_pieces
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.vocabulary import PartLabel

_OTHERS: Final = frozenset({PartLabel.DRAWER, PartLabel.HANDLE, PartLabel.LEG, PartLabel.SHELF})


@final
@dataclass(frozen=True, slots=True)
class FramedLeafConfig:
    """Which boards are the frame of which panel.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    touch: float = 0.0006
    """How far apart the boards of a leaf lie at most (fraction of the diagonal of all)."""
    plate: float = 0.1
    """Greatest thickness of an infill (fraction of its shorter other side) ..."""
    leaf: float = 0.25
    """... and of a strip and of the leaf as a whole (the same): what is deeper is a carcass."""
    along: float = 0.8
    """A strip runs along at least this much of the infill's side (fraction) ..."""
    wide: float = 0.5
    """... and is as wide as this at most (fraction of the infill's other side)."""
    thinner: float = 0.8
    """Greatest thickness of an infill (fraction of its frame's): a door in a face frame is as thick as that ..."""
    band: float = 0.03
    """... but an infill may be if its strips are bands, no wider than this (fraction of the infill's other side)."""
    edge: float = 3.0
    """Greatest thickness of a strip (multiple of its width) ..."""
    deep: float = 2.0
    """... unless it is no thicker than this (multiple of the infill's thickness) ..."""
    folded: float = 0.12
    """... or than this, as the folded edges of a front of sheet metal are (fraction of the infill's shorter other
    side): boards of a case stand on edge, too."""
    field: float = 0.2
    """Least face of a thin field on a panel (fraction of the panel's) ..."""
    middle: float = 0.05
    """... and how far it lies from the middle of the panel at most (fraction of the panel's side)."""

    def __post_init__(self) -> None:
        require_positive(self, "edge", "deep")
        require_ratios(self, *(set(self.__dataclass_fields__) - {"edge", "deep"}))


def with_framed_leaves(
    parts: tuple[Part, ...], whole: Box, config: FramedLeafConfig = FramedLeafConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts in which the boards of a framed leaf are one part each, and notes on that.

    A leaf is a door where one of its boards is called so. Otherwise it has no label where it has a handle, or where one
    of its boards has no label; panelling of labelled boards without a handle stays as it is.

    Args:
        parts: labelled parts in any one frame.
        whole: the box around them, for tolerances.
        config: the tolerances.
    """
    touch = config.touch * whole.diagonal
    boards = [part for part in parts if part.label not in _OTHERS and part.carried_by is None]
    handles = [part.box for part in parts if part.label is PartLabel.HANDLE]
    members: dict[str, list[Part]] = {}
    for leaf in _leaves(boards, touch, config):
        face = max(leaf, key=lambda part: float(np.prod(np.sort(part.box.size)[1:])))
        label = _label(leaf, handles, touch)
        around = Box.enclosing(part.box for part in leaf)
        if label is None or around.size.min() > config.leaf * np.sort(around.size)[1]:
            continue
        members[face.id] = [replace(face, label=label), *(part for part in leaf if part is not face)]
    joined = {piece.id: face for face, (_, *pieces) in members.items() for piece in pieces}
    kept = tuple(_joined(part, members, joined) for part in parts if part.id not in joined)
    notes = [f"{in_words(pieces)} joined to {face}, which they frame" for face, (_, *pieces) in members.items()]
    return kept, notes


def _joined(part: Part, members: dict[str, list[Part]], joined: dict[str, str]) -> Part:
    if part.id not in members:
        return with_pieces(part, (), joined)
    face, *pieces = members[part.id]
    made = with_pieces(face, pieces, joined)
    return replace(made, labelled_by="none") if face.label is PartLabel.UNKNOWN else replace(made, labelled_by="name")


def _label(leaf: Sequence[Part], handles: Sequence[Box], touch: float) -> PartLabel | None:
    """Returns what the boards of a leaf are together; None where they are no leaf that moves."""
    labels = {part.label for part in leaf}
    if PartLabel.DOOR in labels:
        return PartLabel.DOOR
    is_held = any(part.box.overlaps(handle, touch) for part in leaf for handle in handles)
    return PartLabel.UNKNOWN if is_held or PartLabel.UNKNOWN in labels else None


def _leaves(boards: Sequence[Part], touch: float, config: FramedLeafConfig) -> Iterator[list[Part]]:
    """Yields the boards of each leaf; infills that have a strip in common lie in one."""
    leaves: list[list[Part]] = []
    for infill in boards:
        size = np.sort(infill.box.size)
        is_plate = size[0] <= config.plate * size[1]
        frame = [*_frame(infill, boards, touch, config), *_fields(infill, boards, touch, config)] if is_plate else []
        if not frame:
            continue
        leaf, apart = [infill, *{part.id: part for part in frame}.values()], list[list[Part]]()
        for other in leaves:
            if any(a is b for a in other for b in leaf):
                leaf += [part for part in other if not any(part is one for one in leaf)]
            else:
                apart.append(other)
        leaves = [*apart, leaf]
    yield from leaves


def _frame(infill: Part, boards: Sequence[Part], touch: float, config: FramedLeafConfig) -> list[Part]:
    """Returns the strips along all four sides of an infill; empty where a side has none, or where it is a door."""
    box, axis = infill.box, infill.box.thin_axis
    near = [
        part
        for part in boards
        if part is not infill
        and part.box.overlaps(box, touch)
        and part.box.size[axis] <= config.leaf * np.delete(box.size, axis).min()
    ]
    sides = [
        [part for part in near if _is_strip(part.box, box, (side, along), is_upper, touch, config)]
        for side, along in _sides(axis)
        for is_upper in (False, True)
    ]
    if not all(sides):
        return []
    strips = list({part.id: part for found in sides for part in found}.values())
    if any(_stands_on_edge(part.box, box, axis, config) for part in strips):
        return []
    is_thin = all(box.size[axis] <= config.thinner * part.box.size[axis] for part in strips)
    return strips if is_thin or all(_is_band(part.box, box, axis, config) for part in strips) else []


def _fields(panel: Part, boards: Sequence[Part], touch: float, config: FramedLeafConfig) -> list[Part]:
    """Returns the thin plates that lie on a panel without a label or a door's, in the middle of its face."""
    if panel.label not in (PartLabel.UNKNOWN, PartLabel.DOOR):
        return []
    box, axis = panel.box, panel.box.thin_axis
    across = np.delete(np.arange(3), axis)

    def is_field(field: Box) -> bool:
        gap = max(field.low[axis] - box.high[axis], box.low[axis] - field.high[axis])
        if abs(gap) > touch or field.thin_axis != axis or field.size[axis] > config.thinner * box.size[axis]:
            return False
        is_within = np.all(field.low[across] >= box.low[across]) and np.all(field.high[across] <= box.high[across])
        is_middle = np.all(np.abs((field.center - box.center)[across]) <= config.middle * box.size[across])
        covers = np.prod(field.size[across]) >= config.field * np.prod(box.size[across])
        return bool(is_within and is_middle and covers)

    movable = (PartLabel.UNKNOWN, PartLabel.DOOR, PartLabel.MISC)
    return [part for part in boards if part is not panel and part.label in movable and is_field(part.box)]


def _sides(axis: int) -> tuple[tuple[int, int], tuple[int, int]]:
    first, second = (k for k in range(3) if k != axis)
    return (first, second), (second, first)


def _is_strip(
    strip: Box, box: Box, axes: tuple[int, int], is_upper: bool, touch: float, config: FramedLeafConfig
) -> bool:
    """Whether a board runs along one side of an infill, over its border."""
    side, along = axes
    border = float((box.high if is_upper else box.low)[side])
    shared = min(strip.high[along], box.high[along]) - max(strip.low[along], box.low[along])
    is_at_border = strip.low[side] - touch <= border <= strip.high[side] + touch
    is_slim = strip.size[side] <= config.wide * box.size[side]
    return bool(is_at_border and is_slim and shared >= config.along * box.size[along])


def _stands_on_edge(strip: Box, infill: Box, axis: int, config: FramedLeafConfig) -> bool:
    width, side = (float(np.delete(box.size, axis).min()) for box in (strip, infill))
    return float(strip.size[axis]) > max(
        config.edge * width, config.deep * float(infill.size[axis]), config.folded * side
    )


def _is_band(strip: Box, box: Box, axis: int, config: FramedLeafConfig) -> bool:
    return any(strip.size[side] <= config.band * box.size[side] for side, _ in _sides(axis))
