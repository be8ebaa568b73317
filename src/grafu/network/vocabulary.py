"""The labels that a network knows: grafu's 14, or the 17 of the authors' code, read and answered as grafu's 14.

The authors' code lists a countertop apart from a top panel, and `rail` and `hinge`, which no part may be in the end.
"""

from typing import Final, final

import torch
from torch import Tensor, nn

from grafu.graph.arrays import LABEL_CODES, LABELS
from grafu.network.config import GraFuConfig, Vocabulary
from grafu.shapes import Float, Int64
from grafu.vocabulary import PartLabel

OFFICIAL_WORDS: Final = (
    "handle",
    "shelf",
    "side panel",
    "misc",
    "leg",
    "door",
    "drawer",
    "back panel",
    "bottom panel",
    "top panel",
    "face frame",
    "divider",
    "rail",
    "hinge",
    "bar",
    "countertop",
    "unknown",
)
"""The authors' internal categories in the order of their codes."""
_COUNTERTOP: Final = OFFICIAL_WORDS.index("countertop")


def category_count(vocabulary: Vocabulary) -> int:
    """Returns how many categories a network of this vocabulary has."""
    return len(LABELS) if vocabulary == "grafu" else len(OFFICIAL_WORDS)


def official_places() -> Int64[Tensor, " labels"]:
    """Returns the authors' code of each of our labels."""
    return torch.tensor([OFFICIAL_WORDS.index(label.value) for label in LABELS])


@final
class CategoryEmbedding(nn.Embedding):
    """A linear projection of the one-hot label."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__(category_count(config.vocabulary), config.category)
        self.is_official = config.vocabulary == "official"

    def forward(self, labels: Int64[Tensor, "b n"]) -> Float[Tensor, "b n c"]:
        """Returns the embeddings of our labels."""
        return super().forward(official_places().to(labels.device)[labels] if self.is_official else labels)


def as_labels(logits: Float[Tensor, "b s c"], vocabulary: Vocabulary) -> Float[Tensor, "b s labels"]:
    """Returns the logits of our labels: a top panel is as likely as top panel and countertop together."""
    if vocabulary == "grafu":
        return logits
    kept = logits[..., official_places().to(logits.device)]
    top = LABEL_CODES[PartLabel.TOP_PANEL]
    both = torch.logaddexp(kept[..., top : top + 1], logits[..., _COUNTERTOP : _COUNTERTOP + 1])
    return torch.cat([kept[..., :top], both, kept[..., top + 1 :]], dim=-1)
