"""The paper's network by its parts: padding slots, the second grouping, edges by direction, the authors' words."""

from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest
import torch

from grafu.completion.features import group_points
from grafu.completion.session import onnx_runtime
from grafu.graph.arrays import LABEL_CODES, LABELS, NULL
from grafu.network.batch import one_graph
from grafu.network.config import OFFICIAL, PAPER, GraFuConfig
from grafu.network.export import GRAPH_OUTPUTS, INPUTS, OUTPUTS, PAIR_OUTPUTS, onnx_bytes
from grafu.network.grafu import GraFu
from grafu.network.points import PointEncoder, first_within
from grafu.network.vocabulary import OFFICIAL_WORDS, as_labels
from grafu.training.config import CONFIGS
from grafu.vocabulary import PartLabel
from joined_batches import join_batches
from random_graphs import ANCHORS, NEIGHBOURS, POINTS, TINY, arrays, graph, tiny_network

AUTHORS_PARAMETERS = 9_224_401
BUDGET = replace(TINY, slots=12)
REGROUPED = replace(TINY, second_grouping=True, second_radius=0.5, second_neighbours=3)


def parameters(config: GraFuConfig) -> int:
    return sum(p.numel() for p in GraFu(config).parameters())


def linear(into: int, out: int) -> int:
    return (into + 1) * out


def test_the_named_configuration_trains_the_paper_s_network() -> None:
    config = CONFIGS["paper"]
    assert config.network == PAPER
    assert (PAPER.slots, PAPER.free_slots) == (55, 4)
    assert (config.features.anchors, config.features.neighbours, config.features.points) == (256, 32, 512)


def test_the_number_of_weights_is_the_authors_term_by_term() -> None:
    hidden, edge, layers, head = PAPER.hidden, PAPER.edge, PAPER.encoder_layers, 128
    last_update = linear(2 * hidden + edge, 256) + linear(256, edge) + 2 * edge  # no score depends on it
    unused_head = linear(hidden, head) + linear(head, 4)  # `handle_border_4`, of weight 0
    no_bias = layers * 3 * hidden  # queries, keys and values of the encoder; inferred from the number
    words = len(OFFICIAL_WORDS) - len(LABELS)
    of_words = words * PAPER.category + words * (head + 1)
    assert parameters(OFFICIAL) == AUTHORS_PARAMETERS - last_update - unused_head + no_bias
    assert parameters(PAPER) == parameters(OFFICIAL) - of_words


@pytest.mark.parametrize("sizes", [(3, 3), (6, 4), (4, 9), (12, 2)])
def test_padding_slots_fill_each_graph_up_to_the_budget(sizes: tuple[int, int]) -> None:
    answers = tiny_network(BUDGET)(join_batches([graph(n, seed=n) for n in sizes]))
    assert answers.mask.sum(dim=1).tolist() == [max(12, n + 3) for n in sizes]
    assert answers.padding.sum(dim=1).tolist() == [max(0, 12 - n - 3) for n in sizes]
    assert not (answers.padding & ~answers.mask).any()


def test_a_graph_gets_the_same_answers_alone_and_in_a_batch_with_padding_slots() -> None:
    network, small = tiny_network(BUDGET), graph(4, seed=1)
    together, alone = network(join_batches([small, graph(7, seed=2)])), network(small)
    for name in ("exists", "category", "centre"):
        ours = getattr(together, name)[0, [0, 1, 2, 3, 7, 8, 9]]
        assert torch.allclose(ours, getattr(alone, name)[0, :7], atol=1e-5), name


def test_padding_slots_count_in_what_the_others_see() -> None:
    with_padding, without = tiny_network(BUDGET), tiny_network(replace(BUDGET, slots=7))
    assert with_padding(graph(4)).exists.shape[1] == 12
    assert not torch.allclose(with_padding(graph(4)).exists[:, :7], without(graph(4)).exists, atol=1e-4)


def test_the_first_points_within_the_radius_are_taken_in_their_order() -> None:
    points = torch.tensor([[[0.0, 0, 0], [0.9, 0, 0], [0.3, 0, 0], [0.1, 0, 0], [0.2, 0, 0]]])
    places, inside = first_within(points, points[:, :2], 0.31, 3)
    assert places[0, 0].tolist() == [0, 2, 3]
    assert inside.tolist() == [[[True, True, True], [True, False, False]]]
    assert places[0, 1, 0] == 1


def test_what_is_outside_the_radius_does_not_count() -> None:
    torch.manual_seed(0)
    encode = PointEncoder(replace(REGROUPED, second_neighbours=5))
    one = arrays(1)
    anchors = torch.tensor([[[0.0, 0, 0], [5.0, 0, 0], [0.1, 0, 0], [5.1, 0, 0], [40.0, 0, 0]]])
    changed = one["groups"].clone()
    changed[:, 4] *= 7.0  # the group at 40, which no second centre (the first half: 0 and 5) has within 0.5
    assert torch.equal(encode(anchors, one["groups"]), encode(anchors, changed))
    changed[:, 2] *= 7.0
    assert not torch.equal(encode(anchors, one["groups"]), encode(anchors, changed))


def test_where_a_part_stands_does_not_count_for_groups_of_groups() -> None:
    torch.manual_seed(0)
    encode, one = PointEncoder(REGROUPED), arrays(3)
    moved = encode(one["anchors"] + torch.tensor([0.3, -0.2, 0.1]), one["groups"])
    assert torch.allclose(moved, encode(one["anchors"], one["groups"]), atol=1e-5)


def test_groups_of_a_radius_hold_no_point_beyond_it_and_repeat_the_first_where_few_are() -> None:
    cloud = np.zeros((1, 6, 3), dtype=np.float32)
    cloud[0, :, 0] = [0.0, 1.0, 0.05, 2.0, 0.1, 0.15]
    centres, groups = group_points(cloud, 3, 4, radius=0.2)
    far = groups[0][centres[0, :, 0] == 2.0]
    assert np.abs(groups).max() <= 0.2 + 1e-6
    assert not far.any()  # the centre alone, four times
    near = group_points(cloud, 6, 4, radius=0.2)
    row = int(np.flatnonzero(near[0][0, :, 0] == 0.0)[0])
    assert near[1][0, row, :, 0].tolist() == pytest.approx([0.0, 0.05, 0.1, 0.15])


def test_directions_of_an_edge_learn_by_themselves_and_agree_in_use() -> None:
    network = tiny_network(replace(TINY, symmetric_edges=False, dropout=0.0, geometry_dropout=0.0, name_dropout=0.0))
    in_use, learning = network(graph(5)).edge, network.train()(graph(5)).edge
    assert torch.equal(in_use, in_use.transpose(1, 2))
    assert not torch.allclose(learning, learning.transpose(1, 2), atol=1e-4)
    assert torch.allclose((learning + learning.transpose(1, 2)) / 2, in_use, atol=1e-6)


def test_the_authors_words_are_answered_as_our_labels() -> None:
    logits = torch.zeros(1, 1, len(OFFICIAL_WORDS))
    logits[..., OFFICIAL_WORDS.index("leg")] = 3.0
    logits[..., OFFICIAL_WORDS.index("countertop")] = 9.0
    logits[..., OFFICIAL_WORDS.index("rail")] = 20.0
    ours = as_labels(logits, "official")[0, 0]
    assert ours.shape == (len(LABELS),)
    assert ours[LABEL_CODES[PartLabel.LEG]] == 3.0
    assert ours.argmax() == LABEL_CODES[PartLabel.TOP_PANEL]
    assert float(ours[LABEL_CODES[PartLabel.TOP_PANEL]]) == pytest.approx(9.0, abs=1e-3)


def test_labels_are_embedded_by_the_authors_codes() -> None:
    network = tiny_network(replace(TINY, vocabulary="official"))
    weight = network.encoder.nodes.category.weight
    codes = torch.arange(len(LABELS))
    for label, row in zip(LABELS, network.encoder.nodes.category(codes[None])[0], strict=True):
        assert torch.equal(row, weight[OFFICIAL_WORDS.index(label.value)])


@pytest.mark.slow  # for the export
@pytest.mark.parametrize("n", [1, 4, 30])
def test_the_file_of_such_a_network_answers_as_it_does(n: int) -> None:
    one = arrays(n)
    one["edges"] = one["edges"].clamp(max=NULL)
    found = session().run(list(OUTPUTS), {name: one[name].numpy() for name in INPUTS})
    wanted = tiny_network(ALL)(one_graph(**one))
    for name, value in zip(OUTPUTS, found, strict=True):
        expected = getattr(wanted, name).detach().numpy()
        slots = n + ALL.free_slots
        if name in PAIR_OUTPUTS:
            expected = expected[0, :slots, :slots]
        elif name not in (*GRAPH_OUTPUTS, "parent_abstain", "hinge_abstain"):
            expected = expected[0, :slots]
        assert np.abs(expected.reshape(value.shape) - value).max() < 1e-4, name


ALL = replace(
    PAPER,
    hidden=16,
    heads=2,
    encoder_layers=2,
    decoder_layers=2,
    edge=12,
    category=8,
    points=6,
    geometry=4,
    free_slots=3,
    slots=12,
    second_radius=0.5,
    second_neighbours=3,
    vocabulary="official",
)


@cache
def session() -> Any:
    """Returns the network as ONNX Runtime runs it."""
    sizes = {"points": POINTS, "anchors": ANCHORS, "neighbours": NEIGHBOURS}
    file = onnx_bytes(tiny_network(ALL), **sizes, kinds="paper", radius=0.2, half_weights=False)
    return onnx_runtime().InferenceSession(file, providers=["CPUExecutionProvider"])
