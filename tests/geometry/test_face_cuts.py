"""Faces cut by solids of many planes, and by many solids: the area is right, and memory stays small."""

import tracemalloc

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.errors import TooComplex
from grafu.geometry import face_cuts
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.budget import Budget
from grafu.geometry.face_cuts import remainder
from grafu.geometry.halves import half_of, halves_of
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip
from grafu.geometry.transform import rotation_matrix


def rounded(center: np.ndarray, corners: int, radius: float) -> ConvexSolid:
    angles = 2 * np.pi * np.arange(corners) / corners
    ring = np.stack([radius * np.cos(angles), radius * np.sin(angles), np.zeros(corners)], axis=1) + center
    up = vec3(0.0, 0.0, 1.0)
    solid = ConvexSolid.around(np.vstack([ring - up, ring + up]))
    assert solid is not None
    return solid


def test_a_rounded_hole_has_its_area_and_takes_little_memory() -> None:
    sheet = TriangleMesh(np.array([[-3.0, -3, 0], [3, -3, 0], [0, 5, 0]]), np.array([[0, 1, 2]]))
    hole = rounded(np.zeros(3), 100, 1.0)
    tracemalloc.start()
    left = clip(Surface(sheet), [hole])
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert left.mesh.area == pytest.approx(sheet.area - 50 * np.sin(2 * np.pi / 100), rel=1e-9)
    turned = np.cross(*np.diff(left.mesh.triangles, axis=1).transpose(1, 0, 2))[:, 2]
    assert (turned > 0).all()  # like the sheet
    assert peak < 5e6


def sheet(count: int) -> TriangleMesh:
    x, y = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij")
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    corners = np.stack([first, first + count + 1, first + count + 2, first + 1], axis=1)
    vertices = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    return TriangleMesh(vertices, np.vstack([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]))


def test_batches_of_faces_give_the_same(monkeypatch: pytest.MonkeyPatch) -> None:
    solids = [rounded(np.array([0.3 + 0.1 * k, 0.5, 0.0]), 12, 0.2) for k in range(4)]
    whole = clip(Surface(sheet(12)), solids)
    monkeypatch.setattr(face_cuts, "_MOST_PAIRS", 7)
    monkeypatch.setattr(face_cuts, "_MOST_PIECES", 3)
    assert clip(Surface(sheet(12)), solids).mesh.area == pytest.approx(whole.mesh.area, rel=1e-9)


def test_more_cuts_than_fit_are_too_complex() -> None:
    with Budget(room=1000).in_force(), pytest.raises(TooComplex, match="cutting faces"):
        clip(Surface(sheet(12)), [rounded(np.full(3, 0.5), 12, 0.4)])


def _pieces(random: np.random.Generator, whole: shapely.Polygon, count: int) -> list[np.ndarray]:
    """Returns the points of convex pieces within a triangle in the plane, some only just thicker than nothing."""
    low, high = np.array(whole.bounds[:2]), np.array(whole.bounds[2:])
    found = []
    for _ in range(count):
        size = 10.0 ** random.uniform(-4, 0, 2) * (high - low)
        points = random.uniform(low, high) + random.normal(size=(random.integers(3, 9), 2)) * size
        piece = shapely.intersection(shapely.MultiPoint(points).convex_hull, whole)
        if piece.area > 1e-9:
            found.append(np.array(piece.exterior.coords))
    return found


@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.sampled_from([1.0, 1e-2, 2e-4]))
@settings(max_examples=60, deadline=None)
def test_what_is_left_is_the_triangle_less_all_pieces(seed, count, height):
    random = np.random.default_rng(seed)
    flat = np.array([[0.0, 0.0], [1.0, 0.0], [random.uniform(-0.2, 1.2), height]])
    whole = shapely.Polygon(flat)
    pieces = _pieces(random, whole, count)
    turn = rotation_matrix(np.asarray(vec3(0.6, 0.0, 0.8)), random.uniform(0.0, 6.0))
    corners = np.column_stack([flat, np.zeros(3)]) @ turn.T
    left = remainder(corners, [np.column_stack([p, np.zeros(len(p))]) @ turn.T for p in pieces])
    assert np.all(np.abs(left.sum(axis=2) - 1.0) < 1e-9)
    first, second, third = np.moveaxis(left @ flat, 1, 0)
    doubled = (second - first)[:, 0] * (third - first)[:, 1] - (second - first)[:, 1] * (third - first)[:, 0]
    expected = whole.difference(shapely.union_all([shapely.Polygon(p) for p in pieces])).area
    assert abs(float(doubled.sum()) / 2 - expected) < 1e-6
    assert abs(float(np.abs(doubled).sum()) / 2 - expected) < 1e-6  # none lies over others


def test_nothing_is_left_where_a_piece_covers_all():
    corners = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]])
    assert len(remainder(corners, [corners])) == 0


@given(st.integers(0, 10_000), st.sampled_from((0.0, 0.25, 0.5)))
def test_both_halves_are_those_of_either_side(seed, height):
    rng = np.random.default_rng(seed)
    points = np.round(rng.uniform(0, 1, (12, 3)), 2)
    points[::3, 2] = height  # some lie on the plane
    mesh, normal, origin = (
        TriangleMesh(points, rng.integers(0, 12, (20, 3))),
        vec3(0.0, 0.0, 1.0),
        vec3(0.0, 0.0, height),
    )

    beyond, rest = halves_of(mesh, normal, origin)

    assert beyond == half_of(mesh, normal, origin)
    assert rest == half_of(mesh, -normal, origin)
    assert beyond.vertices[:, 2].min(initial=height) >= height - 1e-9
    assert rest.vertices[:, 2].max(initial=0) <= height + 1e-9
