"""What Blender finds in a .blend of ours: objects, parents, looks, motions. Skipped where there is no Blender."""

import json
from dataclasses import replace

import numpy as np
import pytest
from blend_reading import NEAR, assert_posed, objects_of, visuals_of
from small_cabinet import GLASS, STEEL, WOOD, board, png

from grafu.articulation.articulated_object import (
    ArticulatedObject,
    Joint,
    JointLimits,
    Link,
    Visual,
    VisualRole,
)
from grafu.articulation.sweep import all_open
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.vocabulary import JointType, PartLabel


def test_every_part_and_piece_of_hardware_is_one_mesh(reopened_cabinet, cabinet):
    found = {name: o["properties"] for name, (_, o) in visuals_of(reopened_cabinet).items()}
    visuals = [v for link in cabinet.links for v in link.visuals]

    assert found == {v.name: {"grafu": v.role.value, "id": v.name, "label": v.label.value} for v in visuals}
    assert all(o["type"] == "MESH" for _, o in visuals_of(reopened_cabinet).values())


def test_meshes_hang_on_their_links_and_links_on_their_joints(reopened_cabinet, cabinet):
    links, joints = objects_of(reopened_cabinet, "link"), objects_of(reopened_cabinet, "joint")
    visuals = visuals_of(reopened_cabinet)

    assert links["body"][1]["parent"] is None
    for joint in cabinet.joints:
        assert joints[joint.id][1]["parent"] == links[joint.parent][0]
        assert links[joint.child][1]["parent"] == joints[joint.id][0]
    for link in cabinet.links:
        assert {visuals[v.name][1]["parent"] for v in link.visuals} == {links[link.id][0]}


def test_joints_say_what_they_are(reopened_cabinet):
    (_, door), (_, drawer) = (objects_of(reopened_cabinet, "joint")[j] for j in ("door_1_hinge", "drawer_1_rail"))

    assert door["properties"] == {
        "grafu": "joint",
        "id": "door_1_hinge",
        "type": "revolute",
        "parent": "body",
        "child": "door_1",
        "lower": 0.0,
        "upper": 1.75,
        "after": "[]",
        "open": 0.0,
    }
    assert (drawer["properties"]["type"], drawer["properties"]["upper"]) == ("prismatic", 0.28)
    assert json.loads(drawer["properties"]["after"]) == ["door_1_hinge"]
    assert door["overridable"]  # where the file is linked into another
    assert drawer["overridable"]


def test_the_arrow_of_a_joint_is_its_axis(reopened_cabinet, cabinet):
    for joint in cabinet.joints:
        _, empty = objects_of(reopened_cabinet, "joint")[joint.id]
        assert np.allclose(empty["rest"][:3, 2], joint.axis.direction, atol=1e-6)
        assert joint.axis.distance_to(empty["rest"][:3, 3].astype(float)) < NEAR


def test_collections_hold_what_they_name(reopened_cabinet):
    inner = ["cabinet added", "cabinet hardware", "cabinet parts", "cabinet rig"]

    assert sorted(reopened_cabinet["collections"]["cabinet"]) == inner
    for name, o in reopened_cabinet["objects"].items():
        kind = o["properties"]["grafu"]
        held = {"part": "parts"}.get(kind, kind) if o["type"] == "MESH" else "rig"
        assert o["collections"] == [f"cabinet {held}"], name


def test_the_scene_is_metric_and_as_long_as_the_cycle(reopened_cabinet):
    assert reopened_cabinet["scene"] == (0, 100, "METRIC", 1.0)


@pytest.mark.parametrize(
    ("frame", "door", "drawer"), [(0, 0, 0), (25, 1.75, 0), (50, 1.75, 0.28), (75, 1.75, 0), (100, 0, 0)]
)
def test_all_is_closed_open_and_closed_again_and_the_drawer_waits(reopened_cabinet, cabinet, frame, door, drawer):
    values = {"door_1_hinge": float(door), "drawer_1_rail": float(drawer)}

    assert_posed(reopened_cabinet, reopened_cabinet["frames"][frame], cabinet, values)


def test_halfway_the_door_is_half_open(reopened_cabinet, cabinet):
    poses = reopened_cabinet["frames"][12]
    name, _ = objects_of(reopened_cabinet, "link")["door_1"]
    turned = np.arctan2(-poses[name][1, 0], poses[name][0, 0])

    assert 0.35 * 1.75 < turned < 0.6 * 1.75


@pytest.mark.parametrize("joint", ["door_1_hinge", "drawer_1_rail"])
def test_with_the_animation_muted_one_property_moves_one_joint(reopened_cabinet, cabinet, joint):
    ratio, poses = reopened_cabinet["alone"][joint]

    assert ratio == 0.4
    assert_posed(reopened_cabinet, poses, cabinet, {joint: 0.4 * all_open(cabinet)[joint]})


def test_meshes_stand_with_their_own_normals(reopened_cabinet, cabinet):
    for visual in cabinet.link("drawer_1").visuals:
        _, o = visuals_of(reopened_cabinet)[visual.name]
        assert not o["mended"]  # Blender finds nothing wrong
        assert np.allclose(o["normals"], np.repeat(visual.mesh.face_normals, 3, axis=0), atol=1e-3)


def test_materials_and_images_are_the_inputs(reopened_cabinet):
    materials = reopened_cabinet["materials"]

    assert sorted(materials) == ["glass", "oak", "steel", "white paint"]
    assert materials["oak"]["images"] == ["oak"]
    assert materials["oak"]["linked"]["Base Color"] == "TEX_IMAGE"
    assert materials["steel"]["values"]["Metallic"] == STEEL.metallic
    assert materials["steel"]["values"]["Roughness"] == pytest.approx(STEEL.roughness)
    assert materials["steel"]["culled"] is False
    assert materials["white paint"]["values"]["Base Color"] == pytest.approx([0.9, 0.9, 0.88, 1.0])
    assert materials["glass"]["values"]["Alpha"] == pytest.approx(GLASS.base_color[3])
    assert materials["glass"]["method"] == "BLENDED"
    (image,) = reopened_cabinet["images"].values()
    assert image == {"data": WOOD.base_color_texture.data, "size": (4, 4), "space": "sRGB"}


def test_each_face_keeps_its_material(reopened_cabinet):
    _, door = visuals_of(reopened_cabinet)["door_1"]

    assert door["materials"] == ["oak", "glass"]
    assert door["look"] == [0] * 12 + [1] * 12


def test_texture_coordinates_read_back(reopened_cabinet, cabinet):
    (side,) = (v for v in cabinet.link("body").visuals if v.name == "side_left")
    (surface,) = side.surfaces
    _, o = visuals_of(reopened_cabinet)["side_left"]

    assert np.allclose(o["uv"]["UVMap"], surface.uv[surface.mesh.faces.ravel()], atol=1e-6)


def everything_at_once() -> Material:
    def texture(name, color):
        return Texture(name, png(color), "image/png")

    return Material(
        "everything",
        (0.5, 0.6, 0.7, 0.8),
        0.25,
        0.75,
        (0.1, 0.2, 0.3),
        texture("skin", (1, 2, 3)),
        texture("metal", (4, 5, 6)),
        texture("bumps", (7, 8, 9)),
        texture("dirt", (10, 11, 12)),
        texture("glow", (13, 14, 15)),
        "MASK",
        0.4,
    )


def test_every_slot_of_a_material_has_its_place(reopened, make_cube):
    uv = np.linspace(0, 1, 16).reshape(8, 2)
    colors = np.arange(32, dtype=np.uint8).reshape(8, 4)

    found = reopened(make_cube(material=everything_at_once(), uv=uv, colors=colors))

    material = found["materials"]["everything"]
    assert material["images"] == ["bumps", "dirt", "glow", "metal", "skin"]
    assert {name: i["space"] for name, i in found["images"].items()} == {
        "skin": "sRGB",
        "glow": "sRGB",
        "metal": "Non-Color",
        "bumps": "Non-Color",
        "dirt": "Non-Color",
    }
    assert material["linked"] == {
        "Base Color": "MIX",
        "Metallic": "MATH",
        "Roughness": "MATH",
        "Alpha": "MATH",
        "Normal": "NORMAL_MAP",
        "Emission Color": "MIX",
    }
    assert material["groups"] == {"glTF Material Output": True}  # occlusion, as Blender's own glTF reader keeps it
    ((domain, written),) = visuals_of(found)["cube"][1]["colors"].values()
    assert domain == "POINT"
    assert np.allclose(written, colors / 255.0, atol=1e-6)


def test_textures_without_coordinates_are_left_away(reopened, make_cube):
    found = reopened(make_cube(material=WOOD))

    assert found["images"] == {}
    assert found["materials"]["oak"]["linked"] == {}


def test_an_object_without_parts_is_a_file(reopened):
    found = reopened(ArticulatedObject("empty", "body", (Link("body", ()),)))

    assert list(found["objects"]) == ["body_link"]


def test_a_part_without_faces_keeps_its_place(reopened):
    bare = Visual("bare", (Surface(board(0, 0, 0, 1, 1, 1).with_faces(np.zeros(0, int))),))

    found = reopened(ArticulatedObject("bare", "body", (Link("body", (bare,)),)))

    assert len(found["objects"]["bare"]["triangles"]) == 0


def test_doubled_and_empty_faces_do_not_upset_blender(reopened, make_cube, sheet):
    found = reopened(make_cube(mesh=sheet))
    _, o = visuals_of(found)["cube"]

    assert not o["mended"]
    assert np.allclose(o["triangles"], sheet.triangles[:2])
    assert np.allclose(o["normals"], np.repeat(sheet.face_normals[:2], 3, axis=0), atol=1e-3)
    assert found["materials"]["default"]["culled"] is False


AWKWARD = ["Tür № 1", "a" * 80 + "1", "a" * 80 + "2", "Ж" * 60, "door.001", "door/left", 'quo"te', "line\nbreak", "😀"]


def test_names_that_blender_would_not_keep_lose_nothing(reopened):
    hinge = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    links, joints = [Link("body", ())], []
    for k, name in enumerate(AWKWARD):
        mesh = board(k, 0, 0, k + 0.5, 1, 1)
        links.append(Link(name, (Visual(name, (Surface(mesh),)),)))
        joints.append(Joint(f"{name} joint", JointType.REVOLUTE, "body", name, hinge, JointLimits(0.0, 1.0 + k / 10)))
    awkward = ArticulatedObject("Schränkchen/№ 7 " * 10, "body", tuple(links), tuple(joints))

    found = reopened(awkward)

    assert set(visuals_of(found)) == set(AWKWARD)
    assert all(len(name.encode()) <= 63 for name in (*found["objects"], *found["collections"]))
    assert_posed(found, found["frames"][50], awkward, all_open(awkward))


def tower(directions) -> ArticulatedObject:
    """Links each on the last, about and along slanting axes."""
    links, joints = [Link("l0", ())], []
    for k, direction in enumerate(directions):
        kind = JointType.REVOLUTE if k % 2 else JointType.PRISMATIC
        axis = Axis(vec3(0.1 * k, 0.2, 0.3), direction)
        mesh = board(0.2 * k, -0.1, 0.1 * k, 0.2 * k + 0.3, 0.4, 0.1 * k + 0.2)
        links.append(Link(f"l{k + 1}", (Visual(f"v{k + 1}", (Surface(mesh),), VisualRole.ADDED, PartLabel.DOOR),)))
        joints.append(Joint(f"j{k}", kind, f"l{k}", f"l{k + 1}", axis, JointLimits(0.05, 0.9)))
    return ArticulatedObject("tower", "l0", tuple(links), tuple(joints))


def test_joints_on_joints_about_any_axis_move_as_the_kinematics_say(reopened):
    rng = np.random.default_rng(7)
    slanting = rng.normal(size=(6, 3))
    slanting /= np.linalg.norm(slanting, axis=1, keepdims=True)
    straight = np.array([[0, 0, -1], [0, 0, 1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
    made = tower([vec3(*map(float, d)) for d in (*slanting, *straight)])

    found = reopened(made)

    assert_posed(found, found["frames"][50], made, all_open(made))
    assert_posed(found, found["frames"][0], made, dict.fromkeys(all_open(made), 0.05))
    for joint, (ratio, poses) in found["alone"].items():
        values = dict.fromkeys(all_open(made), 0.05) | {joint: 0.05 + ratio * 0.85}
        assert_posed(found, poses, made, values)


def test_a_fixed_joint_has_nothing_to_open(reopened, cabinet):
    fixed = replace(
        cabinet,
        joints=(
            replace(cabinet.joints[0], type=JointType.FIXED, limits=JointLimits(0.0, 0.0)),
            replace(cabinet.joints[1], after=()),
        ),
    )

    found = reopened(fixed)

    _, empty = objects_of(found, "joint")["door_1_hinge"]
    assert "open" not in empty["properties"]
    assert empty["properties"]["type"] == "fixed"
    assert_posed(found, found["frames"][50], fixed, {"drawer_1_rail": 0.28})
