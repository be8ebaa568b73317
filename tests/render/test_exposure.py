"""Pixels are looked at once; those on a border with all their samples, lit as the surface that each of them shows."""

import numpy as np
import pytest

from grafu.articulation.articulated_object import Visual
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.render.camera import Camera
from grafu.render.exposure import Exposure, PictureStyle
from grafu.render.picture import render
from grafu.render.pixel_window import PixelWindow, any_in_blocks, enlarged, smoothed, surfaces_of
from grafu.render.ray_scene import RayScene

SIZE = (60, 40)
CLEAR = PictureStyle("transparent", shadow=False, outlines=False)
HEAD_ON = Camera(np.array([0.0, -4.0, 0.0]), np.zeros(3), fov=np.arctan(0.5))


def board(x, z, y=0.0, color=(0.5, 0.5, 0.5, 1.0), mode="OPAQUE"):
    box = Box(np.array([x[0], y, z[0]]), np.array([x[1], y + 0.02, z[1]]))
    material = Material(f"{color}", color, alpha_mode=mode)
    return Visual(f"{x}{z}{y}", (Surface(TriangleMesh.box_mesh(box), material),))


@pytest.fixture
def casts(monkeypatch):
    """The number of rays from the camera, at each cast."""
    counts: list[int] = []
    cast = RayScene.cast

    def counted(self, origins, directions):
        counts.append(len(directions))
        return cast(self, origins, directions)

    monkeypatch.setattr(RayScene, "cast", counted)
    return counts


def test_a_plain_front_takes_one_ray_a_pixel_and_four_on_its_border_alone(casts):
    render([board((-5, 5), (-5, 5))], HEAD_ON, SIZE, CLEAR)
    assert casts[0] == SIZE[0] * SIZE[1]
    assert casts[1] < 4 * 2 * sum(SIZE)  # it fills the picture, whose edge counts as a border
    casts.clear()
    seen = render([board((-0.3, 0.3), (-0.3, 0.3))], HEAD_ON, SIZE, CLEAR)[..., 3] > 0
    border = 2 * (seen.any(axis=0).sum() + seen.any(axis=1).sum())
    assert border < casts[1] / 4 < 3 * border


def test_a_pixel_on_a_border_is_covered_as_far_as_its_samples_are():
    picture = render([board((-0.3, 0.3), (-0.3, 0.3))], Camera(np.array([-2.0, -3.5, 1.0]), np.zeros(3)), SIZE, CLEAR)
    assert {64, 128, 191} & set(np.unique(picture[..., 3]).tolist())


def test_a_board_of_two_colours_and_one_with_a_groove_have_borders_inside(casts):
    plain = [board((-0.3, 0.3), (-0.3, 0.3))]
    render(plain, HEAD_ON, SIZE, CLEAR)
    colored = [board((-0.3, 0.0), (-0.3, 0.3)), board((0.0, 0.3), (-0.3, 0.3), color=(0.9, 0.5, 0.5, 1.0))]
    render(colored, HEAD_ON, SIZE, CLEAR)
    stepped = Visual("stepped", (*plain[0].surfaces, *board((-0.1, 0.1), (-0.3, 0.3), -0.02).surfaces))
    render([stepped], HEAD_ON, SIZE, CLEAR)
    assert casts[3] > casts[1]
    assert casts[5] > casts[1]


def test_all_samples_of_glass_are_looked_through():
    pane = board((-0.5, 0.5), (-0.5, 0.5), -1.0, (1.0, 1.0, 1.0, 0.3), "BLEND")
    behind = board((-0.31, 0.31), (-0.31, 0.31), color=(0.9, 0.05, 0.05, 1.0))
    picture = render([pane, behind], HEAD_ON, SIZE, CLEAR).astype(int)
    red = picture[20, :, 0] - picture[20, :, 1]
    assert len({int(r) for r in red if 5 < r < red.max() - 5}) > 0  # the edge behind is smooth, too


def test_a_sample_on_a_border_is_lit_as_its_own_surface_not_as_the_pixel_beside_it():
    """A white front stands before a dark niche: no sample of the front is as dark as the niche."""
    niche = [board((-1, 1), (-1, 1), 0.6), *(board((x, x + 0.02), (-1, 1), 0.02) for x in (-0.3, 0.28))]
    front = board((-0.02, 0.09), (-1, 1), -0.3, (1.0, 1.0, 1.0, 1.0))
    samples = Exposure(RayScene([*niche, front]), HEAD_ON, SIZE, CLEAR).samples()
    row = samples[40, :, 0]
    lit = np.median(row[row > 0.8 * row.max()])
    between = row[(row > 0.55 * lit) & (row < 0.9 * lit)]
    assert len(between) == 0


def test_a_window_knows_which_of_its_pixels_are_in_the_picture():
    window = PixelWindow.around(np.array([0, 1, 60]), SIZE)
    assert window.shape == (6, 6)
    np.testing.assert_array_equal(
        window.pixels(np.ones((6, 6), bool)), [y * 60 + x for y in range(4) for x in range(4)]
    )
    surface = window.grid(np.array([5, 6, 7]), -1)
    found = window.nearest(surface, np.array([0, 1, 61, 61]), np.array([5, 7, 5, 9]))
    assert found[3] == -1
    np.testing.assert_array_equal(surface.reshape(-1)[found[:3]], [5, 7, 5])


def test_what_is_smoothed_stays_on_its_surface():
    surface = np.repeat([[0, 0, 0, 1, 1, 1]], 4, axis=0)
    (mean,) = smoothed([np.where(surface == 1, np.float32(1), np.float32(0))], surface)
    np.testing.assert_array_equal(mean, surface)


def test_surfaces_of_one_visual_differ_by_the_side_that_they_face():
    scene = RayScene([board((-0.3, 0.3), (-0.3, 0.3))])
    origins = np.array([[0, -2, 0], [0, 2, 0], [2, 0.01, 0]], np.float32)
    directions = np.array([[0, 1, 0], [0, -1, 0], [-1, 0, 0]], np.float32)
    assert len(set(surfaces_of(scene.cast(origins, directions)).tolist())) == 3


def test_a_shadow_is_found_for_blocks_of_samples(monkeypatch):
    counts: list[int] = []
    blocked = RayScene.blocked

    def counted(self, origins, directions, reach):
        counts.append(len(origins))
        return blocked(self, origins, directions, reach)

    monkeypatch.setattr(RayScene, "blocked", counted)
    seen = Camera(np.array([-2.0, -3.5, 1.5]), np.zeros(3))
    shadowed = render([board((-0.3, 0.3), (-0.3, 0.3))], seen, SIZE, PictureStyle("transparent", outlines=False))
    assert counts[-1] <= SIZE[0] * SIZE[1]  # one in four samples, of which a pixel has four
    alpha = shadowed[..., 3].astype(int)
    assert ((alpha > 0) & (alpha < 255)).sum() > 50  # the floor beside the board


@pytest.mark.parametrize("shape", [(8, 12), (7, 10), (1, 1)])
def test_blocks_cover_all_of_a_grid_and_grow_to_it_again(shape):
    chosen = np.zeros(shape, dtype=bool)
    chosen[-1, -1] = True
    blocks = any_in_blocks(chosen, 4)
    assert blocks.shape == tuple(-(-side // 4) for side in shape)
    assert blocks[-1, -1]
    assert blocks.sum() == 1
    large = enlarged(np.full(blocks.shape, 0.5, np.float32), 4)
    assert large.shape == tuple(4 * side for side in blocks.shape)
    assert np.all(large == 0.5)
