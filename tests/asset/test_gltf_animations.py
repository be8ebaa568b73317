from math import pi

import numpy as np
import pytest

from animated_scenes import (
    HINGE_POINT,
    OPEN,
    OUT,
    animated_document,
    opening,
    save_glb,
    turned,
    with_animation,
    write_animated,
)
from grafu.asset.load import load_asset
from grafu.errors import AssetTooLarge, UnreadableAsset
from grafu.export.files import write_files
from grafu.export.glb import export_glb
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import PartLabel
from predictions import cabinet
from small_assets import load_annotated, write_glb, write_urdf

DOOR_ID, DRAWER_ID = "door", "drawer"


def joints_of(asset):
    return {joint.part: joint for joint in asset.joints}


def stated(tmp_path):
    """The door's and the drawer's joints as the URDF of the same cabinet states them."""
    joints = load_annotated(write_urdf(tmp_path / "urdf")).joints
    return sorted(joints, key=lambda joint: joint.type.value, reverse=True)


def assert_opens_as_stated(asset, tmp_path):
    door, drawer = stated(tmp_path)
    found = joints_of(asset)
    for joint, true in ((found[DOOR_ID], door), (found[DRAWER_ID], drawer)):
        assert joint.type is true.type
        assert (joint.lower, joint.upper) == pytest.approx((true.lower, true.upper), abs=1e-4)
        np.testing.assert_allclose(joint.axis.direction, true.axis.direction, atol=1e-5)
    np.testing.assert_allclose(
        np.cross(found[DOOR_ID].axis.point - door.axis.point, door.axis.direction), np.zeros(3), atol=1e-4
    )


def test_animated_nodes_are_doors_and_drawers_with_their_joints(tmp_path):
    asset = load_annotated(write_animated(tmp_path))
    assert asset.notes == ()
    assert {asset.part(i).label for i in (DOOR_ID, DRAWER_ID)} == {PartLabel.DOOR, PartLabel.DRAWER}
    assert {p.carried_by for p in asset.parts if p.label is PartLabel.HANDLE} == {DOOR_ID, DRAWER_ID}
    assert_opens_as_stated(asset, tmp_path)


def test_parts_are_those_of_the_scene_without_its_animations(tmp_path):
    still = tmp_path / "still"
    still.mkdir()
    asset, other = load_asset(write_animated(tmp_path)), load_asset(save_glb(still, *animated_document()))
    assert [(p.id, p.label) for p in asset.parts] == [(p.id, p.label) for p in other.parts]
    assert asset.joints == ()
    assert len(asset.annotation.joints) == 2
    assert load_asset(write_glb(tmp_path / "plain.glb")).annotation is None


@pytest.mark.parametrize("interpolation", ["STEP", "CUBICSPLINE"])
def test_every_interpolation_is_read(tmp_path, interpolation):
    tracks = opening()
    if interpolation == "CUBICSPLINE":  # tangent, value, tangent
        for paths in tracks.values():
            for path, (times, values) in paths.items():
                paths[path] = (
                    times,
                    [row for value in values for row in ((9.0,) * len(value), value, (9.0,) * len(value))],
                )
    assert_opens_as_stated(load_annotated(write_animated(tmp_path, tracks, interpolation)), tmp_path)


def test_a_turn_about_a_point_beside_the_node_is_a_turn(tmp_path):
    """The door's node is at the origin, and shifted as it turns; keys of both channels differ."""
    document, binary = animated_document()
    door = next(node for node in document["nodes"] if node["name"] == "door")
    del door["translation"]
    for k in door["children"]:
        del document["nodes"][k]["translation"]
    angles = np.linspace(0.0, OPEN, 60)
    point = np.array(HINGE_POINT)
    c, s = np.cos(angles), np.sin(angles)
    shifted = [tuple(point - np.array([[a, 0, -b], [0, 1, 0], [b, 0, a]]) @ point) for a, b in zip(c, s, strict=True)]
    times = np.linspace(0.0, 1.0, len(angles)).tolist()
    tracks = opening() | {"door": {"translation": (times, shifted), "rotation": (times, [turned(a) for a in angles])}}
    assert_opens_as_stated(load_annotated(save_glb(tmp_path, *with_animation(document, binary, tracks))), tmp_path)


def test_several_animations_of_a_node_and_turns_either_way_are_one_range(tmp_path):
    both = {"door": {"rotation": ([0.0, 1.0], [turned(0.0), turned(-0.4)])}}
    document, binary = with_animation(*animated_document(), opening())
    door = joints_of(load_annotated(save_glb(tmp_path, *with_animation(document, binary, both))))[DOOR_ID]
    assert sorted((door.lower, door.upper)) == pytest.approx([-0.4, OPEN], abs=1e-5)


def test_a_node_drawn_open_moves_both_ways(tmp_path):
    document, binary = with_animation(*animated_document(), opening())
    for node in document["nodes"]:
        if node["name"] == "door":
            node["rotation"] = list(turned(0.5))
        if node["name"] == "drawer":
            node["translation"] = [0.0, 0.0, 0.1]
    found = joints_of(load_annotated(save_glb(tmp_path, document, binary)))
    assert (found[DOOR_ID].lower, found[DOOR_ID].upper) == pytest.approx((-0.5, OPEN - 0.5), abs=1e-5)
    assert (found[DRAWER_ID].lower, found[DRAWER_ID].upper) == pytest.approx((-0.1, OUT - 0.1), abs=1e-5)


def test_what_turns_without_end_is_not_limited(tmp_path):
    rounds = [turned(a) for a in np.linspace(0.0, 2 * pi, 9)]
    door = joints_of(load_annotated(write_animated(tmp_path, {"door": {"rotation": (list(range(9)), rounds)}})))[
        DOOR_ID
    ]
    assert not door.limited


def test_parts_of_what_moves_move_by_themselves(tmp_path):
    """The door's node is below the drawer's: it turns as it stands, wherever the drawer is taken."""
    document, binary = animated_document()
    number = {node["name"]: k for k, node in enumerate(document["nodes"])}
    document["nodes"][number["drawer"]]["children"].append(number["door"])
    document["scenes"][0]["nodes"].remove(number["door"])
    asset = load_annotated(save_glb(tmp_path, *with_animation(document, binary, opening())))
    assert_opens_as_stated(asset, tmp_path)
    assert asset.part(DOOR_ID).carried_by == DRAWER_ID


@pytest.mark.parametrize(
    ("tracks", "note"),
    [
        ({"door": {"rotation": ([0.0, 1.0], [turned(0.0), turned(0.02)])}}, ""),
        ({"drawer": {"translation": ([0.0, 1.0], [(0.0, 0.0, 0.0), (0.0, 0.0, 0.004)])}}, ""),
        ({"drawer": {"scale": ([0.0, 1.0], [(1.0, 1.0, 1.0), (2.0, 2.0, 2.0)])}}, ""),
        (
            {
                "drawer": {
                    "translation": ([0.0, 1.0, 2.0], [(0.0, 0.0, 0.0), (0.0, 0.0, 0.3), (0.3, 0.0, 0.3)]),
                }
            },
            "the animation of drawer is neither a turn about an axis nor a slide, and is not read",
        ),
        (
            {"door": {"rotation": ([0.0, 1.0, 2.0], [turned(0.0), turned(1.0), turned(1.0, (1.0, 0.0, 0.0))])}},
            "the animation of door is neither a turn about an axis nor a slide, and is not read",
        ),
    ],
    ids=["a little turn", "a little slide", "growth", "along two lines", "about two axes"],
)
def test_what_states_no_motion_of_a_part_is_left_out(tmp_path, tracks, note):
    asset = load_asset(write_animated(tmp_path, tracks))
    assert asset.annotation is None
    assert asset.notes == ((note,) if note else ())


def test_a_turntable_moves_no_part(tmp_path):
    document, binary = animated_document()
    document["nodes"].append({"name": "whole", "children": document["scenes"][0]["nodes"]})
    document["scenes"][0]["nodes"] = [len(document["nodes"]) - 1]
    rounds = {"whole": {"rotation": ([0.0, 1.0, 2.0], [turned(a) for a in (0.0, 2.0, 4.0)])}}
    asset = load_asset(save_glb(tmp_path, *with_animation(document, binary, rounds)))
    assert asset.annotation is None


def test_what_a_node_above_stretches_is_no_rigid_motion(tmp_path):
    document, binary = animated_document()
    document["nodes"].append({"name": "whole", "children": document["scenes"][0]["nodes"], "scale": [1.0, 1.0, 3.0]})
    document["scenes"][0]["nodes"] = [len(document["nodes"]) - 1]
    asset = load_annotated(save_glb(tmp_path, *with_animation(document, binary, opening())))
    assert list(joints_of(asset)) == [DRAWER_ID]
    assert any("the animation of door" in note for note in asset.notes)


@pytest.mark.parametrize("levels", [1, 40])
def test_what_is_hidden_by_scales_of_zero_states_no_motion(tmp_path, levels):
    document, binary = animated_document()
    below = next(k for k, node in enumerate(document["nodes"]) if node["name"] == "drawer")
    document["scenes"][0]["nodes"].remove(below)
    for _ in range(levels):
        document["nodes"].append({"name": "gone", "children": [below], "scale": [0.0, 0.0, 0.0]})
        below = len(document["nodes"]) - 1
    document["scenes"][0]["nodes"].append(below)
    asset = load_annotated(save_glb(tmp_path, *with_animation(document, binary, opening())))
    assert list(joints_of(asset)) == [DOOR_ID]


@pytest.mark.parametrize(
    "damage",
    [
        lambda document: document["animations"][0]["channels"][0].update(sampler=99),
        lambda document: document["animations"][0]["samplers"][0].update(output=99),
        lambda document: document["animations"][0]["samplers"][0].update(output=1),
        lambda document: document["animations"][0]["channels"][0].update(sampler="first"),
        lambda document: document["animations"].append(7),
        lambda document: document["accessors"][-1].update(count=10**9),
        lambda document: document["animations"][0]["channels"][0]["target"].update(node=10**6),
    ],
)
def test_damaged_animations_are_refused_in_one_line(tmp_path, damage):
    document, binary = with_animation(*animated_document(), opening())
    damage(document)
    with pytest.raises((UnreadableAsset, AssetTooLarge)) as error:
        load_asset(save_glb(tmp_path, document, binary))
    assert "\n" not in str(error.value)


def test_what_is_written_is_read_back_with_its_joints(tmp_path):
    made = articulated_of(cabinet())
    write_files(export_glb(made), tmp_path, overwrite=True)
    asset = load_annotated(tmp_path / "model.glb")
    of = {joint.child: joint for joint in made.joints if joint.kind.moves}
    assert {joint.part for joint in asset.joints} == set(of)
    for joint in asset.joints:
        true = of[joint.part]
        assert joint.upper == pytest.approx(true.limits.upper, abs=1e-4)
        np.testing.assert_allclose(joint.axis.direction, true.axis.direction, atol=1e-5)
