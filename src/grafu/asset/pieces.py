"""Loose pieces of doors and drawers become one part each, by where they lie. It reads no names but to tell pieces.

A drawer's sides, back and bottom belong to the `front` whose outline, seen along its thin axis, covers them; a door's
pane or panel belongs to the larger door piece around it. Pieces that no front covers stay parts of their own.
"""

from dataclasses import replace

import numpy as np

from grafu.asset.labels import is_piece
from grafu.asset.names import words
from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.vocabulary import PartLabel

# Shares of the object's diagonal: how far a piece may stand out of the outline, and how far it may lie from it.
_STAND_OUT, _TOUCH = 0.01, 0.004


def with_joined_pieces(parts: tuple[Part, ...], whole: Box) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts of an unannotated input with the pieces of one door or drawer joined, and notes on that.

    Args:
        parts: labelled parts in any one frame.
        whole: the box around them, for tolerances.
    """
    hosts: dict[str, list[Part]] = {}
    for label in (PartLabel.DRAWER, PartLabel.DOOR):
        pieces = [p for p in parts if p.label is label and is_piece(p.source.name)]
        for piece, host in _pairs(pieces, label, whole.diagonal):
            hosts.setdefault(host.id, []).append(piece)
    joined = {piece.id: host for host, members in hosts.items() for piece in members}
    kept = tuple(_joined(p, hosts.get(p.id, []), joined) for p in parts if p.id not in joined)
    notes = [f"{_names(members)} joined to {host}" for host, members in hosts.items()]
    return kept, notes


def _pairs(pieces: list[Part], label: PartLabel, size: float) -> list[tuple[Part, Part]]:
    fronts = [p for p in pieces if label is PartLabel.DOOR or {"front", "face"} & set(words(p.source.name))]
    ranked = sorted(fronts, key=lambda p: -_face_area(p.box))
    pairs: list[tuple[Part, Part]] = []
    taken: set[str] = set()
    for piece in sorted(pieces, key=lambda p: _face_area(p.box)):
        others = [f for f in ranked if f.id not in taken and f is not piece]
        host = _host(piece, others, size) if label is PartLabel.DOOR or piece not in fronts else None
        if host is not None:
            pairs.append((piece, host))
            taken.add(piece.id)
    return _followed(pairs)


def _followed(pairs: list[tuple[Part, Part]]) -> list[tuple[Part, Part]]:
    """Returns the pairs with each host replaced by the piece that the host itself was joined to, if any."""
    host_of = {piece.id: host for piece, host in pairs}

    def last(host: Part) -> Part:
        return last(host_of[host.id]) if host.id in host_of else host

    return [(piece, last(host)) for piece, host in pairs]


def _host(piece: Part, fronts: list[Part], size: float) -> Part | None:
    """Returns the front that covers the piece, the nearest of several, or None."""
    covering = [
        f for f in fronts if _covers(f.box, piece.box, size) and _face_area(f.box) >= _face_area(piece.box) * 0.2
    ]
    near = {f.id: float(f.box.axis_gaps(piece.box)[f.box.thin_axis]) for f in covering}
    best = min(covering, key=lambda f: max(near[f.id], 0.0), default=None)
    if best is None or (best.label is PartLabel.DOOR and near[best.id] > _TOUCH * size):
        return None
    return best


def _covers(front: Box, piece: Box, size: float) -> bool:
    wide = np.delete(np.arange(3), front.thin_axis)
    margin = _STAND_OUT * size
    inside = (piece.low >= front.low - margin) & (piece.high <= front.high + margin)
    return bool(inside[wide].all())


def _face_area(box: Box) -> float:
    first, second = np.sort(box.size)[1:]
    return float(first * second)


def _joined(part: Part, members: list[Part], joined: dict[str, str]) -> Part:
    surfaces = part.surfaces + tuple(s for m in members for s in m.surfaces)
    return replace(part, surfaces=surfaces, rides_on=joined.get(part.rides_on or "", part.rides_on))


def _names(members: list[Part]) -> str:
    names = ", ".join(m.source.name for m in members[:4])
    return names if len(members) <= 4 else f"{names} and {len(members) - 4} more"
