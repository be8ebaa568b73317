import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from PIL import Image

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.pieces import shapes
from grafu.synth.pieces.finish import OAK, TEXTURE_SPAN, surface_of, textured_finish, wood_texture

TEXTURED = textured_finish(1).case

SLAB = Box(np.array([-0.2, -0.01, 0.1]), np.array([0.3, 0.01, 0.8]))
VOLUME = SLAB.volume


@pytest.mark.parametrize(
    ("mesh", "volume"),
    [
        (shapes.board((0.0, 0.0, 0.0), (1.0, 2.0, 3.0)), 6.0),
        (shapes.prism(((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)), 0.0, 2.0), 1.0),
        (shapes.rod(np.zeros(3), np.array([0.0, 0.0, 2.0]), 1.0, 400), 2 * np.pi),
    ],
)
def test_solids_are_closed_with_their_volume(mesh, volume):
    assert mesh.is_watertight
    assert mesh.to_trimesh().volume == pytest.approx(volume, rel=1e-3)


@pytest.mark.parametrize("make", [shapes.chamfered_board, shapes.rounded_board])
def test_softened_edges_take_little_away_and_keep_the_box(make):
    mesh = make(SLAB, 0.005)
    assert mesh.is_watertight
    assert 0.97 * VOLUME < mesh.to_trimesh().volume < VOLUME
    assert np.allclose(mesh.box.size, SLAB.size)


def test_a_frame_surrounds_its_opening():
    boards = shapes.framed_opening(SLAB, 0.05)
    area = sum(float(b.box.size[0] * b.box.size[2]) for b in boards)
    assert area == pytest.approx(0.5 * 0.7 - 0.4 * 0.6)


@given(st.sampled_from([(1, 0, 0), (0, -1, 0), (0, 0, 1), (1, 2, 3)]), st.floats(0.001, 0.1))
def test_turned_solids_look_outwards_in_every_direction(direction, radius):
    end = np.array(direction, dtype=float)
    mesh = shapes.turned(np.zeros(3), end, ((0.0, radius), (0.5, 2 * radius), (1.0, radius)))
    assert mesh.is_watertight
    assert mesh.to_trimesh().volume > 0


def test_texture_coordinates_are_to_scale_with_the_grain_lengthwise():
    surface = surface_of(TriangleMesh.box_mesh(SLAB), TEXTURED)
    for face in surface.mesh.faces:
        edges = surface.mesh.vertices[face] - surface.mesh.vertices[np.roll(face, 1)]
        in_texture = surface.uv[face] - surface.uv[np.roll(face, 1)]
        assert np.allclose(np.linalg.norm(edges, axis=1), np.linalg.norm(in_texture, axis=1) * TEXTURE_SPAN)
    assert np.ptp(surface.uv[:, 1]) * TEXTURE_SPAN >= SLAB.size[2] - 1e-9


def test_projection_moves_no_face():
    mesh = shapes.rounded_board(SLAB, 0.005)
    assert np.allclose(surface_of(mesh, TEXTURED).mesh.triangles, mesh.triangles)


def test_a_plain_material_needs_no_texture_coordinates():
    mesh = shapes.rounded_board(SLAB, 0.005)
    assert surface_of(mesh, OAK).mesh is mesh
    assert surface_of(mesh, OAK).uv is None


def test_the_wood_texture_is_a_small_seamless_png():
    image = np.asarray(Image.open(io.BytesIO(wood_texture(3).data)).convert("L"), dtype=float)
    inner = np.abs(np.diff(image, axis=1)).mean()
    assert np.abs(image[:, 0] - image[:, -1]).mean() < 2 * inner
    assert len(wood_texture(3).data) < 20_000
    assert image.std() > 5


def test_finishes_are_reproducible_and_differ_by_seed():
    assert textured_finish(1) == textured_finish(1)
    assert textured_finish(1).case.base_color_texture != textured_finish(2).case.base_color_texture
