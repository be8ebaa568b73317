"""The whole network: shapes, order of parts, sizes of graphs, gradients, named options."""

from dataclasses import replace

import pytest
import torch

from grafu.network.batch import Predictions, one_graph
from grafu.network.config import GraFuConfig
from grafu.network.grafu import GraFu
from joined_batches import join_batches
from random_graphs import TINY, arrays, differences, graph, tiny_network

OPTIONS = [
    TINY,
    replace(TINY, points_frame="object"),
    replace(TINY, pair_features="unsigned"),
    replace(TINY, pair_boxes="predicted"),
    replace(TINY, pair_edges=False),
    replace(TINY, free_slots=0),
    replace(TINY, second_grouping=True, second_radius=0.5, second_neighbours=3),
    replace(TINY, slots=12),
    replace(TINY, symmetric_edges=False),
    replace(TINY, vocabulary="official"),
]


def total(answers: Predictions) -> torch.Tensor:
    return torch.stack(
        [(v.float() - 1).square().mean() for k, v in vars(answers).items() if k != "mask" and v.numel()]
    ).sum()


@pytest.mark.parametrize("n", [0, 1, 2, 200])
def test_graphs_of_all_sizes_get_answers(n: int) -> None:
    answers = tiny_network()(graph(n))
    assert answers.edge.shape == (1, n + 3, n + 3, 7)
    assert answers.category.shape == (1, n + 3, 14)
    assert answers.mask.all()
    assert all(v.isfinite().all() for v in vars(answers).values())
    assert (answers.half > 0).all()


@pytest.mark.parametrize("config", OPTIONS)
def test_the_order_of_parts_changes_only_the_order_of_answers(config: GraFuConfig) -> None:
    network, one, n = tiny_network(config), arrays(6), 6
    order = torch.tensor([3, 0, 5, 1, 4, 2])
    moved = {k: v[order] for k, v in one.items()} | {"edges": one["edges"][order][:, order]}
    slots = torch.tensor([*order.tolist(), *range(n, max(n + config.free_slots, config.slots or 0))])
    assert max(differences(network(one_graph(**one)), network(one_graph(**moved)), slots).values()) < 1e-5


@pytest.mark.parametrize("config", OPTIONS)
def test_every_weight_learns(config: GraFuConfig) -> None:
    torch.manual_seed(0)
    network = GraFu(replace(config, geometry_dropout=0.0)).train()
    total(network(join_batches([graph(6, seed=1), graph(4, seed=2)]))).backward()
    still = [name for name, p in network.named_parameters() if p.grad is None or not p.grad.any()]
    # What moves all scores of a softmax alike moves nothing
    assert [name for name in still if not name.endswith("key.bias") and config.free_slots] == []


def test_gradients_stay_numbers_where_parts_coincide() -> None:
    network, one = tiny_network(), arrays(3)
    one["boxes"] = one["boxes"][:1].repeat(3, 1)
    total(network(one_graph(**one))).backward()
    assert all(p.grad is not None and p.grad.isfinite().all() for p in network.parameters())


def test_edges_have_one_kind_whichever_end_is_asked() -> None:
    edge = tiny_network()(graph(5)).edge
    assert torch.equal(edge, edge.transpose(1, 2))


def test_points_of_some_graphs_are_hidden_in_training_only() -> None:
    network = tiny_network(replace(TINY, dropout=0.0, geometry_dropout=0.5))
    batch = join_batches([graph(4)] * 16)
    known = network(batch).category
    assert torch.allclose(known, known[:1].expand_as(known), atol=1e-6)
    seen = network.train()(batch).category[:, :4].detach()
    hidden = [not torch.allclose(row, known[0, :4], atol=1e-5) for row in seen]
    assert 0 < sum(hidden) < 16


def test_materials_are_seen_and_those_of_some_graphs_are_hidden_in_training_only() -> None:
    one = arrays(4)
    clear = one | {"transparent": torch.zeros(4)}
    batch = join_batches([one_graph(**one)] * 16)
    network = tiny_network(replace(TINY, dropout=0.0, geometry_dropout=0.0, name_dropout=0.0, material_dropout=0.5))
    seen, hidden = network(one_graph(**one)).category[0], network(one_graph(**clear)).category[0]
    assert not torch.allclose(seen, hidden, atol=1e-5)
    trained = network.train()(batch).category[:, :4].detach()
    are_hidden = [torch.allclose(row, hidden[:4], atol=1e-5) for row in trained]
    are_seen = [torch.allclose(row, seen[:4], atol=1e-5) for row in trained]
    assert 0 < sum(are_hidden) < 16
    assert sum(are_hidden) + sum(are_seen) == 16
    blind = tiny_network(replace(TINY, materials=False))
    assert torch.equal(blind(one_graph(**one)).category, blind(one_graph(**clear)).category)


def test_the_kind_of_an_edge_reaches_the_pair_heads_where_asked() -> None:
    one = arrays(4)
    other = one | {"edges": one["edges"].clone()}
    other["edges"][0, 1] = other["edges"][1, 0] = (one["edges"][0, 1] + 1) % 5
    network = tiny_network()
    assert not torch.allclose(network(one_graph(**one)).edge, network(one_graph(**other)).edge, atol=1e-5)


def test_half_precision_is_near() -> None:
    network, batch = tiny_network(), graph(6)
    with torch.autocast("cpu", dtype=torch.bfloat16):
        rough = network(batch)
    assert torch.allclose(rough.edge.float(), network(batch).edge, atol=0.05)
