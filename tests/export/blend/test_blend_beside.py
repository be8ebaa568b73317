"""Objects in a Blender that holds other things: built twice, moved by hand, taken out again."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest
from blend_probe import probe
from blend_reading import assert_posed

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.kinematics import link_origins, link_poses
from grafu.export.blend.process import packed


@pytest.fixture(scope="module")
def beside(interpreter, cabinet, tmp_path_factory):
    folder = tmp_path_factory.mktemp("beside")
    (folder / "object.packed").write_bytes(packed(cabinet))
    script = str(Path(__file__).with_name("blend_beside.py"))
    command = [interpreter, script, str(folder / "object.packed"), str(folder / "found.json")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads((folder / "found.json").read_text()) | {"file": (folder / "saved.blend").read_bytes()}


def assert_links(poses, articulated: ArticulatedObject, values) -> None:
    for link, motion in link_poses(articulated, values).items():
        rest = np.eye(4)
        rest[:3, 3] = link_origins(articulated)[link]
        assert np.allclose(poses[link], motion @ rest, atol=1e-5), link


def test_two_of_a_kind_stand_beside_what_was_there(beside):
    assert beside["names"] == ["door_1.001", "door_1.002"]  # the plain name was another's
    assert beside["ids"] == ["door_1", "door_1"]


def test_a_muted_joint_is_the_users_while_the_others_play(beside, cabinet):
    assert_links(beside["muted"], cabinet, {"door_1_hinge": 0.875, "drawer_1_rail": 0.28})
    assert_links(beside["others"], cabinet, {"door_1_hinge": 1.75, "drawer_1_rail": 0.28})
    assert_links(beside["unmuted"], cabinet, {"door_1_hinge": 1.75, "drawer_1_rail": 0.28})


def test_a_joint_opens_by_hand_at_once(beside, cabinet):
    assert_links(beside["by_hand"], cabinet, {"drawer_1_rail": 0.28})


def test_a_limit_is_changed_by_its_property(beside, cabinet):
    assert_links(beside["limited"], cabinet, {"door_1_hinge": 0.7, "drawer_1_rail": 0.28})


def test_what_is_no_moving_joint_or_no_fraction_is_refused(beside):
    assert beside["refused"] == [True, True, True]


def test_an_object_leaves_nothing_behind_and_takes_nothing_of_others(beside):
    kept = {"objects": ["theirs"], "meshes": ["theirs"], "materials": ["steel"]}  # theirs wears our steel

    assert len(beside["with_one"]["objects"]) == (len(beside["with_two"]["objects"]) - 1) // 2 + 2
    for kind, names in beside["before"].items():
        assert beside["after"][kind] == sorted(names + kept.get(kind, [])), kind


def test_an_object_is_saved_alone_and_what_was_there_stays(beside, interpreter, cabinet, tmp_path):
    assert beside["saved"] == beside["after"]

    found = probe(interpreter, beside["file"], tmp_path)

    assert found["scene"] == (0, 100, "METRIC", 1.0)
    assert len(found["objects"]) == 9 + 3 + 2  # meshes, links, joints, and nothing of the others'
    assert_posed(found, found["frames"][50], cabinet, {"door_1_hinge": 1.75, "drawer_1_rail": 0.28})
    assert "door_1" in found["objects"]  # as if no namesake stood beside it
