"""What is read from each pair of slots: the kind of their edge, and who of all is whose parent or mount."""

from typing import NamedTuple, final

import torch
from jaxtyping import Float
from torch import Tensor, nn

from grafu.network.config import EDGE_COUNT
from grafu.network.perceptron import PairLinear, perceptron

HEAD = 128  # official.md 5
EDGE_HEAD = (256, 128)


class PairAnswers(NamedTuple):
    """Logits by pair, and those of abstaining."""

    edge: Float[Tensor, "b s s kinds"]
    parent: Float[Tensor, "b s s"]
    parent_abstain: Float[Tensor, ""]
    hinge_target: Float[Tensor, "b s s"]
    hinge_abstain: Float[Tensor, ""]


@final
class PairHead(nn.Module):
    """A perceptron over the features of slots i and j and the terms of the pair."""

    def __init__(self, hidden: int, terms: int, *widths: int) -> None:
        super().__init__()
        self.first = PairLinear(hidden, terms, widths[0])
        self.rest = nn.Sequential(nn.GELU(), perceptron(*widths))

    def forward(self, slots: Float[Tensor, "b s h"], terms: Float[Tensor, "b s s t"]) -> Float[Tensor, "b s s o"]:
        """Returns the answers for all pairs (i, j)."""
        return self.rest(self.first(slots, terms))


@final
class PairHeads(nn.Module):
    """Three heads; an edge has one kind, whichever end is asked, so its logits are the mean of both ways."""

    def __init__(self, hidden: int, terms: int) -> None:
        super().__init__()
        self.edge = PairHead(hidden, terms, *EDGE_HEAD, EDGE_COUNT)
        self.parent = PairHead(hidden, terms, HEAD, 1)
        self.hinge_target = PairHead(hidden, terms, HEAD, 1)
        self.parent_abstain = nn.Parameter(torch.zeros(()))
        self.hinge_abstain = nn.Parameter(torch.zeros(()))

    def forward(self, slots: Float[Tensor, "b s h"], terms: Float[Tensor, "b s s t"]) -> PairAnswers:
        """Returns the answers for all pairs (i, j)."""
        edge = self.edge(slots, terms)
        return PairAnswers(
            edge=(edge + edge.transpose(1, 2)) / 2,
            parent=self.parent(slots, terms)[..., 0],
            parent_abstain=self.parent_abstain * 1.0,
            hinge_target=self.hinge_target(slots, terms)[..., 0],
            hinge_abstain=self.hinge_abstain * 1.0,
        )
