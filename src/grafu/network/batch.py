"""The padded batch of graphs that the network reads. It knows no files and not how features are computed.

Parts' points stand in a table of their own, and nodes point into it: several corrupted copies of one model share its
rows, so that each part's points are encoded once.
"""

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import final

import torch
from jaxtyping import Bool, Float32, Int64
from torch import Tensor
from torch.nn.functional import pad

from grafu.graph.arrays import NULL


@final
@dataclass(frozen=True)
class GraphBatch:
    """Graphs of up to n nodes: codes as in `grafu.graph.arrays`, boxes (centre, half size) in the normalised frame.

    `mask` marks true nodes; what padding holds is never seen. Row `point_index` of `anchors` and `groups` holds the
    points of a node: centres of groups in the normalised frame, and each group's points relative to its centre.
    """

    labels: Int64[Tensor, "b n"]
    boxes: Float32[Tensor, "b n 6"]
    edges: Int64[Tensor, "b n n"]
    mask: Bool[Tensor, "b n"]
    point_index: Int64[Tensor, "b n"]
    anchors: Float32[Tensor, "u g 3"]
    groups: Float32[Tensor, "u g k 3"]

    def to(self, device: torch.device | str) -> "GraphBatch":
        """Returns the same batch on a device."""
        return replace(self, **{f.name: getattr(self, f.name).to(device, non_blocking=True) for f in fields(self)})


def one_graph(
    labels: Int64[Tensor, " n"],
    boxes: Float32[Tensor, "n 6"],
    anchors: Float32[Tensor, "n g 3"],
    groups: Float32[Tensor, "n g k 3"],
    edges: Int64[Tensor, "n n"],
) -> GraphBatch:
    """Returns a batch of one graph, each node with its own row of points."""
    index = torch.arange(labels.shape[0], device=labels.device)
    mask = torch.ones_like(labels, dtype=torch.bool)
    return GraphBatch(labels[None], boxes[None], edges[None], mask[None], index[None], anchors, groups)


def join_batches(batches: Sequence[GraphBatch]) -> GraphBatch:
    """Returns the graphs of all batches as one, padded to the largest; their tables of points stand one after another.

    Raises:
        ValueError: if there is no batch.
    """
    if not batches:
        raise ValueError("a batch must hold at least one graph: got none")
    n = max(batch.labels.shape[1] for batch in batches)
    starts = [0]
    for batch in batches:
        starts.append(starts[-1] + batch.anchors.shape[0])
    index = [_padded(b.point_index + start, n, 0, dims=1) for b, start in zip(batches, starts, strict=False)]
    return GraphBatch(
        labels=torch.cat([_padded(b.labels, n, 0, dims=1) for b in batches]),
        boxes=torch.cat([pad(b.boxes, (0, 0, 0, n - b.boxes.shape[1])) for b in batches]),
        edges=torch.cat([_padded(b.edges, n, NULL, dims=2) for b in batches]),
        mask=torch.cat([_padded(b.mask, n, False, dims=1) for b in batches]),
        point_index=torch.cat(index),
        anchors=torch.cat([b.anchors for b in batches]),
        groups=torch.cat([b.groups for b in batches]),
    )


def _padded(values: Tensor, n: int, fill: int | bool, dims: int) -> Tensor:
    """Returns the values with their last `dims` dimensions, all of one length, filled up to n."""
    return pad(values, (0, n - values.shape[-1]) * dims, value=fill)
