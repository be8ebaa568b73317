"""Graphs of random numbers, for a network that has learnt nothing."""

import torch  # noqa: TID251  # for tests of network and training alone
from torch import Tensor  # noqa: TID251

from grafu.completion.name_codes import NAME_BUCKETS, NAME_CODES
from grafu.graph.arrays import EDGE_CODES, NULL
from grafu.network.batch import GraphBatch, Predictions, one_graph
from grafu.network.config import LABEL_COUNT, GraFuConfig
from grafu.network.encoder import VISIBILITY_NUMBERS
from grafu.network.grafu import GraFu

TINY = GraFuConfig(
    hidden=16, heads=2, encoder_layers=2, decoder_layers=2, edge=12, category=8, points=6, geometry=4, free_slots=3
)
POINTS, ANCHORS, NEIGHBOURS = 20, 5, 4
NODE_FIELDS = ("exists", "category", "centre", "half", "ajar")
PAIR_FIELDS = ("edge", "parent", "hinge_target", "border", "sign", "slide", "body")


def arrays(n: int, seed: int = 0) -> dict[str, Tensor]:
    """Returns the features of one graph by name."""
    draw = torch.Generator().manual_seed(seed)
    edges = torch.randint(0, EDGE_CODES["all"], (n, n), generator=draw).triu(1)
    edges = edges + edges.T
    return {
        "labels": torch.randint(0, LABEL_COUNT, (n,), generator=draw),
        "boxes": torch.rand(n, 6, generator=draw) * 0.5,
        "anchors": torch.rand(n, ANCHORS, 3, generator=draw),
        "groups": torch.rand(n, ANCHORS, NEIGHBOURS, 3, generator=draw) * 0.1,
        "edges": edges.fill_diagonal_(NULL),
        "visibility": torch.rand(n, VISIBILITY_NUMBERS, generator=draw),
        "names": torch.randint(0, NAME_BUCKETS + 1, (n, NAME_CODES), generator=draw),
        "transparent": torch.rand(n, generator=draw),
    }


def graph(n: int, seed: int = 0) -> GraphBatch:
    """Returns a batch of one graph of n nodes."""
    return one_graph(**arrays(n, seed))


def tiny_network(config: GraFuConfig = TINY) -> GraFu:
    """Returns a network with random weights, the same at each call, that drops nothing.

    No two weights are alike: an exporter stores equal ones once, such as those of fresh norms.
    """
    torch.manual_seed(1)
    network = GraFu(config).eval()
    with torch.no_grad():
        for weight in network.parameters():
            weight += 0.01 * torch.randn(weight.shape)
    return network


def differences(found: Predictions, wanted: Predictions, slots: Tensor) -> dict[str, float]:
    """Returns by field how far the answers of all graphs are from those wanted, whose slots are `slots` of found."""
    same = {name: getattr(found, name)[:, slots] for name in (*NODE_FIELDS, "mask")}
    same |= {name: getattr(found, name)[:, slots][:, :, slots] for name in PAIR_FIELDS}
    same["piece"] = found.piece
    return {
        k: float((v.float() - getattr(wanted, k).float()).abs().max().detach()) for k, v in same.items() if v.numel()
    }
