"""Lids and flaps in a simulator: released they stay where they are, and a pull at the front edge opens them."""

from pathlib import Path

import numpy as np
import pytest
from lids_and_flaps import chest, dropped, lifted, light_chest

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.export.files import write_files
from grafu.export.formats import export

mujoco = pytest.importorskip("mujoco")

DRIFT = np.radians(5.0)
PULL = 30.0  # newtons
MADE = pytest.mark.parametrize("make", [chest, light_chest, lifted, dropped])


def simulated(made: ArticulatedObject, folder: Path):
    write_files(export(made, ["mjcf"]), folder / "out")
    model = mujoco.MjModel.from_xml_path(str(folder / "out" / "model.xml"))
    return model, mujoco.MjData(model)


@MADE
@pytest.mark.parametrize("ratio", [0.3, 0.6, 0.85])
def test_released_it_stays_where_it_is(make, ratio, tmp_path):
    model, data = simulated(make(), tmp_path)
    data.qpos[0] = start = ratio * model.jnt_range[0, 1]

    mujoco.mj_step(model, data, round(2.0 / model.opt.timestep))

    assert abs(data.qpos[0] - start) < DRIFT


@MADE
def test_a_pull_at_the_front_edge_opens_it_and_shuts_it(make, tmp_path):
    made = make()
    model, data = simulated(made, tmp_path)
    joint = made.joints[0]
    arm = float(joint.axis.distances_to(made.link("lid").mesh.vertices).max())

    data.qfrc_applied[0] = PULL * arm
    mujoco.mj_step(model, data, round(4.0 / model.opt.timestep))
    assert data.qpos[0] > 0.95 * joint.limits.upper

    data.qfrc_applied[0] = -PULL * arm
    mujoco.mj_step(model, data, round(4.0 / model.opt.timestep))
    assert data.qpos[0] < 0.02 * joint.limits.upper


@pytest.mark.parametrize("make", [chest, lifted, dropped])
def test_a_heavy_one_is_carried_by_a_spring_that_weighs_nothing(make, tmp_path):
    made = make()
    model, data = simulated(made, tmp_path)
    mujoco.mj_forward(model, data)

    assert [model.tendon(k).name for k in range(model.ntendon)] == ["lid_counterbalance"]
    assert not np.any(model.body_gravcomp)
    assert float(data.qfrc_passive[0]) == pytest.approx(float(data.qfrc_bias[0]), abs=1e-6)


def test_a_light_one_needs_no_spring(tmp_path):
    model, _ = simulated(light_chest(), tmp_path)

    assert model.ntendon == 0
