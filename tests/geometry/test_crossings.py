"""Lines through triangles: as many crossings as there are, at their heights, in order, whichever way faces look."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.crossings import line_crossings
from grafu.geometry.mesh import TriangleMesh, merge_meshes

XS, YS = np.linspace(0.11, 0.87, 7), np.linspace(0.13, 0.9, 4)
UNIT = TriangleMesh.box_mesh(Box(np.zeros(3), np.ones(3)))


def test_every_line_enters_a_box_at_its_top_and_leaves_it_at_its_bottom():
    found = line_crossings(np.asarray(UNIT.triangles), XS, YS)
    assert found.line.tolist() == np.repeat(np.arange(28), 2).tolist()
    assert np.allclose(found.height.reshape(-1, 2), [1.0, 0.0])
    assert found.looks_up.reshape(-1, 2).tolist() == [[True, False]] * 28


@given(st.lists(st.tuples(*[st.floats(0.0, 0.9)] * 3), min_size=1, max_size=6), st.floats(0.05, 0.5))
def test_crossings_of_boxes_come_in_pairs_from_high_to_low(lows, side):
    boxes = [Box(vec3(*low), vec3(*low) + side) for low in lows]
    mesh = merge_meshes([TriangleMesh.box_mesh(b) for b in boxes])
    found = line_crossings(np.asarray(mesh.triangles), XS + 1e-4, YS + 1e-4)
    for line, (x, y) in enumerate(np.stack(np.meshgrid(XS + 1e-4, YS + 1e-4, indexing="ij"), axis=-1).reshape(-1, 2)):
        over = [b for b in boxes if np.all(np.abs(b.center[:2] - (x, y)) < b.half[:2] - 1e-9)]
        clear = [b for b in boxes if np.any(np.abs(np.abs(b.center[:2] - (x, y)) - b.half[:2]) < 1e-9)]
        if clear or any(abs(abs(x - b.low[0]) - abs(y - b.low[1])) < 1e-9 for b in over):
            continue  # on a border or a diagonal, where a line meets two faces
        heights = found.height[found.line == line]
        assert np.allclose(heights, sorted((float(z) for b in over for z in (b.low[2], b.high[2])), reverse=True))


def test_faces_along_the_lines_and_faces_aside_are_not_crossed():
    upright = np.array([[(0.5, 0.0, 0.0), (0.5, 1.0, 0.0), (0.5, 0.5, 1.0)]])
    assert len(line_crossings(upright, XS, YS).line) == 0
    assert len(line_crossings(np.asarray(UNIT.triangles) + 5.0, XS, YS).line) == 0
    assert len(line_crossings(np.zeros((0, 3, 3)), XS, YS).line) == 0


def test_a_slanted_face_is_met_at_its_own_height():
    slope = np.array([[(-1.0, -1.0, -2.0), (3.0, -1.0, 2.0), (-1.0, 5.0, 4.0)]])  # z = x + y
    found = line_crossings(slope, XS, YS)
    x, y = np.meshgrid(XS, YS, indexing="ij")
    assert np.allclose(found.height, (x + y).reshape(-1))
