"""The padded batch of graphs that the network reads, and what it states about them.

Parts' points stand in a table of their own, and nodes point into it: several corrupted copies of one model share its
rows, so that each part's points are encoded once. Predictions are logits and boxes by slot and by pair of slots.
"""

from dataclasses import fields, replace
from typing import final

import torch
from torch import Tensor

from grafu.dataclass import dataclass
from grafu.shapes import Bool, Float, Float32, Int64


@final
@dataclass(frozen=True)
class Predictions:
    """Scores of s slots: one for each of n input nodes, padding included, then the K free ones, then padding slots.

    All scores are logits. Boxes stand in the normalised frame of the input. A pair (i, j) asks about i as the child,
    the door, drawer or handle, and j as what carries it; `edge` is symmetric. `parent_abstain` and `hinge_abstain` are
    the scores that i's parent, or mount, is none of the slots. Borders, signs and slides are official motion codes.
    `body` is that i and j move as one, symmetric; `ajar` that a part is drawn open; `piece` the kind of the whole. A
    network without `facts` answers 0 there.
    `mask` marks the slots of a graph; the others only fill the batch. `padding` marks those among them that belong to
    no node, given or missing, and must not exist: the paper's padding slots, of a network that has them.
    """

    exists: Float[Tensor, "b s"]
    category: Float[Tensor, "b s labels"]
    centre: Float[Tensor, "b s 3"]
    half: Float[Tensor, "b s 3"]
    edge: Float[Tensor, "b s s kinds"]
    parent: Float[Tensor, "b s s"]
    parent_abstain: Float[Tensor, ""]
    hinge_target: Float[Tensor, "b s s"]
    hinge_abstain: Float[Tensor, ""]
    border: Float[Tensor, "b s s 4"]
    sign: Float[Tensor, "b s s 2"]
    slide: Float[Tensor, "b s s 6"]
    body: Float[Tensor, "b s s"]
    ajar: Float[Tensor, "b s"]
    piece: Float[Tensor, "b pieces"]
    mask: Bool[Tensor, "b s"]
    padding: Bool[Tensor, "b s"]


@final
@dataclass(frozen=True)
class GraphBatch:
    """Graphs of up to n nodes: codes as in `grafu.graph.arrays`, boxes (centre, half size) in the normalised frame.

    `mask` marks true nodes; what padding holds is never seen. Row `point_index` of `anchors` and `groups` holds the
    points of a node: centres of groups in the normalised frame, and each group's points relative to its centre.
    `visibility` is that of `grafu.completion.visibility`, `names` those of `grafu.completion.name_codes`;
    `transparent` the fractions of surfaces through which one sees.
    """

    labels: Int64[Tensor, "b n"]
    boxes: Float32[Tensor, "b n 6"]
    edges: Int64[Tensor, "b n n"]
    mask: Bool[Tensor, "b n"]
    point_index: Int64[Tensor, "b n"]
    anchors: Float32[Tensor, "u g 3"]
    groups: Float32[Tensor, "u g k 3"]
    visibility: Float32[Tensor, "b n v"]
    names: Int64[Tensor, "b n c"]
    transparent: Float32[Tensor, "b n"]

    def to(self, device: torch.device | str) -> "GraphBatch":
        """Returns the same batch on a device."""
        return replace(self, **{f.name: getattr(self, f.name).to(device, non_blocking=True) for f in fields(self)})


def one_graph(
    labels: Int64[Tensor, " n"],
    boxes: Float32[Tensor, "n 6"],
    anchors: Float32[Tensor, "n g 3"],
    groups: Float32[Tensor, "n g k 3"],
    edges: Int64[Tensor, "n n"],
    visibility: Float32[Tensor, "n v"],
    names: Int64[Tensor, "n c"],
    transparent: Float32[Tensor, " n"],
) -> GraphBatch:
    """Returns a batch of one graph, each node with its own row of points."""
    index = torch.arange(labels.shape[0], device=labels.device)
    mask = torch.ones_like(labels, dtype=torch.bool)
    return GraphBatch(
        labels[None],
        boxes[None],
        edges[None],
        mask[None],
        index[None],
        anchors,
        groups,
        visibility[None],
        names[None],
        transparent[None],
    )
