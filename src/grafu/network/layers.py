"""Layers for any graph: linear stacks over nodes and over pairs of nodes, and attention, plain and with edges.

Padding is never attended to; where all is padding, the output of attention is 0. `Attention` calls PyTorch's
`scaled_dot_product_attention`. `EdgeAttention` and the head of boxes need the attention weights themselves, which that
function does not return: they call `attention_weights`.
"""

import math
from itertools import pairwise
from typing import final

import torch
from torch import Tensor, nn
from torch.nn.functional import scaled_dot_product_attention

from grafu.shapes import Bool, Float


def perceptron(*widths: int) -> nn.Sequential:
    """Returns linear layers from each width to the next, with a GELU between two."""
    layers: list[nn.Module] = []
    for into, out in pairwise(widths):
        layers += [nn.Linear(into, out), nn.GELU()]
    return nn.Sequential(*layers[:-1])


@final
class PairLinear(nn.Module):
    """A linear layer over [i | j | terms of the pair], written as a sum of three.

    It is the same function, but i and j are projected once each instead of once for every pair, and no pair holds a
    copy of both: of 522 numbers into 256, for 22 nodes, a fifteenth of the multiplications.
    """

    def __init__(self, width: int, terms: int, out: int) -> None:
        super().__init__()
        self.of_first = nn.Linear(width, out)
        self.of_second = nn.Linear(width, out, bias=False)
        self.of_terms = nn.Linear(terms, out, bias=False)

    def forward(self, nodes: Float[Tensor, "b n width"], terms: Float[Tensor, "b n n t"]) -> Float[Tensor, "b n n o"]:
        """Returns the layer's output for all pairs (i, j)."""
        return self.of_terms(terms) + self.of_first(nodes)[:, :, None] + self.of_second(nodes)[:, None, :]


def masked_mean(nodes: Float[Tensor, "b n h"], mask: Bool[Tensor, "b n"]) -> Float[Tensor, "b h"]:
    """Returns the mean of the nodes in the mask; 0 where there is none."""
    return (nodes * mask[:, :, None]).sum(dim=1) / mask.sum(dim=1, keepdim=True).clamp(min=1)


_UNSEEN = -1e4  # the score of padding: exp of it is 0 in every precision, and it is no infinity


@final
class Attention(nn.Module):
    """Slots or nodes attend to slots or nodes."""

    def __init__(self, hidden: int, heads: int) -> None:
        super().__init__()
        self.heads = heads
        self.query = nn.Linear(hidden, hidden)
        self.key = nn.Linear(hidden, hidden)
        self.value = nn.Linear(hidden, hidden)
        self.out = nn.Linear(hidden, hidden)

    def forward(
        self, x: Float[Tensor, "b q h"], memory: Float[Tensor, "b k h"], mask: Bool[Tensor, "b k"]
    ) -> Float[Tensor, "b q h"]:
        """Returns what each of x draws from the memory's elements that are in the mask."""
        query, key, value = self.query(x), self.key(memory), self.value(memory)
        query, key, value = (split_heads(part, self.heads) for part in (query, key, value))
        unseen = torch.where(mask, 0.0, _UNSEEN).to(query.dtype)[:, None, None, :]
        drawn = scaled_dot_product_attention(query, key, value, attn_mask=unseen)
        return self.out(join_heads(drawn * mask.any(dim=1)[:, None, None, None]))


@final
class EdgeAttention(nn.Module):
    """Nodes attend to nodes; an edge adds W_b z_e to each head's score and W_E z_e to the value that is drawn.

    (Supplement, Graph Encoder.) Edges are averaged by each head's attention weights before W_E is applied to them, not
    after: the same sum, without a value for every pair.
    """

    def __init__(self, hidden: int, heads: int, edge: int) -> None:
        super().__init__()
        self.heads = heads
        self.query = nn.Linear(hidden, hidden)
        self.key = nn.Linear(hidden, hidden)
        self.value = nn.Linear(hidden, hidden)
        self.out = nn.Linear(hidden, hidden)
        self.bias_of_edge = nn.Linear(edge, heads, bias=False)  # a bias here would move all scores alike
        self.value_of_edge = nn.Parameter(torch.empty(heads, edge, hidden // heads))
        nn.init.uniform_(self.value_of_edge, -1 / math.sqrt(edge), 1 / math.sqrt(edge))  # as a linear layer's

    def forward(
        self, x: Float[Tensor, "b n h"], edges: Float[Tensor, "b n n e"], mask: Bool[Tensor, "b n"]
    ) -> Float[Tensor, "b n h"]:
        """Returns what each node draws from the nodes in the mask; `edges[i, j]` is that of i looking at j."""
        query, key, value = (split_heads(part(x), self.heads) for part in (self.query, self.key, self.value))
        weights = attention_weights(query, key, self.bias_of_edge(edges).permute(0, 3, 1, 2), mask)
        drawn = (weights.transpose(1, 2) @ edges.to(weights.dtype)).transpose(1, 2)  # b heads n e
        return self.out(join_heads(weights @ value + drawn @ self.value_of_edge))


def split_heads(x: Float[Tensor, "b n h"], heads: int) -> Float[Tensor, "b heads n c"]:
    """Returns the features of each head, an equal part of the width."""
    return x.reshape(*x.shape[:2], heads, x.shape[2] // heads).transpose(1, 2)


def join_heads(x: Float[Tensor, "b heads n c"]) -> Float[Tensor, "b n h"]:
    """Returns the features of all heads side by side."""
    return x.transpose(1, 2).flatten(2)


def attention_weights(
    query: Float[Tensor, "b heads q c"],
    key: Float[Tensor, "b heads k c"],
    bias: Float[Tensor, "b heads q k"] | None,
    mask: Bool[Tensor, "b k"],
) -> Float[Tensor, "b heads q k"]:
    """Returns the softmax over keys: the weights of a query sum to 1, or to 0 where all keys are padding."""
    scores = (query / math.sqrt(query.shape[-1])) @ key.transpose(2, 3)
    scores = scores if bias is None else scores + bias
    seen = mask[:, None, None, :]
    return scores.masked_fill(~seen, _UNSEEN).softmax(dim=-1).to(query.dtype) * seen
