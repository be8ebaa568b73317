"""The node encoder: category, box and points of a part, side by side (supplement, Node Encoder)."""

from typing import final

import torch
from jaxtyping import Bool, Float
from torch import Tensor, nn

from grafu.network.batch import GraphBatch
from grafu.network.config import LABEL_COUNT, GraFuConfig
from grafu.network.pair_terms import face_scale
from grafu.network.perceptron import perceptron
from grafu.network.point_encoder import PointEncoder

BOX_NUMBERS = 9  # centroid and two corners
MARGIN_NUMBERS = 9
BOX_HIDDEN = 64  # official.md 5


@final
class NodeEncoder(nn.Module):
    """From a part to the latent z_v."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.category = nn.Embedding(LABEL_COUNT, config.category)  # a linear projection of the one-hot label
        self.sees_margins = config.margins
        numbers = BOX_NUMBERS + (MARGIN_NUMBERS if config.margins else 0)
        self.box = perceptron(numbers, BOX_HIDDEN, config.geometry)
        self.points = PointEncoder(config.points, config.points_frame)
        self.hidden_share = config.geometry_dropout

    @staticmethod
    def width(config: GraFuConfig) -> int:
        """Returns how many numbers a latent has: the paper's 224."""
        return config.category + config.points + config.geometry

    def forward(self, batch: GraphBatch) -> Float[Tensor, "b n z"]:
        """Returns the latents; in training, some graphs' points are hidden."""
        points = self.points(batch.anchors, batch.groups)[batch.point_index]
        if self.training and self.hidden_share > 0:
            points = points * (torch.rand(points.shape[0], 1, 1, device=points.device) >= self.hidden_share)
        seen = [corners(batch.boxes)] + ([margins(batch.boxes, batch.mask)] if self.sees_margins else [])
        box = self.box(torch.cat(seen, dim=-1))
        return torch.cat([self.category(batch.labels), points, box], dim=-1)


def corners(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n 9"]:
    """Returns [centroid, low corner, high corner] of boxes given as centre and half size."""
    centre, half = boxes[..., :3], boxes[..., 3:]
    return torch.cat([centre, centre - half, centre + half], dim=-1)


def margins(boxes: Float[Tensor, "b n 6"], mask: Bool[Tensor, "b n"]) -> Float[Tensor, "b n 9"]:
    """Returns how far boxes are from the object's low and high faces, and how large they are, on the scale of faces.

    `mask` marks the boxes of which the object consists.
    """
    centre, half = boxes[..., :3], boxes[..., 3:]
    low, high = centre - half, centre + half
    absent = ~mask[..., None]
    nothing = torch.full_like(low.sum(dim=1, keepdim=True), torch.inf)  # so that a graph without nodes has ends too
    bottom = torch.cat([low.masked_fill(absent, torch.inf), nothing], dim=1).amin(dim=1, keepdim=True)
    top = torch.cat([high.masked_fill(absent, -torch.inf), -nothing], dim=1).amax(dim=1, keepdim=True)
    found = face_scale(torch.cat([low - bottom, top - high, 2 * half], dim=-1))
    return found.masked_fill(absent, 0.0)
