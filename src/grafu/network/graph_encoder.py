"""The graph encoder: layers over the fully connected graph, nodes and edges refining each other."""

from typing import final

from jaxtyping import Float
from torch import Tensor, nn

from grafu.network.batch import GraphBatch
from grafu.network.config import GraFuConfig
from grafu.network.edge_encoder import EdgeEncoder
from grafu.network.graph_layer import EdgeUpdate, GraphLayer
from grafu.network.node_encoder import NodeEncoder


@final
class GraphEncoder(nn.Module):
    """From a graph to what each node, and each edge, knows of the whole."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.nodes = NodeEncoder(config)
        self.into_hidden = nn.Linear(NodeEncoder.width(config), config.hidden)
        self.edges = EdgeEncoder(config.edge, config.pair_features)
        self.layers = nn.ModuleList([GraphLayer(config) for _ in range(config.encoder_layers)])
        # Nothing would read what the last layer makes of the edges, if the pair heads do not
        updates = config.encoder_layers if config.pair_edges else config.encoder_layers - 1
        self.updates = nn.ModuleList([EdgeUpdate(config) for _ in range(updates)])
        self.norm = nn.LayerNorm(config.hidden)

    def forward(self, batch: GraphBatch) -> tuple[Float[Tensor, "b n h"], Float[Tensor, "b n n e"]]:
        """Returns the encoded nodes and edges."""
        nodes, edges = self.into_hidden(self.nodes(batch)), self.edges(batch)
        for number, layer in enumerate(self.layers):
            nodes = layer(nodes, edges, batch.mask)
            if number < len(self.updates):
                edges = self.updates[number](nodes, edges)
        return self.norm(nodes), edges
