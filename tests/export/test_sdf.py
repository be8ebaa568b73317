"""SDF for Gazebo: what is written comes back through our own reader, and in libsdformat where it is installed."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import lids_and_flaps
import numpy as np
import pytest
from small_cabinet import make_cabinet

from grafu.articulation.articulated_object import ArticulatedObject, Link, VisualRole
from grafu.articulation.grasp_search import GraspHint, with_grasps
from grafu.articulation.physics import physics_of
from grafu.asset.load import load_asset
from grafu.export.files import write_files
from grafu.export.sdf import SdfConfig, export_sdf
from grafu.geometry.box import Box
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.transform import euler_matrix


@pytest.fixture(scope="module")
def cabinet():
    return with_grasps(make_cabinet(), {"door_1": GraspHint("handle")})


@pytest.fixture(scope="module")
def folder(cabinet, tmp_path_factory):
    out = tmp_path_factory.mktemp("sdf") / "cabinet"
    write_files(export_sdf(cabinet), out)
    return out


@pytest.fixture(scope="module")
def model(folder) -> ET.Element:
    return ET.parse(folder / "model.sdf").getroot().find("model")


def floats(element: ET.Element, tag: str) -> list[float]:
    return [float(word) for word in element.findtext(tag).split()]


def test_our_reader_reads_the_same_parts_and_joints(cabinet, folder):
    asset = load_asset(folder / "model.sdf")

    assert asset.kind == "sdf"
    every = (visual for link in cabinet.links for visual in link.visuals)
    drawn = {visual.name: visual for visual in every if visual.role is not VisualRole.HARDWARE}
    assert {part.id for part in asset.parts} == set(drawn)
    shift = asset.frame.input_to_output
    for part in asset.parts:
        own = drawn[part.id].mesh
        if part.id == "door_1":  # hardware is read as part of what it is fixed to
            own = merge_meshes([own, cabinet.link("door_1").hardware_mesh])
        box = Box.around(own.transformed(np.array(shift)).vertices)
        assert np.allclose([part.box.low, part.box.high], [box.low, box.high], atol=1e-5)
    assert {s.material.name for p in asset.parts for s in p.surfaces} >= {"oak", "glass", "steel"}
    stated = {joint.part: joint for joint in asset.stated_joints}
    for joint in cabinet.joints:
        assert np.allclose(stated[joint.child].axis.direction, joint.axis.direction, atol=1e-6)
        assert stated[joint.child].upper == pytest.approx(joint.limits.upper)


def test_numbers_are_those_of_the_physics(cabinet, model):
    physics = physics_of(cabinet)
    for link in model.findall("link"):
        name, shapes = link.get("name"), link.findall("collision")
        assert float(link.findtext("inertial/mass")) == pytest.approx(physics.masses[name].mass)
        assert np.allclose(floats(link, "pose")[:3], physics.origins[name], atol=1e-9)
        assert len(shapes) == len(physics.shapes[name])
    for joint in cabinet.joints:
        axis = next(j for j in model.findall("joint") if j.get("name") == joint.id).find("axis")
        assert float(axis.findtext("dynamics/damping")) == pytest.approx(physics.dynamics[joint.id].damping)
        assert float(axis.findtext("dynamics/friction")) == pytest.approx(physics.dynamics[joint.id].friction)
        assert float(axis.findtext("limit/effort")) == pytest.approx(physics.dynamics[joint.id].effort)


def test_grasps_are_frames(cabinet, model):
    (frame,) = model.findall("frame")
    (grasp,) = cabinet.grasps
    origin = physics_of(cabinet).origins["door_1"]

    assert (frame.get("name"), frame.get("attached_to")) == ("handle_1_grasp", "door_1")
    pose = floats(frame, "pose")
    assert np.allclose(origin + pose[:3], grasp.position)
    assert np.allclose(euler_matrix(pose[3:])[:3, :3], grasp.rotation, atol=1e-6)


def test_every_file_that_is_named_is_there(cabinet):
    files = export_sdf(cabinet)
    root = ET.fromstring(files["model.sdf"])

    assert {uri.text for uri in root.iter("uri")} <= set(files.names)


def test_a_heavy_lid_has_its_spring():
    made = lids_and_flaps.chest()
    (joint,) = made.joints
    spring = physics_of(made).dynamics[joint.id].counterbalance.spring
    dynamics = ET.fromstring(export_sdf(made)["model.sdf"]).find(".//axis/dynamics")

    assert float(dynamics.findtext("spring_stiffness")) == pytest.approx(spring.stiffness)
    assert float(dynamics.findtext("spring_reference")) == pytest.approx(spring.target)
    assert float(dynamics.findtext("friction")) == pytest.approx(spring.friction)


def test_joints_that_follow_others_need_the_newer_version(cabinet):
    leader, follower = cabinet.joints
    coupled = replace(cabinet, joints=(leader, follower.following(leader, multiplier=0.1)))
    root, plain = (ET.fromstring(export_sdf(made)["model.sdf"]) for made in (coupled, cabinet))

    assert (root.get("version"), plain.get("version")) == ("1.11", "1.9")
    mimic = root.find(".//mimic")
    assert mimic.get("joint") == leader.id
    assert float(mimic.findtext("multiplier")) == pytest.approx(0.1)


def test_the_root_is_held_to_the_world_unless_it_stands_free(cabinet):
    fixed, free = (ET.fromstring(export_sdf(cabinet, SdfConfig(fixed=f))["model.sdf"]) for f in (True, False))

    assert fixed.find("model/joint[@name='root_fixed']/parent").text == "world"
    assert free.find("model/joint[@name='root_fixed']") is None


@pytest.mark.parametrize("name", ["world", "__model__", "a::b", "root_fixed"])
def test_names_that_sdf_keeps_are_changed(cabinet, name):
    links = tuple(Link(name, link.visuals) if link.id == "body" else link for link in cabinet.links)
    joints = tuple(replace(joint, parent=name) for joint in cabinet.joints)
    made = ArticulatedObject("__o__", name, links, joints)

    model = ET.fromstring(export_sdf(made)["model.sdf"]).find("model")

    names = [e.get("name") for tag in ("link", "joint", "frame") for e in model.findall(tag)]
    assert len(set(names)) == len(names)
    assert name not in [link.get("name") for link in model.findall("link")]
    assert model.get("name") != "__o__"


def test_libsdformat_loads_it(folder):
    sdformat = next(
        (pytest.importorskip(name) for name in ("sdformat15", "sdformat14", "sdformat13") if _has(name)), None
    )
    if sdformat is None:
        pytest.skip("libsdformat's Python module is not installed")
    root = sdformat.Root()
    root.load(str(folder / "model.sdf"))

    assert root.model().joint_count() == 3


def _has(name: str) -> bool:
    from importlib.util import find_spec

    return find_spec(name) is not None
