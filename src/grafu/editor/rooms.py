"""How far the handles that were added to a moving part can be moved over it, for the page and for the server."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final

import numpy as np

from grafu.geometry.box import Box

Range = tuple[float, float]
Room = tuple[Range, Range]
_AXES: Final = (0, 2)  # aside is X, up is Z


def room_on(fronts: Sequence[Box], handles: Sequence[Box], *, is_upright: bool, offset: Range = (0.0, 0.0)) -> Room:
    """Returns the least and the greatest offset of handles, aside and up, that keep all of them on their front, metres.

    Args:
        fronts: the pieces of the input that move as one body.
        handles: the handles on it as they were built.
        is_upright: whether it stands upright and looks to the front. On another, each way is its longest side.
        offset: that of the handles as they were built.
    """
    if is_upright:
        across = (_across(fronts, handles, axis) for axis in _AXES)
    else:
        longest = max(float(one.size.max()) for one in fronts)
        across = ((-longest, longest) for _ in _AXES)
    aside, up = ((by + least, by + most) for by, (least, most) in zip(offset, across, strict=True))
    return aside, up


def _across(fronts: Sequence[Box], handles: Sequence[Box], axis: int) -> Range:
    """Returns how far all handles can be moved along an axis; a handle that is as long as its front stays."""
    front, handle = Box.enclosing(fronts), Box.enclosing(handles)
    low, high = float(front.low[axis] - handle.low[axis]), float(front.high[axis] - handle.high[axis])
    return (low, high) if low < high else (0.0, 0.0)


def rooms_on(
    items: Iterable[Mapping[str, Any]], handles: Mapping[str, str], upright: Iterable[str], offsets: Mapping[str, Range]
) -> dict[str, Room]:
    """Returns by moving part the room of the handles that were added to it.

    Args:
        items: those of the view, see `grafu.viewer.scene_data`.
        handles: by added handle the moving part that it is on.
        upright: moving parts that stand upright and look to the front.
        offsets: how far handles were moved already, by moving part.
    """
    pieces: dict[int, list[Box]] = {}
    added: dict[str, tuple[int, list[Box]]] = {}
    for item in items:
        if item["box"] is None:
            continue
        box = Box(*(np.array(corner, float) for corner in item["box"]))
        if item["role"] == "part":
            pieces.setdefault(item["link"], []).append(box)
        elif item["role"] == "added" and item["name"] in handles:
            added.setdefault(handles[item["name"]], (item["link"], []))[1].append(box)
    stands = set(upright)
    return {
        part: room_on(pieces[link], found, is_upright=part in stands, offset=offsets.get(part, (0.0, 0.0)))
        for part, (link, found) in added.items()
        if link in pieces
    }
