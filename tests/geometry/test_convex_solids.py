"""Convex solids cut out of surfaces: volumes and areas as they must be, attributes kept, closed stays closed."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip, clip_by_faces, in_any, subtract

OAK = Material("oak")
UNIT = Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0))
numbers = st.floats(0.05, 0.95).map(lambda x: round(x, 3))


def solid(low: tuple[float, float, float], high: tuple[float, float, float]) -> ConvexSolid:
    found = ConvexSolid.around(Box(vec3(*low), vec3(*high)).corners())
    assert found is not None
    return found


def cube(box: Box = UNIT) -> Surface:
    """A cube whose attributes are linear in position, so that every cut shows whether they were kept."""
    mesh = TriangleMesh.box_mesh(box)
    return Surface(mesh, OAK, mesh.vertices[:, [0, 2]] * [2.0, 3.0], None, _colors(mesh.vertices))


def sheet() -> Surface:
    """The unit square in the plane z = 0."""
    vertices = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    mesh = TriangleMesh(vertices, np.array([[0, 1, 2], [0, 2, 3]]))
    normals = np.tile([0.0, 0.0, 1.0], (4, 1))
    return Surface(mesh, OAK, vertices[:, :2] * [2.0, 3.0], normals, _colors(vertices))


def _colors(points: np.ndarray) -> np.ndarray:
    return np.column_stack([np.round(200 * points), np.full(len(points), 255)]).astype(np.uint8)


def volume(mesh: TriangleMesh) -> float:
    return float(np.linalg.det(mesh.triangles).sum() / 6)


def test_the_hull_of_a_box_has_its_corners_and_six_planes():
    hull = solid((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    assert hull.vertices.shape == (8, 3)
    assert hull.planes.shape == (6, 4)
    assert hull.mesh.is_watertight
    assert volume(hull.mesh) == pytest.approx(6.0)  # faces look outwards
    assert np.all(hull.vertices @ hull.planes[:, :3].T <= hull.planes[:, 3] + 1e-9)


@given(st.integers(0, 2**32 - 1))
@settings(max_examples=20)
def test_the_hull_of_points_holds_them_all(seed):
    points = np.random.default_rng(seed).normal(size=(30, 3))
    hull = ConvexSolid.around(points)
    assert hull is not None
    assert np.all(points @ hull.planes[:, :3].T <= hull.planes[:, 3] + 1e-8)
    assert hull.mesh.is_watertight


@pytest.mark.parametrize(
    "points", [np.zeros((0, 3)), np.eye(3), np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]])]
)
def test_flat_points_have_no_hull(points):
    assert ConvexSolid.around(points) is None


def test_what_nothing_cuts_is_the_very_same_surface():
    surface = cube()
    assert subtract(surface, []) is surface
    assert subtract(surface, [solid((2.0, 2.0, 2.0), (3.0, 3.0, 3.0))]) is surface
    plane = sheet()
    assert subtract(plane, [solid((0.2, 0.2, 0.0), (0.8, 0.8, 1.0))]) is plane  # it lies on the solid's face


@given(st.tuples(numbers, numbers, numbers), st.booleans())
@settings(max_examples=30)
def test_a_closed_body_loses_the_shared_volume_and_stays_closed(corner, at_high_end):
    low, high = ((0.0,) * 3, corner) if not at_high_end else (corner, (1.0,) * 3)
    grown = solid(tuple(c - 0.5 * (c == 0) for c in low), tuple(c + 0.5 * (c == 1) for c in high))
    left = subtract(cube(), [grown])
    assert left.mesh.is_watertight
    assert volume(left.mesh) == pytest.approx(1.0 - np.prod(np.subtract(high, low)), abs=1e-5)


@given(numbers, numbers)
@settings(max_examples=30)
def test_an_open_sheet_loses_the_shared_area(x, y):
    left = subtract(sheet(), [solid((-1.0, -1.0, -1.0), (x, y, 1.0))])
    assert left.mesh.area == pytest.approx(1.0 - x * y, abs=1e-9)
    inside = (left.mesh.triangles.mean(axis=1)[:, :2] < [x - 1e-9, y - 1e-9]).all(axis=1)
    assert not inside.any()


@given(numbers, numbers)
@settings(max_examples=20)
def test_attributes_of_an_open_sheet_stay_where_they_were(x, y):
    left = subtract(sheet(), [solid((-1.0, -1.0, -1.0), (x, y, 1.0))])
    points = left.mesh.vertices
    assert left.material is OAK
    np.testing.assert_allclose(left.uv, points[:, :2] * [2.0, 3.0], atol=1e-9)
    np.testing.assert_allclose(left.normals, np.tile([0.0, 0.0, 1.0], (len(points), 1)), atol=1e-9)
    assert np.abs(left.colors.astype(int) - _colors(points).astype(int)).max() <= 1


def test_attributes_of_a_closed_body_stay_on_its_own_faces():
    left = subtract(cube(), [solid((0.7, -1.0, -1.0), (2.0, 2.0, 2.0))])
    assert left.material is OAK
    own = np.unique(left.mesh.faces[np.abs(left.mesh.face_normals[:, 0]) < 0.5])  # not the cut, not x = 0
    np.testing.assert_allclose(left.uv[own], left.mesh.vertices[own][:, [0, 2]] * [2.0, 3.0], atol=1e-5)
    assert left.mesh.box.high[0] == pytest.approx(0.7, abs=1e-6)


def test_several_solids_are_cut_one_after_another():
    holes = [solid((-1.0, -1.0, -1.0), (0.2, 2.0, 2.0)), solid((0.8, -1.0, -1.0), (2.0, 2.0, 2.0))]
    assert volume(subtract(cube(), holes).mesh) == pytest.approx(0.6, abs=1e-6)
    assert subtract(sheet(), holes).mesh.area == pytest.approx(0.6)


@pytest.mark.parametrize("surface", [cube(), sheet()], ids=["closed", "open"])
def test_nothing_is_left_of_what_lies_wholly_inside(surface):
    assert subtract(surface, [solid((-1.0, -1.0, -1.0), (2.0, 2.0, 2.0))]).is_empty


def test_a_body_turned_inside_out_is_clipped_as_a_surface():
    inverted = replace(cube(), mesh=TriangleMesh(cube().mesh.vertices, cube().mesh.faces[:, ::-1]))
    left = subtract(inverted, [solid((0.5, -1.0, -1.0), (2.0, 2.0, 2.0))])
    assert left.mesh.area == pytest.approx(3.0)  # half of the six squares; the cut stays open


def test_faces_without_area_vanish_with_the_cut():
    mesh = sheet().mesh
    flat = TriangleMesh(mesh.vertices, np.vstack([mesh.faces, [[0, 1, 1], [0, 0, 0]]]))
    left = subtract(Surface(flat, OAK), [solid((-1.0, -1.0, -1.0), (0.5, 2.0, 1.0))])
    assert left.mesh.area == pytest.approx(0.5)
    assert np.all(left.mesh.face_areas > 0)


def _boxes_over_the_sheet(seed: int, count: int) -> tuple[list[ConvexSolid], np.ndarray]:
    """Boxes that pass through the unit square, and where they meet it: (low, high) corners in tenths."""
    random = np.random.default_rng(seed)
    low = random.integers(-2, 9, (count, 2))
    cells = np.stack([low, low + random.integers(1, 5, (count, 2))], axis=1)
    found = [solid((*map(float, a / 10), -1.0), (*map(float, b / 10), 1.0)) for a, b in cells]
    return found, cells


@given(st.integers(0, 2**32 - 1), st.integers(2, 30))
@settings(max_examples=30)
def test_what_overlapping_solids_take_of_a_sheet_goes_once(seed, count):
    solids, cells = _boxes_over_the_sheet(seed, count)
    x, y = np.meshgrid(np.arange(10) + 0.5, np.arange(10) + 0.5)
    taken = np.any([(a[0] < x) & (x < b[0]) & (a[1] < y) & (y < b[1]) for a, b in cells], axis=0)
    left = subtract(sheet(), solids)
    assert left.mesh.area == pytest.approx((~taken).sum() / 100, abs=1e-7)
    clipped = clip(sheet(), solids)
    assert 1.0 - clipped.mesh.area == pytest.approx(taken.sum() / 100, abs=1e-7)
    assert subtract(sheet(), solids, clipped) is clipped
    middles = left.mesh.triangles.mean(axis=1)
    for one in solids:
        assert np.all((middles @ one.planes[:, :3].T > one.planes[:, 3] - 1e-7).any(axis=1))
    assert np.all(left.mesh.face_normals[:, 2] > 0.99)  # turned as they were
    np.testing.assert_allclose(left.uv, left.mesh.vertices[:, :2] * [2.0, 3.0], atol=1e-6)


@given(st.integers(0, 2**32 - 1), st.integers(1, 12))
@settings(max_examples=20)
def test_what_each_face_loses_is_what_it_loses_alone(seed, count):
    surface, (solids, _) = cube(Box(vec3(0.0, 0.0, -0.5), vec3(1.0, 1.0, 0.5))), _boxes_over_the_sheet(seed, count)
    left, lost = clip_by_faces(surface, solids)
    assert lost.sum() == pytest.approx(surface.mesh.area - left.mesh.area, abs=1e-9)
    for k, own in enumerate(lost):
        alone = Surface(surface.mesh.with_faces(np.array([k])))
        assert own == pytest.approx(alone.mesh.area - clip(alone, solids).mesh.area, abs=1e-9)


def test_what_is_not_clipped_loses_nothing():
    left, lost = clip_by_faces(sheet(), [solid((2.0, 2.0, -1.0), (3.0, 3.0, 1.0))])
    assert left == sheet()
    assert lost.tolist() == [0.0, 0.0]


def test_a_closed_surface_is_clipped_open_and_cut_closed():
    corner = [solid((0.5, 0.5, 0.5), (2.0, 2.0, 2.0))]
    clipped = clip(cube(), corner)
    assert clipped.mesh.area == pytest.approx(6.0 - 0.75)  # three quarters of a square at the corner
    assert not clipped.mesh.is_watertight
    cut = subtract(cube(), corner, clipped)
    assert cut.mesh.is_watertight
    assert cut.mesh.area == pytest.approx(6.0)


def test_a_sheet_is_not_shredded_by_many_overlapping_solids():
    """Taken one after another, 400 boxes leave a hundred thousand triangles, and take minutes."""
    random = np.random.default_rng(0)
    points = random.uniform(0.1, 0.9, (400, 1, 3)) * [1.0, 1.0, 0.0] + random.normal(0.0, 0.08, (400, 12, 3))
    solids = [found for cloud in points if (found := ConvexSolid.around(cloud)) is not None]
    assert len(subtract(sheet(), solids).mesh.faces) < 1000


@given(st.integers(0, 2**32 - 1), st.integers(0, 12))
@settings(max_examples=20)
def test_points_lie_in_any_of_some_solids_or_in_none(seed, count):
    rng = np.random.default_rng(seed)
    points = rng.random((200, 3))
    hulls = [ConvexSolid.around(rng.random(3) * 0.8 + 0.4 * rng.random((8, 3))) for _ in range(count)]
    solids = [hull for hull in hulls if hull is not None]

    expected = [any(bool(one.contains(point[None])[0]) for one in solids) for point in points]
    np.testing.assert_array_equal(in_any(solids, points), expected)


def test_a_hull_that_is_remembered_is_that_of_the_same_points_alone():
    corners = UNIT.corners()
    first, again = ConvexSolid.around(corners), ConvexSolid.around(corners.copy())
    moved = ConvexSolid.around(corners + 1e-12)
    assert first is again
    assert moved is not first
    assert moved is not None
    np.testing.assert_array_equal(moved.box.low, UNIT.low + 1e-12)
    assert ConvexSolid.around(corners[:3]) is None
    assert ConvexSolid.around(np.asfortranarray(corners)) is first  # whatever the order in memory
