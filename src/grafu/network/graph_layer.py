"""One layer of the graph encoder: nodes attend along edges, then edges are told by their nodes again."""

from typing import final

from jaxtyping import Bool, Float
from torch import Tensor, nn

from grafu.network.attention import EdgeAttention
from grafu.network.config import GraFuConfig
from grafu.network.perceptron import PairLinear, perceptron

WIDENING = 4  # of the feed-forward block (official.md 5)
EDGE_HIDDEN = 256


@final
class GraphLayer(nn.Module):
    """A pre-norm transformer block over all pairs of nodes (supplement, figure Graph encoder architecture)."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        hidden = config.hidden
        self.before_attention = nn.LayerNorm(hidden)
        self.attention = EdgeAttention(hidden, config.heads, config.edge)
        self.before_forward = nn.LayerNorm(hidden)
        self.feed_forward = perceptron(hidden, WIDENING * hidden, hidden)
        self.dropout = nn.Dropout(config.dropout)

    def forward(
        self, nodes: Float[Tensor, "b n h"], edges: Float[Tensor, "b n n e"], mask: Bool[Tensor, "b n"]
    ) -> Float[Tensor, "b n h"]:
        """Returns the nodes, told by what they attended to."""
        nodes = nodes + self.dropout(self.attention(self.before_attention(nodes), edges, mask))
        return nodes + self.dropout(self.feed_forward(self.before_forward(nodes)))


@final
class EdgeUpdate(nn.Module):
    """Encodes every edge anew from its two nodes and what it was."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.joined = PairLinear(config.hidden, config.edge, EDGE_HIDDEN)
        self.rest = nn.Sequential(nn.GELU(), nn.Linear(EDGE_HIDDEN, config.edge))
        self.norm = nn.LayerNorm(config.edge)

    def forward(self, nodes: Float[Tensor, "b n h"], edges: Float[Tensor, "b n n e"]) -> Float[Tensor, "b n n e"]:
        """Returns the edges, told by their nodes."""
        return self.norm(edges + self.rest(self.joined(nodes, edges)))
