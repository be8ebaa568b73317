import json
from math import radians
from pathlib import Path

import numpy as np
import pytest

from grafu.asset.load import detect
from grafu.asset.options import Limits, LoadOptions
from grafu.cli.main import main
from grafu.errors import AssetTooLarge, UnreadableAsset
from grafu.geometry.transform import transform_points
from grafu.synth.samples import KINDS
from grafu.vocabulary import JointType, PartLabel
from hssd_models import WORDS, hssd_model
from small_assets import Y_UP, glb_bytes, gltf_document, load_annotated, mesh_of

PAIR, CORNER, BEHIND = "overlay pair", "corner door at 45 degrees", "drawers behind a pair"


def written(folder: Path, kind: str = PAIR, change=None, **options):
    """Returns the synthetic furniture and the path of its HSSD files, changed before they are saved."""
    made = KINDS[kind]()
    model = hssd_model(made)
    if change is not None:
        change(model)
    return made, model.save(folder, **options)


def articulations(model):
    return model.articulations["annotation"]["articulations"]


def opened(joint, points, ratio):
    """Returns points moved by a fraction of a joint's range."""
    value = joint.lower + ratio * (joint.upper - joint.lower)
    T = joint.axis.rotation(value) if joint.type is JointType.REVOLUTE else joint.axis.shift(value)
    return transform_points(T, points)


@pytest.mark.parametrize("kind", [PAIR, CORNER, BEHIND, "chest with a lid", "drop-down flap", "cabinet that faces +X"])
@pytest.mark.parametrize("meshes", [1, 3])
def test_what_was_made_is_read_back(tmp_path, kind, meshes):
    made = KINDS[kind]()
    asset = load_annotated(hssd_model(made, meshes).save(tmp_path))
    assert (asset.kind, asset.name, asset.frame.scale) == ("hssd", "a1b2", 1.0)
    assert not asset.notes
    T_read_made = asset.frame.input_to_output[:3, :3] @ Y_UP
    T = np.eye(4)
    T[:3, :3] = T_read_made
    T[:3, 3] = asset.frame.input_to_output[:3, 3]
    assert len(asset.parts) == len(made.parts)
    for before, after in zip(made.parts, asset.parts, strict=True):
        corners = transform_points(T, before.mesh.triangles.reshape(-1, 3))
        np.testing.assert_allclose(np.sort(after.mesh.triangles.reshape(-1, 3), 0), np.sort(corners, 0), atol=1e-6)
        assert after.label is (before.label if before.label in WORDS else PartLabel.MISC)  # `base` is nothing of ours
    ids = {b.id: a.id for b, a in zip(made.parts, asset.parts, strict=True)}
    assert {ids[p.id]: ids[p.carried_by] for p in made.parts if p.carried_by} == {
        p.id: p.carried_by for p in asset.parts if p.carried_by
    }
    read = {joint.part: joint for joint in asset.joints}
    assert set(read) == {ids[joint.part] for joint in made.joints}
    for joint in made.joints:
        found = read[ids[joint.part]]
        assert (found.type, found.lower, found.upper, found.limited) == (joint.type, joint.lower, joint.upper, True)
        corners = made.part(joint.part).box.corners()
        for ratio in (0.3, 1.0):
            expected = transform_points(T, opened(joint, corners, ratio))
            np.testing.assert_allclose(opened(found, transform_points(T, corners), ratio), expected, atol=1e-6)


def test_materials_and_texture_coordinates_stay_with_their_triangles(tmp_path):
    _, path = written(tmp_path)
    asset = load_annotated(path)
    assert {s.material.name for p in asset.parts for s in p.surfaces} == {"colour_0", "colour_1", "colour_2"}
    T = np.linalg.inv(np.asarray(asset.frame.input_to_output))
    for surface in (s for p in asset.parts for s in p.surfaces):
        x_and_y = transform_points(T, surface.mesh.vertices)[:, :2]
        np.testing.assert_allclose(surface.uv, np.column_stack([x_and_y[:, 0], 1 - x_and_y[:, 1]]), atol=1e-6)


def test_the_door_of_a_corner_cabinet_turns_about_its_own_border(tmp_path):
    _, path = written(tmp_path, CORNER)
    asset = load_annotated(path)
    (joint,) = asset.joints
    door = asset.part(joint.part)
    assert min(door.box.size[:2]) > 0.3  # it stands across both axes
    corners = door.box.corners()
    assert np.abs(joint.axis.direction[2]) == pytest.approx(1.0)
    flat = corners[:, :2] - joint.axis.point[:2]
    assert np.linalg.norm(flat, axis=1).min() < 0.03  # at a corner of the box around it
    assert opened(joint, corners, 1.0)[:, :2].min() < asset.box.low[:2].min()  # out of the case


@pytest.mark.parametrize("bom", [True, False])
@pytest.mark.parametrize("prefix", ["", "fpModel."])
def test_articulations_are_found_with_and_without_mark_and_prefix(tmp_path, bom, prefix):
    _, path = written(tmp_path, bom=bom, prefix=prefix)
    assert len(load_annotated(path).joints) == 2


def test_a_model_without_articulations_has_parts_and_no_joints(tmp_path):
    def change(model):
        model.articulations = None

    _, path = written(tmp_path, change=change)
    asset = load_annotated(path)
    assert asset.joints == ()
    assert asset.part("door_6").label is PartLabel.DOOR
    assert asset.part("handle_7").carried_by == "door_6"  # by contact
    assert any("no joint is stated" in note for note in asset.notes)


def test_a_glb_without_an_annotation_stays_a_glb(tmp_path):
    _, path = written(tmp_path)
    path.with_name("a1b2.artpre.json").unlink()
    assert detect(path) == ("gltf", path)
    (tmp_path / "other.glb").write_bytes(path.read_bytes())
    assert detect(tmp_path / "other.glb")[0] == "gltf"


@pytest.mark.parametrize("name", ["", "a1b2.glb", "a1b2.artpre.json", "fpModel.a1b2.articulations.json"])
def test_each_file_and_the_folder_mean_the_model(tmp_path, name):
    _, path = written(tmp_path / "folder", prefix="fpModel.")
    assert detect(path.parent / name if name else path.parent) == ("hssd", path)


def test_triangles_of_no_part_stand_still_and_are_reported(tmp_path):
    path = hssd_model(KINDS[PAIR](), meshes=2, spare=3).save(tmp_path)
    asset = load_annotated(path)
    assert len(asset.part("rest").mesh.faces) == 6
    assert asset.part("rest").carried_by is None
    assert any("6 triangles belong to no annotated part" in note for note in asset.notes)


def test_a_part_without_a_word_stays_unknown_and_the_user_may_mask_all(tmp_path):
    def change(model):
        model.parts["parts"][1].update(label="", name=None)

    _, path = written(tmp_path, change=change)
    assert load_annotated(path).part("part_1").label is PartLabel.UNKNOWN
    assert {p.label for p in load_annotated(path, LoadOptions(labels="none")).parts} == {PartLabel.UNKNOWN}


def test_a_triangle_of_two_parts_is_the_first_ones(tmp_path):
    def change(model):
        runs = [entry["partInfo"]["meshTri"] for entry in model.parts["parts"][1:3]]
        runs[1].extend(runs[0])

    made, path = written(tmp_path, change=change)
    asset = load_annotated(path)
    assert [len(p.mesh.faces) for p in asset.parts] == [len(p.mesh.faces) for p in made.parts]
    assert any("annotated as two parts" in note for note in asset.notes)


def test_a_run_without_triangles_is_the_whole_mesh_and_single_numbers_are_triangles(tmp_path):
    document, binary = gltf_document(["vertical_side_panel-1", "shelf-6"])
    path = tmp_path / "two.glb"
    path.write_bytes(glb_bytes(document, binary))
    runs = ([{"meshIndex": 0}], [{"meshIndex": 1, "triIndex": [0, [1, 12]]}])
    parts = [{"pid": k, "label": "base", "partInfo": {"meshTri": run}} for k, run in enumerate(runs)]
    path.with_name("two.artpre.json").write_text(json.dumps({"parts": parts}))
    asset = load_annotated(path)
    assert [len(p.mesh.faces) for p in asset.parts] == [12, 12]


@pytest.mark.parametrize(
    ("low", "high", "closed", "axis_sense", "limits"),
    [
        (0.0, 1.5, 0.0, 1, (0.0, 1.5)),
        (-1.5, 0.0, 0.0, -1, (0.0, 1.5)),  # closed at its upper end: positive opens all the same
        (-1.5, 0.0, None, 1, (-1.5, 0.0)),  # nothing is known of what is closed: as stated
        (1.5, 0.0, 0.0, 1, (0.0, 1.5)),  # upside down
        (0.2, 1.7, 0.2, 1, (0.2, 1.7)),
    ],
)
def test_limits_count_from_what_is_closed(tmp_path, low, high, closed, axis_sense, limits):
    def change(model):
        states = {} if closed is None else {"closed": {"value": closed}}
        articulations(model)[0].update(rangeMin=low, rangeMax=high, motionStates=states)

    made, path = written(tmp_path, change=change)
    joint = load_annotated(path).joints[0]
    assert (joint.lower, joint.upper) == pytest.approx(limits)
    np.testing.assert_allclose(joint.axis.direction, axis_sense * made.joints[0].axis.direction, atol=1e-9)


def test_a_range_that_is_not_stated_is_no_limit_and_a_default_value_is_the_drawn_pose(tmp_path):
    def change(model):
        first, second = articulations(model)
        first.update(rangeMin=None, rangeMax=None)
        second.update(rangeMin=0.0, rangeMax=1.5, defaultValue=0.5, type="hinge_rotation")

    _, path = written(tmp_path, change=change)
    first, second = load_annotated(path).joints
    assert not first.limited
    assert (second.lower, second.upper) == pytest.approx((-0.5, 1.0))
    assert second.type is JointType.REVOLUTE


def test_what_moves_and_is_no_door_or_drawer_stays(tmp_path):
    def change(model):
        handle = model.pid("handle_1")
        articulations(model).append({**articulations(model)[0], "pid": handle})
        articulations(model).append({**articulations(model)[0], "rangeMax": 0.1})

    _, path = written(tmp_path, change=change)
    asset = load_annotated(path)
    assert [joint.part for joint in asset.joints] == ["door_6", "door_8"]
    assert asset.joints[0].upper == pytest.approx(radians(100))
    assert any("handle-7 is annotated to move" in note for note in asset.notes)
    assert any("door-6 has several motions" in note for note in asset.notes)
    assert asset.part("handle_7").carried_by == "door_6"


def test_a_drawer_behind_a_door_that_is_its_base_rides_on_it(tmp_path):
    def change(model):
        door, drawer = articulations(model)[0], articulations(model)[2]
        drawer["base"] = [door["pid"]]

    _, path = written(tmp_path, BEHIND, change=change)
    asset = load_annotated(path)
    assert asset.part(asset.joints[2].part).carried_by == asset.joints[0].part


def test_a_body_that_touches_only_a_door_does_not_ride_on_it(tmp_path):
    def change(model):
        graph = [[] for _ in model.asset.parts] + [[]]
        door, handle = model.pid("door_1"), model.pid("handle_1")
        still = [k + 1 for k, p in enumerate(model.asset.parts) if p.label.is_support]
        graph[door] = [handle, still[0]]
        graph[still[0]] = still[1:]
        model.articulations["annotation"]["connectivity"] = graph
        for stated in articulations(model):
            stated["base"] = []

    _, path = written(tmp_path, change=change)
    attached = {p.id: p.carried_by for p in load_annotated(path).parts if p.carried_by}
    assert attached == {"handle_7": "door_6", "handle_9": "door_8"}  # the second by contact


def test_parts_that_lie_elsewhere_than_annotated_are_reported(tmp_path):
    def change(model):
        for entry in model.parts["parts"][1:]:
            entry["obb"]["centroid"][0] += 1.0

    made, path = written(tmp_path, change=change)
    count = len(made.parts)
    assert any(f"{count} of {count} parts lie elsewhere" in note for note in load_annotated(path).notes)


def test_up_and_front_come_from_the_annotation(tmp_path):
    def change(model):
        model.parts["upAxis"], model.parts["frontAxis"] = [0, 0, 1], {"x": 0, "y": -1, "z": 0.001}

    _, path = written(tmp_path, change=change)
    frame = load_annotated(path, LoadOptions(labels="none")).frame
    assert frame.up == "+Z"
    assert "stated by the annotation" in frame.assumed[0]


def broken(name):
    """Returns a change that breaks the files in one way, and words that the error must hold."""

    def first(model):
        return model.parts["parts"][1]["partInfo"]["meshTri"][0]

    changes = {
        "range": (lambda m: first(m).update(triIndex=[[0, 99999]]), "names triangle 99998 of mesh 0, which has"),
        "mesh": (lambda m: first(m).update(meshIndex=7), "names mesh 7 of 3"),
        "negative": (lambda m: first(m).update(meshIndex=-1), "names mesh -1"),
        "words": (lambda m: first(m).update(triIndex="all"), "not [first, last)"),
        "backwards": (lambda m: first(m).update(triIndex=[[9, 3]]), "not [first, last)"),
        "pid": (lambda m: articulations(m)[0].update(pid=99), "part 99, which is not there"),
        "repeated": (lambda m: m.parts["parts"][2].update(pid="1"), "a pid repeats"),
        "type": (lambda m: articulations(m)[0].update(type="screw"), "motion of type 'screw'"),
        "axis": (lambda m: articulations(m)[0].update(axis=[0, 0, 0]), "the axis of part 6 is zero"),
        "origin": (lambda m: articulations(m)[0].update(origin=[0, "x", 0]), "the origin of part 6"),
        "infinite": (lambda m: articulations(m)[0].update(axis=[float("inf"), 0, 0]), "the axis of part 6"),
        "no triangles": (lambda m: m.parts["parts"][1].update(partInfo=None), "part 1 has no `partInfo.meshTri`"),
        "no parts": (lambda m: m.parts.update(parts="none"), "`parts` is no list"),
        "no list": (lambda m: m.articulations.update(annotation=[1]), "`annotation` is no object"),
    }
    return changes[name]


BREAKS = ["range", "mesh", "negative", "words", "backwards", "pid", "repeated", "type", "axis", "origin", "infinite"]


@pytest.mark.parametrize("name", [*BREAKS, "no triangles", "no parts", "no list"])
def test_what_does_not_fit_is_one_clear_line(tmp_path, name):
    change, words = broken(name)
    _, path = written(tmp_path, change=change)
    with pytest.raises(UnreadableAsset) as caught:
        load_annotated(path)
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "fetch" in str(caught.value)


@pytest.mark.parametrize("ending", [".artpre.json", ".articulations.json"])
@pytest.mark.parametrize("data", [b"{", b"[]", b"\xff\xfe\x00", b"", b"[" * 100_000])
def test_a_damaged_file_is_one_clear_line(tmp_path, capsys, ending, data):
    _, path = written(tmp_path)
    path.with_name(f"a1b2{ending}").write_bytes(data)
    assert main(["inspect", str(path)]) == 2
    said = capsys.readouterr().err
    assert "is damaged" in said
    assert len(said.strip().splitlines()) == 1


def test_too_many_parts_are_refused(tmp_path):
    _, path = written(tmp_path)
    with pytest.raises(AssetTooLarge):
        load_annotated(path, LoadOptions(limits=Limits(max_parts=4)))


def test_inspect_tells_kind_parts_and_joints(tmp_path, capsys):
    _, path = written(tmp_path)
    assert main(["inspect", str(path)]) == 0
    said = capsys.readouterr().out
    assert "hssd" in said
    assert "door_6" in said
    assert "revolute" in said


def two_primitives(folder: Path, runs, boxes=()):
    """Writes a GLB of two meshes, the first of two primitives (a side, a shelf), the second a top; 12 faces each."""
    names = ["vertical_side_panel-1", "shelf-6", "top_panel-3"]
    document, binary = gltf_document(names)
    primitives = [mesh["primitives"][0] for mesh in document["meshes"]]
    document["meshes"] = [{"primitives": primitives[:2]}, {"primitives": primitives[2:]}]
    document["nodes"] = [{"mesh": 0}, {"mesh": 1}]
    document["scenes"] = [{"nodes": [0, 1]}]
    path = folder / "two.glb"
    path.write_bytes(glb_bytes(document, binary))
    parts = [{"pid": k, "label": "base", "partInfo": {"meshTri": [run]}} for k, run in enumerate(runs)]
    for part, name in zip(parts, boxes, strict=False):
        corners = mesh_of(name).vertices @ Y_UP.T
        low, high = corners.min(axis=0), corners.max(axis=0)
        axes = list(np.eye(3).flat)
        part["obb"] = {"centroid": list((low + high) / 2), "axesLengths": list(high - low), "normalizedAxes": axes}
    path.with_name("two.artpre.json").write_text(json.dumps({"parts": parts}))
    return path


def test_a_mesh_of_several_primitives_may_be_counted_whole(tmp_path):
    """Where the counting by primitives does not fit, a node's triangles are counted through."""
    runs = ({"meshIndex": 0, "triIndex": [[0, 12]]}, {"meshIndex": 0, "triIndex": [[12, 24]]}, {"meshIndex": 1})
    asset = load_annotated(two_primitives(tmp_path, runs))
    assert [round(float(p.box.size.max()), 3) for p in asset.parts] == [0.98, 0.76, 0.8]


@pytest.mark.parametrize(
    ("boxes", "longest"),
    [
        (("vertical_side_panel-1", "shelf-6"), [0.98, 0.76, 0.8]),  # by primitives, the rest is the top
        (("vertical_side_panel-1", "top_panel-3"), [0.98, 0.8, 0.76]),  # by nodes, the rest is the shelf
    ],
)
def test_where_both_ways_of_counting_fit_the_annotated_boxes_decide(tmp_path, boxes, longest):
    runs = ({"meshIndex": 0, "triIndex": [[0, 12]]}, {"meshIndex": 1, "triIndex": [[0, 12]]})
    asset = load_annotated(two_primitives(tmp_path, runs, boxes))
    assert [round(float(p.box.size.max()), 3) for p in asset.parts] == longest
    assert asset.parts[2].source.name == "rest"
    assert not any("elsewhere" in note for note in asset.notes)
