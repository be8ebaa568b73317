"""The losses of motions at the true hinges and rails (supplement, Motion Loss), before weights."""

from dataclasses import dataclass
from typing import final

from jaxtyping import Bool, Float, Int64
from torch import Tensor
from torch.nn import functional

from grafu.graph.arrays import HINGE, NONE, RAIL
from grafu.network.predictions import Predictions
from grafu.training.slot_truth import SlotTruth


@final
@dataclass(frozen=True)
class MotionLosses:
    """Three numbers: two over hinges, one over rails."""

    border: Float[Tensor, ""]
    sign: Float[Tensor, ""]
    slide: Float[Tensor, ""]


def motion_losses(predictions: Predictions, truth: SlotTruth) -> MotionLosses:
    """Returns the cross-entropies of border, sign and slide, read at (moving part, what carries it)."""
    hinges, rails = truth.child & (truth.edges == HINGE), truth.child & (truth.edges == RAIL)
    return MotionLosses(
        border=code_loss(predictions.border.float(), truth.border, hinges),
        sign=code_loss(predictions.sign.float(), truth.sign, hinges),
        slide=code_loss(predictions.slide.float(), truth.slide, rails),
    )


def code_loss(
    logits: Float[Tensor, "b s s c"], codes: Int64[Tensor, "b s"], edges: Bool[Tensor, "b s s"]
) -> Float[Tensor, ""]:
    """Returns the mean cross-entropy over the edges of parts whose code is known."""
    graph, child, carrier = (edges & (codes != NONE)[:, :, None]).nonzero(as_tuple=True)  # few of all pairs
    wrong = functional.cross_entropy(logits[graph, child, carrier], codes[graph, child], reduction="sum")
    return wrong / max(len(graph), 1)
