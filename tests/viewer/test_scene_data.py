"""Surfaces packed for the browser: what comes back, and what is stored once."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.viewer.packed_surface import PackedSurface, pack_surface

CUBE = TriangleMesh.box_mesh(Box(np.array([-0.2, 0.1, 0.0]), np.array([0.5, 0.4, 2.0])))


def unpacked(packed: PackedSurface) -> np.ndarray:
    ratios = np.frombuffer(packed.mesh.vertices, np.uint16).reshape(-1, 4)[:, :3] / 65535
    corners = np.array(packed.low) + ratios * np.array(packed.size)
    return corners[np.frombuffer(packed.mesh.indices, np.uint32 if packed.mesh.wide else np.uint16)].reshape(-1, 3, 3)


@given(
    arrays(np.float64, (12, 3), elements=st.floats(-1, 1, width=32)),
    st.floats(1e-4, 1e3),
    arrays(np.float64, (3,), elements=st.floats(-50, 50)),
)
@settings(max_examples=60, deadline=None)
def test_every_triangle_comes_back_within_half_a_step(points, scale, offset):
    mesh = TriangleMesh(points * scale + offset, np.arange(12).reshape(4, 3))
    packed = pack_surface(Surface(mesh), textured=False)
    back = unpacked(packed)
    step = np.array(packed.size) / 65535

    steps = np.rint((mesh.triangles - np.array(packed.low)) / np.where(step > 0, step, 1))
    whole = [len({tuple(corner) for corner in face}) == 3 for face in steps]
    assert len(back) >= sum(whole)  # what vanishes is smaller than a step
    if all(whole):
        assert (np.abs(back - mesh.triangles) <= 0.51 * step + 1e-9 * scale + 1e-12).all()


def test_a_flat_surface_stays_flat():
    flat = TriangleMesh(np.array([[0, 0, 0.7], [1, 0, 0.7], [0, 1, 0.7]], float), np.array([[0, 1, 2]]))

    assert (unpacked(pack_surface(Surface(flat), False))[..., 2] == 0.7).all()


def test_what_differs_in_place_alone_is_one_mesh():
    there = CUBE.translated(vec3(3.25, -1.5, 0.125))

    assert pack_surface(Surface(CUBE), False).mesh == pack_surface(Surface(there), False).mesh


def test_corners_that_are_equal_are_stored_once():
    packed = pack_surface(Surface(CUBE), False)

    assert len(packed.mesh.vertices) == 24 * 8  # a cube's corners, once for each of three faces
    assert packed.mesh.count == 36


def test_texture_coordinates_keep_their_place_in_the_picture():
    uv = np.linspace(-7.3, 9.1, 16).reshape(8, 2)
    packed = pack_surface(Surface(CUBE, Material(), uv), textured=True)
    ratios = np.frombuffer(packed.mesh.uv, np.uint16).reshape(-1, 2) / 65535
    index = np.frombuffer(packed.mesh.indices, np.uint16)
    found = (np.array(packed.uv_low) + ratios * np.array(packed.uv_size))[index]
    expected = uv[CUBE.faces.ravel()] * [1, -1] + [0, 1]

    off = found - expected
    assert np.abs(off - np.rint(off)).max() < 1e-3


def test_texture_coordinates_that_are_no_numbers_are_survived():
    uv = np.full((8, 2), np.nan)
    uv[0] = [np.inf, 1e30]

    assert pack_surface(Surface(CUBE, Material(), uv), textured=True).mesh.count == 36


@pytest.mark.parametrize("count", [65535, 70000])
def test_many_vertices_take_wide_indices(count):
    points = np.random.default_rng(0).uniform(size=(count - count % 3, 3))
    mesh = TriangleMesh(points, np.arange(len(points)).reshape(-1, 3))
    packed = pack_surface(Surface(mesh, normals=np.tile([0.0, 0.0, 1.0], (len(points), 1))), False)

    assert packed.mesh.wide == (len(packed.mesh.vertices) // 8 > 65535)
    assert np.abs(unpacked(packed) - mesh.triangles).max() < 1e-4
