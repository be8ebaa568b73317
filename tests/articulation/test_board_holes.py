"""Holes through a board: found where they are, and boards without any are known quickly."""

import numpy as np
import pytest
import shapely

from grafu.articulation.board_holes import BoardHole, holes_through
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.solids import extrude

LIMITS = (0.04, 0.12, 0.05)  # metres: diameters that are seen, and the thickness of a board


def holes_of(mesh: TriangleMesh) -> tuple[BoardHole, ...]:
    return holes_through(mesh, *LIMITS)


def board(*holes: shapely.Polygon, size: tuple[float, float] = (0.8, 0.5)) -> TriangleMesh:
    """A board of 18 mm, drawn in strips, so that it has many faces."""
    strips = [shapely.box(x, 0.0, x + size[0] / 8, size[1]) for x in np.arange(8) * size[0] / 8]
    return merge_meshes([extrude(strip.difference(shapely.union_all(holes)), 0.0, 0.018) for strip in strips])


def no_union(*_: object) -> None:
    raise AssertionError("it was to be known without a union")


@pytest.mark.parametrize("radius", [0.0205, 0.03, 0.055])
@pytest.mark.parametrize("at", [(0.1, 0.1), (0.313, 0.271), (0.72, 0.43)])
def test_a_hole_is_found_wherever_it_is(radius, at):
    (hole,) = holes_of(board(shapely.Point(*at).buffer(radius)))
    assert hole.middle[:2] == pytest.approx(at, abs=1e-3)
    assert hole.radius == pytest.approx(radius, rel=0.02)


@pytest.mark.parametrize("radius", [0.015, 0.065])
def test_what_is_too_narrow_or_too_wide_is_none(radius):
    assert holes_of(board(shapely.Point(0.4, 0.25).buffer(radius))) == ()


def test_a_board_without_a_hole_needs_no_union(monkeypatch):
    whole = board()
    monkeypatch.setattr(shapely, "union_all", no_union)
    assert holes_of(whole) == ()


def test_a_board_too_slim_for_any_hole_needs_no_union(monkeypatch):
    slim = board(shapely.Point(0.4, 0.06).buffer(0.02), size=(0.8, 0.12))
    monkeypatch.setattr(shapely, "union_all", no_union)
    assert holes_of(slim) == ()


def test_a_hole_that_the_other_side_alone_shows_is_none():
    """The back has no hole: one does not see through."""
    front, back = board(shapely.Point(0.4, 0.25).buffer(0.03)), board()
    assert holes_of(merge_meshes([front, back.translated(np.array([0.0, 0.0, 0.018]))])) == ()
