"""Catches in simulation, and in formats that cannot hold them: what is near closed closes, what is far open stays."""

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from glb_reader import Glb
from mjcf_reading import compiled, run

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.base import BaseKind
from grafu.articulation.catch import Catch
from grafu.articulation.catch_kind import CatchKind
from grafu.articulation.physics import physics_of
from grafu.asset.load import load_asset
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.export.mjcf import MjcfConfig, export_mjcf
from grafu.joints.catches import with_catches

NONE, DETENT, SELF_CLOSING = CatchKind
DRAWER, DOOR = "drawer_1_rail", "door_1_hinge"
WIDTH = 0.6  # metres from the hinge of the door to its far edge


def model_of(cabinet: ArticulatedObject, kind: CatchKind, folder: Path, **config) -> mujoco.MjModel:
    return compiled(export_mjcf(with_catches(cabinet, kind), MjcfConfig(**config)), folder / "out")


def left_at(model: mujoco.MjModel, joint: str, value: float, push: float = 0.0, seconds: float = 3.0) -> float:
    """Returns where a joint is that was left at a value, with a force or torque on it; the door does not stand in
    the drawer's way."""
    data = mujoco.MjData(model)
    if joint == DRAWER:
        data.joint(DOOR).qpos[:] = 1.7
    data.joint(joint).qpos[:] = value
    data.joint(joint).qfrc_applied[:] = push
    run(model, data, seconds)
    return float(data.joint(joint).qpos[0])


@pytest.mark.parametrize(
    ("kind", "joint", "start", "closes"),
    [
        (SELF_CLOSING, DRAWER, 0.02, True),
        (SELF_CLOSING, DRAWER, 0.2, False),
        (SELF_CLOSING, DOOR, 0.05 / WIDTH, True),
        (SELF_CLOSING, DOOR, 0.2 / WIDTH, False),
        (DETENT, DRAWER, 0.003, True),
        (DETENT, DRAWER, 0.02, False),
        (DETENT, DOOR, 0.002 / WIDTH, True),
        (DETENT, DOOR, 0.05 / WIDTH, False),
        (NONE, DRAWER, 0.02, False),
        (NONE, DOOR, 0.05 / WIDTH, False),
    ],
)
def test_what_is_near_closed_closes_and_what_is_further_open_stays(cabinet, tmp_path, kind, joint, start, closes):
    end = left_at(model_of(cabinet, kind, tmp_path), joint, start)

    assert end == pytest.approx(0.0 if closes else start, abs=1e-3)


@pytest.mark.parametrize(("joint", "arm"), [(DRAWER, 1.0), (DOOR, WIDTH)])
@pytest.mark.parametrize("kind", [DETENT, SELF_CLOSING])
def test_a_push_of_8_newtons_opens_nothing_and_a_pull_of_20_opens_all(cabinet, tmp_path, kind, joint, arm):
    model = model_of(cabinet, kind, tmp_path)
    upper = float(model.joint(joint).range[1])

    assert left_at(model, joint, 0.0, 3.0 * arm) < 1e-3
    assert left_at(model, joint, 0.0, 8.0 * arm) < 1e-3
    assert left_at(model, joint, 0.0, 20.0 * arm) > 0.99 * upper
    assert left_at(model_of(cabinet, NONE, tmp_path / "without"), joint, 0.0, 8.0 * arm) > 0.99 * upper


def test_on_a_tilted_floor_a_drawer_stays_closed_that_would_roll_open(cabinet, tmp_path):
    for kind, opens in ((NONE, True), (DETENT, False)):
        model = model_of(cabinet, kind, tmp_path / kind)
        model.opt.gravity[:] = 9.81 * np.array([0.0, -np.sin(0.1), -np.cos(0.1)])  # 6 degrees forward
        assert (left_at(model, DRAWER, 0.0) > 0.1) is opens


def test_the_force_is_the_law_of_the_value(cabinet, tmp_path):
    caught = with_catches(cabinet, SELF_CLOSING)
    model, law = model_of(cabinet, SELF_CLOSING, tmp_path), physics_of(caught).dynamics[DRAWER].catch
    data, place = mujoco.MjData(model), model.actuator(f"{DRAWER}_catch").id
    values = np.array([0.0, 0.01, 0.029, 0.033, 0.039, 0.041, 0.2])
    found = []
    for value in values:
        data.joint(DRAWER).qpos[:] = value
        data.ctrl[:] = 5.0  # no control input changes it
        mujoco.mj_forward(model, data)
        found.append(data.actuator_force[place])

    assert law is not None
    assert found == pytest.approx(law.effort_at(values), rel=1e-5, abs=1e-5)


def test_it_acts_between_two_bodies_so_that_a_free_piece_stays_where_it_is(cabinet, tmp_path):
    model = model_of(replace(cabinet, base=BaseKind.FREE), SELF_CLOSING, tmp_path)
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    data.joint(DRAWER).qpos[:] = 0.02
    run(model, data, 0.1)
    mujoco.mj_subtreeVel(model, data)

    assert float(data.joint(DRAWER).qvel[0]) < -0.05
    alone = 10.0 * 0.1 / model.body_subtreemass[0]  # what a force from outside would have given the whole
    assert np.linalg.norm(data.subtree_linvel[0]) < 0.05 * alone  # all but what the armature of joints takes


def test_servos_open_against_it_and_keyframes_have_an_input_for_each(cabinet, tmp_path):
    model = model_of(cabinet, SELF_CLOSING, tmp_path, actuators=True)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("open").id)
    data.qpos[:] = 0.0
    run(model, data, 6.0)

    assert model.nu == 4
    assert data.qpos == pytest.approx(model.key("open").qpos, rel=0.05)


def test_without_one_no_file_has_changed_and_with_one_the_file_is_read_all_the_same(cabinet, tmp_path):
    formats = ["glb", "urdf", "mjcf", "sdf"]
    plain, same = export(cabinet, formats), export(with_catches(cabinet, NONE), formats)
    caught = export(with_catches(cabinet, DETENT), formats)

    assert dict(same.contents) == dict(plain.contents)
    assert not any(b"catch" in plain[name] for name in ("model.glb", "model.urdf", "model.xml", "model.sdf"))
    assert plain["model.xml"] != caught["model.xml"]
    write_files(caught, tmp_path / "caught")
    assert len(load_asset(tmp_path / "caught" / "model.xml").stated_joints) == 2


def test_a_format_without_catches_changes_only_the_greatest_effort(cabinet):
    plain, caught = (export(with_catches(cabinet, kind), ["urdf", "sdf"]) for kind in (NONE, DETENT))

    for name in ("model.urdf", "model.sdf"):
        lines = zip(plain[name].splitlines(), caught[name].splitlines(), strict=True)
        assert {b"effort" in after for before, after in lines if before != after} == {True}


def test_a_glb_states_the_kind(cabinet):
    nodes = Glb.parse(export(with_catches(cabinet, SELF_CLOSING), ["glb"])["model.glb"]).tables["nodes"]
    joints = [node["extras"]["grafu"]["joint"] for node in nodes if "joint" in node.get("extras", {}).get("grafu", {})]

    assert [joint["catch"] for joint in joints] == ["self-closing"] * 2


def test_the_law_that_the_page_states_is_the_law_of_the_catch():
    page = (Path(__file__).parents[2] / "docs" / "exports.md").read_text()
    code = next(block for block in page.split("```") if "def catch_force" in block).removeprefix("python\n")
    scope: dict = {}
    exec(code, scope)
    catch = Catch(effort=9.0, reach=0.05, fade=0.01)
    values = np.linspace(0.0, 0.1, 41)

    assert [scope["catch_force"](v, catch.effort, catch.reach, catch.fade) for v in values] == pytest.approx(
        catch.effort_at(values)
    )
