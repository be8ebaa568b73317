from dataclasses import replace

import numpy as np
import pytest
import trimesh

from grafu.articulation.articulated_object import Link, Visual, VisualRole
from grafu.articulation.collision_shapes import CollisionShapeConfig, collision_shapes, corners_of
from grafu.articulation.convex_pieces import ConvexPieceConfig, convex_pieces, hull_of
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.solids import ConvexSolid, subtract
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
    config = replace(CollisionShapeConfig(), most_shapes=3, pieces=ConvexPieceConfig(most=20))

    shapes = collision_shapes(link_of(posts), config)

    assert [round(2 * float(s.half[2]), 2) for s in shapes] == [0.58, 0.57, 0.56]


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
