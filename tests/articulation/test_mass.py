from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import Link, Visual
from grafu.articulation.build_material import MassConfig
from grafu.articulation.mass import MassProperties, mass_of_link, moments_of
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes

PANEL = Box(vec3(0.1, -0.3, 0.0), vec3(0.5, -0.282, 0.7))
PANEL_MESH = TriangleMesh.box_mesh(PANEL)
sizes = st.tuples(*[st.floats(0.002, 2.0)] * 3).map(np.array)


def link_of(*meshes: TriangleMesh, material: Material = Material(), **visual) -> Link:  # noqa: B008
    return Link("a", tuple(Visual(f"v{k}", (Surface(mesh, material),), **visual) for k, mesh in enumerate(meshes)))


def box_inertia(mass: float, size: np.ndarray) -> np.ndarray:
    return mass / 12 * np.diag([size[1] ** 2 + size[2] ** 2, size[0] ** 2 + size[2] ** 2, size[0] ** 2 + size[1] ** 2])


@given(sizes, st.floats(-3, 3))
def test_a_box_weighs_what_the_textbook_says(size, offset):
    mesh = TriangleMesh.box_mesh(Box(np.full(3, offset), offset + size))

    made = mass_of_link(link_of(mesh), MassConfig(least_mass=1e-9, solid_wood=1.0))

    assert made.mass == pytest.approx(650 * np.prod(size), rel=1e-6)
    assert np.allclose(made.center, offset + size / 2, atol=1e-6)
    assert np.allclose(made.inertia, box_inertia(made.mass, size), rtol=1e-3, atol=1e-5 * made.mass)


def test_inverted_normals_and_split_vertices_change_nothing():
    inverted = TriangleMesh(PANEL_MESH.triangles.reshape(-1, 3), np.arange(36).reshape(-1, 3)[:, ::-1])

    assert np.allclose(mass_of_link(link_of(inverted)).inertia, mass_of_link(link_of(PANEL_MESH)).inertia)


def test_faces_drawn_twice_weigh_once():
    doubled = merge_meshes([PANEL_MESH, TriangleMesh(PANEL_MESH.vertices, PANEL_MESH.faces[:, ::-1])])

    assert moments_of(doubled).volume == pytest.approx(PANEL.volume)


@pytest.mark.parametrize("missing", range(6))
def test_an_open_panel_weighs_nearly_as_much_as_the_whole_and_never_more(missing):
    keep = np.ones(12, dtype=bool)
    keep[2 * missing : 2 * missing + 2] = False

    volume = moments_of(PANEL_MESH.with_faces(keep)).volume

    assert 0.8 * PANEL.volume <= volume <= PANEL.volume * (1 + 1e-9)


def test_a_sheet_weighs_as_a_board():
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]])
    one = TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
    # its back is cut along the other diagonal, so that no face is drawn twice
    both = TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]))

    assert moments_of(one, 0.015).volume == pytest.approx(0.015)
    assert moments_of(both, 0.015).volume == pytest.approx(0.015)


def test_two_sheets_weigh_no_more_than_the_board_between_them():
    faces = np.abs(PANEL_MESH.face_normals[:, 1]) > 0.5

    assert moments_of(PANEL_MESH.with_faces(faces)).volume == pytest.approx(PANEL.volume)


def test_a_yawed_panel_weighs_as_a_straight_one():
    turn = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0)).rotation(0.6)
    keep = np.arange(10)

    straight, yawed = (moments_of(m.with_faces(keep)).volume for m in (PANEL_MESH, PANEL_MESH.transformed(turn)))

    assert yawed == pytest.approx(straight)


def test_inertia_turns_with_the_body():
    turn = Axis(vec3(0.2, 0.1, 0.0), vec3(0.3, 0.5, 0.8)).rotation(1.1)
    here, there = (mass_of_link(link_of(m)) for m in (PANEL_MESH, PANEL_MESH.transformed(turn)))

    R = turn[:3, :3]
    assert np.allclose(there.inertia, R @ here.inertia @ R.T, atol=1e-9)


@given(st.integers(0, 10_000))
def test_any_triangles_have_the_mass_of_a_body(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(1, 30))
    points = rng.normal(size=(count + 2, 3)) * rng.choice([1e-6, 1e-3, 1.0], size=3)
    mesh = TriangleMesh(points, rng.integers(0, len(points), (count, 3)))

    made = mass_of_link(link_of(mesh))  # MassProperties checks itself

    assert np.all(made.center >= mesh.box.low - 1e-9)
    assert np.all(made.center <= mesh.box.high + 1e-9)
    assert made.mass <= 650 * np.prod(np.maximum(mesh.box.size * 1.5, 0.015)) + 0.01


def test_a_link_without_parts_has_the_least_mass():
    assert mass_of_link(Link("empty", ())).mass == MassConfig().least_mass


def test_impossible_inertia_is_refused():
    good = mass_of_link(link_of(PANEL_MESH))

    with pytest.raises(ValueError, match="principal moments"):
        replace(good, inertia=np.diag([1.0, 1.0, 3.0]))
    with pytest.raises(ValueError, match="mass 0"):
        MassProperties(0.0, good.center, good.inertia)
