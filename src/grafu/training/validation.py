"""What weights are chosen by: the same graphs each time, of models that no training sees; and how well they do.

The network's answers are taken at their face, the likeliest everywhere, as graphs in arrays.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import isnan
from statistics import fmean

import numpy as np
import torch
from torch import Tensor, nn

from grafu.data.corruption.corrupt import VARIANTS, asked_pairs
from grafu.graph.arrays import (
    ALONG,
    ATTACHED,
    DOOR,
    DRAWER,
    HANDLE,
    HINGE,
    NONE,
    NULL,
    RAIL,
    SLIDE,
    TURN,
    GraphArrays,
)
from grafu.metrics.graph_accuracy import GraphAccuracy, compare_graphs, pair_added, total_accuracy
from grafu.network.batch import Predictions
from grafu.training.batching import Showing, TrainingBatch, stack_showings
from grafu.training.config import TrainingConfig
from grafu.training.criterion import criterion
from grafu.training.fact_figures import FactFigures
from grafu.training.loss_config import LossConfig
from grafu.training.matcher import match_slots, slot_truth
from grafu.training.sample import Sample, make_sample
from grafu.training.source import RESERVED_SEEDS, VALIDATION_SEED, FurFunSource, Source, SynthSource
from grafu.training.targets import TargetBatch

_CHILD_OF = {HINGE: DOOR, RAIL: DRAWER, ATTACHED: HANDLE}


def batch_accuracy(predictions: Predictions, targets: TargetBatch) -> list[GraphAccuracy]:
    """Returns how right the answers are, graph by graph; lengths are fractions of the object's largest side."""
    scores = {name: _array(value) for name, value in vars(predictions).items()}
    scores["mask"] &= ~scores["padding"]  # what padding slots answer is never used
    wanted = {name: _array(value) for name, value in vars(targets).items()}
    width = wanted["anchors"].shape[1]
    return [
        _accuracy(_found({k: v[g] for k, v in scores.items() if v.ndim}, width), {k: v[g] for k, v in wanted.items()})
        for g in range(len(wanted["labels"]))
    ]


def _accuracy(answer: tuple[GraphArrays, np.ndarray], wanted: dict[str, np.ndarray]) -> GraphAccuracy:
    found, slots = answer
    real = wanted["mask"]
    truth = GraphArrays(
        wanted["labels"][real],
        wanted["boxes"][real].astype(np.float64),
        wanted["edges"][real][:, real],
        wanted["child"][real][:, real],
        *(wanted[name][real] for name in ("border", "sign", "slide")),
    )
    known = np.full(len(slots), NONE)
    anchored = slots < len(wanted["anchors"])
    known[anchored] = wanted["anchors"][slots[anchored]]
    return compare_graphs(found, truth, pair_added(found, truth, known, 1.0), known == NONE, 1.0)


def _found(scores: dict[str, np.ndarray], width: int) -> tuple[GraphArrays, np.ndarray]:
    """Returns the graph that is answered, and the slot of each of its nodes; the first `width` slots are inputs."""
    free = np.arange(len(scores["mask"])) >= width
    slots = np.flatnonzero(scores["mask"] & (~free | (scores["exists"] > 0)))
    pairs = np.ix_(slots, slots)
    labels = scores["category"][slots].argmax(axis=-1)
    edges = scores["edge"][pairs].argmax(axis=-1)
    np.fill_diagonal(edges, NULL)
    child = np.zeros_like(edges, dtype=bool)
    boxes = np.hstack([scores["centre"][slots], scores["half"][slots]]).astype(np.float64)
    smaller, target = _is_smaller(boxes), scores["hinge_target"][pairs]
    for kind, label in _CHILD_OF.items():
        rather = target > target.T if kind == HINGE else smaller  # which of two doors hangs on the other
        child |= (edges == kind) & (labels == label)[:, None] & (rather | (labels != label)[None, :])
    child |= np.isin(edges, (SLIDE, TURN)) & smaller
    hinged, along = child & (edges == HINGE), child & np.isin(edges, ALONG)
    mount = _best(target, hinged)
    chances = scores["edge"][pairs]
    runner = _best(chances[..., [k for k in ALONG if k < chances.shape[-1]]].max(axis=-1), along)
    motions = (
        _at(scores["border"][pairs], mount),
        _at(scores["sign"][pairs], mount),
        _at(scores["slide"][pairs], runner),
    )
    return GraphArrays(labels, boxes, edges, child, *motions), slots


def _is_smaller(boxes: np.ndarray) -> np.ndarray:
    """Returns whether i is smaller than j: what slides or turns is smaller than what carries it."""
    volume = np.prod(boxes[:, 3:], axis=1)
    return np.asarray(volume[:, None] <= volume[None, :])


def _best(scores: np.ndarray, among: np.ndarray) -> np.ndarray:
    """Returns for each row the best of the columns that count, `NONE` where none does."""
    if not len(scores):
        return np.zeros(0, dtype=np.int64)
    return np.where(among.any(axis=1), np.where(among, scores, -np.inf).argmax(axis=1), NONE)


def _at(scores: np.ndarray, column: np.ndarray) -> np.ndarray:
    """Returns the likeliest code of each row at its column, `NONE` where it has none."""
    rows = np.arange(len(column))
    return np.where(column == NONE, NONE, scores[rows, column].argmax(axis=-1)) if len(column) else column


def _array(value: Tensor) -> np.ndarray:
    value = value.detach()
    return (value.float() if value.is_floating_point() else value).cpu().numpy()


SCORED = ("existence", "category", "contact", "hinge", "rail", "attached", "joint", "slide", "mount", "parent")
"""The figures whose mean over all variants the best weights have most of."""


def validation_source(source: Source, points: int) -> Source:
    """Returns what is to judge weights that `source` trains: synthetic furniture, or the release's own validation part.

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
    samples = [_sample(source, number, config) for number in range(count)]
    samples.sort(key=lambda sample: len(sample.anchors))
    size = max(1, config.validation.batch // len(VARIANTS))
    batches = [samples[k : k + size] for k in range(0, count, size)]
    shares_shifted = config.network.points_frame == "part"
    return [stack_showings([Showing(one, one.copies) for one in batch], shares_shifted) for batch in batches]


@torch.inference_mode()
def validate(network: nn.Module, batches: Iterable[TrainingBatch], loss: LossConfig) -> dict[str, float]:
    """Returns the loss, the figures of each variant by name, and `score`, the mean of those that count.

    The network is left in the mode it was in.
    """
    was_training = network.training
    device = next(network.parameters()).device
    totals: list[float] = []
    accuracies: dict[str, list[GraphAccuracy]] = {name: [] for name in VARIANTS}
    facts = FactFigures()
    network.eval()
    try:
        for batch in batches:
            moved = batch.to(device)
            predictions = network(moved.graphs)
            totals.append(float(criterion(predictions, moved.targets, loss).total))
            facts.add(
                predictions, slot_truth(predictions, moved.targets, match_slots(predictions, moved.targets, loss))
            )
            for number, accuracy in enumerate(batch_accuracy(predictions, moved.targets)):
                accuracies[VARIANTS[number % len(VARIANTS)]].append(accuracy)
    finally:
        network.train(was_training)
    figures = _figures(totals, {name: total_accuracy(ones) for name, ones in accuracies.items()})
    return figures | facts.by_name()


def _figures(totals: Sequence[float], accuracies: Mapping[str, GraphAccuracy]) -> dict[str, float]:
    by_variant = {name: accuracy.by_name() for name, accuracy in accuracies.items()}
    counted = [figures[name] for figures in by_variant.values() for name in SCORED if not isnan(figures[name])]
    named = {f"{variant}/{name}": value for variant, figures in by_variant.items() for name, value in figures.items()}
    return {"loss": fmean(totals), "score": fmean(counted) if counted else 0.0} | named


def _sample(source: Source, number: int, config: TrainingConfig) -> Sample:
    natural = source.pair(number)
    return make_sample(list(asked_pairs(natural, number).values()), config.features)
