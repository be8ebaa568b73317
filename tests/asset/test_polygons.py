"""Polygons to triangles: all with an area, all corners kept, so that surfaces stay whole."""

import numpy as np
import pytest

from grafu.asset.mesh_files import read_mesh_file
from grafu.asset.polygons import PolygonConfig, triangulate
from grafu.asset.reading import has_area
from grafu.asset.resources import ModelFiles
from grafu.segmentation.mesh_shells import MeshShells

PLATE = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 2), (0, 2)]  # two corners on one side
GRID = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)]  # one in the middle of each side
ROW = [(0, 0), (1, 0), (2, 0), (3, 0), (3, 2), (2, 2), (1, 2), (0, 2), (0, 1)]  # no fan has triangles with an area
ELL = [(0, 0), (1, 0), (2, 0), (2, 1), (1.5, 1), (1, 1), (1, 2), (0, 2), (0, 1)]  # concave
RING = [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0), (1, 1), (1, 3), (3, 3), (3, 1), (1, 1)]  # a frame, with a bridge


def areas(outline, plane=2):
    """Returns the signed areas of the triangles of an outline in the plane whose normal is an axis."""
    points = np.insert(np.array(outline, float), plane, 0.5, axis=1)
    triangles, owner = triangulate(points, np.arange(len(points)), np.array([0, len(points)]))
    assert (owner == 0).all()
    corners = points[triangles]
    sign = -1.0 if plane == 1 else 1.0
    return sign * np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, plane] / 2, triangles


@pytest.mark.parametrize("plane", [0, 1, 2])
@pytest.mark.parametrize("outline", [PLATE, GRID, ROW, ELL, RING], ids=["plate", "grid", "row", "ell", "ring"])
def test_every_corner_is_kept_and_no_triangle_is_flat(outline, plane):
    x, y = np.array(outline, float).T
    whole = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() / 2
    for turned in (outline, outline[::-1], outline[3:] + outline[:3]):
        found, triangles = areas(turned, plane)
        sign = -1.0 if turned == outline[::-1] else 1.0
        assert len(found) == len(outline) - 2
        assert (sign * found > 1e-6).all()
        assert found.sum() == pytest.approx(sign * whole)
        assert set(triangles.ravel().tolist()) == set(range(len(outline)))


def test_polygons_without_corners_on_sides_are_fans_from_the_first_corner():
    for outline in ([(0, 0), (2, 0), (2, 1), (0, 1)], [(np.cos(a), np.sin(a)) for a in np.arange(12) * np.pi / 6]):
        _, triangles = areas(outline)
        np.testing.assert_array_equal(triangles, [[0, k, k + 1] for k in range(1, len(outline) - 1)])


def test_corners_on_a_line_give_triangles_without_area():
    found, _ = areas([(0, 0), (1, 0), (2, 0), (3, 0)])
    np.testing.assert_allclose(found, 0.0)


def test_a_polygon_of_very_many_corners_may_lose_straight_ones():
    side = np.linspace(0, 4, 80)[:-1]
    square = [(s, 0) for s in side] + [(4, s) for s in side] + [(4 - s, 4) for s in side] + [(0, 4 - s) for s in side]
    dented = [*square, (2, 1)]
    assert len(dented) > PolygonConfig().most
    found, _ = areas(dented)
    assert len(found) == len(dented) - 2
    assert np.abs(found).sum() == pytest.approx(16.0 - (4 / 79) * 2 / 2, abs=0.3)


def test_a_box_whose_front_was_cut_into_a_grid_stays_one_shell(tmp_path):
    """The sides of the box have corners where the cells of its front end: without them it would fall apart."""
    zs = [0, 0.4, 0.8, 1.2]
    front = [(x, 0, z) for z in zs for x in (0, 0.3, 0.7, 1)]
    back = [(0, 0.5, 0), (1, 0.5, 0), (1, 0.5, 1.2), (0, 0.5, 1.2)]
    cells = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4) for j in range(3) for i in range(3)]
    sides = [(0, 4, 8, 12, 19, 16), (3, 17, 18, 15, 11, 7), (0, 16, 17, 3, 2, 1), (12, 13, 14, 15, 18, 19)]
    lines = [f"v {x} {y} {z}" for x, y, z in front + back]
    lines += ["f " + " ".join(str(k + 1) for k in face) for face in [*cells, *sides, (19, 18, 17, 16)]]
    (tmp_path / "a.obj").write_text("\n".join(lines) + "\n")
    mesh = read_mesh_file(tmp_path / "a.obj", ModelFiles(tmp_path)).surfaces[0].mesh
    assert has_area(mesh).all()
    assert len(MeshShells.of([mesh]).owner) == 1
    assert mesh.area == pytest.approx(2 * (1.2 + 0.5 + 0.6))
