import json
from math import pi

import numpy as np
import pytest

from grafu.asset.options import LoadOptions
from grafu.errors import UnreadableAsset
from grafu.vocabulary import JointType, PartLabel
from small_assets import load_annotated, write_pnm, yaw


def edit_json(path, change):
    data = json.loads(path.read_text())
    change(data)
    path.write_text(json.dumps(data))


def test_a_moving_link_is_one_part_and_its_handle_rides_on_it(tmp_path):
    asset = load_annotated(write_pnm(tmp_path / "m"))
    assert asset.kind == "partnet-mobility"
    assert asset.name == "m"
    labels = {p.id: p.label for p in asset.parts}
    assert labels["cabinet_door_0"] is PartLabel.DOOR
    assert labels["drawer_1"] is PartLabel.DRAWER
    assert asset.part("handle_8").carried_by == "cabinet_door_0"
    assert asset.part("handle_11").carried_by == "drawer_1"
    assert len(asset.parts) == 10


def test_joints_come_in_the_object_frame_in_radians_and_metres(tmp_path):
    asset = load_annotated(write_pnm(tmp_path / "m"))
    door, drawer = asset.joints
    assert (door.part, door.type, drawer.type) == ("cabinet_door_0", JointType.REVOLUTE, JointType.PRISMATIC)
    np.testing.assert_allclose(door.axis.direction, [0, 0, -1], atol=1e-9)
    assert door.axis.distance_to(asset.box.low * [1, 0, 0] + [0, asset.part(door.part).box.low[1], 0]) < 1e-6
    np.testing.assert_allclose(drawer.axis.direction, [0, -1, 0], atol=1e-9)
    assert (door.lower, door.upper) == (0.0, pytest.approx(pi / 2))
    assert drawer.upper == pytest.approx(0.3 * asset.frame.scale)


def test_the_frame_stands_on_the_floor_and_maps_the_mesh_files(tmp_path):
    asset = load_annotated(write_pnm(tmp_path / "m"), LoadOptions(scale=1.0))
    np.testing.assert_allclose(asset.box.low, [-0.4, -0.215, 0.0], atol=1e-6)
    np.testing.assert_allclose(asset.frame.input_to_output[:3, :3], [[1, 0, 0], [0, 0, -1], [0, 1, 0]])


@pytest.mark.parametrize("scale", [10.0, 0.1])
@pytest.mark.parametrize("turns", [0, 1, 2, 3])
def test_scale_and_yaw_of_the_input_change_nothing(tmp_path, scale, turns):
    plain = load_annotated(write_pnm(tmp_path / "plain"))
    other = load_annotated(write_pnm(tmp_path / "other", scale * yaw(turns)))
    for part in plain.parts:
        np.testing.assert_allclose(other.part(part.id).box.low, part.box.low, atol=1e-6)
    for a, b in zip(plain.joints, other.joints, strict=True):
        np.testing.assert_allclose(b.axis.direction, a.axis.direction, atol=1e-6)
        assert b.upper == pytest.approx(a.upper)


def test_a_mirrored_input_comes_out_mirrored_at_the_same_size(tmp_path):
    plain = load_annotated(write_pnm(tmp_path / "plain"))
    other = load_annotated(write_pnm(tmp_path / "other", np.diag([-1.0, 1, 1])))
    assert other.frame.scale == pytest.approx(plain.frame.scale, rel=1e-6)
    np.testing.assert_allclose(other.part("handle_8").box.center, plain.part("handle_8").box.center * [-1, 1, 1])
    np.testing.assert_allclose(other.joints[0].axis.direction, [0, 0, 1], atol=1e-9)


@pytest.mark.parametrize("name", ["caster", "wheel", "knob", "button"])
def test_what_turns_but_is_no_door_stays_as_misc(tmp_path, name):
    folder = write_pnm(tmp_path / "m")
    edit_json(folder / "mobility_v2.json", lambda links: links[0].update(name=name))
    asset = load_annotated(folder)
    assert [j.part for j in asset.joints] == ["drawer_1"]
    assert asset.part("cabinet_door_surface_7").label is PartLabel.MISC
    assert any("no door or drawer" in note for note in asset.notes)


def test_a_door_on_a_drawer_rides_on_it_and_keeps_its_joint(tmp_path):
    folder = write_pnm(tmp_path / "m")
    edit_json(folder / "mobility_v2.json", lambda links: links[0].update(parent=1))
    asset = load_annotated(folder)
    assert asset.part("cabinet_door_0").carried_by == "drawer_1"
    assert len(asset.joints) == 2


def test_a_sliding_door_is_a_door_on_a_prismatic_joint(tmp_path):
    folder = write_pnm(tmp_path / "m")

    def slide(links):
        links[0].update(joint="slider", name="leaf")
        links[0]["parts"][0]["name"] = "leaf"
        links[0]["jointData"]["axis"]["direction"] = [1, 0, 0]

    edit_json(folder / "mobility_v2.json", slide)
    asset = load_annotated(folder)
    assert asset.joints[0].type is JointType.PRISMATIC
    assert asset.part(asset.joints[0].part).label is PartLabel.DOOR


def test_a_drawer_front_annotated_as_fixed_is_a_frame(tmp_path):
    folder = write_pnm(tmp_path / "m")
    edit_json(folder / "mobility_v2.json", lambda links: links[1].update(joint="heavy"))
    asset = load_annotated(folder)
    assert asset.part("drawer_front_9").label is PartLabel.FACE_FRAME
    assert len(asset.joints) == 1


def test_reversed_limits_are_sorted_and_unlimited_ones_say_so(tmp_path):
    folder = write_pnm(tmp_path / "m")

    def turn(links):
        links[0]["jointData"]["limit"] = {"a": 0, "b": -90, "noLimit": True}

    edit_json(folder / "mobility_v2.json", turn)
    door = load_annotated(folder).joints[0]
    assert (door.lower, door.upper, door.limited) == (pytest.approx(-pi / 2), 0.0, False)


def test_masked_labels_leave_structure_and_no_label(tmp_path):
    asset = load_annotated(write_pnm(tmp_path / "m"), LoadOptions(labels="none"))
    assert {p.label for p in asset.parts} == {PartLabel.UNKNOWN}
    assert asset.part("handle_8").carried_by == "cabinet_door_0"
    assert len(asset.joints) == 2


def test_a_missing_mesh_is_a_note(tmp_path):
    folder = write_pnm(tmp_path / "m")
    (folder / "textured_objs" / "shelf-6.obj").unlink()
    asset = load_annotated(folder)
    assert any("shelf-6.obj is missing" in note for note in asset.notes)
    assert len(asset.parts) == 9


@pytest.mark.parametrize("name", ["mobility_v2.json", "result.json"])
@pytest.mark.parametrize("content", ["{not json", "[1, 2]", '[{"id": 0}]', '{"a": 1}', "null"])
def test_damaged_json_is_one_clear_line(tmp_path, name, content):
    folder = write_pnm(tmp_path / "m")
    (folder / name).write_text(content)
    with pytest.raises(UnreadableAsset, match=r"^[^\n]+$"):
        load_annotated(folder)
