"""Batches: joined, padded, and what padding must not change."""

import pytest
import torch

from grafu.network.batch import GraphBatch
from joined_batches import join_batches
from random_graphs import differences, graph, tiny_network


def test_joined_graphs_keep_their_points() -> None:
    joined = join_batches([graph(3, seed=1), graph(2, seed=2)])
    assert joined.labels.shape == (2, 3)
    assert joined.mask.tolist() == [[True] * 3, [True, True, False]]
    assert torch.equal(joined.anchors[joined.point_index[1, :2]], graph(2, seed=2).anchors)
    assert (joined.edges[1, 2] == 4).all()


def test_copies_share_the_rows_of_their_points() -> None:
    one = graph(4)
    copies = GraphBatch(
        labels=one.labels.repeat(2, 1),
        boxes=one.boxes.repeat(2, 1, 1),
        edges=one.edges.repeat(2, 1, 1),
        mask=torch.tensor([[True] * 4, [True] * 3 + [False]]),
        point_index=torch.tensor([[0, 1, 2, 3], [0, 1, 2, 0]]),
        anchors=one.anchors,
        groups=one.groups,
        visibility=one.visibility.repeat(2, 1, 1),
        names=one.names.repeat(2, 1, 1),
        transparent=one.transparent.repeat(2, 1),
    )
    network = tiny_network()
    answers = network(join_batches([graph(2, seed=5), copies]))
    assert torch.allclose(answers.category[1, :4], network(one).category[0, :4], atol=1e-6)


@pytest.mark.parametrize("n", [0, 1, 4, 6])
def test_a_graph_among_others_gets_the_answers_it_gets_alone(n: int) -> None:
    network = tiny_network()
    joined = join_batches([graph(6, seed=1), graph(n, seed=2), graph(3, seed=3)])
    answers = network(joined)
    own = torch.tensor([*range(n), *range(6, 9)])
    found = type(answers)(**{k: v[1:2] if v.ndim else v for k, v in vars(answers).items()})
    assert max(differences(found, network(graph(n, seed=2)), own).values()) < 1e-5


def test_what_padding_holds_is_never_seen() -> None:
    network = tiny_network()
    plain = join_batches([graph(5), graph(2)])
    spoilt = GraphBatch(**vars(plain) | {
        "labels": plain.labels.masked_fill(~plain.mask, 3),
        "boxes": plain.boxes.masked_fill(~plain.mask[..., None], 7.0),
        "visibility": plain.visibility.masked_fill(~plain.mask[..., None], 5.0),
        "names": plain.names.masked_fill(~plain.mask[..., None], 5),
        "edges": plain.edges.masked_fill(~(plain.mask[:, :, None] & plain.mask[:, None, :]), 1),
    })  # fmt: skip
    a, b = network(plain), network(spoilt)
    own = torch.tensor([0, 1, 5, 6, 7])
    for name in ("exists", "category", "centre", "half"):
        assert torch.allclose(getattr(a, name)[1, own], getattr(b, name)[1, own], atol=1e-6)
    assert torch.allclose(a.edge[1][own][:, own], b.edge[1][own][:, own], atol=1e-6)
