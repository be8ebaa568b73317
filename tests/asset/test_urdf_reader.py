from math import pi

import numpy as np
import pytest
import trimesh

from grafu.articulation.articulated_object import Coupling
from grafu.asset.load import load_asset
from grafu.asset.options import LoadOptions
from grafu.asset.part import AnnotatedJoint, moved_joints
from grafu.errors import UnreadableAsset, UnsegmentedAsset
from grafu.geometry.axis import Axis
from grafu.graph.parse import parse_graph
from grafu.pipeline.inspection import inspect
from grafu.vocabulary import JointType, PartLabel
from small_assets import load_annotated, urdf_text, write_urdf


def test_links_become_parts_and_joints_in_place(tmp_path):
    asset = load_annotated(write_urdf(tmp_path))
    assert asset.kind == "urdf"
    assert {p.id for p in asset.parts if p.label.is_movable} == {"door_link", "drawer_link"}
    assert asset.part("handle_8").carried_by == "door_link"
    np.testing.assert_allclose(asset.box.size, [0.8, 0.43, 1.0], atol=1e-6)
    np.testing.assert_allclose(asset.part("door_link").box.low, [-0.4, -0.185, 0.0], atol=1e-6)
    assert asset.joints[0].upper == 1.5


def test_the_folder_of_a_urdf_reads_the_same(tmp_path):
    by_file, by_folder = load_annotated(write_urdf(tmp_path / "m")), load_annotated(tmp_path / "m")
    assert by_file.name == "cabinet"
    assert by_folder.name == "m"
    assert [p.id for p in by_file.parts] == [p.id for p in by_folder.parts]


def test_continuous_joints_are_unlimited(tmp_path):
    asset = load_annotated(write_urdf(tmp_path, urdf_text(door_type="continuous")))
    assert not asset.joints[0].limited


def coupled(mimic: str) -> str:
    """A second leaf on the door whose hinge follows the door's."""
    return urdf_text(
        '<link name="leaf_door"><visual><origin xyz="0.2 0 0.5"/><geometry><box size="0.3 0.02 0.8"/></geometry>'
        '</visual></link><joint name="leaf_joint" type="revolute"><parent link="door_link"/><child link="leaf_door"/>'
        f'<axis xyz="0 0 -1"/><limit lower="-3" upper="0"/>{mimic}</joint>'
    )


def test_which_joint_a_joint_follows_is_read(tmp_path):
    mimic = '<mimic joint="door_joint" multiplier="-2" offset="0.1"/>'
    asset = load_annotated(write_urdf(tmp_path, coupled(mimic)))
    joint = next(joint for joint in asset.joints if joint.part == "leaf_door")
    assert joint.coupling == Coupling("door_link", -2.0, 0.1)
    assert asset.part("leaf_door").carried_by == "door_link"
    (stated,) = (joint for joint in inspect(asset, parse_graph(asset)).joints if joint.follows)
    assert (stated.part, stated.follows.leader, stated.follows.multiplier) == ("leaf_door", "door_link", -2.0)


@pytest.mark.parametrize("mimic", ['<mimic joint="absent"/>', '<mimic joint="door_joint" multiplier="0"/>', ""])
def test_what_follows_nothing_that_moves_has_no_coupling(tmp_path, mimic):
    asset = load_annotated(write_urdf(tmp_path, coupled(mimic)))
    assert [joint.coupling for joint in asset.joints] == [None] * 3


@pytest.mark.parametrize(("length", "is_handle"), [(0.12, True), (0.3, False)])
def test_what_is_small_and_turns_on_a_door_is_its_handle_with_a_small_joint(tmp_path, length, is_handle):
    lever = urdf_text(
        '<link name="movable"><visual><origin xyz="0.3 -0.02 0.5"/><geometry>'
        f'<box size="{length} 0.02 0.02"/></geometry></visual></link>'
        '<joint name="turn" type="revolute"><parent link="door_link"/><child link="movable"/>'
        '<axis xyz="0 -1 0"/><limit lower="0" upper="0.8"/></joint>'
    )
    asset = load_annotated(write_urdf(tmp_path, lever))
    part = next(part for part in asset.parts if part.source.name == "movable")
    assert (part.label is PartLabel.HANDLE, part.carried_by) == (is_handle, "door_link")
    assert [joint.part == part.id for joint in asset.small_joints] == [True] * is_handle
    assert (part.id in {joint.part for joint in asset.joints}) is not is_handle


def test_lengths_of_a_coupling_grow_with_the_model():
    axis = Axis(np.zeros(3), np.eye(3)[2])
    turn = AnnotatedJoint("a", JointType.REVOLUTE, axis, 0.0, 1.0)
    slide = AnnotatedJoint("b", JointType.PRISMATIC, axis, 0.0, 0.4, coupling=Coupling("a", 0.3, 0.1))
    back = AnnotatedJoint("c", JointType.REVOLUTE, axis, 0.0, 1.0, coupling=Coupling("b", 2.0, 0.5))
    _, scaled, turned = moved_joints((turn, slide, back), 10.0 * np.eye(4), 10.0)
    assert (scaled.coupling, scaled.upper) == (Coupling("a", 3.0, 1.0), 4.0)
    assert (turned.coupling, turned.upper) == (Coupling("b", 0.2, 0.5), 1.0)


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_kinds_that_are_not_built_stay_in_place_with_a_note(tmp_path, kind):
    asset = load_annotated(write_urdf(tmp_path, urdf_text(door_type=kind)))
    assert len(asset.joints) == 1
    assert any(kind in note for note in asset.notes)


def test_a_link_fixed_to_a_moving_link_belongs_to_it(tmp_path):
    extra = """<link name="knob_link"><visual><origin xyz="0.35 -0.02 0.5"/><geometry><sphere radius="0.01"/></geometry>
    </visual></link><joint name="k" type="fixed"><parent link="door_link"/><child link="knob_link"/></joint>"""
    asset = load_annotated(write_urdf(tmp_path, urdf_text(extra)))
    knob = asset.part("handle_knob_link")
    assert (knob.label, knob.carried_by) == (PartLabel.HANDLE, "door_link")


def test_package_names_are_sought_upwards_and_absent_meshes_noted(tmp_path):
    text = urdf_text().replace('filename="meshes/', 'filename="package://cabinet_model/meshes/')
    text = text.replace("meshes/shelf-6.obj", "meshes/shelf-60.obj")
    asset = load_annotated(write_urdf(tmp_path, text))
    assert any("shelf-60.obj is missing" in note for note in asset.notes)
    assert "shelf_6" not in {p.id for p in asset.parts}


def test_primitives_scale_and_colours_are_read(tmp_path):
    text = """<robot name="r"><material name="red"><color rgba="1 0 0 1"/></material><link name="a">
    <visual name="top"><geometry><box size="1 0.5 0.02"/></geometry><material name="red"/></visual>
    <visual name="leg"><origin xyz="0 0 -0.4" rpy="1.5707963 0 0"/><geometry>
    <cylinder radius="0.1" length="0.3"/></geometry></visual></link></robot>"""
    (tmp_path / "r.urdf").write_text(text)
    top, leg = load_annotated(tmp_path / "r.urdf").parts
    assert top.surfaces[0].material.base_color == (1.0, 0.0, 0.0, 1.0)
    np.testing.assert_allclose(sorted(leg.box.size), [0.2, 0.2, 0.3], atol=2e-3)


def test_solids_of_any_size_are_one_mesh_scaled(tmp_path, monkeypatch):
    made = []
    for form in ("icosphere", "capsule"):
        own = getattr(trimesh.creation, form)
        monkeypatch.setattr(f"trimesh.creation.{form}", lambda *a, own=own, **k: made.append(a) or own(*a, **k))
    balls = "".join(
        f'<visual><origin xyz="{k} 0 0"/><geometry><sphere radius="{(k + 1) / 20}"/></geometry></visual>'
        for k in range(5)
    )
    pins = "".join(
        f'<visual name="pin"><origin xyz="{k} 1 0"/>'
        f'<geometry><capsule radius="{(k + 1) / 20}" length="0.7"/></geometry></visual>'
        for k in range(5)
    )
    (tmp_path / "r.urdf").write_text(f'<robot name="r"><link name="a">{balls}{pins}</link></robot>')
    parts = load_asset(tmp_path / "r.urdf", LoadOptions(parts="input", scale=1.0)).parts

    sizes = np.sort([part.box.size for part in parts], axis=1)
    np.testing.assert_allclose(sizes[:5], [[2 * r] * 3 for r in np.arange(1, 6) / 20], atol=1e-3)
    np.testing.assert_allclose(sizes[5:, 2], [0.7 + 2 * r for r in np.arange(1, 6) / 20], atol=1e-9)
    np.testing.assert_allclose(sizes[5:, 0], [2 * r for r in np.arange(1, 6) / 20], atol=1e-3)
    assert len(made) <= 2


def test_roll_pitch_yaw_turn_about_fixed_axes(tmp_path):
    turned = f'<origin rpy="{pi / 2} 0 {pi / 2}"/><axis xyz="0 1 0"/>'
    text = urdf_text().replace('<axis xyz="0 -1 0"/>', turned)
    drawer = load_annotated(write_urdf(tmp_path, text), LoadOptions(front="-Y")).joints[1]
    np.testing.assert_allclose(drawer.axis.direction, [0, 0, 1], atol=1e-9)
    turned = f'<origin rpy="0 {pi / 2} {pi / 2}"/><axis xyz="1 0 0"/>'
    text = urdf_text().replace('<axis xyz="0 -1 0"/>', turned)
    drawer = load_annotated(write_urdf(tmp_path, text), LoadOptions(front="-Y")).joints[1]
    np.testing.assert_allclose(drawer.axis.direction, [0, 0, -1], atol=1e-9)


CYCLE = """<joint name="c1" type="fixed"><parent link="door_link"/><child link="carcass"/></joint>"""
TWICE = """<joint name="c2" type="fixed"><parent link="drawer_link"/><child link="door_link"/></joint>"""
STRAY = """<joint name="c3" type="fixed"><parent link="nowhere"/><child link="door_link"/></joint>"""
HUGE = """<link name="l"><visual><geometry><box size="1e308 1e308 1e308"/></geometry></visual></link>"""
HALF = """<joint name="c4" type="fixed"><parent link="carcass"/></joint>"""


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (urdf_text(CYCLE), "cycle"),
        (urdf_text(TWICE), "two parent joints"),
        (urdf_text(STRAY), "nowhere"),
        (urdf_text(HALF), "lacks a parent or a child"),
        ("<robot><link", "not readable XML"),
        ("<mujoco/>", "expected <robot>"),
        ('<robot name="r"/>', "no links"),
        (urdf_text().replace("meshes/", "gone/"), "no visual shape"),
        (urdf_text().replace('<link name="', '<link name="a" was="'), "several links are named 'a'"),
        ('<robot name="r"><link/><link/></robot>', "several links are named ''"),
        (urdf_text().replace('lower="0"', 'lower="zero"'), "finite numbers"),
        (urdf_text().replace('xyz="0 0 -1"', 'xyz="0 0"'), "expected 3 finite numbers"),
        (urdf_text().replace('xyz="0 0 -1"', f'xyz="{"x" * 70_000}"'), "expected 3 finite numbers"),
        (urdf_text(HUGE), "expected 3 sizes other than 0"),
        ('<!DOCTYPE r [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]><robot name="&b;"/>', "entities"),
    ],
)
def test_bad_files_are_refused_in_one_line(tmp_path, text, said):
    with pytest.raises(UnreadableAsset, match=said) as caught:
        load_annotated(write_urdf(tmp_path, text))
    assert "\n" not in str(caught.value)
    assert "cabinet.urdf" in str(caught.value)
    assert len(str(caught.value).replace(str(tmp_path), "")) < 300


def test_a_model_that_lost_its_meshes_says_which(tmp_path):
    text = urdf_text().replace("meshes/", "gone/").replace("gone/", "meshes/", 1)
    with pytest.raises(UnsegmentedAsset, match=r"is one part, `.*` \(mesh gone/.*.obj is missing and was left out\)"):
        load_annotated(write_urdf(tmp_path, text))


def test_a_zero_axis_keeps_the_part_in_place(tmp_path):
    asset = load_annotated(write_urdf(tmp_path, urdf_text().replace('xyz="0 0 -1"', 'xyz="0 0 0"')))
    assert len(asset.joints) == 1
    assert any("zero axis" in note for note in asset.notes)
