"""A file that holds several pieces of furniture, told apart: each becomes a reading of its own. It settles no frame.

What is one piece, `grafu.segmentation.furniture_pieces` states.
"""

import re
from collections.abc import Sequence
from dataclasses import replace
from itertools import takewhile
from typing import final

import numpy as np

from grafu.asset.loose import faces_of_part
from grafu.asset.names import safe_id, spoken
from grafu.asset.part import Annotation, Frame, Part
from grafu.asset.reading import Reading
from grafu.dataclass import dataclass
from grafu.errors import AssetError, UnreadableAsset
from grafu.geometry.arrays import distinct
from grafu.geometry.box import Box
from grafu.segmentation.furniture_pieces import ALONE, FLOOR_OR_WALL, SceneShells, furniture_pieces

_NAMED = 4  # objects that a note names
_WORD = re.compile(r"[^\W_]+")


@final
@dataclass(frozen=True)
class FurniturePiece:
    """One piece of furniture of a file: the common name of its objects, empty where they have none, and its parts."""

    name: str
    reading: Reading


def told_apart(reading: Reading, frame: Frame) -> tuple[FurniturePiece, ...]:
    """Returns the pieces of furniture of a file, from left to right; none where it holds floors and walls alone.

    A file of one piece is returned as it is, without the floor and the walls. An object that holds shells of several
    pieces is divided between them.

    Args:
        reading: what was read, with at least one part.
        frame: how it stands as a whole, and its scale.
    """
    shells = SceneShells.of([part.mesh.transformed(frame.input_to_output) for part in reading.parts])
    number = furniture_pieces(shells)
    count = int(number.max()) + 1
    if count == 1 and bool((number == 0).all()):
        return (FurniturePiece("", reading),)
    left_out = (*_left_out(reading, shells, number, FLOOR_OR_WALL), *_left_out(reading, shells, number, ALONE))
    boxes = [shells.box(np.flatnonzero(number == k)) for k in range(count)]
    found = [parts_of(reading, shells, number == k) for k in range(count)]
    names = _common_names(found) if count > 1 else [""] * count
    annotations = _annotations(reading.annotation, frame, boxes)
    notes = [f"piece {k} of {count} of the file (--pieces split)" if count > 1 else "" for k in range(1, count + 1)]
    return tuple(
        FurniturePiece(
            name,
            replace(reading, parts=parts, annotation=stated, notes=(*reading.notes, *filter(None, [note]), *left_out)),
        )
        for name, parts, stated, note in zip(names, found, annotations, notes, strict=True)
    )


def parts_of(reading: Reading, shells: SceneShells, chosen: np.ndarray) -> tuple[Part, ...]:
    """Returns the parts of which some shells are chosen, with these alone."""
    of = {k: np.flatnonzero(chosen & (shells.owner == k)) for k in distinct(shells.owner[chosen]).tolist()}
    parts = []
    for k, own in of.items():
        part, is_whole = reading.parts[k], len(own) == int((shells.owner == k).sum())
        faces = np.sort(np.concatenate([shells.faces[s] for s in own.tolist()]))
        parts.append(part if is_whole else replace(part, surfaces=faces_of_part(part, faces)))
    known = {part.id for part in parts}
    return tuple(replace(p, carried_by=None) if p.carried_by and p.carried_by not in known else p for p in parts)


def _left_out(reading: Reading, shells: SceneShells, number: np.ndarray, what: int) -> tuple[str, ...]:
    """Returns a note on the objects that belong to no piece, as floor and walls or because they lie alone."""
    owners = distinct(shells.owner[number == what]).tolist()
    if not owners:
        return ()
    names = ", ".join(reading.parts[k].source.name for k in owners[:_NAMED])
    more = f" and {len(owners) - _NAMED} more" if len(owners) > _NAMED else ""
    why = "as floor or wall" if what == FLOOR_OR_WALL else "for no piece of furniture is near"
    return (f"{names}{more}: left out of every piece, {why} (--pieces split)",)


def _common_names(pieces: Sequence[tuple[Part, ...]]) -> list[str]:
    """Returns for each piece the words that all names of its objects begin with; empty where none or not its own."""
    found = [_common_name(parts) for parts in pieces]
    return [name if name and found.count(name) == 1 else "" for name in found]


def _common_name(parts: tuple[Part, ...]) -> str:
    named = [_WORD.findall(part.source.name) for part in parts]
    shared = takewhile(lambda column: len(set(column)) == 1, zip(*named, strict=False))
    name = "_".join(column[0] for column in shared)
    return safe_id(name) if spoken(name) else ""


def _annotations(annotation: Annotation | None, frame: Frame, boxes: Sequence[Box]) -> list[Annotation | None]:
    """Returns what is annotated of each piece: a part goes to the piece whose box its middle is in or nearest to."""
    if annotation is None:
        return [None] * len(boxes)
    middles = [part.mesh.transformed(frame.input_to_output).box.center for part in annotation.parts]
    nearest = [min(range(len(boxes)), key=lambda k: (_distance(m, boxes[k]), boxes[k].volume)) for m in middles]
    return [_annotation_of(annotation, [of == k for of in nearest]) for k in range(len(boxes))]


def _distance(point: np.ndarray, box: Box) -> float:
    return float(np.linalg.norm(np.maximum(np.maximum(box.low - point, point - box.high), 0.0)))


def _annotation_of(annotation: Annotation, chosen: Sequence[bool]) -> Annotation | None:
    own = annotation.of_parts(tuple(part for part, is_own in zip(annotation.parts, chosen, strict=True) if is_own))
    return own if own.joints else None


def chosen_piece(pieces: Sequence[FurniturePiece], number: int | None, where: object) -> tuple[str, Reading]:
    """Returns how the name of the results of one piece ends, and its reading: of this number, or of the only one.

    Args:
        pieces: the pieces of the file.
        number: from 1; None: there must be one only.
        where: the file, for messages.

    Raises:
        UnreadableAsset: if there is no piece.
        AssetError: if there is no piece of this number, or there are several and none was chosen.
    """
    endings = endings_of(pieces)
    if not pieces:
        raise UnreadableAsset(f"{where} holds no piece of furniture, only floor and walls: leave --pieces split out")
    if number is not None and number > len(pieces):
        raise AssetError(f"--piece must be at most {len(pieces)}, the number of pieces in {where}: got {number}")
    if number is None and len(pieces) > 1:
        listed = ", ".join(f"{k} {one}" for k, one in enumerate(endings[:_NAMED], 1))
        more = ", ..." if len(endings) > _NAMED else ""
        raise AssetError(f"{where} holds {len(pieces)} pieces of furniture ({listed}{more}): choose one by --piece")
    chosen = (number or 1) - 1
    return endings[chosen], pieces[chosen].reading


def endings_of(pieces: Sequence[FurniturePiece]) -> tuple[str, ...]:
    """Returns how the names of the results of pieces end: `piece_1`, or the common name; empty for a single one."""
    if len(pieces) == 1:
        return ("",)
    return tuple(piece.name or f"piece_{k}" for k, piece in enumerate(pieces, 1))
