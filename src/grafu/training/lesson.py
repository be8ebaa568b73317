"""One model prepared for learning: its points grouped once, and several copies that lack something. No torch.

The points are those of the whole model, in its own frame. A copy names the points' rows of the parts that it shows, and
how the frame of what it shows lies to that of the whole: a model without its top is smaller, and the network must not
see by the scale that something is to be added.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, final

import numpy as np
from jaxtyping import Float32, Float64, Int64

from grafu.completion.features import FeatureConfig, graph_features, object_frame
from grafu.data.asked import masked_pair
from grafu.data.corruption.config import CorruptionConfig
from grafu.data.corruption.corrupt import fold
from grafu.data.pair import GraphPair
from grafu.geometry.arrays import ArrayValue, freeze_arrays
from grafu.graph.arrays import graph_arrays
from grafu.training.targets import GraphTargets, graph_targets

CopyKind = Literal["natural", "masked", "fold"]


@final
@dataclass(frozen=True)
class CopyMix:
    """How often a copy is the model as it was found, that with all labels hidden, or a corrupted one of its truth.

    `folds` is the number of different corrupted copies of a model (None: without end). Corrupted copies are of
    `corruption`; mirror images are drawn elsewhere, for all copies at once, so its mirror probability must be 0.

    Raises:
        ValueError: if a share is not in 0..1, there is nothing to draw, or the corruption mirrors.
    """

    natural: float
    masked: float
    corruption: CorruptionConfig
    folds: int | None = None

    def __post_init__(self) -> None:
        if min(self.natural, self.masked) < 0 or self.natural + self.masked > 1:
            raise ValueError(f"`natural` and `masked` must be shares of one: got {self.natural}, {self.masked}")
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

    `rows` are the nodes' rows in the points of the lesson. A point x there is `stretch` x + `shift` in this frame.
    """

    labels: Int64[np.ndarray, " n"]
    boxes: Float32[np.ndarray, "n 6"]
    edges: Int64[np.ndarray, "n n"]
    rows: Int64[np.ndarray, " n"]
    stretch: float
    shift: Float64[np.ndarray, "3"]
    targets: GraphTargets
    strategy: str

    def __post_init__(self) -> None:
        freeze_arrays(self)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Lesson(ArrayValue):
    """The grouped points of a whole model (u parts), and copies of it."""

    model_id: str
    anchors: Float32[np.ndarray, "u g 3"]
    groups: Float32[np.ndarray, "u g s 3"]
    copies: tuple[Copy, ...]

    def __post_init__(self) -> None:
        freeze_arrays(self)


def make_lesson(pairs: Sequence[GraphPair], features: FeatureConfig) -> Lesson:
    """Returns the lesson of pairs of one model, which all have its target.

    Raises:
        ValueError: if there is no pair, or their targets differ.
    """
    if not pairs or any(pair.target is not pairs[0].target for pair in pairs):
        raise ValueError("a lesson must be of pairs with one target")
    whole = graph_features(pairs[0].target, features)
    return Lesson(
        pairs[0].model_id,
        whole.anchors,
        whole.groups,
        tuple(_copy(pair, whole.origin, whole.scale) for pair in pairs),
    )


def draw_pairs(natural: GraphPair, count: int, mix: CopyMix, rng: np.random.Generator) -> list[GraphPair]:
    """Returns `count` pairs of a model, drawn by the mix."""
    return [_pair(natural, mix.draw(rng), mix, rng) for _ in range(count)]


def _pair(natural: GraphPair, kind: CopyKind, mix: CopyMix, rng: np.random.Generator) -> GraphPair:
    if kind == "fold":
        number = int(rng.integers(mix.folds if mix.folds is not None else 2**31))
        return fold(natural, number, config=mix.corruption)
    return natural if kind == "natural" else masked_pair(natural)


def _copy(pair: GraphPair, origin: np.ndarray, scale: float) -> Copy:
    given = pair.input
    seen = graph_arrays(given)
    new_origin, new_scale = object_frame(given)
    rows = {node.id: k for k, node in enumerate(pair.target.nodes)}
    names = [node.id for node in given.nodes]
    targets = graph_targets(pair.target, names, new_origin, new_scale)
    places = np.array([rows[name] for name in names], dtype=np.int64)
    return Copy(
        seen.labels,
        targets.boxes[places],
        seen.edges,
        places,
        scale / new_scale,
        (origin - new_origin) / new_scale,
        targets,
        pair.strategy,
    )
