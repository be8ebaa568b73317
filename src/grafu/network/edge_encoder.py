"""The edge encoder: the kind of a pair's edge and where its boxes stand (supplement, Graph Encoder)."""

from typing import final

import torch
from jaxtyping import Float
from torch import Tensor, nn

from grafu.network.batch import GraphBatch
from grafu.network.config import EDGE_COUNT, PairFeatures
from grafu.network.pair_terms import EDGE_TERMS, FACE_TERMS, edge_terms, face_terms
from grafu.network.perceptron import perceptron

PART = 64  # width of the kind and of the geometric terms before they are joined (official.md 5)


@final
class EdgeEncoder(nn.Module):
    """From each pair of nodes to the feature z_e."""

    def __init__(self, width: int, features: PairFeatures) -> None:
        super().__init__()
        self.features = features
        self.kind = nn.Embedding(EDGE_COUNT, PART)
        self.terms = perceptron(EDGE_TERMS + (FACE_TERMS if features == "faces" else 0), PART, PART)
        self.joined = nn.Linear(2 * PART, width)

    def forward(self, batch: GraphBatch) -> Float[Tensor, "b n n e"]:
        """Returns the features of all pairs, null edges included."""
        boxes = [edge_terms(batch.boxes)] + ([face_terms(batch.boxes)] if self.features == "faces" else [])
        terms = self.terms(torch.cat(boxes, dim=-1))
        return self.joined(torch.cat([self.kind(batch.edges).to(terms.dtype), terms], dim=-1))
