"""Pieces of one surface are neither cut nor left as sheets; what is drawn apart, or of few faces, is no such piece."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Part
from grafu.asset.parted_surface import is_parted_surface, with_boards
from grafu.asset.reading import Convention, Reading
from grafu.asset.settling import settled
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel
from small_scenes import box
from solids import as_mesh, solid

GLB = Convention("glTF", up="+Z", front="-Y", unit=1.0)


def _cabinet(cell: float = 0.02) -> TriangleMesh:
    """A cabinet of 0.6 x 0.4 x 0.8 m with two plain drawers, drawn as one closed surface of small faces."""
    body = solid((0.0, 0.0, 0.0), (0.6, 0.4, 0.8)) + solid((0.25, -0.03, 0.18), (0.35, 0.0, 0.2))
    return as_mesh((body + solid((0.25, -0.03, 0.58), (0.35, 0.0, 0.6))).refine_to_length(cell))


def _parted(mesh: TriangleMesh) -> tuple[Part, ...]:
    """The lower drawer, the upper one and the case: what lies in the front within two rectangles, and the rest."""
    centers = mesh.triangles.mean(axis=1)
    is_front = (mesh.face_normals[:, 1] < -0.5) & (centers[:, 1] < 0.01) | (centers[:, 1] < -1e-6)
    number = np.where(is_front, np.where(centers[:, 2] < 0.4, 0, 1), 2)
    return tuple(
        replace(
            box(f"part_{k}", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0)),
            label=PartLabel.UNKNOWN,
            labelled_by="none",
            surfaces=(Surface(mesh.with_faces(number == k)),),
        )
        for k in range(3)
    )


def test_pieces_of_one_surface_are_known_by_their_borders() -> None:
    assert is_parted_surface(_parted(_cabinet()))


@pytest.mark.parametrize("case", ["few faces", "boards", "apart"])
def test_other_objects_are_no_pieces_of_one_surface(case: str) -> None:
    parts = _parted(_cabinet(0.3 if case == "few faces" else 0.02))
    if case == "boards":
        fine = as_mesh(solid((0.0, 0.0, 0.0), (0.6, 0.02, 0.8)).refine_to_length(0.02))
        parts = tuple(
            replace(p, surfaces=(Surface(fine.translated(np.array([0.0, float(k), 0.0]))),))
            for k, p in enumerate(parts)
        )
    if case == "apart":
        parts = tuple(
            replace(p, surfaces=(Surface(p.mesh.translated(np.array([0.0, -0.01 * k, 0.0]))),))
            for k, p in enumerate(parts)
        )

    assert not is_parted_surface(parts)


def test_sheets_become_boards_and_the_case_stays() -> None:
    lower, upper, case = _parted(_cabinet())

    made = with_boards((lower, upper, case))

    assert [part.id for part in made] == ["part_0", "part_0_handle", "part_1", "part_1_handle", "part_2"]
    assert np.array_equal(made[4].mesh.faces, case.mesh.faces)
    for board in (made[0], made[2]):
        assert board.box.high[1] == pytest.approx(0.015 * 0.83, abs=0.004), "behind its plane"


def test_no_piece_of_one_surface_is_cut_into_fronts(tmp_path) -> None:
    asset = settled(Reading("glb", _parted(_cabinet()), GLB), "cabinet", tmp_path)

    assert [part.id for part in asset.parts if part.carried_by is None] == ["part_0", "part_1", "part_2"]
    assert any("pieces of one surface" in note for note in asset.notes)
