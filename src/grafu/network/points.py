"""A part's surface: a lightweight PointNet++ of two stages over groups of points (supplement, Node Encoder).

The first stage looks at each group, made beforehand (`grafu.completion.features`). The second takes all groups of a
part at once, or groups once more, as the paper's does: half of the groups' centres are centres again, each with the
groups within a radius. Centres come as farthest points, each the farthest from those before it, so that the first
half of them is what picking farthest points among them would give.
"""

from itertools import pairwise
from typing import final

import torch
from torch import Tensor, nn

from grafu.network.config import GraFuConfig
from grafu.network.layers import perceptron
from grafu.shapes import Bool, Float, Int64

FIRST_STAGE = (3, 32, 64)  # widths of the stages and of the head
SECOND_STAGE = (67, 64, 128)
POINT_HEAD = 128
_NOTHING = -1e4  # below every feature, and no infinity


@final
class PointEncoder(nn.Module):
    """From a part's grouped points to a latent of `config.points` numbers."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.config = config
        self.first = _stage(*FIRST_STAGE)
        self.second = _stage(*SECOND_STAGE)
        self.head = perceptron(SECOND_STAGE[-1], POINT_HEAD, config.points)

    def forward(self, anchors: Float[Tensor, "u g 3"], groups: Float[Tensor, "u g k 3"]) -> Float[Tensor, "u width"]:
        """Returns a latent of each part; the order of the points of a group does not matter."""
        of_groups = self.first(groups).amax(dim=2)
        of_part = self._regrouped(anchors, of_groups) if self.config.second_grouping else self._all(anchors, of_groups)
        return self.head(of_part.amax(dim=1))

    def _all(self, anchors: Float[Tensor, "u g 3"], of_groups: Float[Tensor, "u g f"]) -> Float[Tensor, "u g o"]:
        centres = anchors - middles(anchors) if self.config.points_frame == "part" else anchors
        return self.second(torch.cat([centres.to(of_groups.dtype), of_groups], dim=2))

    def _regrouped(self, anchors: Float[Tensor, "u g 3"], of_groups: Float[Tensor, "u g f"]) -> Float[Tensor, "u h o"]:
        centres = anchors[:, : max(1, anchors.shape[1] // 2)]
        count = min(self.config.second_neighbours, anchors.shape[1])
        places, inside = first_within(anchors, centres, self.config.second_radius, count)
        away = _rows(anchors, places) - centres[:, :, None]
        seen = self.second(torch.cat([away.to(of_groups.dtype), _rows(of_groups, places)], dim=3))
        return torch.where(inside[..., None], seen, _NOTHING).amax(dim=2)


def middles(anchors: Float[Tensor, "u g 3"]) -> Float[Tensor, "u 1 3"]:
    """Returns the middle of each part's box of anchors."""
    return (anchors.amax(dim=1, keepdim=True) + anchors.amin(dim=1, keepdim=True)) / 2


def first_within(
    points: Float[Tensor, "u g 3"], centres: Float[Tensor, "u h 3"], radius: float, count: int
) -> tuple[Int64[Tensor, "u h k"], Bool[Tensor, "u h k"]]:
    """Returns the places of the first `count` points within a radius of each centre, in their order, and which are.

    Where fewer are within it, others fill the places, and are marked as outside.
    """
    away = (points[:, None] - centres[:, :, None]).square().sum(dim=-1)
    inside = away <= radius**2
    order = torch.arange(points.shape[1], device=points.device).expand_as(away)
    places = torch.where(inside, order, order + points.shape[1]).topk(count, dim=-1, largest=False).values
    return places % points.shape[1], places < points.shape[1]


def _rows(values: Float[Tensor, "u g f"], places: Int64[Tensor, "u h k"]) -> Float[Tensor, "u h k f"]:
    flat = places.flatten(1)[..., None].expand(-1, -1, values.shape[2])
    return values.gather(1, flat).reshape(*places.shape, values.shape[2])


def _stage(*widths: int) -> nn.Sequential:
    layers: list[nn.Module] = []
    for into, out in pairwise(widths):
        layers += [nn.Linear(into, out), nn.LayerNorm(out), nn.ReLU()]
    return nn.Sequential(*layers)
