"""What is read from each slot: whether it exists, its category and its box."""

from typing import NamedTuple, final

import torch
from jaxtyping import Bool, Float
from torch import Tensor, nn
from torch.nn.functional import pad, softplus

from grafu.network.config import LABEL_COUNT, GraFuConfig
from grafu.network.perceptron import perceptron
from grafu.network.pointing import Pointing

HEAD = 128  # official.md 5


class SlotAnswers(NamedTuple):
    """Logits and boxes by slot."""

    exists: Float[Tensor, "b s"]
    category: Float[Tensor, "b s labels"]
    centre: Float[Tensor, "b s 3"]
    half: Float[Tensor, "b s 3"]


@final
class SlotHeads(nn.Module):
    """Four perceptrons; a slot of an input node says how far its centre is from the node's.

    Free slots say theirs beside the nodes that they point at, or else in the object's frame.
    """

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        hidden = config.hidden
        self.exists = perceptron(hidden, HEAD, 1)
        self.category = perceptron(hidden, HEAD, LABEL_COUNT)
        self.shift = perceptron(hidden, HEAD, 3)
        self.size = perceptron(hidden, HEAD, 3)
        self.pointing = Pointing(hidden) if config.free_boxes == "pointed" else None

    def forward(
        self,
        slots: Float[Tensor, "b s h"],
        nodes: Float[Tensor, "b n h"],
        boxes: Float[Tensor, "b n 6"],
        mask: Bool[Tensor, "b n"],
    ) -> SlotAnswers:
        """Returns the answers, given the encoded nodes of the input, their boxes, and which are no padding."""
        count = boxes.shape[1]
        beside, spread = pad(boxes[..., :3], (0, 0, 0, slots.shape[1] - count)), torch.zeros_like(slots[..., :3])
        if self.pointing is not None:
            centre, half = self.pointing(slots[:, count:], nodes, boxes, mask)
            beside, spread = torch.cat([boxes[..., :3], centre], dim=1), pad(half, (0, 0, count, 0))
        return SlotAnswers(
            exists=self.exists(slots)[..., 0],
            category=self.category(slots),
            centre=beside + self.shift(slots),
            half=spread + softplus(self.size(slots).float()),
        )
