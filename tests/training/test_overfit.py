"""Network and loss together: a tiny network learns two graphs by heart in a few seconds, parts and motions alike."""

import pytest
import torch

from grafu.completion.features import FeatureConfig, GraphFeatures, graph_features
from grafu.graph.edit import as_contacts, mirrored, without_nodes
from grafu.graph.functional_graph import FunctionalGraph
from grafu.metrics.graph_accuracy import total_accuracy
from grafu.network.batch import GraphBatch, Predictions, one_graph
from grafu.network.config import GraFuConfig
from grafu.network.grafu import GraFu
from grafu.training.criterion import criterion
from grafu.training.loss_config import PAPER, LossConfig
from grafu.training.targets import GraphTargets, TargetBatch, graph_targets, stack_targets
from grafu.training.validation import batch_accuracy
from joined_batches import join_batches
from small_graphs import cabinet

TINY = GraFuConfig(
    hidden=32, heads=4, encoder_layers=2, decoder_layers=2, edge=32, category=16, points=16, geometry=16,
    free_slots=2, dropout=0.0, geometry_dropout=0.0,
)  # fmt: skip
POINTS = FeatureConfig(points=32, anchors=4, neighbours=8)

pytestmark = pytest.mark.usefixtures("one_thread")


def seen(features: GraphFeatures) -> GraphBatch:
    names = ("labels", "boxes", "anchors", "groups", "edges", "visibility", "names", "transparent")
    return one_graph(*(torch.from_numpy(getattr(features, name).copy()) for name in names))


def sample(truth: FunctionalGraph, missing: list[str]) -> tuple[GraphBatch, GraphTargets]:
    given = without_nodes(as_contacts(truth), missing)
    features = graph_features(given, POINTS)
    wanted = graph_targets(truth, [n.id for n in given.nodes], features.origin, features.scale)
    return seen(features), wanted


def two_samples() -> tuple[GraphBatch, TargetBatch]:
    """A cabinet that lacks a knob, and the mirror image of a part of it that lacks nothing."""
    small = without_nodes(mirrored(cabinet(), 0), ["drawer_2", "knob_4", "back"])
    batches, targets = zip(sample(cabinet(), ["knob_2"]), sample(small, []), strict=True)
    return join_batches(batches), stack_targets(targets)


def learnt(config: LossConfig, steps: int) -> tuple[Predictions, list[float]]:
    torch.manual_seed(0)
    batch, targets = two_samples()
    network = GraFu(TINY)
    optimiser = torch.optim.AdamW(network.parameters(), lr=3e-3, weight_decay=0.0)
    schedule = torch.optim.lr_scheduler.CosineAnnealingLR(optimiser, steps)
    losses = []
    for _ in range(steps):
        loss = criterion(network(batch), targets, config).total
        optimiser.zero_grad()
        loss.backward()
        torch.nn.utils.clip_grad_norm_(network.parameters(), 1.0)
        optimiser.step()
        schedule.step()
        losses.append(loss.item())
    return network.eval()(batch), losses


def test_two_graphs_are_learnt_by_heart() -> None:
    answers, losses = learnt(LossConfig(), steps=100)
    assert losses[0] > 10
    assert losses[-1] < 0.05
    figures = total_accuracy(batch_accuracy(answers, two_samples()[1])).by_name()
    lengths = {name: figures.pop(name) for name in ("centre", "half", "added_centre")}
    assert {name: value for name, value in figures.items() if value != 1.0 and name not in ("slides", "turns")} == {}
    assert max(lengths.values()) < 0.02


def test_the_papers_free_assignment_learns_too() -> None:
    _, losses = learnt(PAPER, steps=40)
    assert losses[-1] < 0.5 * losses[0]
