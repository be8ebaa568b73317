"""Every format states the same grasp frames, and they move with their links."""

import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pytest
import yourdfpy
from mjcf_reading import compiled, posed
from small_cabinet import make_cabinet

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.articulation.kinematics import link_poses
from grafu.asset.load import load_asset
from grafu.export.files import write_files
from grafu.export.glb import export_glb
from grafu.export.glb_object import read_glb_object
from grafu.export.mjcf import export_mjcf
from grafu.export.urdf import UrdfConfig, export_urdf

POSE = {"door_1_hinge": 1.1, "drawer_1_rail": 0.2}


@pytest.fixture(scope="module")
def held() -> ArticulatedObject:
    hints = {
        "door_1": GraspHint("handle"),
        "drawer_1": GraspHint("edge", center=np.array([0.0, -0.18, 0.3]), length=0.3),
    }
    made = with_grasps(make_cabinet(), hints)
    assert [grasp.name for grasp in made.grasps] == ["handle_1_grasp", "drawer_1_grasp"]
    return made


def expected(made: ArticulatedObject, pose: dict[str, float]) -> dict[str, np.ndarray]:
    T = link_poses(made, pose)
    return {grasp.name: T[grasp.link] @ grasp.T_object_grasp for grasp in made.grasps}


@pytest.mark.parametrize("pose", [dict.fromkeys(POSE, 0.0), POSE])
def test_sites_stand_where_the_kinematics_say(held, pose, tmp_path):
    data = posed(model := compiled(export_mjcf(held), tmp_path / "out"), pose)

    frames = expected(held, pose)
    frames |= {"door_1_handle": frames["handle_1_grasp"], "handle": frames["handle_1_grasp"]}
    for name, T in (frames | {"drawer_1_handle": frames["drawer_1_grasp"]}).items():
        site = model.site(name).id
        assert np.allclose(data.site_xpos[site], T[:3, 3], atol=1e-6)
        assert np.allclose(data.site_xmat[site].reshape(3, 3), T[:3, :3], atol=1e-6)


@pytest.mark.parametrize("pose", [dict.fromkeys(POSE, 0.0), POSE])
def test_frames_of_the_urdf_stand_where_the_kinematics_say(held, pose, tmp_path):
    write_files(export_urdf(held, UrdfConfig(grasps=True)), tmp_path / "out")
    robot = yourdfpy.URDF.load(str(tmp_path / "out" / "model.urdf"))
    robot.update_cfg(pose)

    for name, T in expected(held, pose).items():
        assert np.allclose(robot.get_transform(name, "body"), T, atol=1e-6)


def test_frames_of_the_urdf_change_no_mass_and_are_written_on_request(held, tmp_path):
    bare = ET.fromstring(export_urdf(held)["model.urdf"])
    framed = ET.fromstring(export_urdf(held, UrdfConfig(grasps=True))["model.urdf"])
    masses = [sum(float(m.get("value")) for m in tree.iter("mass")) for tree in (bare, framed)]

    assert len(bare.findall("link")) == 3
    assert len(framed.findall("link")) == 5
    assert masses[1] == pytest.approx(masses[0], abs=1e-5)
    write_files(export_urdf(held, UrdfConfig(grasps=True)), tmp_path / "out")
    model = mujoco.MjModel.from_xml_path(str(tmp_path / "out" / "model.urdf"))
    assert model.nq == 2


def test_our_reader_takes_frames_for_no_parts(held, tmp_path):
    write_files(export_urdf(held, UrdfConfig(grasps=True)), tmp_path / "out")

    asset = load_asset(tmp_path / "out" / "model.urdf")

    assert not [part.id for part in asset.parts if part.id.endswith("_grasp")]
    assert {part.id for part in asset.parts} >= {"door_1", "drawer_1", "handle_1"}


def test_a_glb_gives_the_grasps_back(held, tmp_path):
    write_files(export_glb(held), tmp_path / "out")

    back = read_glb_object(tmp_path / "out" / "model.glb").grasps

    for one, other in zip(back, held.grasps, strict=True):
        assert (one.name, one.link, one.part, one.kind) == (other.name, other.link, other.part, other.kind)
        assert np.allclose(one.T_object_grasp, other.T_object_grasp)
        assert (one.width, one.depth) == (other.width, other.depth)


def test_names_that_are_taken_get_another(held):
    links = tuple(
        type(link)("handle_1_grasp" if link.id == "drawer_1" else link.id, link.visuals) for link in held.links
    )
    joints = tuple(
        type(j)(
            j.id, j.type, j.parent, "handle_1_grasp" if j.child == "drawer_1" else j.child, j.axis, j.limits, j.after
        )
        for j in held.joints
    )
    made = ArticulatedObject(held.name, held.root, links, joints, held.grasps[:1])

    names = [
        link.get("name")
        for link in ET.fromstring(export_urdf(made, UrdfConfig(grasps=True))["model.urdf"]).findall("link")
    ]

    assert names == ["body", "door_1", "handle_1_grasp", "handle_1_grasp_2"]
