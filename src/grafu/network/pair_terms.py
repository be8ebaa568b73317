"""What two boxes have to do with each other, in numbers: how far apart, in which direction, with what gaps.

The paper's terms are lengths as they are, and its gaps are 0 wherever boxes overlap. Millimetres decide who carries
whom, and which flank lies inside which wall: `face_terms` tell them apart.
"""

import torch
from jaxtyping import Float
from torch import Tensor

from grafu.network.config import PairFeatures

EDGE_TERMS = 8
FACE_TERMS = 12
_FINE = 0.004  # of the object's size: face terms are linear below it and logarithmic above, 3 mm in a wardrobe
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
    return {"faces": 10 + FACE_TERMS, "signed": 10, "unsigned": 7}[features]


def pair_terms(boxes: Float[Tensor, "b s 6"], features: PairFeatures) -> Float[Tensor, "b s s t"]:
    """Returns [|rx|, |ry|, |rz|, |r|, (r,) g] of all pairs, as the authors' pair heads have them (official.md 5).

    With "faces", the face terms follow.
    """
    r, g = _offsets(boxes), _gaps(boxes)
    terms = [r.abs(), _length(r), g] if features == "unsigned" else [r.abs(), _length(r), r, g]
    return torch.cat([*terms, face_terms(boxes)] if features == "faces" else terms, dim=-1)


def face_terms(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 12"]:
    """Returns how far faces of j's box are from faces of i's, along each axis, on a logarithmic scale.

    Low to low and high to high (0: flush), j's low to i's high (above 0: a gap), i's low to j's high; x, y, z of each.
    A distance d, as a share of the object's size, is asinh(d / 0.004) / 5: 0.18 at 0.004, 1.24 at 1.
    """
    low, high = boxes[..., :3] - boxes[..., 3:], boxes[..., :3] + boxes[..., 3:]
    distances = torch.cat(
        [
            low[:, None, :] - low[:, :, None],
            high[:, None, :] - high[:, :, None],
            low[:, None, :] - high[:, :, None],
            low[:, :, None] - high[:, None, :],
        ],
        dim=-1,
    )
    return face_scale(distances)


def face_scale(distances: Float[Tensor, "*p"]) -> Float[Tensor, "*p"]:
    """Returns distances, as shares of the object's size, on the logarithmic scale of face terms."""
    return torch.asinh(distances / _FINE) / 5.0


def _offsets(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 3"]:
    centres = boxes[..., :3]
    return centres[:, None, :] - centres[:, :, None]


def _gaps(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 3"]:
    halves = boxes[..., 3:]
    return (_offsets(boxes).abs() - halves[:, None, :] - halves[:, :, None]).clamp(min=0.0)


def _length(vectors: Float[Tensor, "*p 3"]) -> Float[Tensor, "*p 1"]:
    return vectors.square().sum(dim=-1, keepdim=True).sqrt()
