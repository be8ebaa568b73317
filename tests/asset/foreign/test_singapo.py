"""SINGAPO's and CAGE's object.json: both trees, degrees, ranges below zero, meshes and boxes, and what is refused."""

import json
import re
from collections.abc import Callable
from math import degrees, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from grafu.asset.foreign import singapo
from grafu.asset.foreign.attach import attach_motions
from grafu.asset.foreign.singapo import read_singapo
from grafu.errors import ExportError, UnreadableAsset
from grafu.export.files import write_files
from grafu.export.singapo import SingapoConfig, export_singapo
from grafu.pipeline.foreign import read_foreign
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import JointType, PartLabel
from predictions import cabinet, require_same_joint, unlabelled

CABINET = cabinet()
OBJECT = articulated_of(CABINET)
Tree = dict[str, Any]


@pytest.fixture
def path(tmp_path: Path) -> Path:
    write_files(export_singapo(OBJECT), tmp_path / "run")
    return tmp_path / "run" / "object.json"


def edit(path: Path, change: Callable[[Tree], Any]) -> None:
    data = json.loads(path.read_text())
    changed = change(data)
    path.write_text(json.dumps(data if changed is None else changed))


def senses(path: Path) -> dict[int, float]:
    return {n["id"]: -1.0 if n["joint"]["range"][1] < 0 else 1.0 for n in json.loads(path.read_text())["diffuse_tree"]}


def require_same(path: Path) -> None:
    found = {joint.part: joint for joint in attach_motions(CABINET, read_singapo(path)).joints}
    assert set(found) == {joint.part for joint in CABINET.joints}
    for true in CABINET.joints:
        sense = 1.0 if found[true.part].upper > 0 else -1.0
        require_same_joint(found[true.part], true, CABINET.box, sense, 1e-6)


@pytest.mark.parametrize("meshes", [True, False])
@pytest.mark.parametrize("tree", ["diffuse_tree", "arti_tree"])
def test_joints_come_back_from_both_trees(tree: str, meshes: bool, tmp_path: Path) -> None:
    write_files(export_singapo(OBJECT, SingapoConfig(tree, meshes)), tmp_path / "run")  # type: ignore[arg-type]

    require_same(tmp_path / "run" / "object.json")
    read = read_singapo(tmp_path / "run" / "object.json")
    assert {part.is_box for part in read.parts} == {not meshes}


def test_the_format_is_what_singapo_writes(path: Path) -> None:
    data = json.loads(path.read_text())
    tree = data["diffuse_tree"]

    assert [n["name"] for n in tree] == ["base", "door", "handle", "door", "handle", "drawer", "handle"]
    assert [n["parent"] for n in tree] == [-1, 0, 1, 0, 3, 0, 5]
    assert [n["children"] for n in tree] == [[1, 3, 5], [2], [], [4], [], [6], []]
    left, right, slide = (tree[k]["joint"] for k in (1, 3, 5))
    assert left["axis"]["direction"] == pytest.approx([0.0, 1.0, 0.0])  # made positive: the range runs below zero
    assert left["range"] == pytest.approx([0.0, -95.0])
    assert right["range"] == pytest.approx([0.0, 95.0])
    assert slide["axis"]["direction"] == pytest.approx([0.0, 0.0, 1.0])  # the front is +Z
    corners = [np.abs(np.array(n["aabb"]["center"])) + np.array(n["aabb"]["size"]) / 2 for n in tree]
    assert np.linalg.norm(np.max(corners, axis=0)) == pytest.approx(1.0)  # half the diagonal


def test_ranges_keep_their_sign(path: Path) -> None:
    read = {joint.part: joint for joint in read_singapo(path).joints}

    assert degrees(read["door_1"].upper) == pytest.approx(-95.0)
    assert degrees(read["door_3"].upper) == pytest.approx(95.0)
    assert all(joint.lower == 0.0 for joint in read.values())


def test_parts_without_labels_get_those_of_the_file(path: Path) -> None:
    found = attach_motions(unlabelled(CABINET), read_singapo(path))

    assert {p.id: p.label for p in found.parts if p.label is not PartLabel.UNKNOWN} == {
        "door_left": PartLabel.DOOR,
        "door_right": PartLabel.DOOR,
        "drawer": PartLabel.DRAWER,
        "handle_left": PartLabel.HANDLE,
        "handle_right": PartLabel.HANDLE,
        "handle_drawer": PartLabel.HANDLE,
    }
    assert {p.id: p.carried_by for p in found.parts} == {p.id: p.carried_by for p in CABINET.parts}


def test_what_turns_without_end_states_no_limits(path: Path) -> None:
    edit(path, lambda data: data["diffuse_tree"][1]["joint"].update(type="continuous", range=[0, 360]))
    joint = read_singapo(path).joints[0]

    assert (joint.type, joint.limited) == (JointType.REVOLUTE, False)
    assert joint.upper == pytest.approx(2 * pi)


def test_screws_are_left_still(path: Path) -> None:
    edit(path, lambda data: data["diffuse_tree"][1]["joint"].update(type="screw"))
    read = read_singapo(path)

    assert [joint.part for joint in read.joints] == ["door_3", "drawer_5"]
    assert "door_1 is predicted to screw, which is not built: left still" in read.notes


def test_meshes_in_other_coordinates_give_way_to_the_box(path: Path) -> None:
    obj = path.parent / "objs" / "part_1.obj"
    obj.write_text(re.sub(r"^v (\S+)", lambda m: f"v {float(m[1]) + 5}", obj.read_text(), flags=re.MULTILINE))
    parts = read_singapo(path).parts

    assert [part.is_box for part in parts] == [False, True, False, False, False, False, False]
    require_same(path)


def test_a_damaged_mesh_gives_way_to_the_box(path: Path) -> None:
    (path.parent / "objs" / "part_3.obj").write_text("v 0 0\nf 1 2 3\n")
    read = read_singapo(path)

    assert read.parts[3].is_box
    assert any("box stands for its mesh" in note for note in read.notes)
    (path.parent / "objs" / "part_3.obj").unlink()
    assert read_singapo(path).parts[3].is_box


def node(key: int, *names: str, value: Any) -> Callable[[Tree], None]:
    def change(data: Tree) -> None:
        place = data["diffuse_tree"][key]
        for name in names[:-1]:
            place = place[name]
        place[names[-1]] = value

    return change


@pytest.mark.parametrize(
    ("damage", "why"),
    [
        (lambda _: [], "lists no parts: expected SINGAPO's or CAGE's object.json"),
        (lambda _: {"diffuse_tree": []}, "lists no parts"),
        (lambda _: {"diffuse_tree": [1]}, "lists no parts"),
        (node(1, "aabb", value=None), "part 1 has no `aabb`"),
        (node(1, "joint", value=[]), "part 1 has no `joint`"),
        (node(1, "aabb", "size", value=[1, 2]), "`size` must be 3 finite numbers"),
        (node(1, "aabb", "size", value=[1, -2, 1]), "`size` must not be negative"),
        (node(1, "aabb", "center", value=[1, "2", 1]), "`center` must be 3 finite numbers"),
        (node(1, "aabb", "center", value=[1, 1e400, 1]), "`center` must be 3 finite numbers"),
        (node(1, "joint", "type", value="ball"), "`type` must be fixed, revolute, prismatic, screw or continuous"),
        (node(1, "joint", "axis", value=None), "part 1 has no `axis`"),
        (node(1, "joint", "range", value=[0]), "`range` must be 2 finite numbers"),
        (node(1, "parent", value=77), "hangs on the part 77, which is not there"),
        (node(1, "parent", value=2), "must form a tree"),
        (node(1, "parent", value=[2]), "`id` and `parent` must be numbers"),
        (node(1, "id", value=2), "`id` of parts must be unique"),
        (node(1, "name", value=3), "`name` of a part must be a word"),
    ],
)
def test_damaged_files_are_refused_in_one_line(damage: Callable[[Tree], Any], why: str, path: Path) -> None:
    edit(path, damage)
    with pytest.raises(UnreadableAsset, match=why) as error:
        read_singapo(path)
    assert "\n" not in str(error.value)


def test_what_is_not_json_is_refused(path: Path) -> None:
    path.write_text("{")
    with pytest.raises(UnreadableAsset, match="is not JSON"):
        read_foreign(path)
    with pytest.raises(UnreadableAsset, match="is not JSON: expected SINGAPO's"):
        read_singapo(path)


def test_what_does_not_start_closed_cannot_be_written() -> None:
    from dataclasses import replace

    from grafu.articulation.articulated_object import JointLimits

    joint = replace(OBJECT.joints[0], limits=JointLimits(0.2, 1.0))
    with pytest.raises(ExportError, match="ranges start at 0"):
        export_singapo(replace(OBJECT, joints=(joint, *OBJECT.joints[1:])))


def test_a_mesh_that_is_listed_very_often_is_read_once(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def repeat(data: Tree) -> None:
        for node in data["diffuse_tree"]:
            node["objs"] = node.get("objs", []) * 1000
            node["plys"] = node.get("plys", []) * 1000

    whole = [len(part.mesh.faces) for part in read_singapo(path).parts]
    edit(path, repeat)
    read: list[Path] = []
    once = singapo.read_mesh_file
    monkeypatch.setattr(
        singapo, "read_mesh_file", lambda file, *args, **how: read.append(file) or once(file, *args, **how)
    )
    assert [len(part.mesh.faces) for part in read_singapo(path).parts] == whole
    assert len(read) == len(set(read)) > 0
