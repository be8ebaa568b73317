"""Plane faces of bodies become these bodies; sheets that enclose one box, or none, stay."""

from dataclasses import replace

import numpy as np

from grafu.asset.bodies_of_faces import with_bodies_of_faces
from grafu.asset.part import Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.vocabulary import PartLabel
from small_scenes import box

BOARDS = [
    ((0.0, 0.0, 0.0), (0.02, 0.4, 0.8)),
    ((0.48, 0.0, 0.0), (0.5, 0.4, 0.8)),
    ((0.02, 0.0, 0.0), (0.48, 0.4, 0.02)),
    ((0.0, -0.02, 0.0), (0.5, 0.0, 0.8)),
]


def _faces(low, high, first: int, label: PartLabel = PartLabel.UNKNOWN) -> list[Part]:
    """The six faces of a box, each a part of its own."""
    whole = box("box", low, high).mesh
    sides = [np.flatnonzero(np.isclose(whole.face_normals[:, k], s)) for k in range(3) for s in (-1.0, 1.0)]
    return [
        replace(
            box(f"Face{first + n}", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)),
            label=label,
            labelled_by="none",
            source=PartSource(f"Face{first + n}"),
            surfaces=(Surface(whole.with_faces(faces)),),
        )
        for n, faces in enumerate(sides)
    ]


def test_plane_faces_of_boards_become_boards() -> None:
    parts = tuple(part for k, board in enumerate(BOARDS) for part in _faces(*board, 6 * k))

    kept, (note,) = with_bodies_of_faces(parts)

    assert len(kept) == 4
    assert all(part.mesh.is_watertight for part in kept)
    assert note == "24 objects are plane faces of 4 bodies, and joined to these (--parts auto)"


def test_a_cabinet_of_six_sheets_stays_as_one_of_them_may_be_its_door() -> None:
    parts = tuple(_faces((0.0, 0.0, 0.0), (0.5, 0.4, 0.8), 0))

    assert with_bodies_of_faces(parts) == (parts, [])


def test_boards_that_are_whole_and_sheets_that_enclose_nothing_stay() -> None:
    boards = tuple(replace(box(f"b{k}", *board), label=PartLabel.UNKNOWN) for k, board in enumerate(BOARDS))
    sheets = tuple(part for k, board in enumerate(BOARDS) for part in _faces(*board, 6 * k)[1:])

    assert with_bodies_of_faces(boards) == (boards, [])
    assert with_bodies_of_faces(sheets) == (sheets, [])


def test_faces_with_names_of_different_things_stay_apart() -> None:
    parts = [part for k, board in enumerate(BOARDS) for part in _faces(*board, 6 * k)]
    parts[0], parts[1] = replace(parts[0], label=PartLabel.DOOR), replace(parts[1], label=PartLabel.BACK_PANEL)

    kept, _ = with_bodies_of_faces(tuple(parts))

    assert len(kept) == 6 + 3
