"""What is found in folders of models, and that each model comes with the truth that its files or its maker state."""

import json
import shutil
from math import pi
from pathlib import Path

import numpy as np
import pytest

from collada_documents import write_collada
from fbx_scenes import write_fbx
from grafu.asset.load import SCENES, load_asset
from grafu.asset.part import Asset
from grafu.data.furfun.points import read_ply
from grafu.data.furfun.write import write_furfun
from grafu.errors import AssetError, OptionError, UnreadableAsset
from grafu.evaluation.dataset import KINDS as DATASET_KINDS
from grafu.evaluation.dataset import TEST_SEED, ModelRef, category_of, find_models, load_model
from grafu.evaluation.dataset_release import DOOR_RANGE, DRAWER_RANGE
from grafu.graph.edges import Hinge, Rail
from grafu.graph.functional_graph import paper_edges
from grafu.graph.motion import direction_to_code
from grafu.synth.generate import make_specimen
from grafu.synth.samples import KINDS
from grafu.training.source import RESERVED_SEEDS
from grafu.vocabulary import JointType, PartLabel
from hssd_models import hssd_model
from robot_models import write_mjcf, write_sdf
from small_assets import AS_IT_IS, Y_UP, obj_text, write_glb, write_obj_folder, write_pnm, write_urdf, yaw
from spoiled_files import SPOILS
from threeds_files import write_threeds
from threemf_packages import write_threemf

SEED = 31
COUNT = 3


@pytest.fixture(scope="module")
def specimens():
    return [make_specimen(SEED, k, points=16) for k in range(COUNT)]


@pytest.fixture(scope="module")
def furfun(tmp_path_factory, specimens) -> Path:
    folder = tmp_path_factory.mktemp("written") / "furfun"
    write_furfun(specimens, folder)
    return folder


@pytest.fixture
def release(tmp_path, furfun) -> Path:
    """A copy of the release, to be changed."""
    return Path(shutil.copytree(furfun, tmp_path / "release"))


def taken_away(folder: Path, *patterns: str) -> Path:
    for path in [found for pattern in patterns for found in sorted(folder.glob(pattern))]:
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    return folder


def kinds(refs) -> dict[str, str]:
    assert [ref.id for ref in refs] == sorted({ref.id for ref in refs})
    return {ref.id: ref.kind for ref in refs}


def joints_by_part(asset: Asset):
    return {joint.part: joint for joint in asset.joints}


@pytest.mark.parametrize(
    "fields",
    [
        {"id": "", "kind": "urdf", "path": Path("a")},
        {"id": "..", "kind": "urdf", "path": Path("a")},
        {"id": "a/b", "kind": "urdf", "path": Path("a")},
        {"id": "a", "kind": "urdf"},
        {"id": "a", "kind": "urdf", "path": Path("a"), "seed": 1},
        {"id": "a", "kind": "made", "seed": 1},
        {"id": "a", "kind": "made", "seed": -1, "number": 0},
        {"id": "a", "kind": "made", "seed": 1, "number": 0, "path": Path("a")},
    ],
)
def test_a_reference_checks_itself(fields):
    with pytest.raises(OptionError):
        ModelRef(**fields)


def test_a_mixed_folder_gives_every_model_once(tmp_path, furfun):
    write_pnm(tmp_path / "45001")
    write_urdf(tmp_path / "kitchen")
    hssd_model(KINDS["overlay pair"]()).save(tmp_path / "hssd" / "flat", "aaaa", "fpModel.")
    hssd_model(KINDS["drop-down flap"]()).save(tmp_path / "hssd" / "flat", "bbbb")
    hssd_model(KINDS["chest with a lid"]()).save(tmp_path / "hssd" / "cccc", "cccc")
    write_glb(tmp_path / "hssd" / "flat" / "plain.glb")  # not annotated, beside some that are: no model of the set
    (tmp_path / "scenes").mkdir()
    write_glb(tmp_path / "scenes" / "dresser.glb")
    write_obj_folder(tmp_path / "pieces")
    shutil.copytree(furfun, tmp_path / "furfun")
    (tmp_path / "readme.txt").write_text("nothing")
    (tmp_path / ".git").mkdir()
    (tmp_path / "empty").mkdir()
    assert kinds(find_models(tmp_path)) == {
        "45001": "partnet-mobility",
        "cabinet": "urdf",
        "aaaa": "hssd",
        "bbbb": "hssd",
        "cccc": "hssd",
        "dresser": "glb",
        "pieces": "mesh",
        **{f"synth_{SEED}_{k:07d}": "furfun" for k in range(COUNT)},
    }


def test_models_of_every_format_are_found(tmp_path):
    write_collada(tmp_path / "dae")
    write_fbx(tmp_path / "fbx")
    write_sdf(tmp_path / "sdf")
    write_mjcf(tmp_path / "mjcf")
    write_threemf(tmp_path / "flat")
    write_threeds(tmp_path / "3ds")
    write_glb(tmp_path / "flat" / "dresser.glb")
    write_threemf(tmp_path / "copies").rename(tmp_path / "copies" / "chest.3mf")
    write_glb(tmp_path / "copies" / "chest.glb")
    (tmp_path / "flat" / "notes.xml").write_text("<notes/>")
    found = kinds(find_models(tmp_path))
    assert sorted(found.values()) == sorted(["collada", "fbx", "sdf", "mjcf", "3mf", "3ds", "glb", "glb"])
    assert (found["chest"], found["dresser"]) == ("glb", "glb")


@pytest.mark.parametrize("kind", SCENES)
def test_every_scene_format_is_a_kind_of_model(kind):
    assert ModelRef("a", {"gltf": "glb"}.get(kind, kind), Path("a")).kind in DATASET_KINDS


def test_one_model_is_a_dataset_of_one(tmp_path):
    write_pnm(tmp_path / "45001")
    write_urdf(tmp_path / "kitchen" / "urdf")
    path = hssd_model(KINDS["overlay pair"]()).save(tmp_path / "hssd")
    assert kinds(find_models(tmp_path / "45001")) == {"45001": "partnet-mobility"}
    assert kinds(find_models(tmp_path / "kitchen")) == {"cabinet": "urdf"}
    assert kinds(find_models(path)) == {"a1b2": "hssd"}
    assert kinds(find_models(str(tmp_path / "hssd"))) == {"a1b2": "hssd"}


def test_models_of_one_name_are_told_apart(tmp_path, furfun):
    write_pnm(tmp_path / "a" / "7")
    write_pnm(tmp_path / "b" / "7")
    write_pnm(tmp_path / "b" / "partnet-mobility_7_2")
    hssd_model(KINDS["overlay pair"]()).save(tmp_path, "7")
    assert kinds(find_models(tmp_path)) == {
        "hssd_7": "hssd",
        "partnet-mobility_7": "partnet-mobility",
        "partnet-mobility_7_2": "partnet-mobility",
        "partnet-mobility_7_3": "partnet-mobility",
    }


def test_a_scene_file_that_names_nothing_is_named_by_its_folder(tmp_path):
    for name in ("dresser", "sideboard"):
        write_urdf(tmp_path / name).rename(tmp_path / name / "model.urdf")
        write_glb(tmp_path / name / "model.glb")  # a copy of it
    assert kinds(find_models(tmp_path)) == {"dresser": "urdf", "sideboard": "urdf"}


@pytest.mark.parametrize("name", ["", "absent", "readme.txt"])
def test_where_nothing_is_found_one_line_says_what_would_be_read(tmp_path, name):
    (tmp_path / "readme.txt").write_text("nothing")
    with pytest.raises(
        UnreadableAsset, match=r"PartNet-Mobility folders .* HSSD models .* URDF .* release .* synth"
    ) as e:
        find_models(tmp_path / name)
    assert "\n" not in str(e.value)


@pytest.mark.parametrize(
    "data", ["synth:", "synth:1", "synth:a:2", "synth:1:0", "synth:-1:3", "synth:1:2:3", "synth:²:1"]
)
def test_made_furniture_is_asked_for_by_two_numbers(data):
    with pytest.raises(OptionError, match="synth:SEED:COUNT"):
        find_models(data)


def test_made_furniture_is_what_the_generator_makes_with_its_true_joints(specimens):
    refs = find_models(f"synth:{SEED}:{COUNT}")
    assert [ref.number for ref in refs] == [0, 1, 2]
    assert {ref.seed for ref in find_models("synth")} == {TEST_SEED}
    assert TEST_SEED in RESERVED_SEEDS  # training refuses it
    for ref, specimen in zip(refs, specimens, strict=True):
        asset = load_model(ref)
        assert (asset.name, ref.id) == (specimen.id, specimen.id)
        assert [p.id for p in asset.parts] == [p.id for p in specimen.asset.parts]
        assert asset.joints == specimen.whole.joints
        assert [p.label for p in asset.parts] == [p.label for p in specimen.asset.parts]
        present = {p.id for p in asset.parts}
        attached = {p.id: p.carried_by for p in specimen.whole.parts if p.id in present and p.carried_by in present}
        assert {p.id: p.carried_by for p in asset.parts if p.carried_by} == attached
        assert not asset.without_annotation().joints
        assert category_of(ref) == specimen.family


def test_the_category_of_a_model_is_what_its_data_set_says(tmp_path):
    write_pnm(tmp_path / "1")
    (tmp_path / "1" / "meta.json").write_text(json.dumps({"model_cat": "StorageFurniture"}))
    write_pnm(tmp_path / "2")
    (tmp_path / "2" / "meta.json").write_text("{")
    hssd_model(KINDS["overlay pair"]()).save(tmp_path, "3")
    found = [category_of(ref) for ref in find_models(tmp_path)]
    assert found == ["StorageFurniture", "partnet-mobility", "hssd"]


@pytest.mark.parametrize("what", SPOILS)
def test_a_category_that_cannot_be_read_is_none(tmp_path, what):
    write_pnm(tmp_path / "1")
    (tmp_path / "1" / "meta.json").write_text(json.dumps({"model_cat": "StorageFurniture"}))
    SPOILS[what](tmp_path / "1" / "meta.json")
    assert category_of(ModelRef("1", "partnet-mobility", tmp_path / "1")) == "partnet-mobility"


def test_the_truth_of_a_folder_with_joints_is_its_own(tmp_path):
    write_pnm(tmp_path / "45001")
    write_urdf(tmp_path / "kitchen")
    hssd_model(KINDS["overlay pair"]()).save(tmp_path / "hssd")
    for ref in find_models(tmp_path):
        asset = load_model(ref)
        assert asset.joints == load_asset(ref.path).stated_joints
        assert len(asset.joints) == 2


def read_id(part_id: str) -> str:
    """Returns the id of a part once it is read: names of hardware are kept for hardware."""
    return f"part_{part_id}" if part_id.startswith(("hinge_", "rail_", "support_")) else part_id


def test_a_release_with_functional_graphs_states_how_parts_move(furfun, specimens):
    moved = 0
    for ref, specimen in zip(find_models(furfun), specimens, strict=True):
        asset = load_model(ref)
        assert (asset.kind, asset.name, category_of(ref)) == ("release", specimen.id, "furfun")
        sizes = {read_id(p.id): p.box.size for p in specimen.asset.parts}
        assert {p.id for p in asset.parts} == set(sizes)
        to_frame = np.abs(asset.frame.input_to_output[:3, :3])  # by quarter turns: a front may be drawn at a side
        for part in asset.parts:
            np.testing.assert_allclose(part.box.size, to_frame @ sizes[part.id], atol=1e-4)
        read = joints_by_part(asset)
        stated = {e.child for e in paper_edges(specimen.truth) if isinstance(e, Hinge | Rail)}
        assert set(read) == stated & {p.id for p in asset.parts}
        for joint in specimen.whole.joints:
            if joint.part not in read:
                continue
            found = read[joint.part]
            turned = asset.frame.input_to_output[:3, :3] / asset.frame.scale @ joint.axis.direction
            assert direction_to_code(found.axis.direction) == direction_to_code(turned)
            size = specimen.truth.node(joint.part).box.size
            if found.type is JointType.REVOLUTE:
                assert found.upper == DOOR_RANGE == pi / 2
            else:
                slide = int(np.argmax(np.abs(joint.axis.direction)))
                assert found.upper == pytest.approx(DRAWER_RANGE * size[slide] * asset.frame.scale, rel=1e-4)
            moved += 1
        attached = {e.child: e.parent for e in specimen.truth.attachments if e.child in sizes}
        assert {p.id: p.carried_by for p in asset.parts if p.label is PartLabel.HANDLE and p.id in attached} == attached
        assert any("states no ranges" in note for note in asset.notes)
    assert moved > 2


@pytest.mark.parametrize("kind", ["pnm_clean", "hssd_test"])
def test_a_release_of_inputs_alone_has_meshes_and_no_truth(release, kind):
    taken_away(release, "graphs_functional", "splits", "part_geometries/*/*.npy")
    if kind == "hssd_test":
        (release / "graphs_unfunctional").rename(release / "graph_unfunc")
    refs = find_models(release)
    assert {ref.kind for ref in refs} == {kind}
    asset = load_model(refs[0])
    assert asset.joints == ()
    assert len(asset.parts) > 3
    assert any("no joint is stated" in note for note in asset.notes)


@pytest.mark.parametrize("functional", [True, False])
def test_points_without_meshes_cannot_be_swung_and_that_is_said(release, functional):
    taken_away(release, "part_geometries/*/*.ply", *([] if functional else ["graphs_functional"]))
    with pytest.raises(UnreadableAsset, match=r"holds no meshes: expected <node>.ply.*nothing can be swung") as caught:
        load_model(find_models(release)[0])
    said = "codes can be compared" if functional else "states no motion either"
    assert said in str(caught.value)


def test_a_part_without_a_mesh_is_left_out_with_its_joint_and_reported(release, specimens):
    moving = next(j.part for j in specimens[0].whole.joints)
    (release / "part_geometries" / specimens[0].id / f"{moving}.ply").unlink()
    asset = load_model(find_models(release)[0])
    assert moving not in {p.id for p in asset.parts} | {j.part for j in asset.joints} | {
        p.carried_by for p in asset.parts
    }
    assert any(note.startswith("1 of ") and "have no mesh" in note for note in asset.notes)


TURNS = {"as they are": AS_IT_IS, "180": yaw(2), "90": yaw(1), "Y up": Y_UP, "Y up, 180": Y_UP @ yaw(2), "270": yaw(3)}


@pytest.mark.parametrize("turn", TURNS)
@pytest.mark.parametrize("listed", [True, False])
def test_meshes_in_another_frame_are_turned_into_the_graphs(release, furfun, specimens, turn, listed):
    """OBJ files of a release may lie Y up or be yawed; `parts.json` may name them."""
    ref = find_models(furfun)[0]
    folder = release / "part_geometries" / ref.id
    names = {}
    for k, file in enumerate(sorted(folder.glob("*.ply"))):
        mesh = read_ply(file.read_bytes(), "")
        (folder / "objs").mkdir(exist_ok=True)
        names[file.stem] = f"part_{k}.obj"
        target = folder / "objs" / names[file.stem] if listed else folder / f"{file.stem}.obj"
        target.write_text(obj_text(mesh, TURNS[turn]))
        file.unlink()
    if listed:
        rows = [{"id": node, "obj_file": f"objs/{name}"} for node, name in names.items()]
        (folder / "parts.json").write_text(json.dumps({"parts": rows}))
    plain, turned = load_model(ref), load_model(find_models(release)[0])
    assert [p.id for p in turned.parts] == [p.id for p in plain.parts]
    for a, b in zip(plain.parts, turned.parts, strict=True):
        np.testing.assert_allclose(b.box.low, a.box.low, atol=1e-5)
        np.testing.assert_allclose(b.box.high, a.box.high, atol=1e-5)
    assert any("were turned into the frame of the graph" in note for note in turned.notes) == (turn != "as they are")
    assert [j.part for j in turned.joints] == [j.part for j in plain.joints]


def test_meshes_beside_their_boxes_are_reported(release, specimens):
    ref = find_models(release)[0]
    file = next((release / "part_geometries" / ref.id).glob("*.ply"))
    mesh = read_ply(file.read_bytes(), "")
    file.with_suffix(".obj").write_text(obj_text(type(mesh)(mesh.vertices + 1.0, mesh.faces), AS_IT_IS))
    file.unlink()
    assert any(note.startswith("1 of ") and "beside the boxes" in note for note in load_model(ref).notes)


def test_only_the_test_models_of_a_split_where_one_is_named(release):
    (release / "splits" / "full_split.json").write_text(
        json.dumps({"train_mids": [], "val_mids": [], "test_mids": [f"synth_{SEED}_0000001", "fur_009"]})
    )
    assert kinds(find_models(release, "full_split")) == {f"synth_{SEED}_0000001": "furfun"}
    with pytest.raises(AssetError):
        find_models(release, "no_such_split")


def test_a_damaged_graph_is_one_clear_line_and_costs_no_other_model(release):
    (release / "graphs_unfunctional" / f"synth_{SEED}_0000000" / f"synth_{SEED}_0000000.json").write_text(
        '{"nodes": {}}'
    )
    refs = find_models(release)
    with pytest.raises(AssetError, match="has no nodes"):
        load_model(refs[0])
    assert load_model(refs[1]).joints
