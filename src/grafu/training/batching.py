"""Samples as padded batches: what is seen, and the answers. Copies of one model share rows of points.

The batches of a run are a function of its source, its config and the batch's number alone.
"""

from collections.abc import Generator, Sequence
from contextlib import closing
from dataclasses import replace
from typing import final

import numpy as np
import torch

from grafu.completion.name_codes import NAME_CODES
from grafu.completion.visibility import VISIBILITY_NUMBERS, visibility_of
from grafu.dataclass import dataclass
from grafu.graph.arrays import NULL
from grafu.network.batch import GraphBatch
from grafu.training.config import TrainingConfig
from grafu.training.sample import Copy, Sample, SampleBatch, Sampler, stream_samples
from grafu.training.source import Source
from grafu.training.targets import ROW_STEP, SLOT_STEP, TargetBatch, mirrored_targets, padded, stack_targets, stepped


@final
@dataclass(frozen=True)
class TrainingBatch:
    """What the network is shown, what it is to answer, and how each graph was made."""

    graphs: GraphBatch
    targets: TargetBatch
    strategies: tuple[str, ...]

    def __len__(self) -> int:
        return len(self.strategies)

    def to(self, device: torch.device | str) -> "TrainingBatch":
        """Returns the same batch on a device."""
        return replace(self, graphs=self.graphs.to(device), targets=self.targets.to(device))


@final
@dataclass(frozen=True)
class Showing:
    """Some copies of one sample, all as they are, or all as their mirror images across axis `across` (0: X, 1: Y)."""

    sample: Sample
    copies: Sequence[Copy]
    across: int | None = None


def stack_showings(showings: Sequence[Showing], shares_shifted: bool) -> TrainingBatch:
    """Returns the showings as one batch, copy by copy.

    Copies share rows of points where their frames have one scale, if `shares_shifted`, as a network may do that takes
    each part about its own middle; else where their frames are the same.

    Raises:
        ValueError: if there is no copy.
    """
    views = [_view(showing, copy) for showing in showings for copy in showing.copies]
    if not views:
        raise ValueError("a batch must hold at least one graph: got none")
    anchors, groups, index = _point_table(showings, shares_shifted)
    n = stepped(max(len(view.labels) for view in views), SLOT_STEP)
    rows = stepped(len(anchors), ROW_STEP)
    graphs = GraphBatch(
        labels=padded([v.labels for v in views], (n,), 0),
        boxes=padded([v.boxes for v in views], (n, 6), 0),
        edges=padded([v.edges for v in views], (n, n), NULL),
        mask=padded([np.ones(len(v.labels), dtype=bool) for v in views], (n,), 0),
        names=padded([v.names for v in views], (n, NAME_CODES), 0),
        transparent=padded([v.transparent for v in views], (n,), 0),
        point_index=padded(index, (n,), 0),
        anchors=padded([anchors], (rows, *anchors.shape[1:]), 0)[0],
        groups=padded([groups], (rows, *groups.shape[1:]), 0)[0],
        visibility=padded([visibility_of(anchors[k], groups[k]) for k in index], (n, VISIBILITY_NUMBERS), 0),
    )
    return TrainingBatch(graphs, stack_targets([v.targets for v in views], SLOT_STEP), tuple(v.strategy for v in views))


def _view(showing: Showing, copy: Copy) -> Copy:
    if showing.across is None:
        return copy
    boxes = copy.boxes.copy()
    boxes[:, showing.across] *= -1
    return replace(copy, boxes=boxes, targets=mirrored_targets(copy.targets, showing.across))


def _point_table(showings: Sequence[Showing], shares_shifted: bool) -> tuple[np.ndarray, np.ndarray, list[np.ndarray]]:
    """Returns the rows of points that are needed, each once, and for each copy the rows of its nodes."""
    anchors: list[np.ndarray] = []
    groups: list[np.ndarray] = []
    index: list[np.ndarray] = []
    start = 0
    for showing in showings:
        frames: dict[tuple[float, ...], list[int]] = {}
        for place, copy in enumerate(showing.copies):
            shift = () if shares_shifted else tuple(copy.shift.tolist())
            frames.setdefault((copy.stretch, *shift), []).append(place)
        own: dict[int, np.ndarray] = {}
        for places in frames.values():
            copies = [showing.copies[place] for place in places]
            rows = np.unique(np.concatenate([copy.rows for copy in copies]))
            new_anchors, new_groups = _in_frame(showing, rows, copies[0])
            anchors.append(new_anchors)
            groups.append(new_groups)
            own |= {p: start + np.searchsorted(rows, c.rows) for p, c in zip(places, copies, strict=True)}
            start += len(rows)
        index += [own[place] for place in range(len(showing.copies))]
    return np.concatenate(anchors), np.concatenate(groups), index


def _in_frame(showing: Showing, rows: np.ndarray, copy: Copy) -> tuple[np.ndarray, np.ndarray]:
    """Returns rows of points in the frame of a copy, mirrored if that is shown."""
    signs = np.ones(3)
    if showing.across is not None:
        signs[showing.across] = -1.0
    stretch = (signs * copy.stretch).astype(np.float32)
    shift = (signs * copy.shift).astype(np.float32)
    return showing.sample.anchors[rows] * stretch + shift, showing.sample.groups[rows] * stretch


def stream_batches(
    source: Source, config: TrainingConfig, start: int = 0, jobs: int = 1, part: tuple[int, int] = (0, 1)
) -> Generator[TrainingBatch, None, None]:
    """Yields batches from number `start` on, endlessly; `jobs` as in `stream_samples`, `part` as in Sampler."""
    sampler = Sampler(source, config.mix, config.features, config.seed, part)
    with closing(stream_samples(sampler, config.sampling, start, jobs)) as batches:
        for number, batch in enumerate(batches, start=start):
            rng = np.random.default_rng([config.seed, number, *part])
            yield stack_showings(_shown(batch, config, rng), config.network.points_frame == "part")


def _shown(batch: SampleBatch, config: TrainingConfig, rng: np.random.Generator) -> list[Showing]:
    """Returns what is shown of each model this time: the copies of this visit, perhaps mirrored."""
    count = config.sampling.copies
    showings = []
    for sample, visit in batch:
        across = int(rng.choice(config.mirror_axes)) if rng.random() < config.mirror else None
        showings.append(Showing(sample, sample.copies[visit * count : (visit + 1) * count], across))
    return showings
