"""One model prepared for learning: its points grouped once, and several copies that lack something. No torch.

The points are those of the whole model, in its own frame. A copy names the points' rows of the parts that it shows, and
how the frame of what it shows lies to that of the whole: a model without its top is smaller, and the network must not
see by the scale that something is to be added.

Samples come as an endless stream, made by several processes, and are grouped into batches of similar size, each sample
several times. Everything is a function of seeds and numbers: the number of processes changes nothing, and a run that
was cut goes on with the very batches that it would have had.
"""

from collections.abc import Generator, Iterator, Sequence
from contextlib import closing
from functools import partial
from itertools import count, islice
from typing import Literal, final

import numpy as np

from grafu.completion.features import FeatureConfig, graph_features, object_frame
from grafu.completion.name_codes import name_codes
from grafu.data.corruption.config import CorruptionConfig
from grafu.data.corruption.corrupt import fold, masked_pair
from grafu.data.pair import GraphPair
from grafu.data.stream import ordered_map
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, freeze_arrays
from grafu.graph.arrays import KindSet, graph_arrays
from grafu.shapes import Float32, Float64, Int64
from grafu.training.source import Source
from grafu.training.targets import GraphTargets, graph_targets

CopyKind = Literal["natural", "masked", "fold"]


@final
@dataclass(frozen=True)
class CopyMix:
    """How often a copy is the model as it was found, that with all labels hidden, or a corrupted one of its truth.

    `folds` is the number of different corrupted copies of a model (None: an endless stream). Corrupted copies are of
    `corruption`; mirror images are drawn elsewhere, for all copies at once, so its mirror probability must be 0.

    Raises:
        ValueError: if a fraction is not in 0..1, there is nothing to draw, or the corruption mirrors.
    """

    natural: float
    masked: float
    corruption: CorruptionConfig
    folds: int | None = None

    def __post_init__(self) -> None:
        if min(self.natural, self.masked) < 0 or self.natural + self.masked > 1:
            raise ValueError(f"`natural` and `masked` must be fractions of one: got {self.natural}, {self.masked}")
        if self.folds is not None and (self.folds < 0 or (not self.folds and self.natural + self.masked < 1)):
            raise ValueError(f"`folds` must be at least 1 where folds are drawn: got {self.folds}")
        if self.corruption.mirror_probability > 0:
            raise ValueError("the corruption must not mirror: the points of all copies are mirrored together")

    def draw(self, rng: np.random.Generator) -> CopyKind:
        """Returns what a copy is to be."""
        place = rng.random()
        return "natural" if place < self.natural else "masked" if place < self.natural + self.masked else "fold"


@final
@dataclass(frozen=True, eq=False, slots=True)
class Copy(ArrayValue):
    """What is seen of a model once (n nodes), and the answers.

    `rows` are the nodes' rows in the points of the sample. A point x there is `stretch` x + `shift` in this frame.
    """

    labels: Int64[np.ndarray, " n"]
    boxes: Float32[np.ndarray, "n 6"]
    edges: Int64[np.ndarray, "n n"]
    names: Int64[np.ndarray, "n c"]
    transparent: Float32[np.ndarray, " n"]
    rows: Int64[np.ndarray, " n"]
    stretch: float
    shift: Float64[np.ndarray, "3"]
    targets: GraphTargets
    strategy: str

    def __post_init__(self) -> None:
        freeze_arrays(self)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Sample(ArrayValue):
    """The grouped points of a whole model (u parts), and copies of it."""

    model_id: str
    anchors: Float32[np.ndarray, "u g 3"]
    groups: Float32[np.ndarray, "u g s 3"]
    copies: tuple[Copy, ...]

    def __post_init__(self) -> None:
        freeze_arrays(self)


def make_sample(pairs: Sequence[GraphPair], features: FeatureConfig) -> Sample:
    """Returns the sample of pairs of one model, which all have its target.

    Raises:
        ValueError: if there is no pair, or their targets differ.
    """
    if not pairs or any(pair.target is not pairs[0].target for pair in pairs):
        raise ValueError("a sample must be of pairs with one target")
    whole = graph_features(pairs[0].target, features)
    return Sample(
        pairs[0].model_id,
        whole.anchors,
        whole.groups,
        tuple(_copy(pair, whole.origin, whole.scale, features.kinds) for pair in pairs),
    )


def draw_pairs(natural: GraphPair, count: int, mix: CopyMix, rng: np.random.Generator) -> list[GraphPair]:
    """Returns `count` pairs of a model, drawn by the mix."""
    return [_pair(natural, mix.draw(rng), mix, rng) for _ in range(count)]


def _pair(natural: GraphPair, kind: CopyKind, mix: CopyMix, rng: np.random.Generator) -> GraphPair:
    if kind == "fold":
        number = int(rng.integers(mix.folds if mix.folds is not None else 2**31))
        return fold(natural, number, config=mix.corruption)
    return natural if kind == "natural" else masked_pair(natural)


def _copy(pair: GraphPair, origin: np.ndarray, scale: float, kinds: KindSet) -> Copy:
    given = pair.input
    seen = graph_arrays(given, kinds)
    new_origin, new_scale = object_frame(given)
    rows = {node.id: k for k, node in enumerate(pair.target.nodes)}
    names = [node.id for node in given.nodes]
    targets = graph_targets(pair.target, names, new_origin, new_scale, kinds, pair.facts)
    places = np.array([rows[name] for name in names], dtype=np.int64)
    return Copy(
        seen.labels,
        targets.boxes[places],
        seen.edges,
        name_codes([node.source_name for node in given.nodes]),
        np.array([node.transparent for node in given.nodes], dtype=np.float32),
        places,
        scale / new_scale,
        (origin - new_origin) / new_scale,
        targets,
        pair.strategy,
    )


SampleBatch = list[tuple[Sample, int]]
"""The models of one batch, and which visit (0, 1, ...) each of them gets."""


@final
@dataclass(frozen=True)
class SamplerConfig:
    """How samples form batches.

    Each batch holds `models`, and of each model `copies` that share its points. A model is visited `reuse` times, with
    other copies: making it and grouping its points is most of the work of a sample. Between two visits lie about
    `spread` batches. Batches are of models of similar size, so that little is padding.

    Raises:
        ValueError: if a number is less than 1.
    """

    models: int = 4
    copies: int = 4
    reuse: int = 4
    spread: int = 64

    def __post_init__(self) -> None:
        if min(self.models, self.copies, self.reuse, self.spread) < 1:
            raise ValueError(f"the numbers of `SamplerConfig` must be at least 1: got {self}")

    @property
    def fresh(self) -> int:
        """How many new models come in one round."""
        return max(1, self.spread // self.reuse) * self.models

    def batches_in(self, turn: int) -> int:
        """How many batches round `turn` (0, 1, ...) has: the first ones have fewer models to draw from."""
        return min(turn + 1, self.reuse) * self.fresh // self.models

    def round_of(self, batch: int) -> tuple[int, int]:
        """Returns the round that batch `batch` (0, 1, ...) belongs to, and which one it is there."""
        turn = 0
        while turn < self.reuse - 1 and batch >= self.batches_in(turn):
            batch -= self.batches_in(turn)
            turn += 1
        return (
            (turn, batch)
            if turn < self.reuse - 1
            else (turn + batch // self.batches_in(turn), batch % self.batches_in(turn))
        )


@final
@dataclass(frozen=True)
class Sampler:
    """The samples of a source, by number; their copies are drawn with `seed`.

    `part` (k, n) takes every n-th model, from the k-th on: n readers share a source without a double.
    """

    source: Source
    mix: CopyMix
    features: FeatureConfig
    seed: int
    part: tuple[int, int] = (0, 1)

    def sample(self, copies: int, number: int) -> Sample:
        """Returns sample `number` (0, 1, ...), with so many copies."""
        model = number * self.part[1] + self.part[0]
        rng = np.random.default_rng([self.seed, model])
        return make_sample(draw_pairs(self.source.pair(model), copies, self.mix, rng), self.features)


def stream_samples(
    sampler: Sampler, sampling: SamplerConfig, start: int = 0, jobs: int = 1
) -> Generator[SampleBatch, None, None]:
    """Yields the batches from number `start` on, as an endless stream.

    The samples are made by `jobs` processes (1: by this one), as in `ordered_map`.
    """
    make = partial(sampler.sample, sampling.copies * sampling.reuse)
    turn, skipped = sampling.round_of(start)
    first = max(0, turn - sampling.reuse + 1)
    with closing(ordered_map(make, first * sampling.fresh, None, jobs)) as samples:
        yield from islice(_streamed(samples, sampling, (sampler.seed, *sampler.part), first, turn), skipped, None)


def _streamed(
    samples: Iterator[Sample], sampling: SamplerConfig, seed: Sequence[int], first: int, turn: int
) -> Iterator[SampleBatch]:
    """Yields the batches of round `turn` and all later ones; the samples begin with those of round `first`.

    While a round is streamed the samples of the next are taken in, some after each batch, so that no step waits for
    all.
    """
    kept: list[list[Sample]] = [list(islice(samples, sampling.fresh)) for _ in range(first, turn + 1)]
    for now in count(turn):
        batches = _batches(kept, sampling, np.random.default_rng([*seed, now]))
        coming: list[Sample] = []
        for number, batch in enumerate(batches, start=1):
            yield batch
            coming.extend(islice(samples, number * sampling.fresh // len(batches) - len(coming)))
        kept = [*kept[-sampling.reuse + 1 :], coming] if sampling.reuse > 1 else [coming]


def _batches(kept: Sequence[Sequence[Sample]], sampling: SamplerConfig, rng: np.random.Generator) -> list[SampleBatch]:
    """Returns all kept samples as batches of similar sizes in a drawn order; the newest get their first visit."""
    visits = [(sample, visit) for visit, samples in enumerate(reversed(kept)) for sample in samples]
    visits = [visits[int(k)] for k in rng.permutation(len(visits))]
    visits.sort(key=lambda one: len(one[0].anchors))
    batches = [visits[k : k + sampling.models] for k in range(0, len(visits), sampling.models)]
    return [batches[int(k)] for k in rng.permutation(len(batches))]
