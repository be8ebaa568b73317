"""The authors' network as the specification states it, written apart from ours: to make checkpoints of its layout.

One graph at a time. Names, what padding slots see and the order of what is joined are ours.
"""

from itertools import pairwise

import torch  # noqa: TID251  # for tests of network and training alone
from torch import Tensor, nn  # noqa: TID251
from torch.nn.functional import softplus  # noqa: TID251

WORDS, HIDDEN, EDGE, HEADS, SLOTS, FREE = 17, 256, 128, 8, 55, 4


def mlp(*widths: int) -> nn.Sequential:
    layers: list[nn.Module] = []
    for a, b in pairwise(widths):
        layers += [nn.Linear(a, b), nn.GELU()]
    return nn.Sequential(*layers[:-1])


def normed(*widths: int) -> nn.Sequential:
    pairs = pairwise(widths)
    return nn.Sequential(*(one for a, b in pairs for one in (nn.Linear(a, b), nn.LayerNorm(b), nn.ReLU())))


def ball(points: Tensor, centre: Tensor, radius: float, most: int) -> Tensor:
    return ((points - centre).square().sum(dim=1) <= radius**2).nonzero()[:most, 0]


class Points(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.sa1, self.sa2, self.head = normed(3, 32, 64), normed(67, 64, 128), mlp(128, 128, 64)

    def forward(self, anchors: Tensor, groups: Tensor) -> Tensor:
        features = self.sa1(groups).amax(dim=1)  # g 64
        found = []
        for centre in anchors[: len(anchors) // 2]:
            near = ball(anchors, centre, 0.4, 32)
            found.append(self.sa2(torch.cat([features[near], anchors[near] - centre], dim=1)).amax(dim=0))
        return self.head(torch.stack(found).amax(dim=0))


class NodeEncoder(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.cat_embed, self.pointnet, self.geo_mlp = nn.Embedding(WORDS, 128), Points(), mlp(9, 64, 32)


class GraphLayer(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.norm1, self.norm2 = nn.LayerNorm(HIDDEN), nn.LayerNorm(HIDDEN)
        self.w_q, self.w_k, self.w_v = (nn.Linear(HIDDEN, HIDDEN, bias=False) for _ in range(3))
        self.w_o = nn.Linear(HIDDEN, HIDDEN)
        self.edge_bias, self.w_e = nn.Linear(EDGE, HEADS, bias=False), nn.Linear(EDGE, HIDDEN, bias=False)
        self.edge_update, self.edge_norm = mlp(2 * HIDDEN + EDGE, 256, EDGE), nn.LayerNorm(EDGE)
        self.ffn = mlp(HIDDEN, 4 * HIDDEN, HIDDEN)

    def forward(self, h: Tensor, e: Tensor) -> tuple[Tensor, Tensor]:
        n, x = len(h), self.norm1(h)
        q, k, v = (w(x).view(n, HEADS, -1) for w in (self.w_q, self.w_k, self.w_v))
        scores = torch.einsum("ihc,jhc->hij", q, k) / (HIDDEN / HEADS) ** 0.5 + self.edge_bias(e).permute(2, 0, 1)
        values = v[None] + self.w_e(e).view(n, n, HEADS, -1)
        h = h + self.w_o(torch.einsum("hij,ijhc->ihc", scores.softmax(dim=-1), values).reshape(n, HIDDEN))
        h = h + self.ffn(self.norm2(h))
        both = torch.cat([h[:, None].expand(n, n, -1), h[None].expand(n, n, -1), e], dim=-1)
        return h, self.edge_norm(e + self.edge_update(both))


class DecoderLayer(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.norm1, self.norm2, self.norm3 = (nn.LayerNorm(HIDDEN) for _ in range(3))
        self.self_attn = nn.MultiheadAttention(HIDDEN, HEADS, batch_first=True)
        self.cross_attn = nn.MultiheadAttention(HIDDEN, HEADS, batch_first=True)
        self.ffn = mlp(HIDDEN, 4 * HIDDEN, HIDDEN)

    def forward(self, s: Tensor, h: Tensor) -> Tensor:
        x = self.norm1(s)
        s = s + self.self_attn(x, x, x, need_weights=False)[0]
        s = s + self.cross_attn(self.norm2(s), h, h, need_weights=False)[0]
        return s + self.ffn(self.norm3(s))


class GraphEncoder(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.input_proj = nn.Linear(224, HIDDEN)
        self.edge_type_embed, self.edge_geo, self.edge_proj = nn.Embedding(5, 64), mlp(8, 64, 64), nn.Linear(128, EDGE)
        self.layers = nn.ModuleList([GraphLayer() for _ in range(4)])
        self.final_norm = nn.LayerNorm(HIDDEN)


class SlotDecoder(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        self.free_queries = nn.Parameter(torch.randn(FREE, HIDDEN) * 0.5)
        self.pool_mlp, self.pool_norm = mlp(HIDDEN, HIDDEN, HIDDEN), nn.LayerNorm(HIDDEN)
        self.layers = nn.ModuleList([DecoderLayer() for _ in range(4)])
        self.final_norm = nn.LayerNorm(HIDDEN)


class Heads(nn.Module):
    def __init__(self) -> None:
        super().__init__()
        pair = 2 * HIDDEN + 10
        self.exist, self.material = mlp(HIDDEN, 128, 1), mlp(HIDDEN, 128, WORDS)
        self.centroid, self.half_size = mlp(HIDDEN, 128, 3), mlp(HIDDEN, 128, 3)
        self.handle_border_4 = mlp(HIDDEN, 128, 4)
        self.edge, self.parent, self.hinge_target = mlp(pair, 256, 128, 5), mlp(pair, 128, 1), mlp(pair, 128, 1)
        self.parent_abstain, self.hinge_target_abstain = (nn.Parameter(torch.randn(1)) for _ in range(2))
        self.hinge_border_4, self.hinge_axis_sign = mlp(pair, 128, 4), mlp(pair, 128, 2)
        self.rail_axis_signed = mlp(pair, 128, 6)


class Authors(nn.Module):
    """9,224,401 weights."""

    def __init__(self) -> None:
        super().__init__()
        self.node_encoder, self.graph_encoder = NodeEncoder(), GraphEncoder()
        self.slot_decoder, self.heads = SlotDecoder(), Heads()

    def forward(
        self, words: Tensor, boxes: Tensor, anchors: Tensor, groups: Tensor, edges: Tensor
    ) -> dict[str, Tensor]:
        n, nodes = len(words), self.node_encoder
        c, half = boxes[:, :3], boxes[:, 3:]
        points = torch.stack([nodes.pointnet(a, g) for a, g in zip(anchors, groups, strict=True)])
        z = torch.cat([nodes.cat_embed(words), points, nodes.geo_mlp(torch.cat([c, c - half, c + half], dim=1))], dim=1)
        encoder, decoder = self.graph_encoder, self.slot_decoder
        h, r = encoder.input_proj(z), c[None] - c[:, None]
        gap = (r.abs() - half[None] - half[:, None]).clamp(min=0)
        far = r.norm(dim=-1, keepdim=True)
        terms = torch.cat([far, gap.norm(dim=-1, keepdim=True), r / far.clamp(min=1e-6), gap], dim=-1)
        e = encoder.edge_proj(torch.cat([encoder.edge_type_embed(edges), encoder.edge_geo(terms)], dim=-1))
        for layer in encoder.layers:
            h, e = layer(h, e)
        h = encoder.final_norm(h)
        free = decoder.free_queries + decoder.pool_norm(decoder.pool_mlp(h.mean(dim=0)))
        s = torch.cat([h, free, torch.zeros(SLOTS - n - FREE, HIDDEN)])
        for block in decoder.layers:
            s = block(s[None], h[None])[0]
        return self._answers(decoder.final_norm(s), c)

    def _answers(self, s: Tensor, given: Tensor) -> dict[str, Tensor]:
        heads, n = self.heads, len(given)
        centre = heads.centroid(s) + torch.cat([given, torch.zeros(len(s) - n, 3)])
        half, r = softplus(heads.half_size(s)), centre[None] - centre[:, None]
        gap = (r.abs() - half[None] - half[:, None]).clamp(min=0)
        both = [s[:, None].expand(len(s), len(s), -1), s[None].expand(len(s), len(s), -1)]
        pair = torch.cat([*both, r.abs(), r.norm(dim=-1, keepdim=True), r, gap], dim=-1)
        names = ("edge", "parent", "hinge_target", "hinge_border_4", "hinge_axis_sign", "rail_axis_signed")
        found = {name: getattr(heads, name)(pair) for name in names}
        return found | {"exist": heads.exist(s)[:, 0], "material": heads.material(s), "centre": centre, "half": half}


def authors(seed: int = 0) -> Authors:
    """Returns a network with random weights, norms too."""
    torch.manual_seed(seed)
    network = Authors().eval()
    with torch.no_grad():
        for weight in network.parameters():
            weight += 0.01 * torch.randn(weight.shape)
    return network
