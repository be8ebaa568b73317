"""Furniture that was joined to one mesh: bowed fronts, drawers' boxes, leaves in their frames, handles on frames."""

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.division import divided
from solids import as_mesh, solid


def board(low, high):
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def cut(*meshes):
    """Returns the low and high ends of the fronts that one mesh of all these is cut into."""
    whole = merge_meshes(meshes)
    pieces = divided([whole], [True], [False]).get(0, [])
    found = (whole.with_faces(piece.faces).box for piece in pieces if piece.role == "front")
    return sorted((*np.round(box.low, 4), *np.round(box.high, 4)) for box in found)


def ends(*meshes):
    return sorted((*np.round(m.box.low, 4), *np.round(m.box.high, 4)) for m in meshes)


def ring(x0, x1, y0, y1, z0, z1, width):
    """Returns a frame as one closed surface."""
    square = [(x0, z0), (x1, z0), (x1, z1), (x0, z1)]
    inner = [(x0 + width, z0 + width), (x1 - width, z0 + width), (x1 - width, z1 - width), (x0 + width, z1 - width)]
    loops = [(square, y1), (square, y0), (inner, y0), (inner, y1)]
    points = [(x, y, z) for loop, y in loops for x, z in loop]
    quads = [
        (4 * a + k, 4 * a + (k + 1) % 4, 4 * ((a + 1) % 4) + (k + 1) % 4, 4 * ((a + 1) % 4) + k)
        for a in range(4)
        for k in range(4)
    ]
    return TriangleMesh(np.array(points), np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))]))


def bowed(left, right, low, high, bulge, thick=0.02, count=12):
    """Returns a front whose middle comes forward by `bulge`; its ends are at y = -0.2."""
    xs = np.linspace(left, right, count + 1)
    out = -0.2 - bulge * (1.0 - (2.0 * (xs - left) / (right - left) - 1.0) ** 2)
    outline = np.vstack([np.column_stack([xs, out]), np.column_stack([xs, out + thick])[::-1]])
    n = len(outline)
    points = np.vstack([np.column_stack([outline, np.full(n, z)]) for z in (low, high)])
    walls = [t for k in range(n) for t in ((k, (k + 1) % n, n + (k + 1) % n), (k, n + (k + 1) % n, n + k))]
    strips = [(k, n - 1 - k, n - 2 - k, k + 1) for k in range(count)]
    caps = [t for a, b, c, d in strips for t in ((a, b, c), (a, c, d))]
    faces = [*walls, *caps, *(tuple(i + n for i in t[::-1]) for t in caps)]
    return TriangleMesh(points, np.array(faces))


def tub(low, high, thick=0.01):
    """Returns a box with walls, open from above, as one closed surface."""
    (x0, y0, z0), (x1, y1, z1) = low, high
    outer = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)]
    inner = [(x0 + thick, y0 + thick), (x1 - thick, y0 + thick), (x1 - thick, y1 - thick), (x0 + thick, y1 - thick)]
    loops = [(outer, z0), (outer, z1), (inner, z1), (inner, z0 + thick)]
    points = [(x, y, z) for loop, z in loops for x, y in loop]
    faces = [(0, 2, 1), (0, 3, 2), (12, 13, 14), (12, 14, 15)]
    for a in range(3):
        for k in range(4):
            p, q, r, s = 4 * a + k, 4 * a + (k + 1) % 4, 4 * a + 4 + (k + 1) % 4, 4 * a + 4 + k
            faces += [(p, q, r), (p, r, s)]
    return TriangleMesh(np.array(points), np.array(faces))


CASE = [
    board((-0.42, -0.2, 0.0), (-0.4, 0.2, 0.62)),
    board((0.4, -0.2, 0.0), (0.42, 0.2, 0.62)),
    board((-0.4, 0.19, 0.0), (0.4, 0.2, 0.62)),
    board((-0.42, -0.2, 0.62), (0.42, 0.2, 0.64)),
]
ROWS = ((0.02, 0.2), (0.22, 0.4), (0.42, 0.6))


@pytest.mark.parametrize("bulge", [0.0, 0.07])
def test_a_bowed_front_is_as_thick_as_a_straight_one(bulge):
    drawers = [bowed(-0.39, 0.39, low, high, bulge) for low, high in ROWS]
    knobs = [board((-0.01, -0.23 - bulge, z + 0.08), (0.01, -0.2 - bulge, z + 0.1)) for z, _ in ROWS]
    assert cut(*CASE, *drawers, *knobs) == ends(*drawers)


def test_a_block_that_is_as_deep_as_a_bowed_front_is_none():
    blocks = [board((-0.39, -0.27, low), (0.39, -0.18, high)) for low, high in ROWS]
    knobs = [board((0.3, -0.3, z + 0.01), (0.32, -0.27, z + 0.03)) for z, _ in ROWS]
    assert cut(*CASE, *blocks, *knobs) == []


def test_a_panel_with_a_sunk_field_is_not_bowed():
    panel = as_mesh(solid((0.1, -0.282, 0.05), (0.3, -0.2, 0.6)) - solid((0.12, -0.3, 0.2), (0.28, -0.25, 0.5)))
    door = board((-0.39, -0.22, 0.05), (0.08, -0.2, 0.6))
    knob = board((0.05, -0.25, 0.3), (0.07, -0.22, 0.32))
    assert cut(*CASE, panel, door, knob) == ends(door)


def test_the_box_of_a_drawer_that_is_one_body_goes_with_its_front():
    fronts = [board((-0.39, -0.22, low), (0.39, -0.2, high)) for low, high in ROWS]
    tubs = [tub((-0.37, -0.2, low + 0.01), (0.37, 0.15, high - 0.03)) for low, high in ROWS]
    knobs = [board((-0.01, -0.25, z + 0.08), (0.01, -0.22, z + 0.1)) for z, _ in ROWS]
    both = [merge_meshes(pair) for pair in zip(fronts, tubs, strict=True)]
    assert cut(*CASE, *fronts, *tubs, *knobs) == ends(*both)
    # a block shows one face: it may be the case itself
    blocks = [board(tuple(t.box.low), tuple(t.box.high)) for t in tubs]
    assert cut(*CASE, *fronts, *blocks, *knobs) == ends(*fronts)


def house_door(has_lever, panel_lever=False):
    """Returns leaf, panels and lever of a door, and the jambs and the head that it hangs in; nothing is behind it."""
    leaf = board((-0.41, -0.04, 0.005), (0.41, 0.0, 2.03))
    places = [(x, z0, z1) for x in (-0.31, 0.04) for z0, z1 in ((0.15, 0.8), (0.95, 1.85))]
    panels = [board((x, -0.05, z0), (x + 0.27, -0.038, z1)) for x, z0, z1 in places]
    x = 0.2 if panel_lever else 0.36
    depth = -0.05 if panel_lever else -0.04
    lever = [
        board((x - 0.012, depth - 0.04, 0.99), (x + 0.012, depth, 1.01)),
        board((x - 0.13, depth - 0.06, 0.99), (x + 0.012, depth - 0.04, 1.01)),
    ]
    frame = [
        board((-0.5, -0.07, 0.0), (-0.414, 0.07, 2.12)),
        board((0.414, -0.07, 0.0), (0.5, 0.07, 2.12)),
        board((-0.414, -0.07, 2.034), (0.414, 0.07, 2.12)),
    ]
    return [leaf, *panels], lever if has_lever else [], frame


def test_the_leaf_of_a_door_is_found_in_its_frame_by_its_lever():
    leaf, lever, frame = house_door(has_lever=True)
    assert cut(*leaf, *lever, *frame) == ends(merge_meshes(leaf))


def test_a_panel_in_a_frame_without_a_lever_is_no_leaf():
    (leaf, *_), _, frame = house_door(has_lever=False)
    assert cut(leaf, *frame) == []


OVEN = [board((-0.3, -0.3, 0.0), (0.3, 0.3, 0.9))]
PANE = board((-0.22, -0.32, 0.27), (0.22, -0.302, 0.63))  # as thick as the frame, nearly


@pytest.mark.parametrize("z", [0.665, 0.45])
def test_a_frame_with_a_handle_on_it_moves_with_its_thick_pane(z):
    door = ring(-0.29, 0.29, -0.325, -0.3, 0.2, 0.7, 0.07)
    foot = -0.325 if z > 0.6 else -0.32
    bar = board((-0.1, foot - 0.04, z - 0.01), (0.1, foot, z + 0.01))
    drawer, knob = board((-0.29, -0.32, 0.02), (0.29, -0.3, 0.18)), board((-0.01, -0.35, 0.09), (0.01, -0.32, 0.11))
    moving = merge_meshes([door, PANE]) if z > 0.6 else PANE  # on the pane: the frame stays
    assert cut(*OVEN, door, PANE, bar, drawer, knob) == ends(moving, drawer)


@pytest.mark.parametrize("count", [2, 5])
def test_a_strip_with_a_row_of_knobs_is_no_drawer(count):
    rows = [board((-0.29, -0.32, low), (0.29, -0.3, high)) for low, high in ((0.74, 0.88), (0.4, 0.72), (0.02, 0.38))]
    xs = np.linspace(-0.22, 0.22, count)
    knobs = [board((x - 0.015, -0.35, 0.8), (x + 0.015, -0.32, 0.83)) for x in xs]
    knobs += [board((-0.01, -0.35, z), (0.01, -0.32, z + 0.02)) for z in (0.5, 0.2)]
    assert cut(*OVEN, *rows, *knobs) == ends(*(rows if count == 2 else rows[1:]))
