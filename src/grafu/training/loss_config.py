"""The weights and choices of the losses, with the paper's numbers (supplement, Loss Function). It computes nothing."""

from dataclasses import replace
from typing import Any, Literal, final

from grafu.dataclass import dataclass
from grafu.graph.arrays import EDGE_CODES
from grafu.visible import ShortRepr

ClassCost = Literal["cross-entropy", "probability"]
BoxError = Literal["squared", "absolute"]


@final
@dataclass(frozen=True)
class LossConfig(ShortRepr):
    """What each term weighs; a weight of 0 holds a term out (supplement, Loss Ablation).

    Departures from the paper, each with its reason:

    - `pinned`: input nodes are matched to the nodes that they are, as in the authors' code, and only free slots are
      assigned. The paper matches all slots and leaves the identity to the anchor loss to learn. Where it goes
      astray early, an input node's slot and a free one stay swapped, and the count contradicts them for good: of two
      graphs learnt by heart in 250 steps the loss was 0.0003 pinned and 1.1 not.
    - `exists_balanced` (the authors' code, not the paper): slots that should exist weigh all slots / such slots.
    - `free_positive` 10 is the paper's. By itself it makes free slots fire where the true chance is one in eleven (a
      short trial expected 250 nodes where 172 were missing): the threshold must be chosen on what is measured.
    - `box_error="absolute"`: the sum of absolute instead of squared differences. Boxes are in units of the object's
      largest side, where squares of the last few per cent hardly count.
    - `free_category`, `free_centre`, `free_half`: what free slots answer, averaged by itself, beside its part in the
      means over all matched slots. There it is one answer in ten, and lost: with these at 0, as in the paper, added
      parts were off by a fifth of the object after 2000 steps.
    - `count_smoothing`: the paper's square root has an endless slope where the count is right. With c for it the term
      is sqrt(x + c) - sqrt(c); with 0.01 its slope stays below 5.
    - `count_capped`: the paper's count is of the nodes that free slots should add, however many; a graph may lack more
      than there are free slots, which are then asked again, so here it is at most the number of free slots.

    Of a network with padding slots (`GraFuConfig.slots`), these must not exist: they count in `exists` and
    `free_exists`, whose formulas in the paper go over all slots, and over all that are not anchored; they answer for
    no node.

    Raises:
        ValueError: if a weight is negative, or there are not five weights of edge kinds.
    """

    match_category: float = 1.0
    """Weight of a wrong category in the assignment (lambda_cls)."""
    match_centre: float = 2.0
    """Weight of the distance of centres in the assignment (lambda_pos)."""
    match_cost: ClassCost = "cross-entropy"
    """The cost of a category: the paper's cross-entropy, or minus its probability, as the authors' code has it."""
    pinned: bool = True
    """Whether input nodes are matched to what they are."""

    category: float = 1.0
    centre: float = 1.0
    half: float = 0.5
    box_error: BoxError = "squared"
    exists: float = 1.0
    exists_balanced: bool = False
    free_exists: float = 3.0
    free_positive: float = 10.0
    """How much more a free slot that should exist weighs than one that should not."""
    count: float = 1.0
    count_smoothing: float = 0.01
    count_capped: bool = True
    anchor_centre: float = 0.3
    anchor_half: float = 0.3
    free_category: float = 0.0
    free_centre: float = 0.0
    free_half: float = 0.0

    edge: float = 1.0
    edge_kinds: tuple[float, ...] = (1.0, 5.0, 5.0, 3.0, 0.2, 5.0, 5.0)
    """Weights of contact, hinge, rail, attached and null (paper), and of slide and turn, which it does not have."""
    parent: float = 0.5
    hinge_target: float = 0.5

    border: float = 1.0
    sign: float = 1.0
    slide: float = 1.0

    body: float = 1.0
    """Which parts move as one; this and the next two are ours."""
    ajar: float = 0.5
    ajar_positive: float = 5.0
    """How much more a part that is drawn ajar weighs than one that is not: of three hundred parts one is."""
    piece: float = 0.2

    def __post_init__(self) -> None:
        numbers = {name: value for name, value in vars(self).items() if isinstance(value, float)}
        negative = {name: value for name, value in numbers.items() if value < 0}
        if negative or min(self.edge_kinds, default=-1.0) < 0:
            raise ValueError(f"weights of losses must not be negative: got {negative or self.edge_kinds}")
        if len(self.edge_kinds) != EDGE_CODES["all"]:
            raise ValueError(f"`edge_kinds` must be {EDGE_CODES['all']} weights: got {self.edge_kinds}")


PAPER = LossConfig(pinned=False, count_smoothing=1e-6, count_capped=False, body=0.0, ajar=0.0, piece=0.0)
"""The paper's losses; its square root has a millionth under it, so that the slope is always a number."""
OFFICIAL = replace(
    LossConfig(),
    match_cost="probability",
    exists_balanced=True,
    border=0.3,
    sign=0.3,
    slide=0.3,
    body=0.0,
    ajar=0.0,
    piece=0.0,
)  # as in the authors' code

HOLD_OUTS = {
    "hinge_target": ("hinge_target",),
    "parent": ("parent",),
    "centre": ("centre",),
    "boxes": ("half", "anchor_half"),
    "anchors": ("anchor_centre", "anchor_half"),
    "firing": ("free_exists", "count"),
}
"""The six experiments of the paper's loss ablation: which terms each leaves out (supplement, Loss Ablation)."""


def held_out(config: LossConfig, experiment: str) -> LossConfig:
    """Returns the configuration without the terms of one of `HOLD_OUTS`.

    Raises:
        KeyError: if there is no such experiment.
    """
    weights: dict[str, Any] = dict.fromkeys(HOLD_OUTS[experiment], 0.0)
    return replace(config, **weights)
