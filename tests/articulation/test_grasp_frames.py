"""Grasp frames: on the surface, turned as grippers close, with the room that is drawn, also in shapes."""

from dataclasses import replace

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from grafu.articulation import physics
from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual
from grafu.articulation.collision_shapes import CollisionShapeConfig, ShapeBody
from grafu.articulation.finger_room import with_finger_room
from grafu.articulation.grasp_frame import GraspFrame
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.articulation.physics import PhysicsConfig, physics_of
from grafu.errors import ArticulationError
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.solids import ConvexSolid
from grafu.vocabulary import JointType, PartLabel

FRONT = (-0.3, -0.02, 0.0, 0.3, 0.0, 0.7)
HINGE = Axis(vec3(-0.3, -0.02, 0.0), vec3(0.0, 0.0, -1.0))  # a door that is pulled towards -Y
RAIL = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))


def board(*bounds: float) -> TriangleMesh:
    x0, y0, z0, x1, y1, z1 = map(float, bounds)
    return TriangleMesh.box_mesh(Box(vec3(x0, y0, z0), vec3(x1, y1, z1)))


def bar(length: float, thick: float, gap: float, upright: bool) -> TriangleMesh:
    """A bar on two feet before a front that lies in the plane y = -0.02."""
    y0, y1 = -0.02 - gap - thick, -0.02 - gap
    rod = [-length / 2, y0, -thick / 2, length / 2, y1, thick / 2]
    feet = [[e - thick / 2, y1, -thick / 2, e + thick / 2, -0.02, thick / 2] for e in (-length / 3, length / 3)]
    boxes = [board(*b) for b in (rod, *feet)]
    mesh = merge_meshes(boxes)
    turned = mesh.vertices[:, [2, 1, 0]] if upright else mesh.vertices
    faces = mesh.faces[:, ::-1] if upright else mesh.faces
    return TriangleMesh(turned + vec3(0.2, 0.0, 0.35), faces)


def made(
    handle: TriangleMesh | None = None,
    axis: Axis = HINGE,
    front: TriangleMesh | None = None,
    hint: GraspHint | None = None,
) -> ArticulatedObject:
    """A case with one front, its grasps found."""
    kind = JointType.REVOLUTE if axis is HINGE else JointType.PRISMATIC
    leaf = Visual("door", (Surface(front or board(*FRONT)),), label=PartLabel.DOOR)
    handles = () if handle is None else (Visual("grip", (Surface(handle),), label=PartLabel.HANDLE),)
    case = Visual("case", (Surface(board(-0.3, 0.001, 0.0, 0.3, 0.4, 0.7)),))
    joint = Joint("j", kind, "body", "door", axis, JointLimits(0.0, 0.4))
    whole = ArticulatedObject("o", "body", (Link("body", (case,)), Link("door", (leaf, *handles))), (joint,))
    return with_grasps(whole, {"door": hint or GraspHint("handle")})


def distance(mesh: TriangleMesh, point: np.ndarray) -> float:
    return float(trimesh.proximity.closest_point(mesh.to_trimesh(), [point])[1][0])


@given(
    length=st.floats(0.06, 0.5),
    thick=st.floats(0.006, 0.03),
    gap=st.floats(0.018, 0.05),
    upright=st.booleans(),
    slides=st.booleans(),
)
@settings(max_examples=30, deadline=None)
def test_a_bar_is_held_across_in_its_middle(length, thick, gap, upright, slides):
    handle = bar(length, thick, gap, upright)
    (grasp,) = made(handle, RAIL if slides else HINGE).grasps

    assert distance(handle, grasp.position) < 1e-5
    assert np.allclose(grasp.approach, [0, 1, 0])
    assert np.allclose(np.abs(grasp.closing), [1, 0, 0] if upright else [0, 0, 1])
    assert grasp.width == pytest.approx(thick, abs=1e-5)
    assert grasp.depth == pytest.approx(min(thick + gap, 0.02), abs=1e-5)
    assert np.allclose(grasp.position, [0.2, -0.02 - gap - thick, 0.35], atol=1e-5)
    assert (grasp.name, grasp.part, grasp.link) == ("grip_grasp", "grip", "door")


@pytest.mark.parametrize("angle", [0.3, -0.6])
def test_the_frame_turns_with_the_piece(angle):
    turn = HINGE.rotation(angle)
    still = made(bar(0.2, 0.01, 0.03, True))
    links = tuple(
        replace(
            link,
            visuals=tuple(replace(v, surfaces=tuple(s.transformed(turn) for s in v.surfaces)) for v in link.visuals),
        )
        for link in still.links
    )
    (grasp,) = with_grasps(replace(still, links=links, grasps=()), {"door": GraspHint("handle")}).grasps
    (before,) = still.grasps

    assert np.allclose(grasp.position, (turn @ np.append(before.position, 1.0))[:3], atol=1e-5)
    assert np.allclose(grasp.approach, turn[:3, :3] @ before.approach, atol=1e-6)
    assert np.allclose(np.abs(grasp.closing @ (turn[:3, :3] @ before.closing)), 1.0)


def test_frames_are_right_handed_and_name_their_axes():
    (grasp,) = made(bar(0.2, 0.01, 0.03, False)).grasps

    R = grasp.rotation
    assert np.allclose(R.T @ R, np.eye(3))
    assert np.linalg.det(R) == pytest.approx(1.0)
    assert np.allclose(R[:, 2], grasp.approach)
    assert np.allclose(R[:, 1], grasp.closing)
    assert np.allclose(np.abs(R[:, 0]), [1, 0, 0])  # along the bar


def test_a_bar_without_a_gap_has_no_room():
    (grasp,) = made(board(0.1, -0.024, 0.34, 0.3, -0.02, 0.36)).grasps

    assert grasp.depth == 0.0
    assert grasp.fingers == ()


def test_an_obstacle_beside_the_middle_moves_the_grasp_along_the_bar():
    handle = bar(0.4, 0.01, 0.03, False)
    fin = board(0.19, -0.06, 0.36, 0.21, -0.02, 0.5)  # on the front, above the bar's middle
    (grasp,) = made(handle, front=merge_meshes([board(*FRONT), fin])).grasps

    assert grasp.depth == pytest.approx(0.02, abs=1e-5)
    assert abs(grasp.position[0] - 0.2) > 0.02


def test_the_free_edge_of_a_door_is_held_between_its_faces():
    place = GraspHint("edge", center=vec3(0.3, -0.01, 0.35), length=0.1)
    (grasp,) = made(front=board(*FRONT), hint=place).grasps  # the case stands behind it by a millimetre
    free = board(-0.3, -0.06, 0.0, 0.3, -0.04, 0.7)
    (held,) = made(front=free, hint=replace(place, center=vec3(0.3, -0.05, 0.35))).grasps

    assert grasp.depth == 0.0  # no finger fits between door and case
    assert held.depth > 0.012
    assert held.width == pytest.approx(0.02, abs=1e-5)
    assert np.allclose(np.abs(held.closing), [0, 1, 0])
    assert np.allclose(held.approach, [-1, 0, 0])
    assert distance(free, held.position) < 1e-5


def test_closed_fingers_hook_into_a_recess():
    hollow = [
        board(-0.3, -0.02, 0, 0.3, 0, 0.5),
        board(-0.3, -0.02, 0.54, 0.3, 0, 0.7),
        board(-0.3, -0.005, 0.5, 0.3, 0, 0.54),
    ]
    front = merge_meshes(hollow)
    (grasp,) = made(front=front, hint=GraspHint("recess", center=vec3(0.0, -0.02, 0.525), length=0.6)).grasps

    assert (grasp.kind, grasp.width) == ("recess", 0.0)
    assert np.allclose(grasp.approach, [0, 1, 0])
    assert np.allclose(grasp.closing, [0, 0, 1])  # the nearer wall is the upper one
    assert grasp.position[1] == pytest.approx(-0.005, abs=1e-5)


def test_what_cannot_be_held_has_no_frame():
    assert with_grasps(replace(made(), grasps=()), {}).grasps == ()


@pytest.mark.parametrize("filled", [True, False])
def test_no_shape_reaches_where_fingers_go(filled):
    whole = made(bar(0.12, 0.01, 0.025, True))
    hull = ConvexSolid.around(bar(0.12, 0.01, 0.025, True).vertices)
    plate = OrientedBox(vec3(0.0, -0.03, 0.35), vec3(0.3, 0.02, 0.34), np.eye(3))
    shapes = {"body": (plate,), "door": (hull,)} if filled else physics_of(whole).shapes
    left = with_finger_room(shapes, whole.grasps)
    fingers = [ShapeBody("", finger) for finger in whole.grasps[0].fingers]

    assert len(fingers) == 2
    held = [ShapeBody(link, shape) for link, shapes_of_link in left.items() for shape in shapes_of_link]
    assert not any(finger.meets(body) for finger in fingers for body in held)
    if filled:
        before = sum(_volume(s) for held_shapes in shapes.values() for s in held_shapes)
        gone = sum(8 * np.prod(f.half + 0.0005) for f in whole.grasps[0].fingers)
        after = sum(_volume(s) for held_shapes in left.values() for s in held_shapes)
        assert before - 2 * gone - 1e-9 < after < before  # nothing else is lost but slivers


def _volume(shape) -> float:
    corners = shape.corners() if isinstance(shape, OrientedBox) else shape.vertices
    return float(trimesh.convex.convex_hull(corners).volume)


@pytest.mark.parametrize(
    "wrong",
    [{"closing": vec3(0.0, 1.0, 0.0)}, {"approach": vec3(0.0, 2.0, 0.0)}, {"width": -0.01}, {"depth": float("nan")}],
)
def test_wrong_frames_are_refused(wrong):
    (grasp,) = made(bar(0.2, 0.01, 0.03, False)).grasps

    with pytest.raises(ArticulationError, match="grip_grasp"):
        replace(grasp, **wrong)


def test_grasps_of_unknown_links_are_refused():
    whole = made(bar(0.2, 0.01, 0.03, False))
    lost: GraspFrame = replace(whole.grasps[0], link="lid")

    with pytest.raises(ArticulationError, match="known links"):
        replace(whole, grasps=(lost,))
    with pytest.raises(ArticulationError, match="grasp"):
        replace(whole, grasps=whole.grasps * 2)


def test_shapes_that_are_cut_for_fingers_stay_as_few_as_allowed(monkeypatch):
    whole = made(bar(0.12, 0.01, 0.025, True))
    plate = OrientedBox(vec3(0.0, -0.04, 0.35), vec3(0.3, 0.03, 0.34), np.eye(3))  # fills what is behind the bar
    monkeypatch.setattr(physics, "chosen_shapes", lambda link, *_: ((plate,) if link.id == "door" else (), ()))
    few = PhysicsConfig(collision=replace(CollisionShapeConfig(), most_shapes=3))

    assert len(physics_of(whole).shapes["door"]) > 3
    kept = physics_of(whole, few)
    assert len(kept.shapes["door"]) == 3
    assert [note.split(":")[0] for note in kept.notes] == ["door does not collide where it is smallest"]
