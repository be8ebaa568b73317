"""Joints on moving links and joints that follow others, from the URDF that states them to the formats written."""

import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
import pytest
from glb_reader import Glb

import grafu
from grafu.articulation.articulated_object import Coupling
from grafu.articulation.kinematics import link_poses
from grafu.articulation.sweep import all_open
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.swept_body import SweptBody
from grafu.graph.serialize import completion_from_json, load_json
from nested_urdfs import drawer_behind_door, drawer_in_door, folding_door


@pytest.fixture(scope="module")
def folding(tmp_path_factory) -> grafu.Result:
    return grafu.functionalize(folding_door(tmp_path_factory.mktemp("folding")), motion="annotation")


@pytest.fixture(scope="module")
def drawer(tmp_path_factory) -> grafu.Result:
    return grafu.functionalize(drawer_in_door(tmp_path_factory.mktemp("drawer")), motion="annotation")


def joint_of(result: grafu.Result, part: str):
    return next(joint for joint in result.report.joints if joint.part == part)


def written(result: grafu.Result, folder: Path, *formats: str) -> Path:
    result.save(folder, formats=formats, page=False)
    return folder


def cuts(result: grafu.Result, values: dict[str, float]) -> set[tuple[str, str]]:
    """The pairs of parts of different links that cut into one another by more than a millimetre; hardware left out."""
    poses, parts = link_poses(result.object, values), {p.id for p in result.asset.parts}
    meshes = [(link.id, v.name, v.mesh) for link in result.object.links for v in link.visuals if v.name in parts]
    found = set()
    for k, (link, name, mesh) in enumerate(meshes):
        body = SweptBody(mesh, 0.0005)
        body.place(poses[link])
        for other, its_name, its_mesh in meshes[k + 1 :]:
            if other != link and body.penetrates(MeshCollider(its_mesh).posed(poses[other])):
                found.add((name, its_name))
    return found


def test_the_second_leaf_hangs_on_the_first_and_follows_it(folding):
    first, second = joint_of(folding, "leaf_1"), joint_of(folding, "leaf_2")
    assert (first.parent, second.parent, second.mount) == ("body", "leaf_1", "leaf_1")
    assert first.follows is None
    assert (second.follows.leader, second.follows.multiplier, second.follows.offset) == ("leaf_1_joint", 2.0, 0.0)
    assert second.upper == pytest.approx(2 * first.upper)
    assert first.upper == pytest.approx(1.4, abs=0.1)
    np.testing.assert_allclose(second.axis, (0.0, 0.0, 1.0), atol=1e-9)
    assert second.grasp == first.grasp == "handle"
    assert folding.report.skipped == ()


def test_the_free_edge_of_a_folding_door_stays_at_the_front(folding):
    """Leaf 2 turns back by twice as much: its far edge keeps to the plane of the cabinet's front."""
    edge = np.array([0.415, -0.21, 0.4, 1.0])
    upper = joint_of(folding, "leaf_1").upper
    ends = [link_poses(folding.object, {"leaf_1_joint": v})["leaf_2"] @ edge for v in np.linspace(0, upper, 9)]
    assert max(abs(end[1] - edge[1]) for end in ends) < 0.05
    assert ends[-1][0] < -0.2  # folded to the hinge side


@pytest.mark.parametrize("ratio", [0.0, 0.1, 0.35, 0.7, 1.0])
def test_nothing_collides_while_a_folding_door_opens(folding, ratio):
    assert cuts(folding, {"leaf_1_joint": ratio * joint_of(folding, "leaf_1").upper}) == set()


def test_a_leaf_moves_with_the_one_that_carries_it(folding):
    values = all_open(folding.object)
    assert values["leaf_2_joint"] == pytest.approx(2 * values["leaf_1_joint"])
    leaf_1 = {v.name for v in folding.object.link("leaf_1").visuals}
    assert {"hinge_leaf_2_0_static", "hinge_leaf_2_1_static"} <= leaf_1  # the hinge between sits on the first leaf


def test_a_written_urdf_has_the_parent_and_the_mimic_element(folding, tmp_path):
    root = ET.parse(written(folding, tmp_path / "out", "urdf") / "model.urdf").getroot()
    joint = root.find("joint[@name='leaf_2_joint']")
    assert joint.find("parent").get("link") == "leaf_1"
    mimic = joint.find("mimic")
    assert (mimic.get("joint"), float(mimic.get("multiplier"))) == ("leaf_1_joint", 2.0)


def test_mujoco_moves_the_second_leaf_with_the_first(folding, tmp_path):
    model = mujoco.MjModel.from_xml_path(str(written(folding, tmp_path / "out", "mjcf") / "model.xml"))
    assert model.neq == 1
    data = mujoco.MjData(model)
    upper = joint_of(folding, "leaf_1").upper
    for name, value in (("leaf_1_joint", upper), ("leaf_2_joint", 2 * upper)):
        data.qpos[model.joint(name).qposadr[0]] = value
    before = mujoco.MjData(model)
    mujoco.mj_forward(model, before)
    mujoco.mj_forward(model, data)
    moved = data.body("leaf_2").xpos - before.body("leaf_2").xpos
    assert model.body("leaf_2").parentid[0] == model.body("leaf_1").id
    assert np.linalg.norm(moved) > 0.3


def test_the_second_leafs_node_lies_below_the_firsts_in_a_glb(folding, tmp_path):
    file = Glb.parse((written(folding, tmp_path / "out", "glb") / "model.glb").read_bytes())
    assert "leaf_2_link" in {file.tables["nodes"][k]["name"] for k in file.node("leaf_1_link")["children"]}
    assert len(file.tables["animations"][0]["channels"]) == 2


def test_a_drawer_in_a_door_runs_on_the_door(drawer):
    door, box = joint_of(drawer, "door"), joint_of(drawer, "drawer")
    assert (door.parent, box.parent, box.mount) == ("body", "door", "door")
    np.testing.assert_allclose(box.axis, (0.0, -1.0, 0.0), atol=1e-9)
    assert box.upper > 0.7 * 0.2
    rails = {v.name for v in drawer.object.link("door").visuals if v.name.startswith("rail_")}
    assert rails == {"rail_drawer_left_static", "rail_drawer_right_static"}
    assert not drawer.report.skipped


@pytest.mark.parametrize(("door", "box"), [(0.0, 1.0), (1.0, 0.0), (1.0, 1.0)])
def test_nothing_collides_with_a_drawer_in_a_door(drawer, door, box):
    uppers = {name: joint_of(drawer, name).upper for name in ("door", "drawer")}
    assert cuts(drawer, {"door_joint": door * uppers["door"], "drawer_joint": box * uppers["drawer"]}) == set()


def test_the_graph_has_an_edge_for_each_joint_between_what_carries_it_and_what_moves(folding, drawer):
    first, second = folding.graph.hinges
    assert (first.child, first.coupling) == ("leaf_1", None)
    assert not folding.graph.node(first.parent).label.is_movable
    assert (second.parent, second.child, second.coupling) == ("leaf_1", "leaf_2", Coupling("leaf_1", 2.0, 0.0))
    [rail] = drawer.graph.rails
    assert (rail.parent, rail.child, rail.axis) == ("door", "drawer", 2)
    for result in (folding, drawer):
        assert result.graph.moving == {joint.part for joint in result.joints}
        assert result.made.completion.refused == ()


def test_the_graph_file_has_the_carrier_and_the_leader(folding, tmp_path):
    text = (written(folding, tmp_path / "out", "urdf") / "graph.json").read_text()
    assert completion_from_json(load_json(text)) == folding.made.completion
    [edge] = [edge for edge in load_json(text)["edges"] if edge["dst"] == "leaf_2" and edge["kind"] == "hinge"]
    assert (edge["src"], edge["follows"]["leader"]) == ("leaf_1", "leaf_1")


def test_a_drawer_in_a_door_swings_with_it(drawer, tmp_path):
    root = ET.parse(written(drawer, tmp_path / "out", "urdf", "mjcf") / "model.urdf").getroot()
    assert root.find("joint[@name='drawer_joint']/parent").get("link") == "door"
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "out" / "model.xml"))
    assert model.body("drawer").parentid[0] == model.body("door").id


def test_a_joint_that_cannot_be_built_leaves_its_part_on_the_link_that_carries_it(tmp_path):
    path = drawer_in_door(tmp_path)
    path.write_text(path.read_text().replace('<axis xyz="0 -1 0"/>', '<axis xyz="0 -1 1"/>'))
    result = grafu.functionalize(path, motion="annotation")
    assert [joint.part for joint in result.joints] == ["door"]
    assert "drawer" in {visual.name for visual in result.object.link("door").visuals}
    (skipped,) = result.skipped
    assert (skipped.request, skipped.detail) == (
        "drawer",
        "it slides askew, neither level nor upright; it moves with door",
    )


def test_a_follower_whose_leader_is_fixed_moves_by_itself(tmp_path):
    """Leaf 1 is fixed by the user: it is static, and leaf 2 hangs on it."""
    asset = grafu.load(folding_door(tmp_path))
    result = grafu.functionalize(asset, motion="annotation", motions={"leaf_1": "fixed"})
    assert [(s.request, s.reason) for s in result.skipped if s.request == "leaf_1"] == [("leaf_1", "rejected")]
    for joint in result.joints:
        assert (joint.parent, joint.follows) == ("body", None)
    assert {joint.part for joint in result.joints} <= result.graph.moving == {"leaf_2"}
    assert all(not result.graph.node(edge.parent).label.is_movable for edge in result.graph.motions)
    assert all(edge.coupling is None for edge in result.graph.motions)


def test_a_follower_that_would_start_outside_its_limits_is_not_coupled(tmp_path):
    mimic = '<mimic joint="leaf_1_joint" multiplier="-2" offset="0.4"/>'
    result = grafu.functionalize(folding_door(tmp_path, mimic), motion="annotation")
    assert all(joint.follows is None for joint in result.joints)
    noted = [note for joint in result.joints for note in joint.notes if "does not follow leaf_1" in note]
    assert noted or "leaf_2" in {skipped.request for skipped in result.skipped}


def test_doors_beside_one_another_are_coupled(tmp_path):
    """Both leaves hang on the case, the second at its right: it opens as far as the first."""
    path = folding_door(tmp_path, '<mimic joint="leaf_1_joint" multiplier="-1"/>')
    text = path.read_text().replace('<parent link="leaf_1"/>', '<parent link="base"/>')
    text = text.replace('<origin xyz="0.415 0.019 0"/>', '<origin xyz="0.415 -0.22 0"/>')
    path.write_text(text.replace('<origin xyz="0.208 -0.0095 0.41"/>', '<origin xyz="-0.207 0.0095 0.41"/>'))
    result = grafu.functionalize(path, motion="annotation")
    first, second = joint_of(result, "leaf_1"), joint_of(result, "leaf_2")
    assert (first.parent, second.parent) == ("body", "body")
    assert (second.follows.leader, second.follows.multiplier) == ("leaf_1_joint", 1.0)
    assert second.upper == pytest.approx(first.upper)
    np.testing.assert_allclose(second.axis, (0.0, 0.0, 1.0), atol=1e-9)


def test_a_drawer_that_the_closed_door_blocks_waits_for_the_door(tmp_path):
    """On the inner side of a door it meets the cabinet's back, until the door that carries it is open."""
    result = grafu.functionalize(drawer_behind_door(tmp_path), motion="annotation")
    drawer = joint_of(result, "drawer")
    assert (drawer.parent, drawer.after) == ("door", ("door_joint",))
    assert drawer.upper > 0.15
    np.testing.assert_allclose(drawer.axis, (0.0, 1.0, 0.0), atol=1e-9)  # as in the door's closed pose
    uppers = {joint.id: joint.upper for joint in result.joints}
    assert cuts(result, uppers) == set()
