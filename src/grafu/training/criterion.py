"""The whole loss: match slots to nodes, lay the answers out by slot, take every term, weigh and add."""

from dataclasses import dataclass
from typing import final

import torch
from jaxtyping import Float
from torch import Tensor

from grafu.network.predictions import Predictions
from grafu.training.loss_config import LossConfig
from grafu.training.matcher import match_slots
from grafu.training.motion_losses import MotionLosses, motion_losses
from grafu.training.pair_losses import PairLosses, pair_losses
from grafu.training.slot_losses import SlotLosses, slot_losses
from grafu.training.slot_truth import slot_truth
from grafu.training.targets import TargetBatch


@final
@dataclass(frozen=True)
class LossTerms:
    """The weighted sum, which is what is minimised, and each term before its weight."""

    total: Float[Tensor, ""]
    slots: SlotLosses
    pairs: PairLosses
    motions: MotionLosses

    def by_name(self) -> dict[str, Tensor]:
        """Returns every number without gradients, by name, the total first; the names are `LossConfig`'s weights."""
        terms = {"total": self.total} | vars(self.slots) | vars(self.pairs) | vars(self.motions)
        return {name: value.detach() for name, value in terms.items()}


def criterion(predictions: Predictions, targets: TargetBatch, config: LossConfig) -> LossTerms:
    """Returns the loss of a batch of predictions (supplement, Loss Function); losses are computed in float32."""
    matching = match_slots(predictions, targets, config)
    truth = slot_truth(predictions, targets, matching)
    slots = slot_losses(predictions, truth, config)
    pairs = pair_losses(predictions, truth, config.edge_kinds)
    motions = motion_losses(predictions, truth)
    terms = vars(slots) | vars(pairs) | vars(motions)
    total = torch.stack([getattr(config, name) * term for name, term in terms.items()]).sum()
    return LossTerms(total, slots, pairs, motions)
