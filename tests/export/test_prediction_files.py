"""Predictions in the authors' form: their fields, and motions that are the same when they are read again."""

import json
from pathlib import Path

import numpy as np
import pytest

from grafu.data.furfun.points import read_ply
from grafu.errors import ExportError
from grafu.export.files import write_files
from grafu.export.formats import export
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge, Rail
from grafu.graph.edit import without_nodes
from grafu.graph.official_json import graph_from_official, prediction_from_official, prediction_to_official
from grafu.graph.official_prediction import read_prediction
from grafu.graph.parse import parse_graph
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.motion_source import MotionSource
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.synth.truth.clashes import articulated_of
from grafu.templates.gallery import builtin_gallery
from grafu.vocabulary import PartLabel
from predictions import cabinet

CABINET = cabinet()


@pytest.fixture(scope="module")
def made() -> Functionalized:
    return functionalize(CABINET.without_annotation(), MotionSource.RULE, builtin_gallery(), PipelineConfig())


@pytest.fixture(scope="module")
def folder(made: Functionalized, tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("written") / "out"
    write_files(export(made.object, ["grafu-pred"], made.completion), out)
    return out / "prediction"


def test_nodes_and_edges_have_the_authors_fields(made: Functionalized, folder: Path) -> None:
    name = made.completion.input.model_id
    data = json.loads((folder / f"{name}_pred.json").read_text())
    assert data["model_id"] == name
    for slot, (key, node) in enumerate(data["nodes"].items()):
        assert node["id"] == key == f"slot{slot:02d}_{node['material'].replace(' ', '_')}"
        assert node["slot"] == slot
        assert (node["type"] == "dynamic") == (node["material"] in ("door", "drawer", "handle"))
        assert min(node["obb"]["half"]) >= 0.005
    order = list(data["nodes"])
    by_kind = {edge["kind"]: set(edge) - {"src", "dst", "kind"} for edge in data["edges"]}
    assert all(order.index(edge["src"]) < order.index(edge["dst"]) for edge in data["edges"])
    assert by_kind["hinge"] == {"hinge_border_4", "hinge_axis_sign", "hinge_border", "hinge_axis_signed"}
    assert by_kind["rail"] == {"rail_axis_signed"}
    assert by_kind["contact"] == set()


def test_the_graph_that_was_predicted_from_lies_beside_it_in_slot_order(made: Functionalized, folder: Path) -> None:
    name = made.completion.input.model_id
    given = graph_from_official(json.loads((folder / f"{name}_input.json").read_text())).graph
    assert [node.id for node in given.nodes] == [node.id for node in made.completion.input.nodes]
    manifest = json.loads((folder / "inference_manifest.json").read_text())[name]
    assert (folder / manifest["input"]).is_file()
    meshes = {path.stem for path in (folder / manifest["mesh_dir"]).iterdir()}
    assert meshes == {node.id for node in given.nodes}


def test_meshes_stand_where_the_boxes_do(made: Functionalized, folder: Path) -> None:
    name = made.completion.input.model_id
    for node in made.completion.input.nodes:
        mesh = read_ply((folder / "part_geometries" / name / f"{node.id}.ply").read_bytes(), node.id)
        assert isinstance(mesh, TriangleMesh)
        np.testing.assert_allclose(mesh.box.center, node.box.center, atol=0.02)  # clearance may trim a part


def test_what_is_read_again_is_what_was_written(made: Functionalized) -> None:
    told = made.completion
    again = prediction_from_official(prediction_to_official(told), told.input)
    assert _motions(again) == _motions(told)
    new = [node.label for node in again.completed.nodes if node.id in again.added]
    assert sorted(new) == sorted(told.completed.node(name).label for name in told.added)


def test_new_nodes_have_the_slots_behind_those_of_the_input(made: Functionalized) -> None:
    graph = made.completion.completed
    handle = next(node for node in graph.nodes if node.label is PartLabel.HANDLE)
    lacking = parse_graph(CABINET.without_annotation())
    given = without_nodes(lacking, [handle.id])
    new = tuple(node.id for node in graph.nodes if node.id not in given)
    data = prediction_to_official(GraphCompletion(given, graph, "test", new, (), made.completion.refused))
    places = [node["obb"]["center"] for node in data["nodes"].values() if node["slot"] >= len(given.nodes)]
    assert len(places) == len(new) >= 1
    assert any(place == pytest.approx(handle.box.center, abs=1e-6) for place in places)


def test_the_motion_source_reads_the_file(made: Functionalized, folder: Path) -> None:
    motions = read_prediction(folder / f"{made.completion.input.model_id}_pred.json")
    moving = {edge.child for edge in made.completion.completed.edges if isinstance(edge, Hinge | Rail)}
    assert len(motions.joints) == len(moving)


def test_an_object_without_a_graph_is_refused() -> None:
    with pytest.raises(ExportError, match="`grafu-pred` holds a completed graph"):
        export(articulated_of(CABINET), ["glb", "grafu-pred"])


def _motions(completion: GraphCompletion) -> set[object]:
    edges = completion.completed.edges
    return {(e.parent, e.child, e.border, e.sign) for e in edges if isinstance(e, Hinge)} | {
        (e.parent, e.child, e.axis) for e in edges if isinstance(e, Rail)
    }
