"""What weights are chosen by: the same graphs each time, of models that no training sees; and how well they do."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import isnan
from statistics import fmean

import torch
from torch import nn

from grafu.data.asked import VARIANTS, asked_pairs
from grafu.metrics.graph_accuracy import GraphAccuracy, total_accuracy
from grafu.training.batching import Showing, TrainingBatch, stack_showings
from grafu.training.config import TrainingConfig
from grafu.training.criterion import criterion
from grafu.training.lesson import Lesson, make_lesson
from grafu.training.loss_config import LossConfig
from grafu.training.raw_answers import batch_accuracy
from grafu.training.source import RESERVED_SEEDS, VALIDATION_SEED, FurFunSource, Source, SynthSource

SCORED = ("existence", "category", "contact", "hinge", "rail", "attached", "joint", "slide", "mount", "parent")
"""The figures whose mean over all variants the best weights have most of."""


def validation_source(source: Source, points: int) -> Source:
    """Returns what is to judge weights that `source` trains: made furniture, or the release's own validation part.

    Raises:
        ValueError: if the source is of the very furniture that is to judge.
        UnreadableAsset: if a release has no pair for validation.
    """
    if source.maker_seed in RESERVED_SEEDS:
        raise ValueError(f"the seed of the furniture must not be one of {RESERVED_SEEDS}: it judges the weights")
    if isinstance(source, FurFunSource):
        return replace(source, part="val")
    return SynthSource(VALIDATION_SEED, points)


def validation_batches(source: Source, config: TrainingConfig) -> list[TrainingBatch]:
    """Returns the graphs that judge, three for each model; models of similar size stand together."""
    count = config.validation.models
    if isinstance(source, FurFunSource):
        count = min(count, len(source.models))
    lessons = [_lesson(source, number, config) for number in range(count)]
    lessons.sort(key=lambda lesson: len(lesson.anchors))
    size = max(1, config.validation.batch // len(VARIANTS))
    hands = [lessons[k : k + size] for k in range(0, count, size)]
    shares_shifted = config.network.points_frame == "part"
    return [stack_showings([Showing(one, one.copies) for one in hand], shares_shifted) for hand in hands]


@torch.inference_mode()
def validate(network: nn.Module, batches: Iterable[TrainingBatch], loss: LossConfig) -> dict[str, float]:
    """Returns the loss, the figures of each variant by name, and `score`, the mean of those that count.

    The network is left in the mode it was in.
    """
    was_training = network.training
    device = next(network.parameters()).device
    totals: list[float] = []
    accuracies: dict[str, list[GraphAccuracy]] = {name: [] for name in VARIANTS}
    network.eval()
    try:
        for batch in batches:
            moved = batch.to(device)
            predictions = network(moved.graphs)
            totals.append(float(criterion(predictions, moved.targets, loss).total))
            for number, accuracy in enumerate(batch_accuracy(predictions, moved.targets)):
                accuracies[VARIANTS[number % len(VARIANTS)]].append(accuracy)
    finally:
        network.train(was_training)
    return _figures(totals, {name: total_accuracy(ones) for name, ones in accuracies.items()})


def _figures(totals: Sequence[float], accuracies: Mapping[str, GraphAccuracy]) -> dict[str, float]:
    by_variant = {name: accuracy.by_name() for name, accuracy in accuracies.items()}
    counted = [figures[name] for figures in by_variant.values() for name in SCORED if not isnan(figures[name])]
    named = {f"{variant}/{name}": value for variant, figures in by_variant.items() for name, value in figures.items()}
    return {"loss": fmean(totals), "score": fmean(counted) if counted else 0.0} | named


def _lesson(source: Source, number: int, config: TrainingConfig) -> Lesson:
    natural = source.pair(number)
    return make_lesson(list(asked_pairs(natural, number).values()), config.features)
