import xml.etree.ElementTree as ET
from pathlib import Path

import mujoco
import numpy as np
import pytest
import yourdfpy
from small_cabinet import make_cabinet

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link
from grafu.articulation.kinematics import link_poses
from grafu.articulation.mass import mass_of_link
from grafu.export.files import write_files
from grafu.export.urdf import UrdfConfig, export_urdf
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.vocabulary import JointType


@pytest.fixture(scope="module")
def folder(tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("urdf") / "cabinet"
    write_files(export_urdf(make_cabinet()), out)
    return out


@pytest.fixture(scope="module")
def robot(folder) -> yourdfpy.URDF:
    return yourdfpy.URDF.load(str(folder / "model.urdf"))


@pytest.fixture
def simulation(folder) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_path(str(folder / "model.urdf"))
    return model, mujoco.MjData(model)


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    for _ in range(round(seconds / model.opt.timestep)):
        mujoco.mj_step(model, data)


def test_it_loads_and_is_valid(robot):
    assert robot.validate()
    assert robot.base_link == "body"
    assert list(robot.link_map) == ["body", "door_1", "drawer_1"]


@pytest.mark.parametrize("values", [(0.0, 0.0), (1.2, 0.0), (1.75, 0.28)])
def test_parts_stand_where_the_kinematics_say(robot, cabinet, values):
    robot.update_cfg(dict(zip(("door_1_hinge", "drawer_1_rail"), values, strict=True)))
    poses = link_poses(cabinet, {"door_1_hinge": values[0], "drawer_1_rail": values[1]})

    expected = [Box.around(link.mesh.transformed(poses[link.id]).vertices) for link in cabinet.links]

    whole = expected[0].union(expected[1]).union(expected[2])
    assert np.allclose(robot.scene.bounds, [whole.low, whole.high], atol=1e-6)


def test_joints_read_back(robot, cabinet):
    for joint in cabinet.joints:
        made = robot.joint_map[joint.id]
        assert (made.type, made.parent, made.child) == (joint.type.value, joint.parent, joint.child)
        assert (made.limit.lower, made.limit.upper) == (joint.limits.lower, joint.limits.upper)
        assert np.allclose(made.axis, joint.axis.direction)
        assert joint.axis.distance_to(made.origin[:3, 3]) < 1e-9
        resistance = (made.limit.effort, made.limit.velocity, made.dynamics.damping, made.dynamics.friction)
        assert min(map(float, resistance)) > 0


def test_every_part_is_its_own_visual(robot, cabinet):
    for link in cabinet.links:
        assert [v.name for v in robot.link_map[link.id].visuals] == [v.name for v in link.visuals]


def test_mesh_names_are_relative_and_there(folder):
    names = [m.get("filename") for m in ET.parse(folder / "model.urdf").iter("mesh")]

    assert names
    assert all(name.startswith("meshes/") and (folder / name).is_file() for name in names)


def test_mass_reads_back(robot, cabinet):
    for link in cabinet.links:
        mass, made = mass_of_link(link), robot.link_map[link.id].inertial
        assert made.mass == pytest.approx(mass.mass)
        assert np.allclose(made.inertia, mass.inertia, atol=1e-9)


def test_the_drawer_is_open_on_top(robot):
    boxes = [c.geometry.box.size for c in robot.link_map["drawer_1"].collisions]

    assert len(boxes) == 5
    assert sum(np.prod(size) for size in boxes) < 0.2 * 0.54 * 0.34 * 0.2


def test_hinges_carry_no_collision_shape(robot):
    assert len(robot.link_map["door_1"].collisions) == 2  # the door and its handle


def test_a_closed_cabinet_stays_closed(simulation):
    model, data = simulation

    run(model, data, 1.0)

    assert np.allclose(data.qpos, 0, atol=1e-4)
    assert data.ncon == 0


def test_a_door_pushed_open_reaches_its_limit_and_stops(simulation):
    model, data = simulation
    door = model.joint("door_1_hinge")
    data.qfrc_applied[door.dofadr] = 0.5 * model.jnt_actfrcrange[door.id, 1]

    run(model, data, 3.0)

    assert data.qpos[door.qposadr] == pytest.approx(door.range[1], abs=0.05)
    assert abs(data.qvel[door.dofadr]) < 1e-2


def test_a_door_let_go_does_not_fly(simulation):
    model, data = simulation
    door = model.joint("door_1_hinge")
    data.qvel[door.dofadr] = 1.0

    run(model, data, 1.0)

    assert 0.05 < data.qpos[door.qposadr] < 0.3
    assert abs(data.qvel[door.dofadr]) < 1e-3


def test_a_drawer_slides_out_past_its_open_door(simulation):
    model, data = simulation
    data.qpos[model.joint("door_1_hinge").qposadr] = 1.75
    drawer = model.joint("drawer_1_rail")
    data.qfrc_applied[drawer.dofadr] = 20.0

    run(model, data, 2.0)

    assert data.qpos[drawer.qposadr] == pytest.approx(0.28, abs=0.01)


def test_a_closed_door_stops_the_drawer_behind_it(simulation):
    model, data = simulation
    drawer = model.joint("drawer_1_rail")
    data.qfrc_applied[drawer.dofadr] = 5.0

    run(model, data, 0.5)

    assert data.qpos[drawer.qposadr] < 0.06


def hung(axis: Axis, moving: Link, kind: JointType = JointType.REVOLUTE) -> ArticulatedObject:
    joint = Joint("lid_hinge", kind, "body", moving.id, axis, JointLimits(0.0, 1.5))
    return ArticulatedObject("made", "body", (Link("body", ()), moving), (joint,))


@pytest.mark.parametrize("direction", [vec3(1.0, 0.0, 0.0), vec3(-1.0, 0.0, 0.0)])
def test_a_flap_hung_below_or_above_stays_closed_at_rest(cabinet, direction, tmp_path):
    front = cabinet.link("door_1")
    height = 0.0 if direction[0] > 0 else 0.8  # opens to the front: hinged at the bottom, or at the top
    files = export_urdf(hung(Axis(vec3(0.0, -0.2, height), direction), front))
    write_files(files, tmp_path / "flap")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "flap" / "model.urdf"))
    data = mujoco.MjData(model)

    run(model, data, 1.0)

    assert abs(data.qpos[0]) < 0.01


def test_a_fixed_joint_has_no_limits(cabinet):
    axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    text = export_urdf(hung(axis, cabinet.link("door_1"), JointType.FIXED))["model.urdf"].decode()

    assert 'type="fixed"' in text
    assert "<limit" not in text


def test_names_that_xml_cannot_hold_are_mended(cabinet):
    odd = ArticulatedObject("a<&>\x01ü", "body", (cabinet.link("body"),))

    assert ET.fromstring(export_urdf(odd)["model.urdf"]).get("name") == "a<&>_ü"


def test_the_same_object_gives_the_same_bytes(cabinet):
    assert export_urdf(cabinet) == export_urdf(make_cabinet())


def test_the_mujoco_element_can_be_left_out(cabinet):
    assert b"mujoco" not in export_urdf(cabinet, UrdfConfig(mujoco=False))["model.urdf"]
