"""A folding door with a coupled hinge in every format: it moves there as the kinematics say."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest
import yourdfpy
from glb_reader import Glb
from gltf_validation import issues_of
from mjcf_reading import at_keyframe, compiled, pose_of, run
from scipy.spatial.transform import Rotation

from bifold import LEAF_HINGE, make_bifold
from grafu.articulation.articulated_object import ArticulatedObject, Coupling
from grafu.articulation.kinematics import link_origins, link_poses
from grafu.articulation.sweep import cycle_tracks, values_at
from grafu.export.files import write_files
from grafu.export.glb import export_glb
from grafu.export.glb_object import read_glb_object
from grafu.export.mjcf import MjcfConfig, export_mjcf
from grafu.export.particulate import export_particulate
from grafu.export.singapo import export_singapo
from grafu.export.urdf import export_urdf
from grafu.geometry.transform import from_rotation, translation

Y_UP = from_rotation(np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]]))


def closing(bifold: ArticulatedObject) -> ArticulatedObject:
    """The second leaf drawn at 1.4 rad, closing as the first opens."""
    first = bifold.joints[0]
    return replace(bifold, joints=(first, LEAF_HINGE.following(first, -1.0, 1.4)))


@pytest.fixture(scope="module", params=[make_bifold, lambda: closing(make_bifold())], ids=["folding", "closing"])
def bifold(request) -> ArticulatedObject:
    return request.param()


@pytest.fixture(scope="module")
def model(bifold, tmp_path_factory) -> mujoco.MjModel:
    return compiled(export_mjcf(bifold), tmp_path_factory.mktemp("mjcf") / "bifold")


def require_poses(bifold: ArticulatedObject, found: dict[str, np.ndarray], leader: float, atol: float) -> None:
    expected, origins = link_poses(bifold, {"leaf_1_hinge": leader}), link_origins(bifold)
    for link in bifold.links:
        assert np.allclose(found[link.id], expected[link.id] @ translation(origins[link.id]), atol=atol), link.id


def animated(file: Glb, time: float) -> dict[str, np.ndarray]:
    """The world pose of every link's node at a time, object frame; every channel is interpolated."""
    nodes, animation = file.tables["nodes"], file.tables["animations"][0]
    local = {k: (np.array(n.get("translation", [0.0, 0, 0])), Rotation.identity()) for k, n in enumerate(nodes)}
    for channel in animation["channels"]:
        sampler = animation["samplers"][channel["sampler"]]
        times, values = file.array(sampler["input"])[:, 0], file.array(sampler["output"]).astype(float)
        value = np.array([np.interp(time, times, column) for column in values.T])
        node = channel["target"]["node"]
        assert channel["target"]["path"] == "rotation"
        local[node] = (local[node][0], Rotation.from_quat(value / np.linalg.norm(value)))
    poses, queue = {}, [(k, np.eye(4)) for k in file.tables["scenes"][0]["nodes"]]
    while queue:
        index, above = queue.pop()
        T = above @ from_rotation(local[index][1].as_matrix(), local[index][0])
        poses[nodes[index]["name"].removesuffix("_link")] = np.linalg.inv(Y_UP) @ T @ Y_UP
        queue += [(child, T) for child in nodes[index].get("children", [])]
    return poses


def test_the_animation_of_nested_nodes_moves_both_leaves_in_step(bifold, tmp_path):
    data = export_glb(bifold)["model.glb"]
    file, tracks = Glb.parse(data), cycle_tracks(bifold)
    assert len(file.tables["animations"][0]["channels"]) == 2
    assert "leaf_2_link" in {file.tables["nodes"][k]["name"] for k in file.node("leaf_1_link")["children"]}
    for time in tracks[0].times:
        values = values_at(tracks, float(time))
        poses = {name: pose for name, pose in animated(file, float(time)).items() if name in link_poses(bifold, {})}
        require_poses(bifold, poses, values["leaf_1_hinge"], 1e-5)
    issues = issues_of(data, tmp_path)
    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_a_glb_read_back_has_the_coupling(bifold, tmp_path):
    (tmp_path / "model.glb").write_bytes(export_glb(bifold)["model.glb"])
    read = read_glb_object(tmp_path / "model.glb")
    made = bifold.joint_of["leaf_2"]
    found = read.joint_of["leaf_2"]
    assert (found.coupling, found.parent, found.limits) == (made.coupling, "leaf_1", made.limits)
    assert np.allclose(found.axis.direction, made.axis.direction)


@pytest.mark.parametrize("angle", [0.0, 0.6, 1.4])
def test_other_readers_of_urdf_move_both_leaves(bifold, tmp_path, angle):
    write_files(export_urdf(bifold), tmp_path / "urdf")
    robot = yourdfpy.URDF.load(str(tmp_path / "urdf/model.urdf"))
    assert robot.validate()
    assert robot.actuated_joint_names == ["leaf_1_hinge"]
    coupling, mimic = bifold.joint_of["leaf_2"].coupling, robot.joint_map["leaf_2_hinge"].mimic
    assert Coupling(mimic.joint, mimic.multiplier, mimic.offset) == coupling
    robot.update_cfg({"leaf_1_hinge": angle})
    require_poses(bifold, {link.id: robot.get_transform(link.id) for link in bifold.links}, angle, 1e-6)


def test_mujoco_knows_the_coupling(bifold, model):
    coupling = bifold.joint_of["leaf_2"].coupling
    assert model.neq == 1
    assert (model.eq_obj1id[0], model.eq_obj2id[0]) == (model.joint("leaf_2_hinge").id, model.joint("leaf_1_hinge").id)
    assert np.allclose(model.eq_data[0][:5], [coupling.offset, coupling.multiplier, 0, 0, 0])


def test_in_simulation_the_coupled_joint_follows(bifold, model):
    data = at_keyframe(model, "closed")
    coupling, reached = bifold.joint_of["leaf_2"].coupling, []
    for _ in range(80):
        data.joint("leaf_1_hinge").qfrc_applied[:] = 12.0
        run(model, data, 0.05)
        leader, follower = (float(data.joint(f"leaf_{k}_hinge").qpos[0]) for k in (1, 2))
        assert follower == pytest.approx(coupling.value(leader), abs=0.02)
        reached.append(leader)
    assert reached[-1] == pytest.approx(1.4, abs=0.03)
    require_poses(bifold, {link.id: pose_of(data, link.id) for link in bifold.links}, reached[-1], 0.03)


def test_a_push_on_the_second_leaf_opens_the_first(model, bifold):
    data = at_keyframe(model, "closed")
    sign = np.sign(bifold.joint_of["leaf_2"].coupling.multiplier)
    for _ in range(40):
        data.joint("leaf_2_hinge").qfrc_applied[:] = sign * 8.0
        run(model, data, 0.05)
    assert float(data.joint("leaf_1_hinge").qpos[0]) > 0.5


def test_the_open_pose_keeps_the_coupling_and_only_the_leader_has_a_servo(bifold, tmp_path):
    model = compiled(export_mjcf(bifold, MjcfConfig(actuators=True)), tmp_path / "mjcf")
    data = at_keyframe(model, "open")
    values = [float(data.joint(f"leaf_{k}_hinge").qpos[0]) for k in (1, 2)]
    assert values[0] > 1.0
    assert values[1] == pytest.approx(bifold.joint_of["leaf_2"].coupling.value(values[0]))
    assert [model.actuator(k).name for k in range(model.nu)] == ["leaf_1_hinge"]


def test_formats_that_cannot_say_it_note_it():
    for files in (export_singapo(make_bifold()), export_particulate(make_bifold())):
        assert [note.split(" cannot say ")[1] for note in files.notes] == [
            "that leaf_2_hinge follows leaf_1_hinge: its joints move by themselves there"
        ]
