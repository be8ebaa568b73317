"""Points on parts: from .npy, from .ply as points or mesh, text or binary, or from the box."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from releases import functional, put, put_model, unfunctional

from grafu.data.furfun.folder import FurFunFolder
from grafu.data.furfun.points import drawn_from, drawn_on_box, read_ply
from grafu.errors import UnreadableAsset
from grafu.export.ply import mesh_to_ply
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh

CORNERS = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
VERTICES = "ply\nformat {} 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
FACE = "element face 1\nproperty list uchar int vertex_indices\n"
TEXT = "0 0 0\n1 0 0\n0 1 0\n"
ASCII_POINTS = f"{VERTICES.format('ascii')}end_header\n{TEXT}".encode()
ASCII_MESH = f"{VERTICES.format('ascii')}{FACE}end_header\n{TEXT}3 0 1 2\n".encode()
BINARY_POINTS = f"{VERTICES.format('binary_little_endian')}end_header\n".encode() + CORNERS.astype("<f4").tobytes()
BINARY_MESH = mesh_to_ply(TriangleMesh(CORNERS, np.array([[0, 1, 2]])))


def points_of(root, node: str = "door_0", **options) -> np.ndarray:
    return FurFunFolder(root, **({"points": 512} | options)).pair("fur_001").target.node(node).points.points


def test_as_many_points_as_asked_are_kept_as_they_are(tmp_path):
    cloud = np.random.default_rng(0).random((512, 3)).astype(np.float32)
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / "door_0.npy", cloud)
    assert np.array_equal(points_of(tmp_path), cloud.astype(np.float64))


def test_more_points_are_drawn_without_repetition_fewer_with(tmp_path):
    cloud = np.random.default_rng(0).random((2000, 3))
    root = put_model(tmp_path)
    put(root / "part_geometries" / "fur_001" / "door_0.npy", cloud)
    put(root / "part_geometries" / "fur_001" / "drawer_0.npy", cloud[:5].astype(np.float32))
    many, few = points_of(root), points_of(root, "drawer_0")
    assert len(np.unique(many, axis=0)) == 512
    assert (len(few), len(np.unique(few, axis=0))) == (512, 5)
    assert np.array_equal(many, points_of(root))
    assert not np.array_equal(many, points_of(root, seed=1))


@pytest.mark.parametrize("data", [ASCII_POINTS, BINARY_POINTS])
def test_a_ply_of_points_is_read(tmp_path, data):
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / "door_0.ply", data)
    assert np.array_equal(np.unique(points_of(tmp_path), axis=0), np.unique(CORNERS, axis=0))


@pytest.mark.parametrize("data", [ASCII_MESH, BINARY_MESH])
def test_points_are_spread_over_a_ply_mesh(tmp_path, data):
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / "door_0.ply", data)
    points = points_of(tmp_path)
    assert len(np.unique(points, axis=0)) == 512
    assert np.all(points[:, 2] == 0)
    assert np.all(points[:, :2].sum(axis=1) <= 1 + 1e-9)


def test_npy_goes_before_ply(tmp_path):
    folder = put_model(tmp_path) / "part_geometries" / "fur_001"
    put(folder / "door_0.npy", np.full((3, 3), 7.0))
    put(folder / "door_0.ply", ASCII_POINTS)
    assert np.all(points_of(tmp_path) == 7)


def test_parts_without_a_file_get_points_on_their_box_and_a_note(tmp_path):
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / "door_0.npy", np.zeros((4, 3)))
    model = FurFunFolder(tmp_path).model("fur_001")
    box, points = model.input.node("drawer_0").box, model.input.node("drawer_0").points.points
    assert np.allclose(np.concatenate([points.min(axis=0), points.max(axis=0)]), [*box.low, *box.high], atol=0.02)
    assert model.notes == ("drew points on the boxes of 3 of 4 parts: they have no .npy and no .ply",)


def test_points_lie_under_the_id_that_the_json_states(tmp_path):
    root = put_model(tmp_path, given=unfunctional("deep"), whole=functional("deep"))
    put(root / "part_geometries" / "deep" / "door_0.npy", np.full((3, 3), 2.0))
    put(root / "part_geometries" / "fur_001" / "door_0.npy", np.full((3, 3), 9.0))
    assert np.all(points_of(root) == 2)
    pair = FurFunFolder(root).pair("fur_001")
    assert pair.model_id == pair.input.model_id == pair.target.model_id == "fur_001"


def test_a_name_that_is_a_path_leads_to_no_file(tmp_path):
    whole = functional("../../..")
    whole["nodes"]["../door_0"] = whole["nodes"]["door_0"]
    whole["edges"].append({"src": "../door_0", "dst": "door_0", "kind": "contact"})
    root = put_model(tmp_path, whole=whole)
    put(root / "part_geometries" / "door_0.npy", np.full((3, 3), 9.0))
    (root / "part_geometries" / "fur_001").mkdir()
    assert not np.any(points_of(root, "../door_0") == 9)


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("door_0.npy", b"nonsense", "door_0.npy is damaged"),
        ("door_0.npy", np.zeros((4, 2)), r"door_0.npy must hold finite points.*\(4, 2\)"),
        ("door_0.npy", np.full((4, 3), np.nan), "door_0.npy must hold finite points"),
        ("door_0.npy", np.array([["a", "b", "c"]]), "door_0.npy must hold finite points"),
        ("door_0.ply", b"ply\nformat ascii 1.0\n", "door_0.ply is damaged"),
        ("door_0.ply", BINARY_MESH[:-20], "door_0.ply is damaged"),
        ("door_0.ply", ASCII_MESH.replace(b"3 0 1 2", b"3 0 1 9"), "door_0.ply"),
    ],
)
def test_damaged_files_are_named_in_one_line(tmp_path, name, data, message):
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / name, data)
    with pytest.raises(UnreadableAsset, match=message) as caught:
        points_of(tmp_path)
    assert "\n" not in str(caught.value)


def test_an_empty_file_is_no_file(tmp_path):
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / "door_0.npy", np.zeros((0, 3)))
    assert len(points_of(tmp_path)) == 512


def test_without_points_no_file_is_read(tmp_path):
    put(put_model(tmp_path) / "part_geometries" / "fur_001" / "door_0.npy", b"nonsense")
    assert FurFunFolder(tmp_path, points=0).pair("fur_001").target.node("door_0").points is None


lengths = st.floats(0.0, 3.0).filter(lambda x: x == 0 or x > 1e-6)


@given(st.tuples(lengths, lengths, lengths), st.integers(1, 300))
def test_points_on_a_box_lie_on_its_faces(size, count):
    box = Box(np.array([1.0, 2.0, 3.0]), np.array([1.0, 2.0, 3.0]) + np.array(size))
    points = drawn_on_box(box, count, np.random.default_rng(count))
    on_face = np.isclose(points, box.low, atol=1e-9) | np.isclose(points, box.high, atol=1e-9)
    assert len(points) == count
    assert np.all(on_face.any(axis=1))
    assert np.all((points >= box.low - 1e-9) & (points <= box.high + 1e-9))


def test_faces_of_a_box_get_points_by_their_area():
    points = drawn_on_box(Box(np.zeros(3), np.array([1.0, 2.0, 0.01])), 20000, np.random.default_rng(0))
    broad = np.isclose(points[:, 2], 0.0) | np.isclose(points[:, 2], 0.01)
    assert abs(broad.mean() - 2 / 2.03) < 0.005


@given(st.integers(1, 40), st.integers(1, 40))
def test_resampling_repeats_only_where_it_must(have, want):
    points = np.arange(3.0 * have).reshape(-1, 3)
    found = drawn_from(points, want, np.random.default_rng(0))
    assert len(found) == want
    if have >= want:
        assert len(np.unique(found, axis=0)) == want
    assert set(map(tuple, found)) <= set(map(tuple, points))


def test_a_mesh_round_trips():
    mesh = read_ply(BINARY_MESH, "x.ply")
    assert isinstance(mesh, TriangleMesh)
    assert np.array_equal(mesh.vertices, CORNERS)
    assert np.array_equal(mesh.faces, [[0, 1, 2]])
