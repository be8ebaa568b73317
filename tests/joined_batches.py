"""Graphs of several batches as one, padded: to ask a network about all of them at once."""

from collections.abc import Sequence

import torch  # noqa: TID251  # for tests of network and training alone
from torch import Tensor  # noqa: TID251
from torch.nn.functional import pad  # noqa: TID251

from grafu.graph.arrays import NULL
from grafu.network.batch import GraphBatch


def join_batches(batches: Sequence[GraphBatch]) -> GraphBatch:
    """Returns the graphs of all batches as one, padded to the largest, their tables of points one after another."""
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
        visibility=torch.cat([pad(b.visibility, (0, 0, 0, n - b.visibility.shape[1])) for b in batches]),
        names=torch.cat([pad(b.names, (0, 0, 0, n - b.names.shape[1])) for b in batches]),
        transparent=torch.cat([pad(b.transparent, (0, n - b.transparent.shape[1])) for b in batches]),
    )


def _padded(values: Tensor, n: int, fill: int | bool, dims: int) -> Tensor:
    """Returns the values with their last `dims` dimensions, all of one length, filled up to n."""
    return pad(values, (0, n - values.shape[-1]) * dims, value=fill)
