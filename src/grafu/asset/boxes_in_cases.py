"""The box of a drawer that was drawn in another object than its front, such as that of the case, is joined to it.

What is a box behind a front, `segmentation` states; no name is asked but what tells that a part is something else.
"""

from dataclasses import replace
from typing import Final

import numpy as np

from grafu.asset.cutting import is_divided, turn_of
from grafu.asset.loose import faces_of_part
from grafu.asset.part import Frame, Part
from grafu.asset.pieces import with_pieces
from grafu.asset.reading import Reading
from grafu.geometry.arrays import Indices, without
from grafu.segmentation.boxes_in_case import boxes_in_cases
from grafu.vocabulary import PartLabel

_FRONTS: Final = frozenset({PartLabel.UNKNOWN, PartLabel.DRAWER})
_NO_CASES: Final = frozenset({PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE})


def with_boxes_from_cases(reading: Reading, frame: Frame) -> Reading:
    """Returns the reading in which a front and its box are one part, a drawer, and a note on each.

    Args:
        reading: what was read, cut where fronts appear.
        frame: how it stands; its unit does not matter.
    """
    if not reading.parts or is_divided(reading):
        return reading
    parts, T = reading.parts, turn_of(frame)
    fronts = [part.label in _FRONTS and part.carried_by is None for part in parts]
    cases = [part.label not in _NO_CASES and part.carried_by is None for part in parts]
    found = boxes_in_cases([part.mesh.transformed(T) for part in parts], fronts, cases)
    if not found:
        return reading
    given: dict[int, list[Indices]] = {}
    for box in found.values():
        for k, faces in box.items():
            given.setdefault(k, []).append(faces)
    left = {k: without(np.arange(len(parts[k].mesh.faces)), np.concatenate(cut)) for k, cut in given.items()}
    hosts = {parts[k].id: parts[front].id for front, box in found.items() for k in box if not len(left[k])}
    made = [
        _drawer(part, [_cut(parts[i], faces) for i, faces in found[k].items()], hosts) if k in found
        else _cut(with_pieces(part, (), hosts), left[k]) if k in left
        else with_pieces(part, (), hosts)
        for k, part in enumerate(parts)
        if k not in left or len(left[k])
    ]  # fmt: skip
    notes = (
        f"{_names(parts, box)} behind {parts[front].id} joined to it (--parts auto)" for front, box in found.items()
    )
    return replace(reading, parts=tuple(made), notes=(*reading.notes, *notes))


def _drawer(front: Part, pieces: list[Part], hosts: dict[str, str]) -> Part:
    made = with_pieces(front, pieces, hosts)
    return made if front.label is PartLabel.DRAWER else replace(made, label=PartLabel.DRAWER, labelled_by="shape")


def _cut(part: Part, faces: Indices) -> Part:
    return replace(part, surfaces=faces_of_part(part, faces))


def _names(parts: tuple[Part, ...], box: dict[int, Indices]) -> str:
    return "the box of a drawer in " + ", ".join(parts[k].source.name for k in box)
