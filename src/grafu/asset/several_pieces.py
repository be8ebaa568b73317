"""Pieces of furniture that were settled one by one, put back as one asset: each keeps how it stands."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.part import Asset, Frame, Part, Standing
from grafu.asset.reading import Placing, Reading
from grafu.geometry.arrays import Mat4
from grafu.vocabulary import PartLabel


def put_together(pieces: Sequence[Asset], others: Sequence[Part], reading: Reading, frame: Frame, path: str) -> Asset:
    """Returns one asset in the frame of the whole file.

    Args:
        pieces: the pieces, each in its own frame; `input_to_output` of all starts from the same coordinates.
        others: floors, walls and props, in the input's coordinates: what nothing tells of them is no furniture.
        reading: the whole file: its kind, notes and annotation.
        frame: that of the whole file.
        path: where it was read.
    """
    taken: set[str] = set()
    parts: list[Part] = []
    standings: list[Standing] = []
    notes = list(reading.notes)
    for piece in pieces:
        T: Mat4 = frame.input_to_output @ np.linalg.inv(piece.frame.input_to_output)
        found = _renamed(tuple(_moved(part, T) for part in piece.parts), taken)
        taken |= {part.id for part in found}
        parts += found
        standings.append(Standing(tuple(part.id for part in found), np.linalg.inv(T), piece.frame))
        notes += piece.notes
    place = Placing(frame)
    parts += _renamed(tuple(_as_room(part) for part in place.moved(tuple(others))), taken)
    return Asset(
        pieces[0].name,
        path,
        reading.kind,
        tuple(parts),
        frame,
        notes=tuple(dict.fromkeys(notes)),
        annotation=reading.annotation and place.annotation(reading.annotation),
        standings=tuple(standings),
    )


def _moved(part: Part, T: Mat4) -> Part:
    return replace(part, surfaces=tuple(surface.transformed(T) for surface in part.surfaces))


def _renamed(parts: tuple[Part, ...], taken: set[str]) -> tuple[Part, ...]:
    """Returns the parts with ids that are not taken: pieces that one object was divided into have the same."""
    own = {part.id for part in parts}
    new: dict[str, str] = {}
    for part in parts:
        if part.id in taken:
            number = 2
            while (name := f"{part.id}_{number}") in taken or name in own or name in new.values():
                number += 1
            new[part.id] = name
    return tuple(
        replace(part, id=new.get(part.id, part.id), carried_by=new.get(part.carried_by or "", part.carried_by))
        for part in parts
    )


def _as_room(part: Part) -> Part:
    """Returns a floor, a wall or a prop as what is no furniture, whatever its name told."""
    return replace(part, label=PartLabel.MISC, labelled_by="shape", carried_by=None)
