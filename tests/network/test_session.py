"""A network that was exported is asked without torch: the session, and a graph completed from end to end."""

import json
from pathlib import Path

import numpy as np
import onnx
import pytest
import torch

from grafu.completion.features import FeatureConfig, graph_features
from grafu.completion.network import complete_by_network
from grafu.completion.probabilities import probabilities_of
from grafu.completion.session import NetworkSession, open_network
from grafu.errors import WeightsError
from grafu.graph.edit import as_contacts
from grafu.network.batch import one_graph
from grafu.network.export import INPUTS
from grafu.network.grafu import GraFu
from random_graphs import ANCHORS, NEIGHBOURS, POINTS, TINY, tiny_network
from small_graphs import cabinet

pytestmark = pytest.mark.slow  # for the export in `files`, as in test_onnx

FEW = FeatureConfig(points=POINTS, anchors=ANCHORS, neighbours=NEIGHBOURS)


@pytest.fixture(scope="module")
def model() -> GraFu:
    return tiny_network()


@pytest.fixture(scope="module")
def weights(files: dict[bool, bytes], tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("weights") / "tiny.onnx"
    path.write_bytes(files[False])
    return path


def test_the_session_says_what_the_network_says(model: GraFu, weights: Path) -> None:
    session = NetworkSession(weights)
    features = graph_features(cabinet(512), session.features)
    arrays = (getattr(features, name) for name in INPUTS)
    with torch.no_grad():
        expected = model(one_graph(*(torch.from_numpy(array.copy()) for array in arrays)))
    scores = session(features)

    assert session.features == FEW
    assert len(scores.exists) == len(features.labels) + TINY.free_slots
    for name in ("exists", "category", "centre", "edge", "parent", "border", "slide"):
        assert np.allclose(getattr(scores, name), getattr(expected, name)[0].numpy(), atol=1e-4)
    assert scores.hinge_abstain == pytest.approx(float(expected.hinge_abstain), abs=1e-5)


def test_a_graph_is_completed_by_weights_in_a_file(weights: Path) -> None:
    graph = as_contacts(cabinet(512))
    session = open_network(weights)
    completion = complete_by_network(graph, session, session.features)

    assert completion.source == "network"
    assert completion == complete_by_network(graph, session, session.features)


def test_the_order_of_parts_changes_no_probability(weights: Path) -> None:
    graph, session = cabinet(512), open_network(weights)
    turned = type(graph)("turned", graph.nodes[::-1], graph.edges)
    n = len(graph.nodes)
    here, there = (probabilities_of(session(graph_features(g, FEW))) for g in (graph, turned))

    assert np.allclose(here.edge[:n, :n], there.edge[:n, :n][::-1, ::-1], atol=1e-4)


def test_a_file_is_opened_once(weights: Path) -> None:
    assert open_network(weights) is open_network(weights)


def test_what_is_no_network_is_refused(tmp_path: Path) -> None:
    damaged = tmp_path / "damaged.onnx"
    damaged.write_bytes(b"no network")
    with pytest.raises(WeightsError, match="must be a network in ONNX form"):
        NetworkSession(damaged)
    with pytest.raises(WeightsError, match="there are no trained weights"):
        NetworkSession(tmp_path / "none.onnx")


def test_a_file_that_is_silent_about_its_points_is_shown_the_usual_number(weights: Path, tmp_path: Path) -> None:
    proto = onnx.load(str(weights))
    facts = {p.key: p.value for p in proto.metadata_props if p.key != "features"}
    older = tmp_path / "older.onnx"
    onnx.helper.set_model_props(proto, facts | {"config": json.dumps({"points": 8, "anchors": 4, "neighbours": 3})})
    onnx.save(proto, str(older))

    assert NetworkSession(older).features == FeatureConfig(anchors=4, neighbours=3, kinds="paper")


@pytest.mark.parametrize("features", ["many", "{}{}", '{"points": 2}', '{"pixels": 2}', "7"])
def test_a_file_that_misstates_its_points_is_refused(weights: Path, tmp_path: Path, features: str) -> None:
    proto = onnx.load(str(weights))
    facts = {p.key: p.value for p in proto.metadata_props}
    onnx.helper.set_model_props(proto, facts | {"features": features})
    other = tmp_path / "other.onnx"
    onnx.save(proto, str(other))
    with pytest.raises(WeightsError, match="how many points of a part"):
        NetworkSession(other)


def test_a_network_for_other_labels_is_refused(weights: Path, tmp_path: Path) -> None:
    proto = onnx.load(str(weights))
    onnx.helper.set_model_props(proto, {"labels": '["door"]', "config": "{}"})
    other = tmp_path / "other.onnx"
    onnx.save(proto, str(other))
    with pytest.raises(WeightsError, match="trained on other labels"):
        NetworkSession(other)


def test_a_network_that_reads_something_else_is_refused(weights: Path, tmp_path: Path) -> None:
    proto = onnx.load(str(weights))
    proto.graph.output.pop(0)
    other = tmp_path / "other.onnx"
    onnx.save(proto, str(other))
    with pytest.raises(WeightsError, match=r"must read .* and say"):
        NetworkSession(other)
