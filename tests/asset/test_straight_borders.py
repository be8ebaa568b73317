"""Fronts of a parted surface get straight borders, and handles of their own; what is round or raised stays as it is."""

from dataclasses import replace

import numpy as np
import pytest

from grafu.asset.part import Part
from grafu.asset.parted_surface import with_boards
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel
from small_scenes import box
from solids import as_mesh, solid

TOOTH = 0.01


def _cabinet(*more) -> TriangleMesh:
    """A cabinet of 0.6 x 0.4 x 0.8 m, drawn as one closed surface of small faces."""
    body = solid((0.0, 0.0, 0.0), (0.6, 0.4, 0.8))
    for low, high in more:
        body = body + solid(low, high)
    return as_mesh(body.refine_to_length(0.02))


def _parted(mesh: TriangleMesh, is_door: np.ndarray) -> tuple[Part, Part]:
    """The door and the case; faces beside their border belong to the other, now and then."""
    random = np.random.default_rng(3)
    centers = mesh.triangles.mean(axis=1)
    near = np.linalg.norm(centers[:, None] - centers[is_door][None, ::7], axis=2).min(axis=1) < TOOTH
    swapped = ~is_door & near & (random.random(len(centers)) < 0.3)
    made = box("part", (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
    made = replace(made, label=PartLabel.UNKNOWN, labelled_by="none")
    door, case = (mesh.with_faces(s) for s in (is_door | swapped, ~(is_door | swapped)))
    return replace(made, id="door", surfaces=(Surface(door),)), replace(made, id="case", surfaces=(Surface(case),))


def _in_front(mesh: TriangleMesh) -> tuple[np.ndarray, np.ndarray]:
    centers = mesh.triangles.mean(axis=1)
    return centers, (mesh.face_normals[:, 1] < -0.5) & (centers[:, 1] < 1e-6) | (centers[:, 1] < -1e-6)


def _door_and_case(*more) -> tuple[Part, Part]:
    mesh = _cabinet(*more)
    centers, ahead = _in_front(mesh)
    return _parted(mesh, ahead & (np.abs(centers[:, [0, 2]] - [0.3, 0.4]) < [0.2, 0.3]).all(axis=1))


def test_the_border_of_a_door_is_a_rectangle_that_its_case_does_not_reach_into() -> None:
    door, case = _door_and_case()
    sides = door.mesh.box.size[[0, 2]]

    straight, beside = with_boards((door, case))

    assert (straight.mesh.box.size[[0, 2]] < sides).all(), "teeth are gone"
    low, high = straight.mesh.box.low + 1e-4, straight.mesh.box.high - 1e-4
    points = beside.mesh.vertices
    assert not ((points > low) & (points < high)).all(axis=1).any()
    moved = np.linalg.norm(points - case.mesh.vertices, axis=1)
    assert moved.max() < 0.03, "by no more than a tooth"
    assert np.count_nonzero(moved) < 0.1 * len(moved)


def test_a_round_door_stays_as_it_is() -> None:
    mesh = _cabinet()
    centers, ahead = _in_front(mesh)
    door, case = _parted(mesh, ahead & (np.hypot(centers[:, 0] - 0.3, centers[:, 2] - 0.4) < 0.2))

    straight, beside = with_boards((door, case))

    assert np.array_equal(straight.mesh.vertices[: len(door.mesh.vertices)], door.mesh.vertices)
    assert beside is case


def test_a_handle_on_its_door_is_a_part_that_goes_with_it() -> None:
    made = with_boards(_door_and_case(((0.45, -0.03, 0.35), (0.47, 0.0, 0.5))))

    assert [part.id for part in made] == ["door", "door_handle", "case"]
    assert (made[1].label, made[1].carried_by) == (PartLabel.HANDLE, "door")
    assert made[1].mesh.box.low[1] == pytest.approx(-0.03)


@pytest.mark.parametrize("depth", [0.006, 0.03])
def test_a_panel_on_a_door_is_no_handle(depth: float) -> None:
    made = with_boards(_door_and_case(((0.15, -depth, 0.2), (0.45, 0.0, 0.6))))

    assert [part.id for part in made] == ["door", "case"]
