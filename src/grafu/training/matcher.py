"""Which slot answers for which node: the Hungarian assignment (supplement, Set assignment). It takes no gradients.

An input node's slot is pinned to the node that it is, unless the configuration leaves even that to the assignment.
"""

import numpy as np
import torch
from jaxtyping import Bool, Float, Int64
from scipy.optimize import linear_sum_assignment
from torch import Tensor

from grafu.graph.arrays import NONE, UNKNOWN
from grafu.network.batch import Predictions
from grafu.training.loss_config import ClassCost, LossConfig
from grafu.training.targets import TargetBatch

_HOPELESS = 1e6  # stands for a cost that is not a number, so that the losses, not the assignment, show what went wrong


@torch.no_grad()
def match_slots(predictions: Predictions, targets: TargetBatch, config: LossConfig) -> Int64[Tensor, "b s"]:
    """Returns for each slot the target node that it answers for, `NONE` for padding and for slots left over."""
    pinned = torch.full_like(predictions.exists, NONE, dtype=torch.int64)
    if config.pinned:
        pinned[:, : targets.anchors.shape[1]] = targets.anchors
    slots = predictions.mask & ~anchored_slots(predictions, targets) if config.pinned else predictions.mask
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
