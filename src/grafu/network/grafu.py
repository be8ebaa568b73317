"""The whole network: graph encoder, slot decoder, heads (paper, figure GraFu pipeline).

The decoder has slots for the input's nodes and free ones for what is missing (supplement, Graph Decoder). With the
paper's budget of slots (`GraFuConfig.slots`) there are padding slots, too, which begin as zeros; else there are as many
slots as nodes, and K more.
"""

from typing import NamedTuple, final

import torch
from torch import Tensor, nn
from torch.nn.functional import pad

from grafu.network.batch import GraphBatch, Predictions
from grafu.network.config import GraFuConfig
from grafu.network.encoder import WIDENING, GraphEncoder, pair_term_count, pair_terms
from grafu.network.heads import FactHeads, MotionHeads, PairHeads, SlotAnswers, SlotHeads, no_facts
from grafu.network.layers import Attention, masked_mean, perceptron
from grafu.shapes import Bool, Float


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


class Slots(NamedTuple):
    """The decoded slots, which of them belong to a graph, and which of those are its padding."""

    features: Float[Tensor, "b s h"]
    mask: Bool[Tensor, "b s"]
    padding: Bool[Tensor, "b s"]


@final
class SlotDecoder(nn.Module):
    """From the encoded nodes to n + K slots, the K free ones behind the nodes', then padding slots if there are any."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        hidden = config.hidden
        self.budget = config.slots
        self.free = nn.Parameter(torch.randn(config.free_slots, hidden) * 0.5)  # apart from each other from the start
        self.summary = nn.Sequential(perceptron(hidden, hidden, hidden), nn.LayerNorm(hidden))
        self.layers = nn.ModuleList([SlotLayer(config) for _ in range(config.decoder_layers)])
        self.norm = nn.LayerNorm(hidden)

    def forward(self, nodes: Float[Tensor, "b n h"], mask: Bool[Tensor, "b n"]) -> Slots:
        """Returns the slots."""
        free = self.free + self.summary(masked_mean(nodes, mask))[:, None, :]
        slots = torch.cat([nodes, free.to(nodes.dtype)], dim=1)
        slot_mask = torch.cat([mask, torch.ones_like(free[..., 0], dtype=torch.bool)], dim=1)
        padding = torch.zeros_like(slot_mask)
        if self.budget is not None:
            # No more than is missing in a full graph; a file has them all, as its graphs have any size
            exporting = torch.compiler.is_exporting()
            more = self.budget if exporting else max(0, self.budget - slots.shape[1])
            slots, slot_mask = pad(slots * slot_mask[..., None], (0, 0, 0, more)), pad(slot_mask, (0, more))
            rank = (~slot_mask).cumsum(dim=1)
            padding = ~slot_mask & (rank <= self.budget - slot_mask.sum(dim=1, keepdim=True))
            slot_mask = slot_mask | padding
        for layer in self.layers:
            slots = layer(slots, slot_mask, nodes, mask)
        return Slots(self.norm(slots), slot_mask, padding)


@final
class GraFu(nn.Module):
    """The graph functionalizer: what is missing in a graph, how its parts are joined, how they move."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.config = config
        self.encoder = GraphEncoder(config)
        self.decoder = SlotDecoder(config)
        terms = pair_term_count(config.pair_features) + (config.edge if config.pair_edges else 0)
        self.slot_heads = SlotHeads(config)
        self.pair_heads = PairHeads(config.hidden, terms, config.edge_codes, config.symmetric_edges)
        self.motion_heads = MotionHeads(config.hidden, terms)
        self.fact_heads = FactHeads(config.hidden, terms) if config.facts else None

    def forward(self, batch: GraphBatch) -> Predictions:
        """Returns the scores of all slots and pairs of slots."""
        nodes, edges = self.encoder(batch)
        slots, mask, padding = self.decoder(nodes, batch.mask)
        answers = self.slot_heads(slots, nodes, batch.boxes, batch.mask)
        terms = self._pair_terms(batch.boxes, answers, edges)
        pairs, motions = self.pair_heads(slots, terms), self.motion_heads(slots, terms)
        facts = no_facts(slots, terms)
        if self.fact_heads is not None:
            facts = self.fact_heads(slots, masked_mean(nodes, batch.mask), terms)
        scores = answers._asdict() | pairs._asdict() | motions._asdict() | facts._asdict()
        return Predictions(**scores, mask=mask, padding=padding)

    def _pair_terms(
        self, given: Float[Tensor, "b n 6"], answers: SlotAnswers, edges: Float[Tensor, "b n n e"]
    ) -> Float[Tensor, "b s s t"]:
        boxes = torch.cat([answers.centre, answers.half], dim=-1).detach()
        if self.config.pair_boxes == "input":
            boxes = torch.cat([given, boxes[:, given.shape[1] :]], dim=1)
        terms = pair_terms(boxes, self.config.pair_features)
        if not self.config.pair_edges:
            return terms
        more = terms.shape[1] - edges.shape[1]
        return torch.cat([terms.to(edges.dtype), pad(edges, (0, 0, 0, more, 0, more))], dim=-1)
