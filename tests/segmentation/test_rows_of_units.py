"""Rows of kitchen units drawn as one surface: low drawers, wall units set back, a case that looks like a drawer."""

from itertools import pairwise

import numpy as np
import pytest

from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.segmentation.creases import drawn_fronts, drawn_handles
from solids import as_mesh, solid

GAP, THICK = 0.01, 0.02
Fronts = list[tuple[float, float, float, float, float]]  # left, right, lower, upper end, and where its case ends (y)


def unit(left: float, right: float, levels: tuple[float, ...], face: float = 0.0) -> Fronts:
    """The fronts of one unit, between levels."""
    return [(left + GAP, right - GAP, low + GAP, high - GAP, face) for low, high in pairwise(levels)]


def drawn_on(cases, fronts: Fronts, thick: float = THICK) -> TriangleMesh:
    """One closed surface: cases, and fronts that stand out of them."""
    body = solid(*cases[0])
    for case in cases[1:]:
        body += solid(*case)
    for left, right, low, high, face in fronts:
        body += solid((left, face - thick, low), (right, face + 0.05, high))
    return as_mesh(body)


def found(mesh: TriangleMesh) -> list[tuple[float, ...]]:
    pieces = drawn_fronts([mesh], [True], [np.zeros(len(mesh.faces), np.int64)]).get(0, [])
    boxes = [mesh.with_faces(piece.faces).box for piece in pieces if piece.role == "front"]
    return sorted(tuple(np.round([b.low[0], b.high[0], b.low[2], b.high[2]], 3)) for b in boxes)


def outlines(fronts: Fronts) -> list[tuple[float, ...]]:
    return sorted(tuple(np.round(front[:4], 3)) for front in fronts)


BASE = ((0.0, 0.0, 0.0), (4.2, 0.6, 0.88))
DRAWERS = (0.1, 0.4, 0.7, 0.86)


def test_low_drawers_and_a_narrow_unit_are_found_in_line_with_the_others():
    """The upper drawers are 0.14 high and the last unit 0.18 wide, of 4.2: alone they would be rails."""
    fronts = [front for k in range(6) for front in unit(0.66 * k, 0.66 * k + 0.66, DRAWERS)]
    fronts += unit(3.98, 4.18, DRAWERS)
    assert found(drawn_on([BASE], fronts)) == outlines(fronts)


def test_plinths_as_wide_as_a_unit_and_boards_of_other_depth_are_no_drawers():
    fronts = [front for k in range(6) for front in unit(0.66 * k, 0.66 * k + 0.66, (0.1, 0.5, 0.86))]
    plinths = [(0.66 * k + GAP, 0.66 * k + 0.65, 0.01, 0.075, 0.0) for k in range(6)]
    assert found(drawn_on([BASE], [*fronts, *plinths])) == outlines(fronts)
    boards = [(0.66 * k + GAP, 0.66 * k + 0.65, 0.01, 0.09, 0.01) for k in range(6)]
    assert found(drawn_on([BASE], [*fronts, *boards])) == outlines(fronts)


def test_wall_units_behind_the_front_of_the_units_below_are_found():
    wall = ((0.0, 0.25, 1.4), (2.4, 0.6, 2.2))
    back = ((0.0, 0.58, 0.0), (2.4, 0.6, 2.2))  # what holds both
    base = ((0.0, 0.0, 0.0), (2.4, 0.6, 0.88))
    low = [front for k in range(4) for front in unit(0.6 * k, 0.6 * k + 0.6, (0.1, 0.86))]
    high = [front for k in range(4) for front in unit(0.6 * k, 0.6 * k + 0.6, (1.4, 2.2), 0.25)]
    assert found(drawn_on([base, wall, back], low + high)) == outlines(low + high)


def test_panels_at_the_back_of_open_compartments_are_no_fronts():
    base = ((0.0, 0.0, 0.0), (2.4, 0.6, 0.88))
    back = ((0.0, 0.5, 0.0), (2.4, 0.6, 2.2))
    boards = [((x, 0.0, 0.8), (x + 0.02, 0.55, 2.2)) for x in (0.0, 0.79, 1.59, 2.38)] + [
        ((0.0, 0.0, 2.18), (2.4, 0.55, 2.2))
    ]
    low = [front for k in range(4) for front in unit(0.6 * k, 0.6 * k + 0.6, (0.1, 0.86))]
    panels = [(x + 0.05, x + 0.75, 0.95, 2.1, 0.5) for x in (0.02, 0.81, 1.61)]
    assert found(drawn_on([base, back, *boards], low + panels)) == outlines(low)


def row_between(levels, face, low_end, high_end, width=0.6, count=3) -> tuple[TriangleMesh, Fronts]:
    """Units between two high ones, each a body of its own that touches the next, and all their fronts."""
    end = 0.6 + count * width
    high = [front for x in (0.0, end) for front in unit(x, x + 0.6, (0.1, 0.7, 1.6, 2.2))]
    cases = [((x, 0.0, 0.0), (x + 0.6, 0.6, 2.2)) for x in (0.0, end)]
    low = [front for k in range(count) for front in unit(0.6 + k * width, 0.6 + (k + 1) * width, levels, face)]
    middle = drawn_on([((0.6, face, low_end), (end, 0.6, high_end))], low)
    bodies = [drawn_on([case], high[3 * k : 3 * k + 3]) for k, case in enumerate(cases)]
    return merge_meshes([*bodies, middle]), high + low


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize("levels", [(0.1, 0.5, 0.86), (0.1, 0.86), (0.1, 0.24, 0.38, 0.7)])
def test_low_units_between_high_ones_are_a_case_with_fronts_and_no_drawer(levels, count):
    mesh, fronts = row_between(levels, 0.0, 0.0, 0.88, count=count)
    assert found(mesh) == outlines(fronts)


def test_a_wall_unit_with_a_wall_behind_it_is_a_case_with_a_door():
    mesh, fronts = row_between((1.41, 2.19), 0.1, 1.4, 2.2, count=1)
    wall = as_mesh(solid((0.0, 1.0, 0.0), (1.8, 1.02, 2.2)))
    assert found(merge_meshes([mesh, wall])) == outlines(fronts)


def test_a_drawer_drawn_as_a_body_with_one_handle_stays_one():
    case = solid((0.0, 0.0, 0.0), (0.6, 0.6, 0.9))
    for low in (0.05, 0.35, 0.65):
        case -= solid((0.02, -1.0, low), (0.58, 0.55, low + 0.2))
    drawers = [((0.03, -0.01, low + 0.01), (0.57, 0.5, low + 0.19)) for low in (0.05, 0.35, 0.65)]
    bodies = [as_mesh(solid(*d) + solid((0.28, -0.04, d[0][2] + 0.08), (0.32, 0.0, d[0][2] + 0.1))) for d in drawers]
    assert found(merge_meshes([as_mesh(case), *bodies])) == [
        (0.03, 0.57, 0.06, 0.24),
        (0.03, 0.57, 0.36, 0.54),
        (0.03, 0.57, 0.66, 0.84),
    ]


def door(handle, pieces=()) -> TriangleMesh:
    """A door of 0.5 x 2 with a box on its face, in one surface."""
    body = solid((0.0, -0.02, 0.1), (0.5, 0.0, 2.1))
    for piece in (handle, *pieces):
        body += solid(*piece)
    return as_mesh(body)


CASE = as_mesh(solid((-0.02, 0.0, 0.0), (1.04, 0.6, 2.2)) - solid((0.0, -1.0, 0.02), (1.02, 0.58, 2.18)))
HANDLE = ((0.44, -0.05, 0.9), (0.46, -0.01, 1.2))


def handles_of(*meshes):
    one = [np.zeros(len(mesh.faces), np.int64) for mesh in meshes]
    cut = drawn_handles(meshes, [k < len(meshes) - 1 for k in range(len(meshes))], one)
    roles = {k: [(p.role, meshes[k].with_faces(p.faces).box) for p in pieces] for k, pieces in cut.items()}
    return {k: [box for role, box in pieces if role == "handle"] for k, pieces in roles.items()}


def test_a_handle_drawn_on_a_door_in_one_surface_with_it_is_told_apart():
    ((k, (handle,)),) = handles_of(door(HANDLE), CASE).items()
    assert k == 0
    assert np.allclose([handle.low, handle.high], [(0.44, -0.05, 0.9), (0.46, -0.02, 1.2)])


@pytest.mark.parametrize(
    "drawn",
    [
        ((0.1, -0.03, 0.3), (0.4, -0.01, 1.9)),  # a raised panel
        ((0.24, -0.024, 0.3), (0.27, -0.01, 1.6)),  # a strip
        ((0.02, -0.027, 0.12), (0.04, -0.01, 2.08)),  # a bead along the whole of it
    ],
    ids=["panel", "strip", "bead"],
)
def test_mouldings_of_a_door_are_no_handles(drawn):
    assert handles_of(door(drawn), CASE) == {}
