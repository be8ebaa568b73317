"""One mesh that holds the handles of several doors and drawers becomes a part for each. It settles no frame."""

from collections.abc import Collection
from dataclasses import replace

import numpy as np

from grafu.asset.loose import loose_parts
from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

_REACH = 0.01  # of the whole's largest side: how far a handle may stand off its front


def with_split_handles(parts: tuple[Part, ...]) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts, each handle whose shells lie on several doors and drawers split between them, and notes.

    Every shell goes to the door or drawer that is nearest to its middle. A handle in one piece stays whole.
    """
    fronts = [part for part in parts if part.label.is_movable]
    if len(fronts) < 2:
        return parts, []
    reach = _REACH * float(Box.enclosing(part.box for part in parts).size.max())
    taken = {part.id for part in parts}
    found: list[Part] = []
    notes: list[str] = []
    for part in parts:
        pieces = _split(part, fronts, reach, taken) if part.label is PartLabel.HANDLE and part.rides_on is None else []
        found += pieces or [part]
        taken |= {piece.id for piece in pieces}
        if pieces:
            notes.append(f"{part.source.name} serves {len(pieces)} doors and drawers: split between them")
    return tuple(found), notes


def _split(handle: Part, fronts: list[Part], reach: float, taken: Collection[str]) -> list[Part]:
    """Returns the handle in a piece for each front that it serves, empty where it serves one or is one piece."""
    near = [front for front in fronts if front.box.overlaps(handle.box, reach)]
    shells = loose_parts([handle]) if len(near) > 1 else ()
    if len(shells) < 2:
        return []
    ratios: dict[str, list[Part]] = {}
    for shell in shells:
        ratios.setdefault(min(near, key=lambda front: _distance(shell.box, front.box)).id, []).append(shell)
    if len(ratios) < 2:
        return []
    names = (name for k in range(1, 10_000) if (name := f"{handle.id}_{k}") not in taken)
    return [
        replace(handle, id=name, surfaces=tuple(s for shell in of for s in shell.surfaces), rides_on=front)
        for name, (front, of) in zip(names, ratios.items(), strict=False)
    ]


def _distance(shell: Box, front: Box) -> float:
    """Returns how far the middle of a box lies from another box."""
    return float(np.linalg.norm(np.maximum(np.maximum(front.low - shell.center, shell.center - front.high), 0.0)))
