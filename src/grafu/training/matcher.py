"""Which slot answers for which node: the Hungarian assignment (supplement, Set assignment). It takes no gradients.

An input node's slot is pinned to the node that it is, unless the configuration leaves even that to the assignment. The
answers are then laid out by slot: what each slot, and each pair of slots, should have said.
"""

from typing import final

import numpy as np
import torch
from scipy.optimize import linear_sum_assignment
from torch import Tensor

from grafu.dataclass import dataclass
from grafu.graph.arrays import NONE, NULL, UNKNOWN
from grafu.network.batch import Predictions
from grafu.shapes import Bool, Float, Float32, Int64
from grafu.training.loss_config import ClassCost, LossConfig
from grafu.training.targets import TargetBatch

_HOPELESS = 1e6  # stands for a cost that is not a number, so that the losses, not the assignment, show what went wrong


@torch.no_grad()
def match_slots(predictions: Predictions, targets: TargetBatch, config: LossConfig) -> Int64[Tensor, "b s"]:
    """Returns for each slot the target node that it answers for, `NONE` for padding and for slots left over.

    Padding slots, which must not exist, answer for none.
    """
    pinned = torch.full_like(predictions.exists, NONE, dtype=torch.int64)
    if config.pinned:
        pinned[:, : targets.anchors.shape[1]] = targets.anchors
    slots = predictions.mask & ~predictions.padding
    slots = slots & ~anchored_slots(predictions, targets) if config.pinned else slots
    nodes = targets.mask & ~anchored_nodes(targets) if config.pinned else targets.mask
    costs = assignment_costs(predictions, targets, config)
    found = _assign(costs.cpu().numpy(), slots.cpu().numpy(), nodes.cpu().numpy())
    assigned = torch.from_numpy(found).to(pinned.device)
    return torch.where(assigned == NONE, pinned, assigned)


def anchored_slots(predictions: Predictions, targets: TargetBatch) -> Bool[Tensor, "b s"]:
    """Returns which slots stand for input nodes: the first n, without padding."""
    anchored = torch.zeros_like(predictions.mask)
    anchored[:, : targets.anchors.shape[1]] = targets.anchors != NONE
    return anchored


def anchored_nodes(targets: TargetBatch) -> Bool[Tensor, "b t"]:
    """Returns which target nodes are in the input."""
    places = torch.where(targets.anchors == NONE, targets.mask.shape[1], targets.anchors)  # padding to a spare place
    spare = torch.zeros_like(targets.mask[:, :1])
    return torch.cat([torch.zeros_like(targets.mask), spare], dim=1).scatter(1, places, True)[:, :-1]


def assignment_costs(predictions: Predictions, targets: TargetBatch, config: LossConfig) -> Float[Tensor, "b s t"]:
    """Returns what it costs that a slot answers for a node: wrong category and distance of centres.

    A node whose label is unknown costs no category.
    """
    wrong = _category_costs(predictions.category.float(), targets.labels, config.match_cost)
    apart = torch.cdist(predictions.centre.float(), targets.boxes[..., :3])
    return config.match_category * wrong + config.match_centre * apart


def _category_costs(
    logits: Float[Tensor, "b s c"], labels: Int64[Tensor, "b t"], cost: ClassCost
) -> Float[Tensor, "b s t"]:
    table = -logits.log_softmax(dim=-1) if cost == "cross-entropy" else -logits.softmax(dim=-1)
    costs = table.gather(2, labels[:, None, :].expand(-1, table.shape[1], -1))
    return costs.masked_fill((labels == UNKNOWN)[:, None, :], 0.0)


def _assign(
    costs: Float[np.ndarray, "b s t"], slots: Bool[np.ndarray, "b s"], nodes: Bool[np.ndarray, "b t"]
) -> Int64[np.ndarray, "b s"]:
    costs = np.nan_to_num(costs, nan=_HOPELESS, posinf=_HOPELESS, neginf=_HOPELESS)
    found = np.full(slots.shape, NONE)
    for graph in np.flatnonzero(slots.any(axis=1) & nodes.any(axis=1)):
        free, missing = np.flatnonzero(slots[graph]), np.flatnonzero(nodes[graph])
        rows, columns = linear_sum_assignment(costs[graph][np.ix_(free, missing)])
        found[graph, free[rows]] = missing[columns]
    return found


@final
@dataclass(frozen=True)
class SlotTruth:
    """What s slots should answer; a slot that answers for no node has label `UNKNOWN`, null edges and no motion.

    `matched` marks the slots that answer for a node, `anchored` those of input nodes, `free` those that may answer for
    a missing one, `padding` those that must not exist. `given` are the boxes of the anchored slots' own nodes.
    `missing` counts the nodes that the input lacks.
    """

    matched: Bool[Tensor, "b s"]
    anchored: Bool[Tensor, "b s"]
    free: Bool[Tensor, "b s"]
    padding: Bool[Tensor, "b s"]
    labels: Int64[Tensor, "b s"]
    boxes: Float32[Tensor, "b s 6"]
    given: Float32[Tensor, "b s 6"]
    edges: Int64[Tensor, "b s s"]
    child: Bool[Tensor, "b s s"]
    border: Int64[Tensor, "b s"]
    sign: Int64[Tensor, "b s"]
    slide: Int64[Tensor, "b s"]
    bodies: Int64[Tensor, "b s"]
    ajar: Int64[Tensor, "b s"]
    piece: Int64[Tensor, " b"]
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
        free=predictions.mask & ~anchored & ~predictions.padding,
        padding=predictions.padding,
        labels=_nodes(targets.labels, matching, UNKNOWN),
        boxes=_boxes(targets.boxes, matching),
        given=_boxes(targets.boxes, own),
        edges=_pairs(targets.edges, matching, NULL),
        child=_pairs(targets.child, matching, False),
        border=_nodes(targets.border, matching, NONE),
        sign=_nodes(targets.sign, matching, NONE),
        slide=_nodes(targets.slide, matching, NONE),
        bodies=_nodes(targets.bodies, matching, NONE),
        ajar=_nodes(targets.ajar, matching, NONE),
        piece=targets.piece,
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
