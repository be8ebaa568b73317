"""Whole furniture, made and real, through the pipeline into a simulator: closed it rests, pushed it opens fully."""

import os
from pathlib import Path

import mujoco
import numpy as np
import pytest
from gltf_validation import issues_of

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.collision_shapes import corners_of
from grafu.articulation.floor_clearance import FloorConfig
from grafu.articulation.kinematics import link_poses
from grafu.articulation.physics import physics_of
from grafu.articulation.sweep import opening_stages, rest_to_full
from grafu.asset.load import load_asset
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.pipeline.functionalize import functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.templates.gallery import builtin_gallery

_ROOT = Path(__file__).parents[2]
_MODELS = Path(os.environ.get("GRAFU_MODELS", _ROOT.parent / "shared" / "models")) / "pnm"
INPUTS = [
    _ROOT / "samples" / "kitchen_base.glb",
    _ROOT / "samples" / "dresser.glb",
    _MODELS / "46408",
    _MODELS / "44781",
]


@pytest.fixture(scope="module", params=INPUTS, ids=lambda path: path.stem)
def made(request) -> ArticulatedObject:
    if not request.param.exists():
        pytest.skip("real models are not here")
    return functionalize(load_asset(request.param), MotionSource.AUTO, builtin_gallery()).object


def run(model: mujoco.MjModel, data: mujoco.MjData, seconds: float) -> None:
    mujoco.mj_step(model, data, round(seconds / model.opt.timestep))


def test_what_moves_keeps_off_the_floor_and_no_hardware_reaches_below_it(made):
    physics, gap = physics_of(made), FloorConfig().gap
    floor = min(float(corners_of(shape)[:, 2].min()) for shape in physics.shapes[made.root])
    assert floor < 0.01
    for joint in made.free_joints:
        for values in rest_to_full(made, joint.id, 40, 2.0):
            poses = link_poses(made, values)
            for link in (other.child for other in made.moving_joints):
                T = poses[link]
                lowest = [float((corners_of(s) @ T[2, :3]).min()) + float(T[2, 3]) for s in physics.shapes[link]]
                assert min(lowest, default=1.0) >= floor + gap - 1e-4  # a flap may be lower between sampled poses
    assert all(len(v) == 0 or float(v[:, 2].min()) >= -1e-6 for v in (k.hardware_mesh.vertices for k in made.links))


@pytest.mark.parametrize(("kind", "file"), [("urdf", "model.urdf"), ("mjcf", "model.xml")])
def test_it_rests_closed_and_opens_fully(made, kind, file, tmp_path):
    write_files(export(made, [kind]), tmp_path / "out")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "out" / file))
    data = mujoco.MjData(model)

    run(model, data, 1.0)
    assert np.allclose(data.qpos, 0, atol=2e-3)

    for stage in opening_stages(made):
        for joint in map(model.joint, stage):
            data.qfrc_applied[joint.dofadr] = 0.5 * model.jnt_actfrcrange[joint.id, 1]
        run(model, data, 4.0)
    assert made.moving_joints
    assert np.all(data.qpos >= 0.95 * model.jnt_range[:, 1])


def test_the_open_pose_stays_as_it_is_but_for_gravity(made, tmp_path):
    write_files(export(made, ["mjcf"]), tmp_path / "out")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "out" / "model.xml"))
    model.opt.gravity[:] = 0.0  # what no spring and no friction holds would fall shut
    model.tendon_stiffness[:] = 0.0  # springs balance gravity
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("open").id)
    opened = data.qpos.copy()

    run(model, data, 1.0)

    assert np.all(opened > 0)
    assert np.allclose(data.qpos, opened, atol=2e-3)


def test_the_official_validator_finds_no_error(made, tmp_path):
    issues = issues_of(export(made, ["glb"])["model.glb"], tmp_path)

    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]
