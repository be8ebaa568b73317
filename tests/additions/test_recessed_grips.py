"""Recessed grips: carved where there is room, where hands look for them, and without harm to anything."""

from dataclasses import replace
from functools import cache
from math import radians

import numpy as np
import pytest
from grip_judge import assert_sound, least_wall

from grafu.additions.grip.carve import Carved, carve_grip
from grafu.additions.grip.config import GripConfig, GripKind
from grafu.articulation.articulated_object import Visual
from grafu.asset.part import Part
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.mesh import TriangleMesh
from grafu.refusal import Reason, Refusal
from grafu.scene.scene import JointMotion, MovingBody, Scene
from grafu.vocabulary import JointType
from judging import realized_kind, swept_collisions
from small_scenes import DOOR, LEFT_EDGE, SIDE, box, drawer

DOOR_MOTION = JointMotion(LEFT_EDGE, JointType.REVOLUTE, radians(100))
DRAWER_MOTION = JointMotion(Axis(vec3(0.0, 0.0, 0.1), vec3(0.0, -1.0, 0.0)), JointType.PRISMATIC, 0.3)
FRONT = box("drawer", (-0.2, -0.22, 0.0), (0.2, -0.2, 0.17))
KINDS = tuple(GripKind)
PLATE = Visual("hinge_1", box("plate", (0.0, -0.03, 0.0), (0.4, -0.021, 0.6)).surfaces)


def scene_of(moving: Part, joint_motion: JointMotion, *others: Part, members: tuple[str, ...] = (), **fields) -> Scene:
    parts = {part.id: part for part in (moving, *others)}
    return Scene(
        parts,
        {moving.id: MovingBody(moving.id, (moving.id, *members))},
        1.0,
        joint_motions={moving.id: joint_motion},
        **fields,
    )


def of_kind(kind: GripKind, **fields) -> GripConfig:
    return GripConfig(kind=kind, **fields)


def carved(scene: Scene, moving: str, config: GripConfig, spot=None) -> Carved:
    result = carve_grip(scene, moving, config, spot)
    assert isinstance(result, Carved), result
    return result


def reason(scene: Scene, moving: str, config: GripConfig) -> Reason:
    result = carve_grip(scene, moving, config)
    assert isinstance(result, Refusal), result.kind
    return result.reason


def with_material(part: Part, material: Material) -> Part:
    return replace(part, surfaces=tuple(replace(s, material=material) for s in part.surfaces))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("profile", ["sharp", "rounded"])
def test_a_plain_door_takes_every_kind_opposite_its_hinge(kind, profile):
    result = carved(scene_of(DOOR, DOOR_MOTION, SIDE), "door", of_kind(kind, profile=profile))
    assert_sound(DOOR, result)
    assert result.part.mesh.is_watertight
    assert result.centre[0] > 0.34  # of 0.4
    assert result.outward == pytest.approx([0.0, -1.0, 0.0])
    assert abs(result.direction @ LEFT_EDGE.direction) == pytest.approx(1.0)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("side", ["top", "bottom"])
def test_a_drawer_front_takes_every_kind_in_the_middle_of_the_chosen_edge(kind, side):
    result = carved(scene_of(FRONT, DRAWER_MOTION), "drawer", of_kind(kind, drawer_side=side))
    assert_sound(FRONT, result)
    assert result.centre[0] == pytest.approx(0.0)
    assert result.centre[2] > 0.12 if side == "top" else result.centre[2] < 0.05
    assert abs(result.direction[0]) == pytest.approx(1.0)


@pytest.mark.parametrize("profile", ["sharp", "rounded"])
@pytest.mark.parametrize("thickness", [0.008, 0.018, 0.04])
def test_behind_a_groove_a_wall_remains(thickness, profile):
    door = box("door", (0.0, -thickness, 0.0), (0.4, 0.0, 0.6))
    result = carved(scene_of(door, DOOR_MOTION), "door", of_kind(GripKind.GROOVE, profile=profile))
    assert_sound(door, result)
    wall = least_wall(result.part, result)
    assert wall == pytest.approx(thickness - result.size[2], rel=0.02)
    assert wall >= 0.003 - 1e-5


def test_a_hole_and_a_notch_go_right_through():
    for kind in (GripKind.HOLE, GripKind.EDGE):
        result = carved(scene_of(DOOR, DOOR_MOTION), "door", of_kind(kind))
        assert least_wall(result.part, result) == pytest.approx(0.0, abs=1e-6)


def test_a_sharp_groove_takes_what_its_sizes_say_and_a_rounded_one_a_little_less():
    config = of_kind(GripKind.GROOVE, size=(0.12, 0.03), depth=0.01)
    sharp = carved(scene_of(DOOR, DOOR_MOTION), "door", replace(config, profile="sharp"))
    rounded = carved(scene_of(DOOR, DOOR_MOTION), "door", config)
    assert sharp.size == pytest.approx([0.12, 0.03, 0.01])
    assert sharp.volume == pytest.approx(0.12 * 0.03 * 0.01)
    assert 0.6 * sharp.volume < rounded.volume < 0.95 * sharp.volume


def test_a_turned_groove_lies_across_the_edge():
    result = carved(scene_of(DOOR, DOOR_MOTION), "door", of_kind(GripKind.GROOVE, turned=True))
    assert abs(result.direction[0]) == pytest.approx(1.0)
    assert result.size[0] == pytest.approx(0.12)  # capped at a fraction of the door's width


def test_a_spot_is_kept_where_it_is_good_and_left_where_it_is_not():
    scene = scene_of(DOOR, DOOR_MOTION)
    wanted = vec3(0.2, -0.02, 0.45)
    assert carved(scene, "door", of_kind(GripKind.GROOVE), wanted).centre == pytest.approx(wanted)
    knob = box("handle", (0.18, -0.05, 0.43), (0.22, -0.02, 0.47), carried_by="door")
    taken = scene_of(DOOR, DOOR_MOTION, knob, members=("handle",))
    elsewhere = carved(taken, "door", of_kind(GripKind.GROOVE), wanted)
    assert np.linalg.norm(elsewhere.centre - wanted) > 0.04


def test_tall_doors_are_gripped_in_reach_and_high_hung_ones_low():
    tall = box("door", (0.0, -0.02, 0.1), (0.5, 0.0, 2.2))
    assert carved(scene_of(tall, DOOR_MOTION), "door", of_kind(GripKind.EDGE)).centre[2] == pytest.approx(1.0)
    hung = box("door", (0.0, -0.02, 1.4), (0.5, 0.0, 2.2))
    assert carved(scene_of(hung, DOOR_MOTION), "door", of_kind(GripKind.EDGE)).centre[2] == pytest.approx(1.6)


def test_a_lid_is_gripped_at_its_front_edge():
    lid = box("door", (-0.4, -0.25, 0.5), (0.4, 0.25, 0.52))
    joint_motion = JointMotion(Axis(vec3(0.0, 0.25, 0.52), vec3(1.0, 0.0, 0.0)), JointType.REVOLUTE, 1.2)
    opens_up = replace(
        joint_motion,
        axis=joint_motion.axis if joint_motion.axis.rotation(0.5)[2, 1] < 0 else joint_motion.axis.reversed(),
    )
    result = carved(scene_of(lid, opens_up), "door", of_kind(GripKind.GROOVE))
    assert result.centre[1] < -0.2
    assert abs(result.outward[2]) == pytest.approx(1.0)


def test_a_sliding_door_is_gripped_at_the_edge_that_trails():
    joint_motion = JointMotion(Axis(vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)), JointType.PRISMATIC, 0.3)
    result = carved(scene_of(DOOR, joint_motion), "door", of_kind(GripKind.GROOVE))
    assert result.centre[0] < 0.06
    assert result.outward == pytest.approx([0.0, -1.0, 0.0])


def test_a_sheet_takes_a_hole_and_a_notch_but_no_groove():
    sheet = replace(DOOR, surfaces=(Surface(TriangleMesh(vec4_sheet(), np.array([[0, 1, 2], [0, 2, 3]]))),))
    scene = scene_of(sheet, DOOR_MOTION)
    assert reason(scene, "door", of_kind(GripKind.GROOVE)) is Reason.NO_THICKNESS
    for kind in (GripKind.HOLE, GripKind.EDGE):
        result = carved(scene, "door", of_kind(kind))
        assert result.volume == 0.0
        assert result.part.mesh.area == pytest.approx(sheet.mesh.area - result.area)
        assert np.allclose(result.part.box.size, sheet.box.size)
        assert len(result.part.surfaces) == 1


def vec4_sheet() -> np.ndarray:
    return np.array([(0.0, 0.0, 0.0), (0.4, 0.0, 0.0), (0.4, 0.0, 0.6), (0.0, 0.0, 0.6)])


@pytest.mark.parametrize("kind", KINDS)
def test_a_hollow_board_of_sheets_is_lined_where_it_is_cut(kind):
    mesh = DOOR.mesh.with_faces(np.abs(DOOR.mesh.face_normals[:, 1]) > 0.5)
    result = carved(scene_of(replace(DOOR, surfaces=(Surface(mesh),)), DOOR_MOTION), "door", of_kind(kind))
    walls = result.part.surfaces[1].mesh
    assert walls.box.low[1] == pytest.approx(-0.02)
    assert walls.box.high[1] == pytest.approx(result.size[2] - 0.02)
    outside = walls.triangles.mean(axis=1) + 1e-4 * walls.face_normals - result.centre
    inside = walls.triangles.mean(axis=1) - 1e-4 * walls.face_normals - result.centre
    if kind is not GripKind.EDGE:
        assert np.all(np.linalg.norm(outside[:, [0, 2]], axis=1) < np.linalg.norm(inside[:, [0, 2]], axis=1) + 1e-9)


REFUSALS = {
    "motion unknown": (lambda: replace(scene_of(DOOR, DOOR_MOTION), joint_motions={}), "auto", Reason.NO_MOTION),
    "a slat": (
        lambda: scene_of(box("door", (0.0, -0.02, 0.0), (0.03, 0.0, 0.6)), DOOR_MOTION), GripKind.GROOVE,
        Reason.TOO_SMALL,
    ),
    "a board of three millimetres": (
        lambda: scene_of(box("door", (0.0, -0.003, 0.0), (0.4, 0.0, 0.6)), DOOR_MOTION), GripKind.GROOVE,
        Reason.TOO_THIN,
    ),
    "a solid drawer": (
        lambda: scene_of(drawer().part("drawer"), DRAWER_MOTION), GripKind.HOLE, Reason.TOO_THICK,
    ),
    "glass": (
        lambda: scene_of(with_material(DOOR, Material("glass", (1.0, 1.0, 1.0, 0.3))), DOOR_MOTION), "auto",
        Reason.GLASS,
    ),
    "a board right behind": (
        lambda: scene_of(DOOR, DOOR_MOTION, box("panel", (0.0, 0.002, 0.0), (0.4, 0.02, 0.6))), GripKind.HOLE,
        Reason.NO_FINGER_ROOM,
    ),
    "a board right before": (
        lambda: scene_of(DOOR, DOOR_MOTION, box("panel", (0.0, -0.03, 0.0), (0.4, -0.022, 0.6))), GripKind.GROOVE,
        Reason.NO_FINGER_ROOM,
    ),
    "a plate all over": (
        lambda: scene_of(DOOR, DOOR_MOTION, hardware=(("door", PLATE),)), "auto", Reason.TAKEN,
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSALS)
def test_refusals_have_their_reasons(name):
    scene, kind, expected = REFUSALS[name]
    (moving,) = scene().moving_bodies
    assert reason(scene(), moving, GripConfig(kind=kind)) is expected


def test_auto_falls_back_to_what_a_front_bears():
    backed = scene_of(DOOR, DOOR_MOTION, box("panel", (0.0, 0.002, 0.0), (0.4, 0.02, 0.6)))
    assert carved(scene_of(DOOR, DOOR_MOTION), "door", GripConfig()).kind is GripKind.EDGE
    assert carved(backed, "door", GripConfig()).kind is GripKind.GROOVE


def test_the_front_is_carved_where_it_rides_on_its_drawer():
    tray = box("drawer", (-0.18, -0.2, 0.02), (0.18, 0.2, 0.1))
    board = box("front", (-0.2, -0.22, 0.0), (0.2, -0.2, 0.17), carried_by="drawer")
    result = carved(scene_of(tray, DRAWER_MOTION, board, members=("front",)), "drawer", of_kind(GripKind.GROOVE))
    assert result.part.id == "front"
    assert_sound(board, result)


@pytest.mark.parametrize(
    ("scale", "kind"), [(0.1, k) for k in KINDS] + [(10.0, GripKind.GROOVE), (10.0, "auto"), (0.02, "auto")]
)
def test_grips_fit_models_of_any_scale(scale, kind):
    T = np.diag([scale, scale, scale, 1.0])
    door = replace(DOOR, surfaces=tuple(s.transformed(T) for s in DOOR.surfaces))
    joint_motion = replace(DOOR_MOTION, axis=DOOR_MOTION.axis.transformed(T))
    scene = replace(scene_of(door, joint_motion), extent=scale)
    result = carved(scene, "door", of_kind(kind))
    assert_sound(door, result)
    assert result.size[0] <= 0.5 * 0.6 * scale


@cache
def final_scene(kind: str) -> Scene:
    return realized_kind(kind).scene


MADE = (
    "overlay pair", "inset pair", "framed door", "chamfered door", "bowed door", "pair under one arch",
    "overlay door without a handle", "drawers with panels between", "corner door at 30 degrees",
    "cabinet that faces +X", "cabinet turned by 30 degrees", "drawer fronts alone", "lift-up flap",
    "doubled faces", "inverted normals", "degenerate faces", "chest with a lid", "table with hanging drawers",
)  # fmt: skip


@pytest.mark.parametrize("name", MADE)
@pytest.mark.parametrize("kind", KINDS)
def test_made_furniture_is_carved_soundly_or_not_at_all(name, kind):
    scene = final_scene(name)
    for moving in scene.joint_motions:
        result = carve_grip(scene, moving, of_kind(kind))
        if isinstance(result, Carved):
            assert_sound(scene.parts[result.part.id], result)


@pytest.mark.parametrize("name", MADE)
def test_every_front_of_made_furniture_takes_some_grip(name):
    scene = final_scene(name)
    bare = replace(scene, moving_bodies={m.id: MovingBody(m.id, (m.id,)) for m in scene.moving_bodies.values()})
    refused = [r for m in bare.joint_motions if isinstance(r := carve_grip(bare, m, GripConfig()), Refusal)]
    assert refused == []


def test_glass_and_louvres_are_carved_on_their_frames_only():
    for name in ("glass door", "inset louvred pair"):
        scene = final_scene(name)
        for moving in scene.joint_motions:
            result = carved(scene, moving, of_kind(GripKind.GROOVE))
            assert_sound(scene.parts[moving], result)
            middle = scene.parts[moving].box.center
            assert abs(result.centre[0] - middle[0]) > 0.3 * scene.parts[moving].box.size[0]


def test_motions_stay_as_free_as_they_were():
    result = realized_kind("overlay pair")
    (joint, *_) = result.object.joints
    grip = carved(result.scene, joint.child, GripConfig())
    new = {grip.part.id: grip.part.surfaces}
    links = tuple(
        replace(link, visuals=tuple(replace(v, surfaces=new.get(v.name, v.surfaces)) for v in link.visuals))
        for link in result.object.links
    )
    assert swept_collisions(replace(result.object, links=links), joint, 20) == {}
