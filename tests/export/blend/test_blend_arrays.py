"""Meshes, keys and names as Blender will get them, without Blender."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from small_cabinet import GLASS, PAINT, STEEL, board

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.export.blend.layout import cycle_keys, fitted_name
from grafu.export.blend.mesh_arrays import mesh_arrays
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import JointType

HERE = vec3(1.0, 2.0, 3.0)


NOWHERE = vec3(0.0, 0.0, 0.0)
faces_of_six = st.lists(st.tuples(*[st.integers(0, 5)] * 3), max_size=30)


@given(faces_of_six, faces_of_six)
def test_every_face_of_each_look_is_there_once_in_its_place(faces, others):
    points = np.random.default_rng(0).uniform(size=(6, 3))
    surfaces = [
        Surface(TriangleMesh(points, np.array(some, dtype=np.int64).reshape(-1, 3)), material)
        for some, material in ((faces, PAINT), (others, STEEL), (faces[:5], PAINT))
    ]
    expected = {
        (frozenset(face), material)
        for some, material in ((faces, PAINT), (others, STEEL))
        for face in some
        if len(set(face)) == 3
    }

    arrays = mesh_arrays(Visual("v", tuple(surfaces)), NOWHERE)

    number = {tuple(point): k for k, point in enumerate(points.tolist())}
    corners = [[number[tuple(point)] for point in face] for face in arrays.vertices[arrays.faces].tolist()]
    found = [
        (frozenset(face), arrays.materials[k].material) for face, k in zip(corners, arrays.material_index, strict=True)
    ]
    assert len(found) == len(expected)
    assert set(found) == expected
    assert len({tuple(sorted(face)) for face in arrays.faces.tolist()}) == len(found)  # no two share all corners
    assert np.allclose(np.linalg.norm(arrays.normals, axis=1), 1.0)


@pytest.mark.parametrize("inside_first", [False, True])
def test_of_faces_back_to_back_the_outer_ones_stay(inside_first):
    box = board(0, 0, 0, 1, 2, 3)
    sides = [box.faces[:, ::-1], box.faces] if inside_first else [box.faces, box.faces[:, ::-1]]
    doubled = Surface(TriangleMesh(box.vertices, np.vstack(sides)), PAINT)

    arrays = mesh_arrays(Visual("v", (doubled,)), HERE)

    kept = TriangleMesh(np.array(arrays.vertices), np.array(arrays.faces))
    assert len(kept.faces) == 12
    assert np.all(np.einsum("nd,nd->n", kept.face_normals, kept.triangles.mean(axis=1) - kept.box.center) > 0)
    assert np.allclose(arrays.normals, np.repeat(kept.face_normals, 3, axis=0))
    assert [shown.material for shown in arrays.doubled] == [PAINT]


def test_nothing_is_doubled_where_nothing_lies_back_to_back():
    twice = Surface(board(0, 0, 0, 1, 1, 1), PAINT)

    arrays = mesh_arrays(Visual("v", (twice, twice)), HERE)

    assert (len(arrays.faces), arrays.doubled) == (12, frozenset())


def test_surfaces_are_joined_and_each_look_is_named_once():
    boards = [board(k, 0, 0, k + 1, 1, 1) for k in range(3)]
    uv, colors = np.full((8, 2), 0.5), np.full((8, 4), 51, np.uint8)
    surfaces = (Surface(boards[0], PAINT), Surface(boards[1], GLASS, uv, colors=colors), Surface(boards[2], PAINT))

    arrays = mesh_arrays(Visual("v", surfaces), vec3(0.0, 0.0, 0.0))

    assert [(shown.material, shown.textured, shown.colored) for shown in arrays.materials] == [
        (PAINT, False, False),
        (GLASS, False, True),  # it has no image
    ]
    assert arrays.material_index.tolist() == [0] * 12 + [1] * 12 + [0] * 12
    assert np.allclose(arrays.uv, np.repeat([[0.0], [0.5], [0.0]], 36, axis=0))
    assert np.allclose(arrays.colors, np.repeat([[1.0], [0.2], [1.0]], 8, axis=0))


def test_wild_texture_coordinates_are_tamed():
    uv = np.full((8, 2), np.inf)
    uv[3] = np.nan

    arrays = mesh_arrays(Visual("v", (Surface(board(0, 0, 0, 1, 1, 1), STEEL, uv),)), HERE)

    assert np.isfinite(arrays.uv).all()


def in_stages(count: int) -> ArticulatedObject:
    """Joints each of which waits for the last."""
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    links = tuple(Link(f"l{k}", ()) for k in range(count + 1))
    joints = tuple(
        Joint(f"j{k}", JointType.REVOLUTE, "l0", f"l{k + 1}", axis, JointLimits(0.0, 1.0), (f"j{k - 1}",) if k else ())
        for k in range(count)
    )
    return ArticulatedObject("stages", "l0", links, joints)


@given(st.one_of(st.integers(0, 12), st.integers(45, 60)))
def test_all_is_open_at_the_middle_and_nothing_moves_before_what_it_waits_for(count):
    keys = cycle_keys(in_stages(count))

    assert len(keys) == count
    for k in range(count):
        frames, ratios = zip(*keys[f"j{k}"], strict=True)
        assert (frames[0], ratios[0], frames[-1], ratios[-1]) == (0.0, 0.0, 100.0, 0.0)
        assert list(frames) == sorted(set(frames))
        assert np.interp(50.0, frames, ratios) == 1.0
        if k:
            waited = keys[f"j{k - 1}"]
            moving = [frame for frame in np.linspace(0, 100, 201) if 0 < np.interp(frame, frames, ratios) < 1]
            assert np.allclose(np.interp(moving, *zip(*waited, strict=True)), 1.0)


@given(st.text(), st.integers(0, 20))
def test_names_fit_into_blender(name, room):
    fitted = fitted_name(name, room)

    assert 0 < len(fitted.encode()) <= 63 - room
    assert fitted.isprintable()
