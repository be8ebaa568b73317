"""The graph encoder: nodes and edges encoded, then layers over the fully connected graph (supplement, Graph Encoder).

A node is its category, box and points side by side; an edge its kind and where its boxes stand. Nodes attend along
edges, then edges are updated from their nodes.
"""

from typing import final

import torch
from torch import Tensor, nn

from grafu.network.batch import GraphBatch
from grafu.network.config import GraFuConfig, PairFeatures
from grafu.network.layers import EdgeAttention, PairLinear, perceptron
from grafu.network.points import PointEncoder
from grafu.network.vocabulary import CategoryEmbedding
from grafu.shapes import Bool, Float, Int64

EDGE_TERMS = 8
FACE_TERMS = 12
_FINE = 0.004  # of the object's size: face terms are linear below it and logarithmic above, 3 mm in a wardrobe
_TINY = 1e-6  # of the object's size: two parts with one centre have no direction


def edge_terms(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 8"]:
    """Returns [|r|, |g|, r / |r|, g] of all pairs (supplement, Graph Encoder).

    r runs from i's centre to j's, g holds the gaps of the boxes along the axes, 0 where they overlap.
    """
    r, g = _offsets(boxes), _gaps(boxes)
    far, gap = _length(r), _length(g)
    return torch.cat([far, gap, r / far.clamp(min=_TINY), g], dim=-1)


def pair_term_count(features: PairFeatures) -> int:
    """Returns how many numbers `pair_terms` gives for a pair."""
    return {"faces": 10 + FACE_TERMS, "signed": 10, "unsigned": 7}[features]


def pair_terms(boxes: Float[Tensor, "b s 6"], features: PairFeatures) -> Float[Tensor, "b s s t"]:
    """Returns [|rx|, |ry|, |rz|, |r|, (r,) g] of all pairs, as the authors' pair heads have them.

    With "faces", the face terms follow.
    """
    r, g = _offsets(boxes), _gaps(boxes)
    terms = [r.abs(), _length(r), g] if features == "unsigned" else [r.abs(), _length(r), r, g]
    return torch.cat([*terms, face_terms(boxes)] if features == "faces" else terms, dim=-1)


def face_terms(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 12"]:
    """Returns how far faces of j's box are from faces of i's, along each axis, on a logarithmic scale.

    Low to low and high to high (0: flush), j's low to i's high (above 0: a gap), i's low to j's high; x, y, z of each.
    A distance d, as a fraction of the object's size, is asinh(d / 0.004) / 5: 0.18 at 0.004, 1.24 at 1.
    """
    low, high = boxes[..., :3] - boxes[..., 3:], boxes[..., :3] + boxes[..., 3:]
    distances = torch.cat(
        [
            low[:, None, :] - low[:, :, None],
            high[:, None, :] - high[:, :, None],
            low[:, None, :] - high[:, :, None],
            low[:, :, None] - high[:, None, :],
        ],
        dim=-1,
    )
    return face_scale(distances)


def face_scale(distances: Float[Tensor, "*p"]) -> Float[Tensor, "*p"]:
    """Returns distances, as fractions of the object's size, on the logarithmic scale of face terms."""
    return torch.asinh(distances / _FINE) / 5.0


def _offsets(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 3"]:
    centres = boxes[..., :3]
    return centres[:, None, :] - centres[:, :, None]


def _gaps(boxes: Float[Tensor, "b n 6"]) -> Float[Tensor, "b n n 3"]:
    halves = boxes[..., 3:]
    return (_offsets(boxes).abs() - halves[:, None, :] - halves[:, :, None]).clamp(min=0.0)


def _length(vectors: Float[Tensor, "*p 3"]) -> Float[Tensor, "*p 1"]:
    return vectors.square().sum(dim=-1, keepdim=True).sqrt()


PART = 64  # width of the kind and of the geometric terms before they are joined


@final
class EdgeEncoder(nn.Module):
    """From each pair of nodes to the feature z_e."""

    def __init__(self, width: int, features: PairFeatures, codes: int) -> None:
        super().__init__()
        self.features = features
        self.kind = nn.Embedding(codes, PART)
        self.terms = perceptron(EDGE_TERMS + (FACE_TERMS if features == "faces" else 0), PART, PART)
        self.joined = nn.Linear(2 * PART, width)

    def forward(self, batch: GraphBatch) -> Float[Tensor, "b n n e"]:
        """Returns the features of all pairs, null edges included."""
        boxes = [edge_terms(batch.boxes)] + ([face_terms(batch.boxes)] if self.features == "faces" else [])
        terms = self.terms(torch.cat(boxes, dim=-1))
        return self.joined(torch.cat([self.kind(batch.edges).to(terms.dtype), terms], dim=-1))


BOX_NUMBERS = 9  # centroid and two corners
MARGIN_NUMBERS = 9
TRANSPARENT_NUMBERS = 1
VISIBILITY_NUMBERS = 18  # those of `grafu.completion.visibility`
BOX_HIDDEN = 64  # as in the authors' code


NAME_CODES, NAME_BUCKETS = 32, 2048  # those of `grafu.completion.name_codes`
NAME_WIDTH = 64


@final
class NameEncoder(nn.Module):
    """From the pieces of a part's name to `NAME_WIDTH` numbers: their mean, through a perceptron."""

    def __init__(self, dropout: float) -> None:
        super().__init__()
        self.pieces = nn.Embedding(NAME_BUCKETS + 1, NAME_WIDTH, padding_idx=0)
        self.mixed = perceptron(NAME_WIDTH, NAME_WIDTH, NAME_WIDTH)
        self.hidden_ratio = dropout

    def forward(self, names: Int64[Tensor, "b n c"]) -> Float[Tensor, "b n w"]:
        """Returns the latents, 0 for parts without a name; in training, some graphs' names are hidden."""
        said = (names > 0).sum(dim=-1, keepdim=True)
        mean = self.pieces(names).sum(dim=-2) / said.clamp(min=1)
        latent = self.mixed(mean) * (said > 0)
        if self.training and self.hidden_ratio > 0:
            latent = latent * (torch.rand(latent.shape[0], 1, 1, device=latent.device) >= self.hidden_ratio)
        return latent


@final
class NodeEncoder(nn.Module):
    """From a part to the latent z_v."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.category = CategoryEmbedding(config)
        self.sees_margins = config.margins
        numbers = BOX_NUMBERS + (MARGIN_NUMBERS if config.margins else 0)
        numbers += TRANSPARENT_NUMBERS if config.materials else 0
        self.sees_materials = config.materials
        self.hidden_materials = config.material_dropout
        self.box = perceptron(numbers, BOX_HIDDEN, config.geometry)
        self.points = PointEncoder(config)
        self.visibility = perceptron(VISIBILITY_NUMBERS, BOX_HIDDEN, config.geometry) if config.visibility else None
        self.names = NameEncoder(config.name_dropout) if config.names else None
        self.hidden_ratio = config.geometry_dropout

    @staticmethod
    def width(config: GraFuConfig) -> int:
        """Returns how many numbers a latent has: the paper's 224, those of visibility, and those of names."""
        geometry = config.geometry * (2 if config.visibility else 1)
        return config.category + config.points + geometry + (NAME_WIDTH if config.names else 0)

    def forward(self, batch: GraphBatch) -> Float[Tensor, "b n z"]:
        """Returns the latents; in training, some graphs' points are hidden."""
        points = self.points(batch.anchors, batch.groups)[batch.point_index]
        if self.training and self.hidden_ratio > 0:
            points = points * (torch.rand(points.shape[0], 1, 1, device=points.device) >= self.hidden_ratio)
        seen = [corners(batch.boxes)] + ([margins(batch.boxes, batch.mask)] if self.sees_margins else [])
        seen += [self._transparent(batch)] if self.sees_materials else []
        box = self.box(torch.cat(seen, dim=-1))
        latent = [self.category(batch.labels), points, box]
        if self.visibility is not None:
            latent.append(self.visibility(batch.visibility))
        if self.names is not None:
            latent.append(self.names(batch.names))
        return torch.cat(latent, dim=-1)

    def _transparent(self, batch: GraphBatch) -> Float[Tensor, "b n 1"]:
        """Returns how transparent each part is; in training, the materials of some graphs are hidden."""
        transparent = batch.transparent[..., None]
        if self.training and self.hidden_materials > 0:
            kept = torch.rand(len(transparent), 1, 1, device=transparent.device) >= self.hidden_materials
            transparent = transparent * kept
        return transparent


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


WIDENING = 4  # of the feed-forward block
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


@final
class GraphEncoder(nn.Module):
    """From a graph to what each node, and each edge, knows of the whole."""

    def __init__(self, config: GraFuConfig) -> None:
        super().__init__()
        self.nodes = NodeEncoder(config)
        self.into_hidden = nn.Linear(NodeEncoder.width(config), config.hidden)
        self.edges = EdgeEncoder(config.edge, config.pair_features, config.edge_codes)
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
