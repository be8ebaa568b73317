"""The answers laid out by slot: what each slot, and each pair of slots, should have said. It knows no losses."""

from dataclasses import dataclass
from typing import final

import torch
from jaxtyping import Bool, Float32, Int64
from torch import Tensor

from grafu.graph.arrays import NONE, NULL, UNKNOWN
from grafu.network.batch import Predictions
from grafu.training.matcher import anchored_nodes, anchored_slots
from grafu.training.targets import TargetBatch


@final
@dataclass(frozen=True)
class SlotTruth:
    """What s slots should answer; a slot that answers for no node has label `UNKNOWN`, null edges and no motion.

    `matched` marks the slots that answer for a node, `anchored` those of input nodes, `free` the others that are no
    padding. `given` are the boxes of the anchored slots' own nodes. `missing` counts the nodes that the input lacks.
    """

    matched: Bool[Tensor, "b s"]
    anchored: Bool[Tensor, "b s"]
    free: Bool[Tensor, "b s"]
    labels: Int64[Tensor, "b s"]
    boxes: Float32[Tensor, "b s 6"]
    given: Float32[Tensor, "b s 6"]
    edges: Int64[Tensor, "b s s"]
    child: Bool[Tensor, "b s s"]
    border: Int64[Tensor, "b s"]
    sign: Int64[Tensor, "b s"]
    slide: Int64[Tensor, "b s"]
    missing: Int64[Tensor, " b"]

    @property
    def real_pairs(self) -> Bool[Tensor, "b s s"]:
        """The pairs of different slots that both answer for a node."""
        apart = ~torch.eye(self.matched.shape[1], dtype=torch.bool, device=self.matched.device)
        return self.matched[:, :, None] & self.matched[:, None, :] & apart


def slot_truth(predictions: Predictions, targets: TargetBatch, matching: Int64[Tensor, "b s"]) -> SlotTruth:
    """Returns the answers in the order of the slots, given which node each slot answers for."""
    matched, anchored = matching != NONE, anchored_slots(predictions, targets)
    own = torch.full_like(matching, NONE)
    own[:, : targets.anchors.shape[1]] = targets.anchors
    return SlotTruth(
        matched=matched,
        anchored=anchored,
        free=predictions.mask & ~anchored,
        labels=_nodes(targets.labels, matching, UNKNOWN),
        boxes=_boxes(targets.boxes, matching),
        given=_boxes(targets.boxes, own),
        edges=_pairs(targets.edges, matching, NULL),
        child=_pairs(targets.child, matching, False),
        border=_nodes(targets.border, matching, NONE),
        sign=_nodes(targets.sign, matching, NONE),
        slide=_nodes(targets.slide, matching, NONE),
        missing=(targets.mask & ~anchored_nodes(targets)).sum(dim=1),
    )


def _nodes(values: Int64[Tensor, "b t"], matching: Int64[Tensor, "b s"], absent: int) -> Int64[Tensor, "b s"]:
    return _with_spare(values, absent, dim=1).gather(1, _places(matching, values.shape[1]))


def _boxes(boxes: Float32[Tensor, "b t 6"], matching: Int64[Tensor, "b s"]) -> Float32[Tensor, "b s 6"]:
    places = _places(matching, boxes.shape[1])[:, :, None].expand(-1, -1, 6)
    return _with_spare(boxes, 0.0, dim=1).gather(1, places)


def _pairs(values: Tensor, matching: Int64[Tensor, "b s"], absent: int | bool) -> Tensor:
    places = _places(matching, values.shape[1])
    padded = _with_spare(_with_spare(values, absent, dim=1), absent, dim=2)
    rows = padded.gather(1, places[:, :, None].expand(-1, -1, padded.shape[2]))
    return rows.gather(2, places[:, None, :].expand(-1, places.shape[1], -1))


def _places(matching: Int64[Tensor, "b s"], spare: int) -> Int64[Tensor, "b s"]:
    """Returns where to read: slots that answer for no node read the spare place behind the last node."""
    return torch.where(matching == NONE, spare, matching)


def _with_spare(values: Tensor, fill: float | int | bool, dim: int) -> Tensor:
    shape = list(values.shape)
    shape[dim] = 1
    return torch.cat([values, torch.full(shape, fill, dtype=values.dtype, device=values.device)], dim=dim)
