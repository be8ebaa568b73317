"""Attention: weights, padding, and edges as bias and as value, against the formula written out."""

import torch
from torch import nn

from grafu.network.layers import Attention, EdgeAttention, PairLinear, attention_weights, join_heads, split_heads


def test_weights_sum_to_one_over_what_is_no_padding() -> None:
    query, key = torch.randn(1, 2, 3, 4), torch.randn(1, 2, 5, 4)
    weights = attention_weights(query, key, None, torch.tensor([[True, True, False, True, False]]))
    assert torch.allclose(weights.sum(dim=-1), torch.ones(1, 2, 3))
    assert not weights[..., [2, 4]].any()


def test_nothing_is_drawn_from_padding_alone() -> None:
    weights = attention_weights(torch.randn(1, 2, 3, 4), torch.randn(1, 2, 5, 4), None, torch.zeros(1, 5).bool())
    assert not weights.any()


def test_attention_of_torch_is_that_of_the_formula() -> None:
    torch.manual_seed(0)
    layer, x, memory = Attention(12, 3), torch.randn(4, 5, 12), torch.randn(4, 7, 12)
    mask = torch.rand(4, 7) < 0.6
    mask[3] = False
    query, key, value = layer.query(x), layer.key(memory), layer.value(memory)
    weights = attention_weights(split_heads(query, 3), split_heads(key, 3), None, mask)
    wanted = layer.out(join_heads(weights @ split_heads(value, 3)))
    assert torch.allclose(layer(x, memory, mask), wanted, atol=1e-6)
    assert torch.allclose(layer(x, memory, mask)[3], layer.out.bias.expand(5, 12))


def test_edges_bias_the_score_and_add_to_the_value() -> None:
    torch.manual_seed(0)
    b, n, hidden, heads, edge = 2, 4, 6, 2, 5
    layer, x, edges = EdgeAttention(hidden, heads, edge), torch.randn(b, n, hidden), torch.randn(b, n, n, edge)
    width = hidden // heads
    wanted = torch.zeros(b, n, hidden)
    for g in range(b):
        query, key, value = (part(x[g]).view(n, heads, width) for part in (layer.query, layer.key, layer.value))
        for i in range(n):
            for h in range(heads):
                score = (key[:, h] @ query[i, h]) / width**0.5 + layer.bias_of_edge(edges[g, i])[:, h]
                drawn = value[:, h] + edges[g, i] @ layer.value_of_edge[h]
                wanted[g, i, h * width : (h + 1) * width] = score.softmax(dim=0) @ drawn
    assert torch.allclose(layer(x, edges, torch.ones(b, n).bool()), layer.out(wanted), atol=1e-6)


def test_a_pair_s_layer_is_that_of_both_nodes_and_terms_side_by_side() -> None:
    torch.manual_seed(0)
    layer, nodes, terms = PairLinear(4, 3, 7), torch.randn(2, 5, 4), torch.randn(2, 5, 5, 3)
    whole = nn.Linear(11, 7)
    whole.weight.data = torch.cat([layer.of_first.weight, layer.of_second.weight, layer.of_terms.weight], dim=1)
    whole.bias.data = layer.of_first.bias.data
    i, j = nodes[:, :, None].expand(-1, -1, 5, -1), nodes[:, None].expand(-1, 5, -1, -1)
    assert torch.allclose(layer(nodes, terms), whole(torch.cat([i, j, terms], dim=-1)), atol=1e-6)
