"""Releases laid out like the authors' are read from their path alone, with all that is odd in them."""

import pickle

import numpy as np
import pytest
from releases import HALVES, functional, put, put_model, unfunctional

from grafu.data.corruption.corrupt import folded
from grafu.data.furfun.folder import FurFunFolder
from grafu.errors import AssetError, GraphError, UnreadableAsset
from grafu.graph.edges import Attached, Contact, Hinge, Rail
from grafu.vocabulary import PartLabel

HINGE, RAIL, KNOB = Hinge("side_panel_0", "door_0", 0, 0), Rail("side_panel_0", "drawer_0", 2), "handle_0"
AT_REST = {Contact("side_panel_0", "door_0"), Contact("side_panel_0", "drawer_0")}


def pair(root, **options):
    return FurFunFolder(root, **({"points": 0} | options)).pair("fur_001")


def test_a_release_is_read_from_its_path_alone(tmp_path):
    folder = FurFunFolder(put_model(put_model(tmp_path), "fur_002"))
    assert folder.layout.kind == "furfun"
    assert folder.models == folder.paired == ("fur_001", "fur_002")
    assert folder.notes == ()
    found = folder.pair("fur_001")
    assert found.missing == (KNOB,)
    assert set(found.input.edges) == AT_REST
    assert set(found.target.edges) == {HINGE, RAIL, Attached("door_0", KNOB)}
    assert [n.id for n in found.target.nodes] == list(HALVES)  # the file's order is the slots'


def test_inputs_alone_are_read_too(tmp_path):
    put(tmp_path / "pnm" / "graphs_unfunctional" / "7120" / "7120.json", unfunctional("7120"))
    put(tmp_path / "hssd" / "graph_unfunc" / "a" / "a.json", unfunctional("a"))
    pnm, hssd = FurFunFolder(tmp_path / "pnm", points=0), FurFunFolder(tmp_path / "hssd", points=0)
    assert (pnm.layout.kind, hssd.layout.kind) == ("pnm_clean", "hssd_test")
    assert (pnm.models, pnm.paired, hssd.models) == (("7120",), (), ("a",))
    model = hssd.model("a")
    assert model.pair is None
    assert set(model.input.edges) == AT_REST
    with pytest.raises(GraphError, match=r"`7120` of .* has no functional graph"):
        pnm.pair("7120")


def test_flat_inputs_and_files_of_another_name_are_found(tmp_path):
    put(tmp_path / "graphs_unfunctional" / "x1_input.json", unfunctional("x1"))
    put(tmp_path / "graphs_unfunctional" / "x2" / "graph.json", unfunctional("x2"))
    put(tmp_path / "graphs_unfunctional" / ".DS_Store", b"")
    (tmp_path / "graphs_unfunctional" / "empty").mkdir()
    assert FurFunFolder(tmp_path, points=0).models == ("x1", "x2")
    assert FurFunFolder(tmp_path, points=0).model("x2").input.model_id == "x2"


@pytest.mark.parametrize("made", [(), ("part_geometries",), ("graphs_functional",), ("graphs_unfunctional",)])
def test_other_folders_are_refused(tmp_path, made):
    for name in made:
        (tmp_path / name).mkdir()
    with pytest.raises(UnreadableAsset, match="expected"):
        FurFunFolder(tmp_path)
    with pytest.raises(UnreadableAsset, match="is no folder"):
        FurFunFolder(tmp_path / "nowhere")


@pytest.mark.parametrize("name", ["graphs_unfunctional", "graphs_functional", "part_geometries", "splits"])
def test_a_folder_of_a_release_that_is_a_link_out_is_refused(tmp_path, name):
    root = put_model(tmp_path / "release")
    (tmp_path / "outside").mkdir()
    if (root / name).is_dir():
        (root / name).rename(tmp_path / "outside" / name)
    (root / name).symlink_to(tmp_path / "outside")
    with pytest.raises(UnreadableAsset, match="leads out of the release"):
        FurFunFolder(root)


def test_a_model_of_a_release_that_is_a_link_out_is_passed_over(tmp_path):
    root, other = put_model(put_model(tmp_path / "release"), "fur_002"), put_model(tmp_path / "other", "fur_003")
    for name in ("fur_003", "x_input.json", "fur_002/fur_002.json"):
        link = root / "graphs_unfunctional" / name
        link.unlink(missing_ok=True)
        link.symlink_to(other / "graphs_unfunctional" / "fur_003" / ("" if name == "fur_003" else "fur_003.json"))
    (root / "part_geometries").mkdir()
    (root / "part_geometries" / "fur_001").symlink_to(other)
    folder = FurFunFolder(root, points=4)
    assert folder.models == ("fur_001",)
    assert "boxes" in " ".join(folder.model("fur_001").notes)


def test_empty_and_disconnected_graphs_are_skipped_with_a_note(tmp_path):
    apart = functional("fur_072")
    apart["edges"] = apart["edges"][:2]
    put_model(tmp_path, "fur_072", whole=apart)
    put_model(tmp_path, "fur_100", given=unfunctional() | {"nodes": {}})
    put_model(tmp_path, "fur_101", whole=functional() | {"nodes": []})
    put(tmp_path / "graphs_functional" / "fur_102" / "fur_102.json", functional())
    folder = FurFunFolder(put_model(tmp_path), points=0)
    assert folder.models == ("fur_001",)
    assert folder.notes == (
        "skipped fur_072: its functional graph falls into 2 pieces",
        "skipped fur_100: it has no nodes",
        "skipped fur_101: it has no nodes",
        "skipped fur_102: it has no input graph",
    )
    with pytest.raises(AssetError, match=r"`fur_072` of .* is left out: its functional graph falls"):
        folder.pair("fur_072")
    with pytest.raises(AssetError, match="holds no model `fur_999`"):
        folder.pair("fur_999")
    assert FurFunFolder(tmp_path, points=0, keep_disconnected=True).pair("fur_072").missing == (KNOB,)


def test_made_furniture_may_fall_apart(tmp_path):
    apart = functional() | {"made_by": "grafu"}
    apart["edges"] = apart["edges"][:2]
    assert FurFunFolder(put_model(tmp_path, whole=apart), points=0).models == ("fur_001",)


def test_large_graphs_are_not_cut(tmp_path):
    given, whole = unfunctional(), functional()
    for k in range(67):
        for graph in (given, whole):
            graph["nodes"][f"leg_{k}"] = {"material": "leg", "obb": {"center": [k, 0, 0], "half": [0.1, 0.1, 0.1]}}
            graph["edges"].append({"src": f"leg_{k}", "dst": "door_0", "kind": "contact"})
    assert len(pair(put_model(tmp_path, given=given, whole=whole)).target.nodes) == 71


def test_nodes_as_a_list_blender_suffixes_odd_kinds_and_doubled_edges(tmp_path):
    whole = functional()
    whole["nodes"] = list(whole["nodes"].values())
    whole["nodes"][1]["material"] = "Door.001"
    whole["nodes"][0]["material"] = "countertop"
    back = [e | {"src": e["dst"], "dst": e["src"]} for e in whole["edges"]]
    odd = [{"src": "drawer_0", "dst": "door_0", "kind": "glued"}, {"src": "door_0", "dst": "ghost", "kind": "hinge"}]
    whole["edges"] = back + whole["edges"] + odd
    found = pair(put_model(tmp_path, whole=whole)).target
    assert found.node("door_0").label is PartLabel.DOOR
    assert found.node("side_panel_0").label is PartLabel.TOP_PANEL
    assert set(found.edges) == {HINGE, RAIL, Attached("door_0", KNOB), Contact("door_0", "drawer_0")}


def test_a_quarter_turn_is_a_box_with_its_sides_exchanged(tmp_path):
    given, whole = unfunctional(), functional()
    for graph in (given, whole):
        half = graph["nodes"]["door_0"]["obb"]["half"]
        turn = {"half": [half[1], half[0], half[2]], "quat": [np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)]}
        graph["nodes"]["door_0"]["obb"] |= turn
    assert np.allclose(
        pair(put_model(tmp_path, given=given, whole=whole)).input.node("door_0").box.half, [0.24, 0.01, 0.49]
    )


def test_an_input_that_is_functional_in_part_takes_the_motion_of_the_answer(tmp_path):
    given = unfunctional()
    given["edges"][0] |= {"kind": "hinge"}
    given["edges"][1] |= {"kind": "hinge"}  # the answer states rail
    assert set(pair(put_model(tmp_path, given=given)).input.edges) == {HINGE, Contact("side_panel_0", "drawer_0")}


def test_parts_are_matched_by_name_and_place(tmp_path):
    given = unfunctional()
    given["nodes"]["drawer_0"]["obb"]["center"][0] += 0.06
    given["nodes"]["door_0"]["obb"]["center"][0] += 0.02
    given["nodes"]["lamp"] = given["nodes"]["door_0"]
    model = FurFunFolder(put_model(tmp_path, given=given), points=0).model("fur_001")
    assert model.pair.missing == ("drawer_0", KNOB)
    assert model.input.node("door_0").box == model.pair.target.node("door_0").box
    assert model.notes == (
        "left out a part of the input that the target lacks: drawer_0",
        "left out a part of the input that the target lacks: lamp",
        "took the boxes of the functional graph: those of the input lie up to 0.020 beside them",
    )


def test_graphs_of_two_models_are_refused(tmp_path):
    other = {"model_id": "x", "nodes": {"lamp": unfunctional()["nodes"]["door_0"]}, "edges": []}
    with pytest.raises(GraphError, match="`fur_001` must share parts"):
        pair(put_model(tmp_path, given=other))


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"{", "fur_001.json: a graph file must be JSON"),
        (b"\xff\xfe\x00", "fur_001.json is no text"),
        (b"[]", "fur_001.json: a graph file must be a JSON object"),
        (b'{"nodes": {"a": 3}}', "fur_001.json: node `a` must be a JSON object"),
        (b'{"nodes": 3}', "fur_001.json: `nodes` must be a JSON object"),
        (b'{"nodes": [{"material": "leg"}]}', "fur_001.json: `id` of a node must be a string"),
        (b'{"nodes": {"a": {"material": "leg"}}, "edges": {}}', "fur_001.json: "),
        (b'{"nodes": {"a": {"obb": {"center": [0, 0, NaN], "half": [1, 1, 1]}}}}', "finite numbers"),
    ],
)
def test_damaged_graphs_are_named_in_one_line(tmp_path, content, message):
    put(put_model(tmp_path) / "graphs_unfunctional" / "fur_001" / "fur_001.json", content)
    with pytest.raises((AssetError, GraphError), match=message) as caught:
        pair(tmp_path)
    assert "\n" not in str(caught.value)


def test_splits_are_read_without_models_that_are_not_there(tmp_path):
    ids = {"train_mids": ["fur_001", "fur_072"], "val_mids": ["fur_002"], "test_mids": []}
    put(put_model(put_model(tmp_path), "fur_002") / "splits" / "full_split.json", ids)
    folder = FurFunFolder(tmp_path, points=0)
    split = folder.split()
    assert (split.train, split.val, split.test) == (("fur_001",), ("fur_002",), ())
    with pytest.raises(AssetError, match=r"no split `subset_split`: it has full_split"):
        folder.split("subset_split")
    with pytest.raises(AssetError, match="holds no split"):
        folder.split("../splits/full_split")
    put(tmp_path / "splits" / "twice.json", {"train_mids": ["a"], "val_mids": ["a"]})
    with pytest.raises(AssetError, match=r"twice\.json.*`a` twice"):
        folder.split("twice")


def test_without_split_files_models_are_divided_80_10_10(tmp_path):
    for k in range(10):
        put_model(tmp_path, f"fur_{k:03d}")
    split = FurFunFolder(tmp_path, points=0).split()
    assert (len(split.train), len(split.val), len(split.test)) == (8, 1, 1)


def test_a_folder_can_be_sent_to_another_process(tmp_path):
    folder = FurFunFolder(put_model(tmp_path), points=8, seed=2)
    assert folder.models
    sent = pickle.loads(pickle.dumps(folder))
    assert sent == folder
    assert sent.pair("fur_001") == folder.pair("fur_001") == pickle.loads(pickle.dumps(folder.pair("fur_001")))


def test_a_release_gives_folds(tmp_path):
    folder = FurFunFolder(put_model(put_model(tmp_path), "fur_002"), points=8)
    pairs = list(folded((folder.pair(i) for i in folder.paired), 3))
    assert [p.model_id for p in pairs] == ["fur_001"] * 4 + ["fur_002"] * 4
    assert pairs[0] == folder.pair("fur_001")


def test_options_must_not_be_negative(tmp_path):
    with pytest.raises(ValueError, match="`points` and `seed`"):
        FurFunFolder(put_model(tmp_path), points=-1)
