"""The whole network: graph encoder, slot decoder, heads (paper, figure GraFu pipeline)."""

from typing import final

import torch
from jaxtyping import Float
from torch import Tensor, nn
from torch.nn.functional import pad

from grafu.network.batch import GraphBatch, Predictions
from grafu.network.config import GraFuConfig
from grafu.network.decoder import SlotDecoder
from grafu.network.encoder import GraphEncoder, pair_term_count, pair_terms
from grafu.network.heads import MotionHeads, PairHeads, SlotAnswers, SlotHeads


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
        self.pair_heads = PairHeads(config.hidden, terms)
        self.motion_heads = MotionHeads(config.hidden, terms)

    def forward(self, batch: GraphBatch) -> Predictions:
        """Returns the scores of all slots and pairs of slots."""
        nodes, edges = self.encoder(batch)
        slots, mask = self.decoder(nodes, batch.mask)
        answers = self.slot_heads(slots, nodes, batch.boxes, batch.mask)
        terms = self._pair_terms(batch.boxes, answers, edges)
        pairs, motions = self.pair_heads(slots, terms), self.motion_heads(slots, terms)
        return Predictions(**answers._asdict(), **pairs._asdict(), **motions._asdict(), mask=mask)

    def _pair_terms(
        self, given: Float[Tensor, "b n 6"], answers: SlotAnswers, edges: Float[Tensor, "b n n e"]
    ) -> Float[Tensor, "b s s t"]:
        boxes = torch.cat([answers.centre, answers.half], dim=-1).detach()
        if self.config.pair_boxes == "input":
            boxes = torch.cat([given, boxes[:, given.shape[1] :]], dim=1)
        terms = pair_terms(boxes, self.config.pair_features)
        if not self.config.pair_edges:
            return terms
        free = self.config.free_slots
        return torch.cat([terms.to(edges.dtype), pad(edges, (0, 0, 0, free, 0, free))], dim=-1)
