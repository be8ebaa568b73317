"""What holds a piece, in each format: nothing, the world, or a wall."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import mujoco
import numpy as np
import pytest
from mjcf_reading import compiled

from grafu.articulation.base import BaseKind
from grafu.asset.load import load_asset
from grafu.export.files import write_files
from grafu.export.mjcf import MjcfConfig, export_mjcf
from grafu.export.urdf import export_urdf


def test_a_free_piece_has_a_free_joint_before_all_others_and_stands_at_zero(cabinet, tmp_path):
    config = MjcfConfig(actuators=True)
    fixed = compiled(export_mjcf(cabinet, config), tmp_path / "fixed")
    free = compiled(export_mjcf(replace(cabinet, base=BaseKind.FREE), config), tmp_path / "free")

    assert (free.nq, free.nv) == (fixed.nq + 7, fixed.nv + 6)
    assert free.joint("root_free").type == mujoco.mjtJoint.mjJNT_FREE
    for name in ("closed", "open"):
        assert np.allclose(free.key(name).qpos[:7], [0, 0, 0, 1, 0, 0, 0])
        assert np.allclose(free.key(name).qpos[7:], fixed.key(name).qpos)


def test_a_free_piece_falls_and_a_fixed_one_does_not(cabinet, tmp_path):
    heights = {}
    for base in BaseKind:
        model = compiled(export_mjcf(replace(cabinet, base=base)), tmp_path / base)
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data, 100)
        heights[base] = float(data.body(cabinet.root).xpos[2])
    assert heights[BaseKind.FREE] < -0.1
    assert heights[BaseKind.FIXED] == heights[BaseKind.WALL] == 0.0


@pytest.mark.parametrize(
    ("base", "has_world"), [(None, False), (BaseKind.FREE, False), (BaseKind.FIXED, True), (BaseKind.WALL, True)]
)
def test_a_urdf_has_a_world_only_where_it_is_stated(cabinet, tmp_path, base, has_world):
    files = export_urdf(replace(cabinet, base=base))
    robot = ET.fromstring(files["model.urdf"])
    fixed = [j for j in robot.findall("joint") if j.find("parent").get("link") == "world"]

    assert [link.get("name") for link in robot.findall("link")].count("world") == has_world
    assert [joint.find("child").get("link") for joint in fixed] == [cabinet.root] * has_world
    assert all(joint.get("type") == "fixed" for joint in fixed)

    write_files(files, tmp_path / "out")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "out" / "model.urdf"))
    assert model.njnt == len(cabinet.moving_joints)
    read = load_asset(tmp_path / "out" / "model.urdf")
    assert len(read.stated_joints) == len(cabinet.moving_joints)


def test_a_part_called_world_stays_what_it_is(cabinet):
    links = tuple(replace(k, id="world") if k.id == cabinet.root else k for k in cabinet.links)
    joints = tuple(replace(j, parent="world") if j.parent == cabinet.root else j for j in cabinet.joints)
    named = replace(cabinet, root="world", links=links, joints=joints, base=BaseKind.FIXED)
    robot = ET.fromstring(export_urdf(named)["model.urdf"])

    names = [link.get("name") for link in robot.findall("link")]
    assert len(names) == len(set(names)) == len(cabinet.links) + 1
    assert [j.find("parent").get("link") for j in robot.findall("joint") if j.get("type") == "fixed"] == ["world_2"]
