"""What is read from each slot: whether it exists, its category and its box."""

from typing import NamedTuple, final

from jaxtyping import Float
from torch import Tensor, nn
from torch.nn.functional import pad, softplus

from grafu.network.config import LABEL_COUNT
from grafu.network.perceptron import perceptron

HEAD = 128  # official.md 5


class SlotAnswers(NamedTuple):
    """Logits and boxes by slot."""

    exists: Float[Tensor, "b s"]
    category: Float[Tensor, "b s labels"]
    centre: Float[Tensor, "b s 3"]
    half: Float[Tensor, "b s 3"]


@final
class SlotHeads(nn.Module):
    """Four perceptrons; a slot of an input node says how far its centre is from the node's."""

    def __init__(self, hidden: int) -> None:
        super().__init__()
        self.exists = perceptron(hidden, HEAD, 1)
        self.category = perceptron(hidden, HEAD, LABEL_COUNT)
        self.shift = perceptron(hidden, HEAD, 3)
        self.size = perceptron(hidden, HEAD, 3)

    def forward(self, slots: Float[Tensor, "b s h"], boxes: Float[Tensor, "b n 6"]) -> SlotAnswers:
        """Returns the answers, given the boxes of the input's nodes."""
        given = pad(boxes[..., :3], (0, 0, 0, slots.shape[1] - boxes.shape[1]))
        return SlotAnswers(
            exists=self.exists(slots)[..., 0],
            category=self.category(slots),
            centre=given + self.shift(slots),
            half=softplus(self.size(slots).float()),
        )
