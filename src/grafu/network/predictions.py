"""What the network says about a batch of graphs: logits and boxes by slot and by pair of slots. It decides nothing."""

from dataclasses import dataclass
from typing import final

from jaxtyping import Bool, Float
from torch import Tensor


@final
@dataclass(frozen=True)
class Predictions:
    """Scores of s = n + K slots: first one for each input node, padding included, then the K free ones.

    All scores are logits. Boxes stand in the normalised frame of the input. A pair (i, j) asks about i as the child,
    the door, drawer or handle, and j as what carries it; `edge` is symmetric. `parent_abstain` and `hinge_abstain` are
    the scores that i's parent, or mount, is none of the slots. Borders, signs and slides are official motion codes.
    `mask` marks slots that are no padding.
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
    mask: Bool[Tensor, "b s"]
