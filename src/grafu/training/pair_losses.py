"""The losses of pairs of slots: kinds of edges and exclusive choices (supplement, Per-pair Loss), before weights."""

from dataclasses import dataclass
from typing import final

import torch
from jaxtyping import Bool, Float
from torch import Tensor

from grafu.graph.arrays import ATTACHED, DOOR, DRAWER, HANDLE, HINGE
from grafu.network.predictions import Predictions
from grafu.training.averages import weighted_mean
from grafu.training.slot_truth import SlotTruth


@final
@dataclass(frozen=True)
class PairLosses:
    """Three numbers: over real pairs, over handles, over doors."""

    edge: Float[Tensor, ""]
    parent: Float[Tensor, ""]
    hinge_target: Float[Tensor, ""]


def pair_losses(predictions: Predictions, truth: SlotTruth, edge_kinds: tuple[float, ...]) -> PairLosses:
    """Returns the per-pair losses, the kinds of edges weighted by `edge_kinds`."""
    return PairLosses(
        edge=edge_loss(predictions.edge.float(), truth, edge_kinds),
        parent=parent_loss(predictions.parent.float(), predictions.parent_abstain.float(), truth),
        hinge_target=hinge_target_loss(predictions.hinge_target.float(), predictions.hinge_abstain.float(), truth),
    )


def edge_loss(logits: Float[Tensor, "b s s k"], truth: SlotTruth, edge_kinds: tuple[float, ...]) -> Float[Tensor, ""]:
    """Returns the cross-entropy of the kinds of edges over real pairs, a mean by the weight of the true kinds."""
    weights = torch.tensor(edge_kinds, device=logits.device)[truth.edges] * truth.real_pairs
    right = logits.log_softmax(dim=-1).gather(-1, truth.edges[..., None])[..., 0]
    return weighted_mean(-right, weights)


def parent_loss(scores: Float[Tensor, "b s s"], abstain: Float[Tensor, ""], truth: SlotTruth) -> Float[Tensor, ""]:
    """Returns how badly handles choose their one door or drawer; one whose parent is no slot should abstain."""
    movable = (truth.labels == DOOR) | (truth.labels == DRAWER)
    right = truth.child & (truth.edges == ATTACHED)
    return choice_loss(scores, abstain, truth.labels == HANDLE, movable[:, None, :] & truth.real_pairs, right)


def hinge_target_loss(
    scores: Float[Tensor, "b s s"], abstain: Float[Tensor, ""], truth: SlotTruth
) -> Float[Tensor, ""]:
    """Returns how badly doors choose what they hang on, among all that is neither door, drawer nor handle.

    A door that truly hangs on several parts may choose any of them; one whose mount is no slot should abstain.
    """
    support = ~torch.isin(truth.labels, torch.tensor([DOOR, DRAWER, HANDLE], device=scores.device))
    right = truth.child & (truth.edges == HINGE)
    return choice_loss(scores, abstain, truth.labels == DOOR, support[:, None, :] & truth.real_pairs, right)


def choice_loss(
    scores: Float[Tensor, "b s s"],
    abstain: Float[Tensor, ""],
    chooses: Bool[Tensor, "b s"],
    candidates: Bool[Tensor, "b s s"],
    right: Bool[Tensor, "b s s"],
) -> Float[Tensor, ""]:
    """Returns minus the log of the share that right candidates, or else abstaining, have in the softmax over all.

    It is the mean over the slots that choose.
    """
    graph, slot = chooses.nonzero(as_tuple=True)
    scores, right = scores[graph, slot], right[graph, slot]
    nowhere = torch.full_like(scores[:, :1], -torch.inf)
    abstains = abstain.expand(nowhere.shape)
    others = scores.masked_fill(~(candidates[graph, slot] | right), -torch.inf)
    right_abstains = torch.where(right.any(dim=-1, keepdim=True), nowhere, abstains)
    right_scores = torch.cat([scores.masked_fill(~right, -torch.inf), right_abstains], dim=-1)
    all_scores = torch.cat([others, abstains], dim=-1)
    return (all_scores.logsumexp(dim=-1) - right_scores.logsumexp(dim=-1)).sum() / max(len(slot), 1)
