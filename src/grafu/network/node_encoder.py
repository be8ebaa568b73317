"""The node encoder: category, box and points of a part, side by side (supplement, Node Encoder)."""

from typing import final

import torch
from jaxtyping import Float
from torch import Tensor, nn

from grafu.network.batch import GraphBatch
from grafu.network.config import LABEL_COUNT, GraFuConfig
from grafu.network.perceptron import perceptron
from grafu.network.point_encoder import PointEncoder

BOX_NUMBERS = 9  # centroid and two corners
BOX_HIDDEN = 64  # official.md 5


@final
class NodeEncoder(nn.Module):
    """From a part to the latent z_v."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.category = nn.Embedding(LABEL_COUNT, config.category)  # a linear projection of the one-hot label
        self.box = perceptron(BOX_NUMBERS, BOX_HIDDEN, config.geometry)
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
            seen = torch.rand(points.shape[0], 1, 1, device=points.device) >= self.hidden_share
            points = points * seen
        box = self.box(corners(batch.boxes))
        return torch.cat([self.category(batch.labels), points, box], dim=-1)


def corners(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n 9"]:
    """Returns [centroid, low corner, high corner] of boxes given as centre and half size."""
    centre, half = boxes[..., :3], boxes[..., 3:]
    return torch.cat([centre, centre - half, centre + half], dim=-1)
