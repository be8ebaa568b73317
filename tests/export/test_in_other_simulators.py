"""URDF and SDF as PyBullet and Drake load and move them, where these are installed.

The frames of grasps must be where the kinematics say, and must weigh nothing that counts.
"""

from pathlib import Path

import numpy as np
import pytest
from small_cabinet import make_cabinet

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.articulation.kinematics import link_poses
from grafu.articulation.physics import physics_of
from grafu.export.files import write_files
from grafu.export.sdf import export_sdf
from grafu.export.urdf import UrdfConfig, export_urdf

JOINTS = ("door_1_hinge", "drawer_1_rail")
POSE = dict(zip(JOINTS, (1.75, 0.28), strict=True))


@pytest.fixture(scope="module")
def cabinet() -> ArticulatedObject:
    return with_grasps(make_cabinet(), {"door_1": GraspHint("handle")})


@pytest.fixture(scope="module")
def folder(cabinet, tmp_path_factory) -> Path:
    out = tmp_path_factory.mktemp("simulators") / "cabinet"
    write_files(export_urdf(cabinet, UrdfConfig(grasps=True)).joined(export_sdf(cabinet)), out)
    return out


def grasp_when_open(cabinet: ArticulatedObject) -> np.ndarray:
    (grasp,) = cabinet.grasps
    return link_poses(cabinet, POSE)[grasp.link] @ grasp.T_object_grasp


def mass_of(cabinet: ArticulatedObject) -> float:
    return sum(mass.mass for mass in physics_of(cabinet).masses.values())


def test_pybullet_opens_it_by_force(cabinet, folder):
    pybullet = pytest.importorskip("pybullet")
    client = pybullet.connect(pybullet.DIRECT)
    try:
        body = pybullet.loadURDF(str(folder / "model.urdf"), useFixedBase=True, physicsClientId=client)
        count = pybullet.getNumJoints(body, physicsClientId=client)
        infos = [pybullet.getJointInfo(body, k, physicsClientId=client) for k in range(count)]
        number = {info[1].decode(): info[0] for info in infos}
        masses = [pybullet.getDynamicsInfo(body, k, physicsClientId=client)[0] for k in range(-1, count)]
        assert set(JOINTS) <= set(number)
        assert sum(masses[1:]) == pytest.approx(
            sum(mass.mass for link, mass in physics_of(cabinet).masses.items() if link != cabinet.root), abs=1e-4
        )
        for joint in JOINTS:  # the door first
            force = {"controlMode": pybullet.VELOCITY_CONTROL, "force": 0.0, "physicsClientId": client}
            pybullet.setJointMotorControl2(body, number[joint], **force)
        for joint in JOINTS:
            for _ in range(960):
                push = {"controlMode": pybullet.TORQUE_CONTROL, "force": 20.0, "physicsClientId": client}
                pybullet.setJointMotorControl2(body, number[joint], **push)
                pybullet.stepSimulation(physicsClientId=client)
            value = pybullet.getJointState(body, number[joint], physicsClientId=client)[0]
            assert value == pytest.approx(POSE[joint], rel=0.1)
    finally:
        pybullet.disconnect(client)


@pytest.mark.parametrize("file", ["model.urdf", "model.sdf"])
def test_drake_has_its_mass_and_poses(cabinet, folder, file):
    pytest.importorskip("pydrake")
    from pydrake.multibody.parsing import Parser
    from pydrake.multibody.plant import MultibodyPlant

    plant = MultibodyPlant(1e-3)
    Parser(plant).AddModels(str(folder / file))
    if file == "model.urdf":
        plant.WeldFrames(plant.world_frame(), plant.GetFrameByName("body"))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    for joint, value in POSE.items():
        moved = plant.GetJointByName(joint)
        (moved.set_angle if moved.type_name() == "revolute" else moved.set_translation)(context, value)

    assert plant.num_positions() == 2
    assert plant.CalcTotalMass(context) == pytest.approx(mass_of(cabinet), abs=1e-4)
    T = plant.GetFrameByName("handle_1_grasp").CalcPoseInWorld(context).GetAsMatrix4()
    assert np.allclose(T, grasp_when_open(cabinet), atol=1e-5)
