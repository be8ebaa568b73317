"""The graph decoder: slots for the input's nodes and free ones for what is missing (supplement, Graph Decoder).

The paper's budget of 55 slots, most of them padding, is only needed where tensors must have one size: here there are as
many slots as nodes, and K more.
"""

from typing import final

import torch
from jaxtyping import Bool, Float
from torch import Tensor, nn

from grafu.network.config import GraFuConfig
from grafu.network.encoder import WIDENING
from grafu.network.layers import Attention, perceptron


@final
class SlotLayer(nn.Module):
    """A pre-norm decoder block: slots attend to slots, then to the encoded nodes."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        hidden, heads = config.hidden, config.heads
        self.before_slots, self.before_nodes, self.before_forward = (nn.LayerNorm(hidden) for _ in range(3))
        self.to_slots, self.to_nodes = Attention(hidden, heads), Attention(hidden, heads)
        self.feed_forward = perceptron(hidden, WIDENING * hidden, hidden)
        self.dropout = nn.Dropout(config.dropout)

    def forward(
        self,
        slots: Float[Tensor, "b s h"],
        slot_mask: Bool[Tensor, "b s"],
        nodes: Float[Tensor, "b n h"],
        node_mask: Bool[Tensor, "b n"],
    ) -> Float[Tensor, "b s h"]:
        """Returns the slots, told by each other and by the nodes."""
        normed = self.before_slots(slots)
        slots = slots + self.dropout(self.to_slots(normed, normed, slot_mask))
        slots = slots + self.dropout(self.to_nodes(self.before_nodes(slots), nodes, node_mask))
        return slots + self.dropout(self.feed_forward(self.before_forward(slots)))


@final
class SlotDecoder(nn.Module):
    """From the encoded nodes to n + K slots, the K free ones last."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        hidden = config.hidden
        self.free = nn.Parameter(torch.randn(config.free_slots, hidden) * 0.5)  # apart from each other from the start
        self.summary = nn.Sequential(perceptron(hidden, hidden, hidden), nn.LayerNorm(hidden))
        self.layers = nn.ModuleList([SlotLayer(config) for _ in range(config.decoder_layers)])
        self.norm = nn.LayerNorm(hidden)

    def forward(
        self, nodes: Float[Tensor, "b n h"], mask: Bool[Tensor, "b n"]
    ) -> tuple[Float[Tensor, "b s h"], Bool[Tensor, "b s"]]:
        """Returns the slots and which of them are no padding."""
        pooled = (nodes * mask[:, :, None]).sum(dim=1) / mask.sum(dim=1, keepdim=True).clamp(min=1)
        free = self.free + self.summary(pooled)[:, None, :]
        slots = torch.cat([nodes, free.to(nodes.dtype)], dim=1)
        slot_mask = torch.cat([mask, torch.ones_like(free[..., 0], dtype=torch.bool)], dim=1)
        for layer in self.layers:
            slots = layer(slots, slot_mask, nodes, mask)
        return self.norm(slots), slot_mask
