"""Scores as probabilities, and the mean of a pass over a graph and one over its mirror image."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.completion.features import SCORE_NAMES, FeatureConfig, GraphFeatures, Scores, graph_features
from grafu.completion.network import complete_by_network, forward, with_image
from grafu.completion.probabilities import averaged, mirrored_back, probabilities_of, softmax
from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS
from grafu.graph.edit import mirrored as mirrored_graph
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import mirror_face, mirror_hinge
from network_answers import Answers, silent
from small_graphs import cabinet

FEW = FeatureConfig(points=16, anchors=2, neighbours=2)
DOOR = [node.id for node in cabinet().nodes].index("door_1")
THIN = np.array([node.box.thin_axis for node in cabinet().nodes])


def test_probabilities_sum_to_one() -> None:
    probabilities = probabilities_of(silent(cabinet()))

    assert np.allclose(probabilities.label.sum(axis=1), 1)
    assert np.allclose(probabilities.edge.sum(axis=2), 1)
    assert np.allclose(probabilities.hinge.sum(axis=(2, 3)), 1)
    assert np.allclose(probabilities.slide.sum(axis=2), 1)
    assert ((probabilities.exists >= 0) & (probabilities.exists <= 1)).all()


def test_large_logits_stay_finite() -> None:
    assert softmax(np.array([1e4, -1e4, 0.0])).tolist() == [1.0, 0.0, 0.0]
    assert softmax(np.zeros((3, 0))).shape == (3, 0)


@pytest.mark.parametrize("across", [0, 1])
@given(border=st.sampled_from(BORDERS), sign=st.sampled_from(SIGNS), axis=st.sampled_from(SIGNED_AXES))
def test_what_is_said_of_the_image_is_said_of_the_graph(across: int, border: int, sign: int, axis: int) -> None:
    graph = cabinet()
    there = mirror_hinge(int(THIN[DOOR]), border, sign, across)
    said = Answers(hinges={"door_1": there}, slides={"door_1": mirror_face(axis, across)})
    back = mirrored_back(probabilities_of(said.about(graph)(seen(graph))), THIN, across)

    assert back.hinge[DOOR, 0].argmax() == 2 * border + sign
    assert back.slide[DOOR, 0].argmax() == axis
    assert back.centre[:, across] == pytest.approx(0)


def seen(graph: FunctionalGraph) -> GraphFeatures:
    return graph_features(graph, FEW)


def test_twice_mirrored_is_as_before() -> None:
    probabilities = probabilities_of(
        Answers(hinges={"door_1": (1, 0)}, slides={"drawer_1": 2}).about(cabinet())(seen(cabinet()))
    )

    assert mirrored_back(mirrored_back(probabilities, THIN, 0), THIN, 0) == probabilities


def test_the_mean_is_of_seen_slots_alone() -> None:
    graph, n = cabinet(), len(cabinet().nodes)
    one = probabilities_of(Answers(slides={"drawer_1": 2}).about(graph)(seen(graph)))
    two = probabilities_of(Answers(slides={"drawer_1": 3, "free0": 5}).about(graph)(seen(graph)))
    mean = averaged(one, two, n)

    assert np.allclose(mean.slide[:n, :n], (one.slide[:n, :n] + two.slide[:n, :n]) / 2)
    assert np.array_equal(mean.slide[n:], one.slide[n:])
    assert averaged(one, one, n) == one


def test_with_the_image_left_and_right_weigh_the_same() -> None:
    """A network with one answer, whatever it sees, states nothing about left and right when asked twice."""
    graph = cabinet()
    stubborn = Answers(slides={"drawer_1": 0}).about(graph)
    inputs, once = forward(graph, stubborn, FEW)
    probabilities = with_image(once, graph, inputs, stubborn)
    drawer = [node.id for node in graph.nodes].index("drawer_1")

    assert probabilities.slide[drawer, 0, 0] == pytest.approx(probabilities.slide[drawer, 0, 1])


def test_with_the_image_the_mirrored_graph_is_completed_in_the_mirror() -> None:
    graph = cabinet()
    bare = replace(graph, edges=())

    def by_place(features: GraphFeatures) -> Scores:
        """Slides towards where a part stands: a network whose answers turn with what it sees."""
        scores = silent(bare)
        slide, edge = scores.slide.copy(), scores.edge.copy()
        n = len(features.labels)
        slide[:n, :, 1] = 9 * features.boxes[:, 0, None]
        edge[:n, :n, 2] = edge[:n, :n, 0] = 9.0
        return replace(scores, slide=slide, edge=edge)

    here = complete_by_network(bare, by_place, FEW)
    there = complete_by_network(mirrored_graph(bare, 0), by_place, FEW)
    slides = ({rail.child: rail.axis for rail in found.completed.rails} for found in (here, there))
    assert {k: mirror_face(axis, 0) for k, axis in next(slides).items()} == next(slides)


def test_scores_are_named_as_the_network_names_them() -> None:
    assert SCORE_NAMES[:4] == ("exists", "category", "centre", "half")
    assert len(SCORE_NAMES) == 15
