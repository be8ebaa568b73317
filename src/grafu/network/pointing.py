"""Where the part of a free slot is, told from the nodes that the slot points at, in units of their sizes."""

from typing import final

import torch
from jaxtyping import Bool, Float
from torch import Tensor, nn
from torch.nn.functional import gelu, softplus

from grafu.network.attention import attention_shares

WIDTH = 128
_THIN = -4.0  # shifts sizes so that at first a part adds a fiftieth of its own


@final
class Pointing(nn.Module):
    """Each slot shares itself out over the nodes; each node says where the slot's part is, and how large."""

    def __init__(self, hidden: int) -> None:
        super().__init__()
        self.query, self.key = nn.Linear(hidden, WIDTH), nn.Linear(hidden, WIDTH)
        self.of_slot, self.of_node = nn.Linear(hidden, WIDTH), nn.Linear(hidden, WIDTH, bias=False)
        self.said = nn.Linear(WIDTH, 6)

    def forward(
        self,
        slots: Float[Tensor, "b k h"],
        nodes: Float[Tensor, "b n h"],
        boxes: Float[Tensor, "b n 6"],
        mask: Bool[Tensor, "b n"],
    ) -> tuple[Float[Tensor, "b k 3"], Float[Tensor, "b k 3"]]:
        """Returns the mean of what the nodes say of each slot's centre and half size, by how much it points at each."""
        query, key = self.query(slots)[:, None], self.key(nodes)[:, None]
        shares = attention_shares(query, key, None, mask)[:, 0].float()
        said = self.said(gelu(self.of_slot(slots)[:, :, None] + self.of_node(nodes)[:, None])).float()
        centres, halves = boxes[:, None, :, :3], boxes[:, None, :, 3:]
        centre = centres + halves * said[..., :3]
        half = halves * softplus(said[..., 3:] + _THIN)
        return torch.einsum("bkn,bknc->bkc", shares, centre), torch.einsum("bkn,bknc->bkc", shares, half)
