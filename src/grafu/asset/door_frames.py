"""What is called a door but stands around doors is their frame. It looks at names and shapes, in any frame of axes.

A leaf has a rail at its bottom, below its pane. The frame of a door in a wall has none: a leaf in it reaches the floor.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.labels import is_opening, is_piece
from grafu.asset.names import spoken
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.box import Box, overlap_across
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.raycast import RayCaster, covered_ratio
from grafu.vocabulary import PartLabel

_RAYS = 12  # along each side of a leaf


@final
@dataclass(frozen=True, slots=True)
class FramedDoorsConfig:
    """What is a frame around doors.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    spare: float = 0.01
    """How far a leaf may stand out of its frame's outline (fraction of the frame's largest side)."""
    open: float = 0.1
    """What of a leaf its frame covers at most (fraction of rays)."""
    filled: float = 0.6
    """What several leaves take of their frame's outline (fraction)."""
    apart: float = 0.1
    """What two leaves share at most (fraction of the smaller outline)."""
    sill: float = 0.02
    """A leaf reaches the open end of its frame up to this (fraction of the frame's side) ..."""
    post: float = 0.01
    """... and the three other sides of the frame are at least as wide (fraction of that side)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_door_frames(
    parts: tuple[Part, ...], config: FramedDoorsConfig = FramedDoorsConfig()
) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts with frames around doors, which were called doors as well, as frames; and notes on that.

    A frame is open before the doors that stand in it. It holds several that fill it, or one that reaches one of its
    ends, or doors that the input states to open, which it does not of the frame. What is called the frame of a door may
    also hold one door that reaches none of its ends, where it has a threshold, and leaves that no name tells: these
    fill it, and reach one of its ends.
    """
    doors = [part for part in parts if part.label is PartLabel.DOOR]
    nameless = [part for part in parts if part.label is PartLabel.UNKNOWN]
    frames = {door.id for door in doors if len(doors) > 1 and _is_frame(door, doors, config)}
    called = [door for door in doors if "frame" in spoken(door.source.name)]
    frames |= {door.id for door in called if _is_open(door, nameless, config) or _has_threshold(door, doors, config)}
    notes = [f"{p.source.name} stands around doors: taken for their frame" for p in parts if p.id in frames]
    return tuple(
        replace(part, label=PartLabel.FACE_FRAME, labelled_by="shape") if part.id in frames else part for part in parts
    ), notes


def _is_frame(door: Part, doors: Sequence[Part], config: FramedDoorsConfig) -> bool:
    box, thin = door.box, door.box.thin_axis
    leaves = _leaves_in(door, doors, config)
    if any(is_opening(leaf.source.name) for leaf in leaves) and not is_opening(door.source.name):
        return True
    outer = [leaf.box for leaf in leaves if not any(_lies_in(leaf, other, thin) for other in leaves)]
    return _fill([*outer], box, thin, config) if len(outer) > 1 else any(_ends_in(leaf, box, config) for leaf in outer)


def _has_threshold(frame: Part, doors: Sequence[Part], config: FramedDoorsConfig) -> bool:
    """Whether a door fills what is called the frame of one: a "door frame", which a "frame door" is not."""
    leaves = _leaves_in(frame, doors, config) if spoken(frame.source.name)[-1] == "frame" else []
    return any(_fill([leaf.box], frame.box, frame.box.thin_axis, config) for leaf in leaves)


def _is_open(frame: Part, nameless: Sequence[Part], config: FramedDoorsConfig) -> bool:
    """Whether parts that no name tells stand in a frame, fill it together, and reach one of its ends."""
    box, thin = frame.box, frame.box.thin_axis
    leaves = [leaf.box for leaf in _leaves_in(frame, nameless, config)]
    return bool(leaves) and _fill(leaves, box, thin, config) and _ends_in(Box.enclosing(leaves), box, config)


def _leaves_in(frame: Part, parts: Sequence[Part], config: FramedDoorsConfig) -> list[Part]:
    """Returns what stands in a frame, and what that does not cover; pieces of doors are no leaves."""
    box = frame.box
    around = box.grown(config.spare * float(box.size.max()))
    whole = [part for part in parts if part is not frame and not is_piece(part.source.name)]
    within = [part for part in whole if around.contains(part.box.corners()).all()]
    if not within:
        return []
    rays = RayCaster(frame.mesh)
    return [p for p in within if covered_ratio(rays, p.box, box.thin_axis, _RAYS, box.diagonal) <= config.open]


def _lies_in(leaf: Part, other: Part, thin: int) -> bool:
    across = np.delete(np.arange(3), thin)
    low, high = other.box.low[across], other.box.high[across]
    inside = np.all(leaf.box.low[across] >= low) and np.all(leaf.box.high[across] <= high)
    return leaf is not other and bool(inside)


def _fill(leaves: Sequence[Box], frame: Box, thin: int, config: FramedDoorsConfig) -> bool:
    """Whether leaves lie beside each other, and fill a frame."""
    across = np.delete(np.arange(3), thin)
    covered = sum(float(np.prod(leaf.size[across])) for leaf in leaves)
    is_full = covered >= config.filled * float(np.prod(frame.size[across]))
    return is_full and not overlap_across(leaves, across.tolist(), config.apart)


def _ends_in(leaf: Box, frame: Box, config: FramedDoorsConfig) -> bool:
    """Whether a leaf reaches one end of its frame, and stands off the other three sides of it."""
    across = np.delete(np.arange(3), frame.thin_axis)
    gaps = np.concatenate([leaf.low - frame.low, frame.high - leaf.high]).reshape(2, 3)[:, across] / frame.size[across]
    return int((gaps <= config.sill).sum()) == 1 and int((gaps >= config.post).sum()) == 3
