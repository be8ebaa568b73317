from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.articulation.collision_shapes import (
    CollisionShapeConfig,
    chosen_shapes,
    collision_shapes,
    corners_of,
    extent_of,
    shapes_of,
)
from grafu.articulation.convex_pieces import (
    ConvexPieceConfig,
    _depths,
    _grid,
    _is_inside_hull,
    _looks,
    convex_pieces,
    hull_of,
)
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.solids import ConvexSolid, subtract
from grafu.geometry.transform import rotation_matrix
from grafu.vocabulary import PartLabel

UP = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))


def board(*bounds: float) -> TriangleMesh:
    x0, y0, z0, x1, y1, z1 = map(float, bounds)
    return TriangleMesh.box_mesh(Box(vec3(x0, y0, z0), vec3(x1, y1, z1)))


def without(mesh: TriangleMesh, *hollows: TriangleMesh) -> TriangleMesh:
    return subtract(Surface(mesh), [s for h in hollows if (s := ConvexSolid.around(h.vertices))]).mesh


def link_of(mesh: TriangleMesh, label: PartLabel = PartLabel.DRAWER) -> Link:
    return Link("a", (Visual("a", (Surface(mesh),), label=label),))


def covered(link: Link, points: np.ndarray) -> np.ndarray:
    """Whether each point lies in a collision shape."""
    solids = [ConvexSolid.around(corners_of(shape)) for shape in collision_shapes(link)]
    inside = [np.all(points @ s.planes[:, :3].T <= s.planes[:, 3] + 1e-9, axis=1) for s in solids]
    return np.any(inside, axis=0)


TRAY = without(board(0, 0, 0, 0.4, 0.5, 0.2), board(0.015, 0.015, 0.012, 0.385, 0.485, 0.3))
SHEETS = board(0, 0, 0, 0.4, 0.5, 0.2).with_faces(board(0, 0, 0, 0.4, 0.5, 0.2).face_normals[:, 2] < 0.5)
FRAME = without(
    board(0, 0, 0, 0.6, 0.02, 0.8), board(0.05, -1, 0.05, 0.55, 1, 0.4), board(0.05, -1, 0.45, 0.55, 1, 0.75)
)


@pytest.mark.parametrize("tray", [TRAY, SHEETS], ids=["of boards", "of sheets"])
@pytest.mark.parametrize("angle", [0.0, 0.5])
def test_a_drawer_in_one_piece_stays_open_on_top(tray, angle):
    turn = UP.rotation(angle)
    inside = np.array([[0.2, 0.25, 0.1], [0.05, 0.05, 0.19], [0.3, 0.4, 0.05]]) @ turn[:3, :3].T
    floor = np.array([[0.2, 0.25, 0.001]]) @ turn[:3, :3].T
    link = link_of(tray.transformed(turn))

    assert len(collision_shapes(link)) == 5
    assert not covered(link, inside).any()
    assert covered(link, floor).all()


def test_a_frame_keeps_its_openings():
    link = link_of(FRAME, PartLabel.FACE_FRAME)

    assert len(collision_shapes(link)) == 5
    assert covered(link, np.array([[0.025, 0.01, 0.4], [0.3, 0.01, 0.2], [0.3, 0.01, 0.6]])).tolist() == [
        True,
        False,
        False,
    ]


def test_a_bar_handle_can_be_grasped():
    bar = without(board(0, 0, 0, 0.15, 0.03, 0.01), board(0.01, 0.01, -1, 0.14, 1, 1))

    assert not covered(link_of(bar, PartLabel.HANDLE), np.array([[0.07, 0.02, 0.005]])).any()
    assert covered(link_of(bar, PartLabel.DOOR), np.array([[0.07, 0.02, 0.005]])).all()  # a shallow rebate is filled


@pytest.mark.parametrize("angle", [0.0, 0.3, -0.7])
def test_a_panel_is_a_box_less_the_margin(angle):
    (shape,) = collision_shapes(link_of(board(-0.3, -0.01, 0, 0.3, 0.01, 0.7).transformed(UP.rotation(angle))))

    assert isinstance(shape, OrientedBox)
    assert np.allclose(np.sort(shape.half), [0.0095, 0.2995, 0.3495])
    assert np.allclose(shape.center, [0, 0, 0.35])


def test_a_sheet_has_the_least_thickness():
    sheet = board(0, 0, 0, 1, 1, 1)

    (shape,) = collision_shapes(link_of(sheet.with_faces(sheet.face_normals[:, 1] > 0.5)))

    assert np.allclose(np.sort(shape.half), [0.002, 0.4995, 0.4995])


def test_a_round_leg_is_one_hull_of_few_corners():
    leg = TriangleMesh.from_trimesh(trimesh.creation.cylinder(0.03, 0.7, sections=200))

    (shape,) = collision_shapes(link_of(leg, PartLabel.LEG))

    assert isinstance(shape, ConvexSolid)
    assert len(shape.vertices) <= 48
    assert np.allclose(np.ptp(shape.vertices, axis=0), [0.059, 0.059, 0.699], atol=2e-3)


def test_a_panel_of_many_shells_is_one_box():
    planks = merge_meshes([board(0.1 * k, 0, 0, 0.1 * (k + 1), 0.02, 0.7) for k in range(6)])

    assert len(collision_shapes(link_of(planks))) == 1


def test_a_part_within_another_is_left_out():
    link = Link(
        "a",
        tuple(
            Visual(n, (Surface(m),))
            for n, m in [("a", board(0, 0, 0, 1, 1, 1)), ("b", board(0.2, 0.2, 0.2, 0.4, 0.4, 0.4))]
        ),
    )

    assert len(collision_shapes(link)) == 1


@pytest.mark.parametrize(("name", "count"), [("hinge_1", 0), ("rail_1", 0), ("support_1", 1)])
def test_mechanisms_carry_no_shape(name, count):
    hardware = Visual(name, (Surface(board(0, 0, 0, 0.1, 0.1, 0.1)),), VisualRole.HARDWARE)

    assert len(collision_shapes(Link("a", (hardware,)))) == count


def test_the_number_of_shapes_is_capped():
    posts = merge_meshes([board(0.2 * k, 0, 0, 0.2 * k + 0.05, 0.05, 0.5 + 0.01 * k) for k in range(9)])
    config = replace(CollisionShapeConfig(), most_shapes=3)

    shapes = collision_shapes(link_of(posts), config)

    assert [round(2 * float(s.half[2]), 2) for s in shapes] == [0.58, 0.57, 0.56]


def test_what_stands_on_the_floor_stays_and_what_is_left_out_is_told():
    shelves = merge_meshes([board(0.3 * k, 0, 0.2, 0.3 * k + 0.2, 0.3, 0.22) for k in range(6)])
    feet = merge_meshes([board(x, y, 0, x + 0.03, y + 0.03, 0.1) for x in (0.0, 1.5) for y in (0.0, 0.3)])
    config = replace(CollisionShapeConfig(), most_shapes=7)

    kept, left_out = chosen_shapes(link_of(merge_meshes([shelves, feet])), config)

    assert len(kept) == 7
    assert len(left_out) == 3
    assert sum(corners_of(shape)[:, 2].min() < 0.005 for shape in kept) == 4
    assert all(corners_of(shape)[:, 2].min() > 0.1 for shape in left_out)


def test_what_carries_a_hinge_stays():
    shelves = merge_meshes([board(0.3 * k, 0, 0.2, 0.3 * k + 0.2, 0.3, 0.22) for k in range(6)])
    post = board(1.9, 0, 0.2, 1.93, 0.03, 0.5)
    hinge = Visual("hinge_door", (Surface(board(1.93, 0, 0.3, 1.94, 0.02, 0.35)),), VisualRole.HARDWARE)
    link = Link("a", (Visual("a", (Surface(merge_meshes([shelves, post])),)), hinge))

    kept, _ = chosen_shapes(link, replace(CollisionShapeConfig(), most_shapes=3))

    assert any(corners_of(shape)[:, 0].min() > 1.85 for shape in kept)


def test_a_body_with_many_loose_parts_keeps_its_cavity():
    case = without(board(0, 0, 0, 0.6, 0.6, 0.8), board(0.02, -0.1, 0.02, 0.58, 0.58, 0.78))
    screws = [board(0.03 * k + 0.02, 0.62, 0.4, 0.03 * k + 0.03, 0.63, 0.41) for k in range(18)]
    link = link_of(merge_meshes([case, *screws]), PartLabel.UNKNOWN)
    inside = np.array([[0.3, 0.05, 0.4], [0.1, 0.5, 0.1], [0.5, 0.3, 0.7]])

    assert not covered(link, inside).any()
    assert len(collision_shapes(link)) == 5 + 18


def test_drawers_and_case_in_one_mesh_of_many_parts_are_all_hollow():
    trays = [
        without(board(0, 0, z, 0.4, 0.5, z + 0.1), board(0.015, 0.015, z + 0.012, 0.385, 0.485, z + 1.0))
        for z in (0.0, 0.2, 0.4)
    ]
    knobs = [board(0.02 * k, -0.02, 1.0, 0.02 * k + 0.01, -0.01, 1.01) for k in range(20)]
    inside = np.array([[0.2, 0.25, z + 0.06] for z in (0.0, 0.2, 0.4)])

    assert not covered(link_of(merge_meshes([*trays, *knobs])), inside).any()


@pytest.mark.parametrize("label", [PartLabel.LEG, PartLabel.BAR])
def test_a_leg_that_is_a_frame_keeps_its_opening(label):
    sled = without(board(0, 0, 0, 0.03, 0.6, 0.7), board(-1, 0.03, 0.03, 1, 0.57, 0.67))

    assert covered(link_of(sled, label), np.array([[0.015, 0.3, 0.35], [0.015, 0.3, 0.015]])).tolist() == [False, True]


def test_the_opening_of_a_sheet_stays_open():
    outer, inner = [(0, 0), (1, 0), (1, 1), (0, 1)], [(0.3, 0.2), (0.7, 0.2), (0.7, 0.8), (0.3, 0.8)]
    points = np.array([(x, 0.0, z) for x, z in outer + inner], dtype=float)
    faces = [(k, (k + 1) % 4, 4 + k) for k in range(4)] + [((k + 1) % 4, 4 + (k + 1) % 4, 4 + k) for k in range(4)]
    link = link_of(TriangleMesh(points, np.array(faces)), PartLabel.UNKNOWN)

    at = np.array([[0.5, 0, 0.5], [0.35, 0, 0.75], [0.15, 0, 0.5], [0.5, 0, 0.1]])

    assert covered(link, at).tolist() == [False, False, True, True]
    assert len(collision_shapes(link)) == 4


def test_cuts_are_budgeted():
    assert len(convex_pieces(TRAY, ConvexPieceConfig(most_cuts=2))) == 3


def test_a_lining_adds_no_shapes():
    panel = board(0, 0, 0, 0.6, 0.018, 0.8)
    lining = [board(0.2 * k + 0.01, 0.017, 0.1, 0.2 * k + 0.19, 0.019, 0.7) for k in range(3)]  # 1 mm proud
    link = Link("a", tuple(Visual(f"v{k}", (Surface(m),)) for k, m in enumerate([panel, *lining])))

    assert len(collision_shapes(link)) == 1


@pytest.mark.parametrize("name", ["margin", "most_shapes", "within", "cuts_of_bars"])
def test_a_setting_that_is_not_above_0_is_refused(name):
    with pytest.raises(ValueError, match=f"`CollisionShapeConfig.{name}` must be above 0"):
        CollisionShapeConfig(**{name: type(getattr(CollisionShapeConfig(), name))(0)})


def test_a_link_without_faces_has_no_shape():
    assert collision_shapes(link_of(merge_meshes([]))) == ()


def test_pieces_of_a_solid_fill_it():
    pieces = convex_pieces(TRAY)

    assert sum(piece.to_trimesh().volume for piece in pieces) == pytest.approx(TRAY.to_trimesh().volume, rel=1e-4)
    assert Box.around(np.vstack([p.vertices for p in pieces])).volume == pytest.approx(TRAY.box.volume, rel=1e-5)


def test_faces_drawn_twice_come_apart_as_one_solid():
    doubled = merge_meshes([TRAY, TriangleMesh(TRAY.vertices, TRAY.faces[:, ::-1])])

    assert len(convex_pieces(doubled)) == 5


@pytest.mark.parametrize("count", [1, 2, 3])
def test_too_few_points_have_a_thick_hull_or_none(count):
    hull = hull_of(np.eye(3)[:count], 0.004)

    assert hull is None or min(np.ptp(hull.vertices, axis=0)) > 0


def test_shapes_are_left_out_just_where_they_lie_in_another() -> None:
    rng = np.random.default_rng(3)
    tolerance = CollisionShapeConfig().within
    shapes = []
    for k in range(120):
        turn, half = rotation_matrix(vec3(0.0, 0.0, 1.0), rng.uniform(0, np.pi)), rng.uniform(0.01, 0.2, 3)
        box = OrientedBox(rng.uniform(-0.2, 0.2, 3), half, turn)
        grown = OrientedBox(box.center, half + tolerance * rng.uniform(0.5, 1.5), turn)
        shapes += [box, grown if k % 2 else ConvexSolid.around(grown.corners()[:7])]
    link = link_of(board(0, 0, 0, 1, 1, 1))
    kept, left = chosen_shapes(link, CollisionShapeConfig(most_shapes=1000), lambda *_: list(shapes))

    expected: list[object] = []
    for shape in sorted(shapes, key=lambda shape: -extent_of(shape)):
        if not any(lies_within(shape, other, tolerance) for other in expected):
            expected.append(shape)
    assert (kept, left) == (tuple(expected), ())
    assert 20 < len(expected) < len(shapes) - 20


def lies_within(shape: OrientedBox | ConvexSolid, other: OrientedBox | ConvexSolid, tolerance: float) -> bool:
    points = corners_of(shape)
    if isinstance(other, OrientedBox):
        return bool((np.abs((points - other.center) @ other.rotation) <= other.half + tolerance).all())
    return bool((points @ other.planes[:, :3].T <= other.planes[:, 3] + tolerance).all())


@given(st.integers(0, 10_000), st.floats(0.01, 0.4))
def test_a_pit_is_as_deep_as_if_all_points_looked_along_all_axes(seed, least):
    rng = np.random.default_rng(seed)
    corners = rng.uniform(0, 1, (8, 1, 3)) + rng.uniform(-0.2, 0.2, (8, 3, 3))
    caster = RayCaster(TriangleMesh(corners.reshape(-1, 3), np.arange(24).reshape(-1, 3)))
    points = rng.uniform(0, 1, (200, 3))
    seen = _looks(caster, points)
    depth = np.where(np.isinf(seen).any(axis=1), np.minimum(seen.min(axis=1), 0.9), 0.0)

    box = Box(np.zeros(3), rng.permutation([0.9, 0.5, 0.2]))  # looks across its thinnest side come first
    assert _depths(caster, points, box, least).tolist() == np.where(depth > least, depth, 0.0).tolist()


@pytest.mark.parametrize("size", [(1.0, 0.5, 0.3), (0.6, 0.4, 0.003), (0.6, 0.4, 1e-7)])
def test_of_a_mesh_with_all_corners_of_its_box_no_hull_is_needed(size, monkeypatch):
    box = Box(np.zeros(3), np.array(size))
    mesh = TriangleMesh.box_mesh(box)
    points = _grid(box, 0.02)
    monkeypatch.setattr("scipy.spatial.ConvexHull", None)
    assert _is_inside_hull(mesh, points, 0.004).all()
    monkeypatch.undo()
    monkeypatch.setattr("grafu.articulation.convex_pieces.has_all_corners", lambda _: False)
    assert _is_inside_hull(mesh, points, 0.004).all()


def test_a_board_without_pits_needs_no_hull_to_see_it(monkeypatch):
    outline = np.array([[0.01, 0], [0.6, 0], [0.6, 0.4], [0, 0.4], [0, 0.01]])  # a corner is cut off
    solid = ConvexSolid.around(np.vstack([np.c_[outline, np.full(5, z)] for z in (0.0, 0.018)]))
    assert solid is not None
    monkeypatch.setattr("scipy.spatial.ConvexHull", None)
    assert convex_pieces(solid.mesh) == [solid.mesh]


def test_a_mesh_that_lacks_a_corner_of_its_box_has_a_hull():
    mesh = TriangleMesh(np.vstack([np.eye(3), np.zeros((1, 3))]), np.array([[0, 1, 2], [0, 1, 3]]))
    points = _grid(mesh.box, 0.1)
    inside = points[_is_inside_hull(mesh, points, 0.004)]
    assert 0.1 * len(points) < len(inside) < 0.3 * len(points)
    assert (inside.sum(axis=1) < 1).all()


def uneven_tray(step, off=0.0015):
    """A drawer box of 0.4 x 0.4 x 0.15 m, open above, in small triangles whose vertices are off by up to `off`."""
    tray = trimesh.creation.box((0.4, 0.4, 0.15)).difference(
        trimesh.creation.box((0.36, 0.36, 0.15)).apply_translation((0.0, 0.0, 0.02)), engine="manifold"
    )
    tray = tray.subdivide_to_size(step)
    tray.merge_vertices()
    shift = np.random.default_rng(0).uniform(-off, off, tray.vertices.shape)
    return TriangleMesh(np.asarray(tray.vertices) + shift, np.asarray(tray.faces))


def test_a_drawer_of_many_faces_is_simplified_and_stays_open_above(monkeypatch):
    seen = []
    monkeypatch.setattr(
        "grafu.articulation.collision_shapes.convex_pieces", lambda m, c: seen.append(m) or convex_pieces(m, c)
    )
    tray = uneven_tray(0.012)
    visual = Visual("drawer", (Surface(tray),), VisualRole.PART, PartLabel.DRAWER)
    shapes = shapes_of(visual)

    assert len(tray.faces) > CollisionShapeConfig().many_faces
    assert len(seen[0].faces) < 0.5 * len(tray.faces)
    inside = np.array([[0.0, 0.0, z] for z in (0.0, 0.05)])
    assert not any(Box.around(corners_of(shape)).contains(inside).any() for shape in shapes)


def test_what_has_fewer_faces_keeps_them(monkeypatch):
    seen = []
    monkeypatch.setattr("grafu.articulation.collision_shapes.convex_pieces", lambda m, c: seen.append(m) or [m])
    tray = uneven_tray(0.04)
    shapes_of(Visual("drawer", (Surface(tray),), VisualRole.PART, PartLabel.DRAWER))

    assert len(seen[0].faces) >= 0.95 * len(tray.faces)
