"""The point encoder: a lightweight PointNet++ of two stages over groups of points made beforehand.

The first stage looks at each group, the second at all groups of a part. The authors' second stage groups once more;
here it takes all groups at once: of so few there is little left to group, and a step is shorter by a tenth or two.
"""

from itertools import pairwise
from typing import final

import torch
from jaxtyping import Float
from torch import Tensor, nn

from grafu.network.config import PointsFrame
from grafu.network.perceptron import perceptron

FIRST = (3, 32, 64)  # widths of the stages and of the head (official.md 5)
SECOND = (67, 64, 128)
HEAD = 128


@final
class PointEncoder(nn.Module):
    """From a part's grouped points to `width` numbers."""

    def __init__(self, width: int, frame: PointsFrame) -> None:
        super().__init__()
        self.frame = frame
        self.first = _stage(*FIRST)
        self.second = _stage(*SECOND)
        self.head = perceptron(SECOND[-1], HEAD, width)

    def forward(self, anchors: Float[Tensor, "u g 3"], groups: Float[Tensor, "u g k 3"]) -> Float[Tensor, "u width"]:
        """Returns a latent of each part; the order of groups and of their points does not matter."""
        centres = anchors - middles(anchors) if self.frame == "part" else anchors
        of_groups = self.first(groups).amax(dim=2)
        of_part = self.second(torch.cat([centres.to(of_groups.dtype), of_groups], dim=2)).amax(dim=1)
        return self.head(of_part)


def middles(anchors: Float[Tensor, "u g 3"]) -> Float[Tensor, "u 1 3"]:
    """Returns the middle of each part's box of anchors."""
    return (anchors.amax(dim=1, keepdim=True) + anchors.amin(dim=1, keepdim=True)) / 2


def _stage(*widths: int) -> nn.Sequential:
    layers: list[nn.Module] = []
    for into, out in pairwise(widths):
        layers += [nn.Linear(into, out), nn.LayerNorm(out), nn.ReLU()]
    return nn.Sequential(*layers)
