"""What is read from each pair of a moving part and its mount: the motion, as classes (paper, Motion Parameters)."""

from typing import NamedTuple, final

from jaxtyping import Float
from torch import Tensor, nn

from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS
from grafu.network.pair_heads import HEAD, PairHead


class MotionAnswers(NamedTuple):
    """Logits by pair (moving part, mount)."""

    border: Float[Tensor, "b s s 4"]
    sign: Float[Tensor, "b s s 2"]
    slide: Float[Tensor, "b s s 6"]


@final
class MotionHeads(nn.Module):
    """The border that carries a door's pin, the sense of its axis, and the signed axis of a drawer."""

    def __init__(self, hidden: int, terms: int) -> None:
        super().__init__()
        self.border = PairHead(hidden, terms, HEAD, len(BORDERS))
        self.sign = PairHead(hidden, terms, HEAD, len(SIGNS))
        self.slide = PairHead(hidden, terms, HEAD, len(SIGNED_AXES))

    def forward(self, slots: Float[Tensor, "b s h"], terms: Float[Tensor, "b s s t"]) -> MotionAnswers:
        """Returns the answers for all pairs (i, j), i being what moves."""
        return MotionAnswers(self.border(slots, terms), self.sign(slots, terms), self.slide(slots, terms))
