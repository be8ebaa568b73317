"""What is our own so that no run waits for scipy or trimesh to be imported: it gives what theirs give."""

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy import ndimage
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation
from trimesh.intersections import slice_faces_plane

from grafu.additions.top.height_map import grown, islands, without_narrow
from grafu.geometry.box import convex_outline
from grafu.geometry.components import linked
from grafu.geometry.halves import half_of
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import (
    euler_matrix,
    quaternion_matrix,
    quaternions_about,
    roll_pitch_yaw,
    rotation_matrix,
)
from grafu.templates.solids import ball

angles = st.floats(-4.0, 4.0) | st.sampled_from([0.0, 1e-9, 1e-4, np.pi / 2, np.pi, -np.pi / 2])
quaternions = st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: max(map(abs, q)) > 1e-3)
halves = st.integers(0, 3).map(lambda k: k / 2)
meshes = st.tuples(
    st.lists(st.tuples(halves, halves, halves), min_size=3, max_size=10),
    st.lists(st.tuples(*[st.integers(0, 2**16)] * 3), min_size=1, max_size=20),
).map(lambda drawn: TriangleMesh(np.array(drawn[0]), np.array(drawn[1]) % len(drawn[0])))
masks = st.tuples(st.integers(1, 12), st.integers(1, 12), st.integers(0, 2**32)).map(
    lambda drawn: np.random.default_rng(drawn[2]).random(drawn[:2]) < 0.6
)


@given(st.integers(1, 40), st.lists(st.tuples(st.integers(0, 2**16), st.integers(0, 2**16)), max_size=60))
def test_linked_things_have_the_numbers_of_connected_components(count: int, links: list[tuple[int, int]]) -> None:
    first, second = np.array(links, dtype=np.int64).reshape(-1, 2).T % count
    graph = coo_matrix((np.ones(len(first)), (first, second)), (count, count))
    assert np.array_equal(linked(count, first, second), connected_components(graph, directed=False)[1])


@pytest.mark.parametrize("leaves", [np.arange(20_000), np.arange(20_000)[::-1]], ids=["rising", "falling"])
def test_a_thing_that_is_linked_with_all_others_makes_one_group_of_them(leaves: np.ndarray) -> None:
    assert not linked(20_001, np.full(20_000, 20_000), leaves).any()


@given(meshes)
def test_a_mesh_is_watertight_where_trimesh_says_so(mesh: TriangleMesh) -> None:
    merged = mesh.to_trimesh()
    merged.merge_vertices()
    assert mesh.is_watertight == bool(merged.is_watertight and merged.is_winding_consistent)


def test_a_ball_is_an_icosphere_and_watertight_until_a_face_is_turned() -> None:
    sphere, made = trimesh.creation.icosphere(subdivisions=1, radius=0.3), ball(0.3)
    assert np.allclose(made.vertices, sphere.vertices, atol=1e-12)
    assert np.array_equal(made.faces, sphere.faces)
    assert made.is_watertight
    turned = np.vstack([made.faces[:1, ::-1], made.faces[1:]])
    assert not TriangleMesh(made.vertices, turned).is_watertight
    assert not TriangleMesh(made.vertices, made.faces[1:]).is_watertight


@given(meshes, st.integers(0, 2), st.sampled_from([-1.0, 1.0]), st.sampled_from([0.0, 0.25, 0.3, 0.5, 1.0]))
def test_half_of_a_mesh_is_what_trimesh_slices_off(mesh: TriangleMesh, axis: int, sign: float, height: float) -> None:
    normal = sign * np.eye(3)[axis]
    vertices, faces = slice_faces_plane(np.array(mesh.vertices), np.array(mesh.faces), normal, abs(normal) * height)[:2]
    half = half_of(mesh, normal, abs(normal) * height)
    assert np.array_equal(half.vertices, np.reshape(vertices, (-1, 3)))
    assert np.array_equal(half.faces, np.reshape(faces, (-1, 3)))


@given(st.integers(0, 2**32), st.integers(3, 300), st.booleans())
def test_the_outline_of_points_is_their_hull(seed: int, count: int, rounded: bool) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 2))
    points = np.round(points * 2) / 2 if rounded else points
    if np.linalg.matrix_rank(points - points[0]) < 2:
        assert len(convex_outline(points)) < 3
        return
    hull, outline = ConvexHull(points), convex_outline(points)
    assert set(map(tuple, outline.tolist())) == set(map(tuple, points[hull.vertices].tolist()))
    x, y = outline.T
    assert (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2 == pytest.approx(hull.volume)  # counter-clockwise


@given(angles, st.tuples(*[st.integers(-3, 3)] * 3).filter(any))
def test_rotations_about_an_axis_are_scipys(angle: float, axis: tuple[int, int, int]) -> None:
    direction = np.array(axis) / np.linalg.norm(axis)
    turns = Rotation.from_rotvec(np.outer([angle, 2 * angle], direction))
    assert np.allclose(rotation_matrix(direction, angle), turns[0].as_matrix(), atol=1e-15)
    assert np.allclose(quaternions_about(direction, np.array([angle, 2 * angle])), turns.as_quat(), atol=1e-15)


@given(
    st.tuples(*[st.floats(-1, 1)] * 4).filter(lambda q: max(map(abs, q)) > 1e-3), st.sampled_from([1e-200, 1.0, 1e200])
)
def test_rotations_of_quaternions_are_scipys(quaternion: tuple[float, ...], length: float) -> None:
    w, x, y, z = quaternion
    found = quaternion_matrix(w * length, x * length, y * length, z * length)
    assert np.allclose(found, Rotation.from_quat([x, y, z, w]).as_matrix(), atol=1e-14)


@given(st.tuples(angles, angles, angles), st.sampled_from(["xyz", "xzy", "yzx", "yxz", "zxy", "zyx"]))
@pytest.mark.filterwarnings("ignore:Gimbal lock")
def test_rotations_about_fixed_axes_are_scipys(turns: tuple[float, float, float], order: str) -> None:
    R = Rotation.from_euler(order, turns).as_matrix()
    assert np.allclose(euler_matrix(turns, order), R, atol=1e-14)
    apart = np.remainder(roll_pitch_yaw(R) - Rotation.from_matrix(R).as_euler("xyz") + np.pi, 2 * np.pi) - np.pi
    assert np.allclose(apart, 0.0, atol=1e-6)  # beside a pitch of 90 degrees small differences are large


@given(masks, st.integers(1, 4), st.booleans())
def test_masks_grow_and_lose_what_is_narrow_as_in_scipy(mask: np.ndarray, times: int, corners: bool) -> None:
    structure = ndimage.generate_binary_structure(2, 2 if corners else 1)
    dilated = ndimage.binary_dilation(mask, structure, iterations=times)
    eroded = ndimage.binary_opening(mask, structure, iterations=times)
    assert np.array_equal(grown(mask, times, corners=corners), dilated)
    assert np.array_equal(without_narrow(mask, times, corners=corners), eroded)
    labels, count = islands(mask, corners=corners)
    assert (count, True) == (
        ndimage.label(mask, structure)[1],
        np.array_equal(labels, ndimage.label(mask, structure)[0]),
    )
