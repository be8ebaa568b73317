"""What two boxes have to do with each other, in numbers: how far apart, in which direction, with what gaps."""

import torch
from jaxtyping import Float
from torch import Tensor

from grafu.network.config import PairFeatures

EDGE_TERMS = 8
_TINY = 1e-6  # of the object's size: two parts with one centre have no direction


def edge_terms(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 8"]:
    """Returns [|r|, |g|, r / |r|, g] of all pairs (supplement, Graph Encoder).

    r runs from i's centre to j's, g holds the gaps of the boxes along the axes, 0 where they overlap.
    """
    r, g = _offsets(boxes), _gaps(boxes)
    far, gap = _length(r), _length(g)
    return torch.cat([far, gap, r / far.clamp(min=_TINY), g], dim=-1)


def pair_term_count(features: PairFeatures) -> int:
    """Returns how many numbers `pair_terms` gives for a pair."""
    return 10 if features == "signed" else 7


def pair_terms(boxes: Float[Tensor, "b s 6"], features: PairFeatures) -> Float[Tensor, "b s s t"]:
    """Returns [|rx|, |ry|, |rz|, |r|, (r,) g] of all pairs, as the authors' pair heads have them (official.md 5)."""
    r, g = _offsets(boxes), _gaps(boxes)
    terms = [r.abs(), _length(r), r, g] if features == "signed" else [r.abs(), _length(r), g]
    return torch.cat(terms, dim=-1)


def _offsets(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 3"]:
    centres = boxes[..., :3]
    return centres[:, None, :] - centres[:, :, None]


def _gaps(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 3"]:
    halves = boxes[..., 3:]
    return (_offsets(boxes).abs() - halves[:, None, :] - halves[:, :, None]).clamp(min=0.0)


def _length(vectors: Float[Tensor, "*p 3"]) -> Float[Tensor, "*p 1"]:
    return vectors.square().sum(dim=-1, keepdim=True).sqrt()
