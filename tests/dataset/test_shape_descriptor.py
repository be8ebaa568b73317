"""A descriptor is the same for every copy of a model, and another for another model."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.dataset.config import DescriptorConfig
from grafu.dataset.descriptor import describe, geometric_hash
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.samples import SAMPLES, TIDY

RADIUS = DescriptorConfig().radius


def meshes_of(name: str) -> list[TriangleMesh]:
    return [part.mesh for part in {**TIDY, **SAMPLES}[name]().parts]


def mapped(meshes: list[TriangleMesh], matrix: np.ndarray, offset: tuple[float, ...] = (0, 0, 0)) -> list[TriangleMesh]:
    return [TriangleMesh(mesh.vertices @ matrix.T + offset, mesh.faces) for mesh in meshes]


def quartered(mesh: TriangleMesh) -> TriangleMesh:
    """Returns the mesh with four triangles in place of each, in another order."""
    corners = mesh.vertices[mesh.faces][::-1]
    middles = (corners + np.roll(corners, -1, axis=1)) / 2
    inner = [np.stack([corners[:, k], middles[:, k], middles[:, k - 1]], axis=1) for k in range(3)]
    all_corners = np.concatenate([middles, *inner]).reshape(-1, 3)
    return TriangleMesh(all_corners, np.arange(len(all_corners)).reshape(-1, 3))


COPIES = {
    "moved": lambda meshes: mapped(meshes, np.eye(3), (3.0, -1.0, 0.5)),
    "scaled": lambda meshes: mapped(meshes, 0.01 * np.eye(3)),
    "mirrored": lambda meshes: mapped(meshes, np.diag([-1.0, 1.0, 1.0])),
    "reordered": lambda meshes: meshes[::-1],
    "cut into other triangles": lambda meshes: [quartered(mesh) for mesh in meshes],
    "all of these": lambda meshes: mapped([quartered(m) for m in meshes[::-1]], np.diag([-7.0, 7.0, 7.0]), (1, 2, 3)),
}


@pytest.mark.parametrize("copied", COPIES.values(), ids=COPIES)
@pytest.mark.parametrize("name", ["sideboard", "wardrobe", "chest"])
def test_a_copy_is_a_near_duplicate(name: str, copied) -> None:
    meshes = meshes_of(name)

    assert np.linalg.norm(describe(copied(meshes)) - describe(meshes)) < RADIUS / 4


def test_copies_that_are_not_cut_have_the_same_geometric_hash() -> None:
    meshes = meshes_of("desk")

    assert {geometric_hash(describe(copied(meshes))) for copied in COPIES.values()} == {
        geometric_hash(describe(meshes))
    }


def test_different_furniture_is_apart() -> None:
    found = {name: describe(meshes_of(name)) for name in SAMPLES}

    near = [pair for pair in combinations(found, 2) if np.linalg.norm(found[pair[0]] - found[pair[1]]) < 2 * RADIUS]
    assert near == []
    assert len({geometric_hash(one) for one in found.values()}) == len(found)


def test_what_is_turned_upside_down_or_stretched_is_another_shape() -> None:
    meshes = meshes_of("kitchen_base")

    for matrix in (np.diag([1.0, 1.0, -1.0]), np.diag([1.5, 1.0, 1.0])):
        assert np.linalg.norm(describe(mapped(meshes, matrix)) - describe(meshes)) > RADIUS


corners = st.tuples(*[st.floats(-1, 1).map(lambda x: round(x, 3))] * 3)
boxes = st.tuples(corners, st.tuples(*[st.floats(0.01, 1).map(lambda x: round(x, 3))] * 3))


@given(st.lists(boxes, min_size=1, max_size=5), st.floats(0.01, 100), corners, st.booleans(), st.randoms())
def test_any_boxes_moved_scaled_and_mirrored_are_the_same(drawn, scale, offset, is_mirrored, random) -> None:
    meshes = [TriangleMesh.box_mesh(Box(np.array(low), np.add(low, sides))) for low, sides in drawn]
    matrix = scale * np.diag([-1.0 if is_mirrored else 1.0, 1.0, 1.0])
    copy = mapped(meshes, matrix, offset)
    random.shuffle(copy)

    assert np.linalg.norm(describe(copy) - describe(meshes)) < RADIUS / 4


def test_nothing_and_a_flat_sheet_have_a_descriptor() -> None:
    sheet = TriangleMesh(np.array([[0.0, 0, 0], [1, 0, 0], [0, 0, 1]]), np.array([[0, 1, 2]]))

    assert not describe([]).any()
    assert np.isfinite(describe([sheet])).all()
    assert np.linalg.norm(describe([sheet]) - describe([])) > RADIUS


def test_an_odd_grid_is_refused() -> None:
    with pytest.raises(ValueError, match="must be even"):
        DescriptorConfig(cells_across=3)
