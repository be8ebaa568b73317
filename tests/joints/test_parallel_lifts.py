"""Flaps of wall units that arms lift upright, as the user states them and as a name shows them, and their exports."""

import json
import xml.etree.ElementTree as ET
from dataclasses import replace
from math import degrees

import numpy as np
import pytest

import grafu
from fold_judge import cuts, cutting_over_sweep, opened
from grafu.articulation.kinematics import link_poses
from grafu.articulation.physics import physics_of
from grafu.asset.edit import yawed
from grafu.asset.part import Asset, PartSource
from grafu.geometry.intersection import MeshCollider
from grafu.joints.lift_arm_config import LiftArmConfig
from grafu.joints.motion_choice import MotionChoice, Moves, Side
from grafu.joints.parallel_lifts import NO_ARMS
from grafu.pipeline.motion_choices import motions_of
from grafu.synth.cabinets.wall_units import WallUnit, make_wall_unit
from small_scenes import box

OVERLAY = WallUnit()
INSET = WallUnit(mount="inset", gap=0.002)


def lifted(asset: Asset, motions: dict[str, str] | None = None, compartments: bool = True) -> grafu.Result:
    return grafu.functionalize(asset, motion="rule", motions=motions, compartments=compartments)


@pytest.fixture(scope="module")
def result() -> grafu.Result:
    return lifted(make_wall_unit(OVERLAY), {"door": "lift-parallel"})


def require_lifted(result: grafu.Result, rise: float) -> None:
    """Raises AssertionError unless the flap rises upright by so much of its height, and nothing collides."""
    made, height = result.object, float(result.asset.part("door").box.size[2])
    lead, follow = made.joint_of["door_arms"], made.joint_of["door"]
    shown = frozenset(v.name for link in made.links for v in link.visuals if v.swing is not None)

    assert (lead.parent, follow.parent) == ("body", "door_arms")
    assert (follow.coupling.leader, follow.coupling.multiplier) == (lead.id, 1.0)
    np.testing.assert_allclose(lead.axis.direction, -follow.axis.direction, atol=1e-9)
    for ratio in np.linspace(0.0, 1.0, 5):
        T = link_poses(made, opened(made, float(ratio)))["door"]
        np.testing.assert_allclose(T[:3, :3], np.eye(3), atol=1e-9)
        assert cuts(made, opened(made, float(ratio)), shown) == set()
    assert T[2, 3] >= rise * height
    assert cutting_over_sweep(made) - cuts(made, opened(made, 1.0)) == set()


def test_a_flap_rises_upright_on_arms(result):
    require_lifted(result, 0.8)


@pytest.mark.parametrize(
    ("asset", "rise"),
    [
        (make_wall_unit(INSET), 0.8),
        (make_wall_unit(replace(OVERLAY, shelves=1)), 0.4),
        (yawed(make_wall_unit(OVERLAY), 0.4), 0.8),
    ],
    ids=["inset", "over a shelf", "turned"],
)
def test_arms_find_room(asset, rise):
    made = lifted(asset, {"door": "lift-parallel"}).object

    assert link_poses(made, opened(made, 1.0))["door"][2, 3] >= rise * float(asset.part("door").box.size[2])


def test_arms_rest_on_the_walls_and_the_flap_and_each_end_moves_as_one(result):
    made = result.object
    body, door = made.link("body"), made.link("door")
    for link, own in ((body, "_static"), (door, "_dynamic")):
        plates = [v for v in link.visuals if v.name.endswith(own) and "_lift_" in v.name]
        parts = [MeshCollider(v.mesh) for v in link.visuals if v not in plates]
        assert len(plates) == 2
        assert all(any(MeshCollider(v.mesh).is_within(1e-3, other) for other in parts) for v in plates)
    swinging = [v for v in body.visuals if v.swing is not None]
    upper = made.joint_of["door_arms"].limits.upper
    assert [v.swing.moving for v in swinging] == ["door_arms"] * 2
    assert all(v.swing.angles[-1] >= upper for v in swinging)
    assert not any(v.name.startswith("hinge_door_0") for link in made.links for v in link.visuals)


def test_the_report_counts_one_door_and_its_page_is_drawn(result, tmp_path):
    result.save(tmp_path / "unit", formats="glb")
    report = json.loads((tmp_path / "unit" / "report.json").read_text())
    records = {record["part"]: record for record in report["joints"]}

    assert report["verdict"]["sentence"].startswith("Everything works: 1 door;")
    assert records["door"]["follows"]["leader"] == records["door_arms"]["id"]
    assert not records["door_arms"]["small"]
    assert "lift arms" in (tmp_path / "unit" / "report.html").read_text()


def test_a_simulator_gets_both_joints_and_holds_the_flap_open(result, tmp_path):
    mujoco = pytest.importorskip("mujoco")
    result.save(tmp_path / "unit", formats="urdf,mjcf", page=False)
    urdf = ET.parse(tmp_path / "unit" / "model.urdf")
    mimic = urdf.find("joint[@name='door_joint']/mimic")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "unit" / "model.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("open").id)
    start = data.qpos.copy()
    mujoco.mj_step(model, data, 1500)

    assert (mimic.get("joint"), float(mimic.get("multiplier"))) == ("door_arms_joint", 1.0)
    np.testing.assert_allclose(data.qpos, start, atol=0.02)


def test_the_spring_holds_the_whole_weight_at_the_ends_of_the_arms(result):
    made, physics = result.object, physics_of(result.object)
    spring = physics.dynamics["door_arms_joint"].counterbalance
    weight = physics.masses["door"].mass

    assert spring is not None
    assert made.joint_of["door"].axis.distance_to(spring.center) < 0.01
    assert weight > 1.0
    assert physics.dynamics["door_joint"].counterbalance is None


def test_a_name_shows_a_parallel_lift():
    asset = make_wall_unit(OVERLAY)
    named = (replace(p, source=PartSource("flap_parallel_lift")) if p.id == "door" else p for p in asset.parts)

    assert "door_arms" in lifted(replace(asset, parts=tuple(named))).object.joint_of


def test_without_room_the_flap_turns_about_its_upper_edge():
    asset = make_wall_unit(OVERLAY)
    filler = box("filler", (-0.43, -0.15, 0.02), (0.43, 0.16, 0.38))
    made = lifted(replace(asset, parts=(*asset.parts, filler)), {"door": "lift-parallel"}, compartments=False)

    assert NO_ARMS in made.joint("door").notes
    assert made.object.joint_of["door"].parent == "body"


def test_it_is_read_back_as_what_was_stated(result):
    assert motions_of(result.object) == {"door": MotionChoice(Moves.LIFTS, Side.TOP)}
    assert degrees(result.joint("door").upper) > 90


def test_what_is_no_lift_is_refused():
    with pytest.raises(ValueError, match="must be top"):
        MotionChoice(Moves.LIFTS, Side.BOTTOM)
    with pytest.raises(ValueError, match="must not be empty"):
        LiftArmConfig(angles=())
    with pytest.raises(ValueError, match="must be 1 or 2"):
        WallUnit(leaves=3)
