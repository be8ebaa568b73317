"""Rays against boxes, where every distance is known; misses, empty meshes, and robust medians."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import (
    RayCaster,
    embree_scene,
    line_crossings,
    outer_faces,
    robust_median,
    stands_between_walls,
    wall_distances,
)

CUBE = TriangleMesh.box_mesh(Box(vec3(-0.5, -0.5, -0.5), vec3(0.5, 0.5, 0.5)))
CASTER = RayCaster(CUBE)
X = vec3(1.0, 0.0, 0.0)


@given(*[st.floats(-0.45, 0.45)] * 2, st.floats(0.51, 2.0))
def test_rays_meet_the_near_side_of_a_cube_to_a_micrometre(y, z, start):
    found = CASTER.along(np.array([[-start, y, z], [start, y, z]]), X)
    assert found[0] == pytest.approx(start - 0.5, abs=1e-6)
    assert found[1] == np.inf  # it looks away


def test_rays_from_inside_meet_the_far_side_whichever_way_faces_look():
    inverted = RayCaster(TriangleMesh(CUBE.vertices, CUBE.faces[:, ::-1]))
    for caster in (CASTER, inverted):
        assert caster.along(np.zeros((1, 3)), X)[0] == pytest.approx(0.5, abs=1e-6)


@pytest.mark.parametrize("unused", [0, 100])
def test_corners_may_be_shared_or_not(unused):
    """Which way a scene is filled follows from the number of vertices."""
    vertices = np.vstack([CUBE.vertices, np.full((unused, 3), 9.0)]).astype(np.float32)
    scene = embree_scene(vertices, CUBE.faces.astype(np.int32))
    found = scene.run(np.float32([[-2, 0, 0]]), np.float32([[1, 0, 0]]), query="DISTANCE")
    assert found[0] == pytest.approx(1.5)


def test_each_ray_has_its_own_direction():
    directions = np.vstack([np.eye(3), -np.eye(3)])
    found = CASTER.distances(-2.0 * directions, directions)
    np.testing.assert_allclose(found, 1.5, atol=1e-6)


def test_the_first_of_several_faces_counts():
    row = merge_meshes([CUBE.translated(vec3(x, 0.0, 0.0)) for x in (6.0, 3.0, 9.0)])
    assert RayCaster(row).along(np.zeros((1, 3)), X)[0] == pytest.approx(2.5, abs=1e-6)


def test_a_sheet_is_met_from_both_sides():
    sheet = RayCaster(CUBE.with_faces(np.flatnonzero(CUBE.face_normals[:, 0] > 0.5)))
    found = sheet.distances(np.array([[-1.0, 0.1, 0.2], [2.0, 0.1, 0.2]]), np.array([X, -X]))
    np.testing.assert_allclose(found, [1.5, 1.5], atol=1e-6)


def test_nothing_is_met_where_there_is_nothing():
    empty = RayCaster(TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64)))
    assert np.isinf(empty.along(np.zeros((3, 3)), X)).all()
    assert CASTER.along(np.zeros((0, 3)), X).shape == (0,)


@pytest.mark.parametrize(
    ("distances", "median"),
    [
        ([1.0, 2.0, 3.0], 2.0),
        ([1.0, 2.0, 9.0, np.inf], 1.5),  # 9 is out of reach
        ([1.0, np.inf, np.inf, np.inf], np.inf),  # a quarter of the rays is too few
        ([1.0, 2.0, np.inf, np.inf], 1.5),
        ([np.inf], np.inf),
        ([], np.inf),
    ],
)
def test_the_robust_median_asks_for_enough_hits_in_reach(distances, median):
    assert robust_median(np.array(distances), reach=5.0) == median


def box(low, high) -> TriangleMesh:
    return TriangleMesh.box_mesh(Box(np.array(low, float), np.array(high, float)))


def test_of_a_box_around_a_box_the_outer_one_is_seen():
    seen = outer_faces(merge_meshes([box((0, 0, 0), (1, 1, 1)), box((0.1, 0.1, 0.1), (0.9, 0.9, 0.9))]))

    assert seen.tolist() == [True] * 12 + [False] * 12


def test_of_an_open_cavity_the_walls_are_seen():
    inner = box((0.1, -0.5, 0.1), (0.9, 0.9, 0.9))  # it comes out of the front of the outer one
    faces = inner.face_normals[:, 1] > -0.5
    shell = box((0, 0, 0), (1, 1, 1))
    mesh = merge_meshes([shell.with_faces(shell.face_normals[:, 1] > -0.5), inner.with_faces(faces)])

    assert outer_faces(mesh).all()


def test_faces_where_two_boards_touch_are_hidden():
    mesh = merge_meshes([box((0, 0, 0), (1, 0.1, 1)), box((0, 0.1, 0), (1, 0.2, 1))])
    hidden = mesh.face_areas[~outer_faces(mesh)].sum()

    assert np.isclose(hidden, 2.0)


@given(st.floats(1e-3, 1e3), st.tuples(*[st.floats(-2, 2)] * 3))
def test_neither_size_nor_place_matters(scale, place):
    mesh = merge_meshes([box((0, 0, 0), (2, 1, 1)), box((0.1, 0.1, 0.1), (0.9, 0.9, 0.9))])
    moved = TriangleMesh(scale * (mesh.vertices + np.array(place)), mesh.faces)

    assert outer_faces(moved).tolist() == [True] * 12 + [False] * 12


def test_a_sheet_is_seen_from_either_side_and_nothing_of_nothing():
    assert outer_faces(TriangleMesh(np.eye(3), np.array([[0, 1, 2]]))).tolist() == [True]
    assert outer_faces(merge_meshes([])).tolist() == []


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


def walls_apart(length: float) -> RayCaster:
    """Two upright boards at x = -0.5 and 0.5 along y, the right one `length` long."""
    left = TriangleMesh.box_mesh(Box(vec3(-0.52, 0.0, 0.0), vec3(-0.5, 1.0, 1.0)))
    right = TriangleMesh.box_mesh(Box(vec3(0.5, 0.0, 0.0), vec3(0.52, length, 1.0)))
    return RayCaster(merge_meshes([left, right]))


def test_a_place_lies_between_walls_where_both_are_met() -> None:
    depths, heights = np.linspace(0.1, 0.9, 5), np.array([0.2, 0.8])
    places = (1, depths), (2, heights)
    walls = walls_apart(0.6).along

    between = stands_between_walls(walls, vec3(0.1, 0.0, 0.0), *places)
    right = wall_distances(walls, vec3(0.1, 0.0, 0.0), *places, 1.0)

    np.testing.assert_array_equal(between, [True, True, True, False, False])
    np.testing.assert_allclose(right[:3], 0.4, atol=1e-6)
    assert np.isinf(right[3:]).all()
    assert not stands_between_walls(walls, vec3(0.1, 0.0, 0.0), *places, reach=0.5).any()


def test_walls_count_from_half_of_the_heights_on() -> None:
    heights = np.array([0.2, 0.8, 1.2, 1.4, 1.6])
    walls = walls_apart(1.0).along

    for count, stands in ((4, True), (5, False)):
        found = stands_between_walls(walls, vec3(0.0, 0.0, 0.0), (1, np.array([0.5])), (2, heights[:count]))
        assert found.tolist() == [stands]


@given(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5))
def test_clear_is_what_no_face_lies_along(y, z):
    origins = np.array([[-2.0, y, z], [0.1, y / 4, z / 4]])
    for direction in (X, -X, vec3(0.0, 0.0, 1.0)):
        assert (CASTER.is_clear(origins, direction) == np.isinf(CASTER.along(origins, direction))).all()
    assert RayCaster(TriangleMesh(np.zeros((0, 3)), np.zeros((0, 3), np.int64))).is_clear(origins, X).all()


def test_front_and_back_of_a_sheet_are_seen_alike_and_asked_once(monkeypatch):
    outer, inner = (TriangleMesh.box_mesh(Box(np.full(3, -a), np.full(3, a))) for a in (2.0, 1.0))
    once = merge_meshes([outer, inner])
    twice = TriangleMesh(once.vertices, np.concatenate([once.faces, np.roll(once.faces[:, ::-1], 1, axis=1)]))
    rays: list[int] = []
    is_clear = RayCaster.is_clear

    def counted(caster: RayCaster, origins: np.ndarray, direction: np.ndarray) -> np.ndarray:
        rays.append(len(origins))
        return is_clear(caster, origins, direction)

    monkeypatch.setattr(RayCaster, "is_clear", counted)
    seen = outer_faces(twice)
    asked = sum(rays)

    assert seen.tolist() == 2 * ([True] * 12 + [False] * 12)
    rays.clear()
    assert outer_faces(once).tolist() == [True] * 12 + [False] * 12
    assert asked == sum(rays)
