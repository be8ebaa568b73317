"""What is written as a release is read back as it was, to six decimals, and appears whole or not at all."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from grafu.data.furfun.folder import FurFunFolder
from grafu.data.furfun.points import read_ply
from grafu.data.furfun.write import furfun_files, split_files, write_furfun
from grafu.errors import ExportError
from grafu.graph.functional_graph import paper_edges
from grafu.graph.official_json import graph_from_official
from grafu.synth.generate import make_specimen
from grafu.synth.specimen import Specimen


def specimens(count: int = 3, points: int = 64) -> list[Specimen]:
    return [make_specimen(0, k, points) for k in range(count)]


def test_a_release_round_trips_to_six_decimals(tmp_path):
    made = specimens(6)
    assert write_furfun(iter(made), tmp_path / "deep" / "out") == tuple(s.id for s in made)
    folder = FurFunFolder(tmp_path / "deep" / "out", points=64)
    assert folder.models == tuple(sorted(s.id for s in made))
    for specimen in made:
        read = folder.model(specimen.id)
        assert read.notes == ()
        for graph, truth in ((read.pair.target, specimen.truth), (read.input, specimen.given)):
            assert [(n.id, n.label) for n in graph.nodes] == [(n.id, n.label) for n in truth.nodes]
            assert set(graph.edges) == set(paper_edges(truth))
            for node, wanted in zip(graph.nodes, truth.nodes, strict=True):
                assert np.allclose([node.box.low, node.box.high], [wanted.box.low, wanted.box.high], atol=1.01e-6)
                assert np.allclose(node.points.points, wanted.points.points, rtol=0, atol=5e-7)


def test_meshes_are_written_for_realization():
    specimen = specimens(1)[0]
    files = furfun_files(specimen)
    for part in specimen.whole.parts:
        mesh = read_ply(files[f"part_geometries/{specimen.id}/{part.id}.ply"], part.id)
        assert np.allclose(mesh.vertices, part.mesh.vertices, atol=5e-7)
        assert np.array_equal(mesh.faces, part.mesh.faces)
        assert files[f"part_geometries/{specimen.id}/{part.id}.npy"][:6] == b"\x93NUMPY"


def test_missing_parts_are_in_the_answer_alone():
    whole = specimens(1)[0]
    asset = replace(whole.asset, parts=whole.asset.parts[1:])
    files = furfun_files(replace(whole, asset=asset))
    given = json.loads(files[f"graphs_unfunctional/{whole.id}/{whole.id}.json"])
    target = json.loads(files[f"graphs_functional/{whole.id}/{whole.id}.json"])
    assert list(target["nodes"])[1:] == list(given["nodes"])
    assert f"part_geometries/{whole.id}/{whole.whole.parts[0].id}.npy" in files.names
    assert target["model_id"] == given["model_id"] == whole.id


def test_every_label_version_is_written_and_read_alone():
    newest, older = {"hinge_border_4", "hinge_axis_sign"}, {"hinge_face_src", "hinge_face_dst", "hinge_direction"}
    found = 0
    for specimen in specimens(8):
        files = furfun_files(specimen)
        data = json.loads(files[f"graphs_functional/{specimen.id}/{specimen.id}.json"])
        hinges = [e for e in data["edges"] if e["kind"] == "hinge"]
        assert all((newest | older | {"hinge_border"}) <= set(e) for e in hinges)
        assert all(e["rail_axis"] == e["rail_axis_signed"] // 2 for e in data["edges"] if e["kind"] == "rail")
        assert all(e["hinge_axis"] == e["hinge_axis_signed"] // 2 for e in hinges)
        for edge in data["edges"]:
            for key in newest & set(edge):
                edge[key] = None
        assert set(graph_from_official(data).graph.edges) == set(paper_edges(specimen.truth))
        found += len(hinges)
    assert found


def test_both_splits_hold_every_model():
    files = split_files(f"m{k}" for k in range(20))
    assert files.names == ("splits/full_split.json", "splits/subset_split.json")
    split = json.loads(files["splits/full_split.json"])
    assert [len(split[key]) for key in ("train_mids", "val_mids", "test_mids")] == [16, 2, 2]


def entries(folder: Path) -> list[str]:
    return sorted(p.name for p in folder.iterdir())


def test_nothing_is_left_of_a_release_that_fails(tmp_path):
    def failing():
        yield specimens(1)[0]
        raise RuntimeError("the generator stops")

    with pytest.raises(RuntimeError, match="stops"):
        write_furfun(failing(), tmp_path / "out")
    with pytest.raises(ExportError, match="twice"):
        write_furfun([specimens(1)[0]] * 2, tmp_path / "out")
    with pytest.raises(ExportError, match="at least one model"):
        write_furfun([], tmp_path / "out")
    assert entries(tmp_path) == []


def test_a_folder_that_holds_something_is_not_touched(tmp_path):
    (tmp_path / "kept").write_text("kept")
    with pytest.raises(ExportError, match="a new or an empty folder"):
        write_furfun(specimens(1), tmp_path)
    with pytest.raises(ExportError, match="a new or an empty folder"):
        write_furfun(specimens(1), tmp_path / "kept")
    assert entries(tmp_path) == ["kept"]
    (tmp_path / "empty").mkdir()
    write_furfun(specimens(1), tmp_path / "empty")
    assert entries(tmp_path / "empty") == ["graphs_functional", "graphs_unfunctional", "part_geometries", "splits"]


def test_ids_that_are_no_file_names_are_refused():
    specimen = specimens(1)[0]
    with pytest.raises(ExportError, match="plain relative path"):
        furfun_files(replace(specimen, id="../out"))
