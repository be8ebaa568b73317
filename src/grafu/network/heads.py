"""What is read from slots: existence, category, box; of pairs their edge, parent and mount; of moving pairs the motion.

The position of the part of a free slot is computed from the nodes that the slot points at, in units of their sizes.
Motions are classes (paper, Motion Parameters).
"""

from typing import NamedTuple, final

import torch
from torch import Tensor, nn
from torch.nn.functional import gelu, pad, softplus

from grafu.graph.edges import BORDERS, SIGNED_AXES, SIGNS
from grafu.network.config import GraFuConfig
from grafu.network.layers import PairLinear, attention_weights, perceptron
from grafu.network.vocabulary import as_labels, category_count
from grafu.shapes import Bool, Float
from grafu.vocabulary import PieceKind

WIDTH = 128
_THIN = -4.0  # shifts sizes so that at first a part adds a fiftieth of its own


@final
class Pointing(nn.Module):
    """Each slot attends to the nodes; each node predicts where the slot's part is, and how large."""

    def __init__(self, hidden: int) -> None:
        super().__init__()
        self.query, self.key = nn.Linear(hidden, WIDTH), nn.Linear(hidden, WIDTH)
        self.of_slot, self.of_node = nn.Linear(hidden, WIDTH), nn.Linear(hidden, WIDTH, bias=False)
        self.said = nn.Linear(WIDTH, 6)

    def forward(
        self,
        slots: Float[Tensor, "b k h"],
        nodes: Float[Tensor, "b n h"],
        boxes: Float[Tensor, "b n 6"],
        mask: Bool[Tensor, "b n"],
    ) -> tuple[Float[Tensor, "b k 3"], Float[Tensor, "b k 3"]]:
        """Returns the mean of what the nodes say of each slot's centre and half size, by how much it points at each."""
        query, key = self.query(slots)[:, None], self.key(nodes)[:, None]
        weights = attention_weights(query, key, None, mask)[:, 0].float()
        said = self.said(gelu(self.of_slot(slots)[:, :, None] + self.of_node(nodes)[:, None])).float()
        centres, halves = boxes[:, None, :, :3], boxes[:, None, :, 3:]
        centre = centres + halves * said[..., :3]
        half = halves * softplus(said[..., 3:] + _THIN)
        return torch.einsum("bkn,bknc->bkc", weights, centre), torch.einsum("bkn,bknc->bkc", weights, half)


HEAD = 128  # as in the authors' code


class SlotAnswers(NamedTuple):
    """Logits and boxes by slot."""

    exists: Float[Tensor, "b s"]
    category: Float[Tensor, "b s labels"]
    centre: Float[Tensor, "b s 3"]
    half: Float[Tensor, "b s 3"]


@final
class SlotHeads(nn.Module):
    """Four perceptrons; a slot of an input node states how far its centre is from the node's.

    Free slots say theirs beside the nodes that they point at, or else in the object's frame.
    """

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        hidden, self.free = config.hidden, config.free_slots
        self.exists = perceptron(hidden, HEAD, 1)
        self.vocabulary = config.vocabulary
        self.category = perceptron(hidden, HEAD, category_count(config.vocabulary))
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
        count, dull = boxes.shape[1], slots.shape[1] - boxes.shape[1] - self.free
        beside, spread = pad(boxes[..., :3], (0, 0, 0, slots.shape[1] - count)), torch.zeros_like(slots[..., :3])
        if self.pointing is not None:
            centre, half = self.pointing(slots[:, count : count + self.free], nodes, boxes, mask)
            beside = pad(torch.cat([boxes[..., :3], centre], dim=1), (0, 0, 0, dull))
            spread = pad(half, (0, 0, count, dull))
        return SlotAnswers(
            exists=self.exists(slots)[..., 0],
            category=as_labels(self.category(slots), self.vocabulary),
            centre=beside + self.shift(slots),
            half=spread + softplus(self.size(slots).float()),
        )


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
    """Three heads; an edge has one kind, whichever end is asked, so its logits are the mean of both ways.

    Without `symmetric`, each way learns by itself, and the mean is taken in use.
    """

    def __init__(self, hidden: int, terms: int, codes: int, symmetric: bool) -> None:
        super().__init__()
        self.symmetric = symmetric
        self.edge = PairHead(hidden, terms, *EDGE_HEAD, codes)
        self.parent = PairHead(hidden, terms, HEAD, 1)
        self.hinge_target = PairHead(hidden, terms, HEAD, 1)
        self.parent_abstain = nn.Parameter(torch.zeros(()))
        self.hinge_abstain = nn.Parameter(torch.zeros(()))

    def forward(self, slots: Float[Tensor, "b s h"], terms: Float[Tensor, "b s s t"]) -> PairAnswers:
        """Returns the answers for all pairs (i, j)."""
        edge = self.edge(slots, terms)
        return PairAnswers(
            edge=(edge + edge.transpose(1, 2)) / 2 if self.symmetric or not self.training else edge,
            parent=self.parent(slots, terms)[..., 0],
            parent_abstain=self.parent_abstain * 1.0,
            hinge_target=self.hinge_target(slots, terms)[..., 0],
            hinge_abstain=self.hinge_abstain * 1.0,
        )


class FactAnswers(NamedTuple):
    """Logits: of pairs that they move as one, of slots that they are drawn open, of the whole what it is."""

    body: Float[Tensor, "b s s"]
    ajar: Float[Tensor, "b s"]
    piece: Float[Tensor, "b pieces"]


@final
class FactHeads(nn.Module):
    """Which slots move as one body, which are drawn ajar, and the kind of the piece, from the mean of its nodes."""

    def __init__(self, hidden: int, terms: int) -> None:
        super().__init__()
        self.body = PairHead(hidden, terms, HEAD, 1)
        self.ajar = perceptron(hidden, HEAD, 1)
        self.piece = perceptron(hidden, HEAD, len(PieceKind))

    def forward(
        self, slots: Float[Tensor, "b s h"], pooled: Float[Tensor, "b h"], terms: Float[Tensor, "b s s t"]
    ) -> FactAnswers:
        """Returns the answers; `pooled` is the mean of the encoded nodes of the input."""
        body = self.body(slots, terms)[..., 0]
        return FactAnswers((body + body.transpose(1, 2)) / 2, self.ajar(slots)[..., 0], self.piece(pooled))


def no_facts(slots: Float[Tensor, "b s h"], terms: Float[Tensor, "b s s t"]) -> FactAnswers:
    """Returns the answers of a network that is not asked about facts: all 0."""
    return FactAnswers(
        torch.zeros_like(terms[..., 0]), torch.zeros_like(slots[..., 0]), slots.new_zeros(len(slots), len(PieceKind))
    )


class MotionAnswers(NamedTuple):
    """Logits by pair (moving part, mount)."""

    border: Float[Tensor, "b s s 4"]
    sign: Float[Tensor, "b s s 2"]
    slide: Float[Tensor, "b s s 6"]


@final
class MotionHeads(nn.Module):
    """The border that carries a door's pin, the sense of its axis, and the signed axis of what slides or turns."""

    def __init__(self, hidden: int, terms: int) -> None:
        super().__init__()
        self.border = PairHead(hidden, terms, HEAD, len(BORDERS))
        self.sign = PairHead(hidden, terms, HEAD, len(SIGNS))
        self.slide = PairHead(hidden, terms, HEAD, len(SIGNED_AXES))

    def forward(self, slots: Float[Tensor, "b s h"], terms: Float[Tensor, "b s s t"]) -> MotionAnswers:
        """Returns the answers for all pairs (i, j), i being what moves."""
        return MotionAnswers(self.border(slots, terms), self.sign(slots, terms), self.slide(slots, terms))
