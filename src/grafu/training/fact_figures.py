"""How right the network is about the whole piece: what moves as one, what is drawn ajar, what it is."""

from dataclasses import field
from typing import final

import torch
from torch import Tensor

from grafu.dataclass import dataclass
from grafu.graph.arrays import NONE
from grafu.network.batch import Predictions
from grafu.shapes import Bool, Float
from grafu.training.criterion import of_moving
from grafu.training.matcher import SlotTruth


@final
@dataclass
class FactFigures:
    """Counts over batches; `by_name` are the figures so far, those left out that nothing was asked about."""

    counts: dict[str, list[int]] = field(default_factory=lambda: {"body": [0, 0, 0], "ajar": [0, 0, 0]})
    """Right, predicted, true."""
    pieces: list[int] = field(default_factory=lambda: [0, 0])
    """Right, asked."""

    def add(self, predictions: Predictions, truth: SlotTruth) -> None:
        """Counts the answers about one batch."""
        same = truth.bodies[:, :, None] == truth.bodies[:, None, :]
        self._count("body", predictions.body, same, of_moving(truth))
        self._count("ajar", predictions.ajar, truth.ajar == 1, truth.anchored & (truth.ajar != NONE))
        known = truth.piece != NONE
        right = predictions.piece.argmax(dim=-1) == truth.piece
        self.pieces[0] += int((right & known).sum())
        self.pieces[1] += int(known.sum())

    def by_name(self) -> dict[str, float]:
        """Returns the F1 of bodies and of parts drawn ajar, and the accuracy of kinds of pieces."""
        found = {f"facts/{name}": 2 * a / (b + c) for name, (a, b, c) in self.counts.items() if b + c}
        return found | ({"facts/piece": self.pieces[0] / self.pieces[1]} if self.pieces[1] else {})

    def _count(
        self, name: str, logits: Float[Tensor, "*p"], true: Bool[Tensor, "*p"], asked: Bool[Tensor, "*p"]
    ) -> None:
        said = logits > 0
        found = torch.stack([(said & true & asked).sum(), (said & asked).sum(), (true & asked).sum()])
        self.counts[name] = [a + b for a, b in zip(self.counts[name], found.tolist(), strict=True)]
