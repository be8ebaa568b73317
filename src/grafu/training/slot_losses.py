"""The losses of single slots: attributes, existence, anchors (supplement, Per-slot Loss). None is weighted here."""

from dataclasses import dataclass
from typing import final

import torch
from jaxtyping import Bool, Float
from torch import Tensor
from torch.nn import functional

from grafu.graph.arrays import UNKNOWN
from grafu.network.predictions import Predictions
from grafu.training.averages import mean_where, weighted_mean
from grafu.training.loss_config import BoxError, LossConfig
from grafu.training.slot_truth import SlotTruth


@final
@dataclass(frozen=True)
class SlotLosses:
    """Each number is a mean over the slots (the count: over the graphs) that it speaks of, before its weight."""

    category: Float[Tensor, ""]
    centre: Float[Tensor, ""]
    half: Float[Tensor, ""]
    exists: Float[Tensor, ""]
    free_exists: Float[Tensor, ""]
    count: Float[Tensor, ""]
    anchor_centre: Float[Tensor, ""]
    anchor_half: Float[Tensor, ""]
    free_category: Float[Tensor, ""]
    free_centre: Float[Tensor, ""]
    free_half: Float[Tensor, ""]


def slot_losses(predictions: Predictions, truth: SlotTruth, config: LossConfig) -> SlotLosses:
    """Returns the per-slot losses; nodes without a known label take no part in the category's."""
    centre, half, error = predictions.centre.float(), predictions.half.float(), config.box_error
    exists, categories = predictions.exists.float(), predictions.category.float()
    added = truth.matched & truth.free
    off_centre = box_errors(centre, truth.boxes[..., :3], error)
    off_size = box_errors(half, truth.boxes[..., 3:], error)
    return SlotLosses(
        category=category_loss(categories, truth, truth.matched),
        centre=mean_where(off_centre, truth.matched),
        half=mean_where(off_size, truth.matched),
        exists=exists_loss(exists, truth, config.exists_balanced),
        free_exists=free_exists_loss(exists, truth, config.free_positive),
        count=count_loss(exists, truth, config.count_smoothing),
        anchor_centre=mean_where(box_errors(centre, truth.given[..., :3], error), truth.anchored),
        anchor_half=mean_where(box_errors(half, truth.given[..., 3:], error), truth.anchored),
        free_category=category_loss(categories, truth, added),
        free_centre=mean_where(off_centre, added),
        free_half=mean_where(off_size, added),
    )


def category_loss(logits: Float[Tensor, "b s c"], truth: SlotTruth, slots: Bool[Tensor, "b s"]) -> Float[Tensor, ""]:
    """Returns the cross-entropy of the categories of these slots, where the node has a label."""
    wrong = functional.cross_entropy(logits.transpose(1, 2), truth.labels, reduction="none")
    return mean_where(wrong, slots & (truth.labels != UNKNOWN))


def box_errors(found: Float[Tensor, "b s 3"], wanted: Float[Tensor, "b s 3"], error: BoxError) -> Float[Tensor, "b s"]:
    """Returns the squared distance, or the sum of the absolute differences, of each slot."""
    apart = found - wanted
    return (apart.square() if error == "squared" else apart.abs()).sum(dim=-1)


def exists_loss(exists: Float[Tensor, "b s"], truth: SlotTruth, balanced: bool) -> Float[Tensor, ""]:
    """Returns the cross-entropy of existence over all slots: those anchored or matched should exist."""
    should, slots = truth.anchored | truth.matched, truth.anchored | truth.free
    share = slots.sum() / should.sum().clamp(min=1)
    return mean_where(_existence(exists, should, share if balanced else torch.ones_like(share)), slots)


def free_exists_loss(exists: Float[Tensor, "b s"], truth: SlotTruth, positive: float) -> Float[Tensor, ""]:
    """Returns the cross-entropy of existence over the free slots, those that should exist weighing `positive`."""
    weight = torch.full((), positive, device=exists.device)
    return mean_where(_existence(exists, truth.matched, weight), truth.free)


def count_loss(exists: Float[Tensor, "b s"], truth: SlotTruth, smoothing: float) -> Float[Tensor, ""]:
    """Returns the square root of how far the expected number of added nodes is from the number that free slots can add.

    It is the mean over the graphs that have a free slot.
    """
    expected = torch.where(truth.free, exists.sigmoid(), 0.0).sum(dim=1)
    wanted = torch.minimum(truth.missing, truth.free.sum(dim=1))
    roots = ((expected - wanted).abs() + smoothing).sqrt() - smoothing**0.5
    return weighted_mean(roots, truth.free.any(dim=1).float())


def _existence(
    exists: Float[Tensor, "b s"], should: Bool[Tensor, "b s"], positive: Float[Tensor, ""]
) -> Float[Tensor, "b s"]:
    return functional.binary_cross_entropy_with_logits(exists, should.float(), pos_weight=positive, reduction="none")
