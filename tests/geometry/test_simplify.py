"""A closed surface of many faces becomes one of few that lies where it was; an open one stays as it is."""

import numpy as np
import trimesh

from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.simplify import simplified

TOLERANCE = 0.002


def uneven_board(step=0.01, off=0.001):
    """A board of 0.4 x 0.02 x 0.6 m in small triangles, whose vertices are off by up to `off` metres."""
    board = trimesh.creation.box((0.4, 0.02, 0.6)).subdivide_to_size(step)
    board.merge_vertices()
    shift = np.random.default_rng(0).uniform(-off, off, board.vertices.shape)
    return TriangleMesh(np.asarray(board.vertices) + shift, np.asarray(board.faces))


def test_a_board_of_many_faces_becomes_one_of_few_within_its_hull():
    board = uneven_board()
    coarse = simplified(board, TOLERANCE)

    assert len(coarse.faces) < 0.25 * len(board.faces)
    assert (coarse.box.low >= board.box.low - 1e-6).all()
    assert (coarse.box.high <= board.box.high + 1e-6).all()
    assert np.allclose(coarse.box.size, board.box.size, atol=2 * TOLERANCE)


def test_what_is_coarser_than_the_tolerance_stays():
    box = TriangleMesh.box_mesh(uneven_board().box)

    assert simplified(box, TOLERANCE) is box


def test_an_open_surface_stays_as_it_is():
    board = uneven_board()
    opened = board.with_faces(np.arange(1, len(board.faces)))

    assert simplified(opened, TOLERANCE) is opened
