"""The page's joints without a browser: the script that moves them, run by Node."""

import json
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from made_models import made_model

import grafu.viewer
from bifold import make_bifold
from grafu.articulation.kinematics import link_poses
from grafu.articulation.swing import Swing
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.render.gallery import concealed_as_articulated
from grafu.templates.gallery import builtin_gallery
from grafu.viewer.scene_data import scene_data

NODE = shutil.which("node")
SCRIPTS = Path(grafu.viewer.__file__).parent / "templates"


@pytest.fixture(scope="module")
def run():
    """Returns what an expression gives with `joints` standing for those of the folding door."""
    if NODE is None:
        pytest.skip("no Node here")
    scene = json.dumps(scene_data(make_bifold(), made_model().report).tables)
    code = "".join((SCRIPTS / name).read_text("utf-8") for name in ("matrices.js", "joints.js"))

    def value(expression: str):
        program = f"{code}\nconst joints = new Joints({scene});\nconsole.log(JSON.stringify({expression}));"
        return json.loads(subprocess.run([NODE, "-e", program], capture_output=True, check=True, timeout=60).stdout)

    return value


def test_a_coupled_joint_follows_its_leader(run):
    assert run("(joints.set(0, 0.5), joints.values)") == pytest.approx([0.5, 1.0])


def test_dragging_the_follower_moves_the_leader(run):
    assert run("(joints.set(1, 1.0), joints.values)") == pytest.approx([0.5, 1.0])
    assert run("(joints.setFraction(1, 1.0), [joints.fraction(0), joints.fraction(1)])") == pytest.approx([1.0, 1.0])
    assert run("(joints.set(1, 99.0), joints.values)") == pytest.approx([1.4, 2.8])


def test_links_stand_where_the_kinematics_say(run):
    poses = run("(joints.set(1, 1.6), joints.poses())")
    expected = link_poses(make_bifold(), {"leaf_1_hinge": 0.8})
    for link, pose in zip(make_bifold().links_from_root, poses, strict=True):
        assert np.allclose(np.array(pose).reshape(4, 4).T, expected[link.id])


def test_hardware_turns_on_its_own_pin():
    if NODE is None:
        pytest.skip("no Node here")
    bifold = make_bifold()
    leaf = bifold.links[1]
    swing = Swing(leaf.id, leaf_axis(bifold), np.array([0.0, 0.5, 1.4]), np.array([0.0, -0.3, -0.4]))
    bar = replace(leaf.visuals[0], name="hinge_bar", swing=swing)
    made = replace(bifold, links=(bifold.links[0], replace(leaf, visuals=(*leaf.visuals, bar)), *bifold.links[2:]))
    scene = json.dumps(scene_data(made, made_model().report).tables)
    code = "".join((SCRIPTS / name).read_text("utf-8") for name in ("matrices.js", "joints.js"))
    program = f"{code} const j = new Joints({scene}); j.set(0, 0.8); console.log(JSON.stringify(j.poses().at(-1)));"
    pose = json.loads(subprocess.run([NODE, "-e", program], capture_output=True, check=True, timeout=60).stdout)

    link = link_poses(made, {"leaf_1_hinge": 0.8})[leaf.id]
    assert np.allclose(np.array(pose).reshape(4, 4).T, link @ swing.motion(0.8))


def test_a_door_on_concealed_hinges_turns_and_shifts():
    if NODE is None:
        pytest.skip("no Node here")
    hinge = concealed_as_articulated(builtin_gallery().concealed[0])
    scene = json.dumps(scene_data(hinge, made_model().report).tables)
    code = "".join((SCRIPTS / name).read_text("utf-8") for name in ("matrices.js", "joints.js"))
    program = f"{code} const j = new Joints({scene}); j.set(0, 0.8); console.log(JSON.stringify(j.poses()[1]));"
    pose = json.loads(subprocess.run([NODE, "-e", program], capture_output=True, check=True, timeout=60).stdout)

    assert np.allclose(np.array(pose).reshape(4, 4).T, hinge.joints[0].shown_motion(0.8))


def leaf_axis(bifold) -> Axis:
    return bifold.joints[0].axis.through(vec3(0.1, 0.2, 0.0))


def test_all_open_and_closed_again(run):
    open_all = "joints.move(true, 0); while (joints.step(1)) {}"
    assert run(f"(() => {{ {open_all} return joints.values; }})()") == pytest.approx([1.4, 2.8])
    close = "joints.move(false, 0); while (joints.step(1)) {}"
    assert run(f"(() => {{ {open_all} {close} return joints.values; }})()") == pytest.approx([0.0, 0.0])
