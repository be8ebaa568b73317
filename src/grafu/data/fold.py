"""Many pairs from each model: the natural one, and corrupted copies. A copy depends on seed, model and number alone."""

from collections.abc import Iterable, Iterator
from hashlib import blake2b

import numpy as np

from grafu.data.corruption.config import PAPER, CorruptionConfig
from grafu.data.corruption.corrupt import corrupt
from grafu.data.pair import GraphPair, natural_pair
from grafu.graph.functional_graph import FunctionalGraph

FOLDS = 17  # the paper's, chosen on its validation set


def folded(
    models: Iterable[GraphPair | FunctionalGraph],
    folds: int = FOLDS,
    seed: int = 0,
    config: CorruptionConfig = PAPER,
) -> Iterator[GraphPair]:
    """Yields each model's natural pair and then `folds` corrupted ones of its target, model by model.

    A bare functional graph is its own target. Nothing depends on the order of the models, nor on what else is there.

    Raises:
        ValueError: if `folds` is negative.
    """
    if folds < 0:
        raise ValueError(f"`folds` must not be negative: got {folds}")
    for model in models:
        pair = model if isinstance(model, GraphPair) else natural_pair(model)
        yield pair
        for number in range(folds):
            yield fold(pair, number, seed, config)


def fold(natural: GraphPair, number: int, seed: int = 0, config: CorruptionConfig = PAPER) -> GraphPair:
    """Returns the corrupted pair `number` (from 0) of a model's natural pair, the same for the same seed.

    Parts that do not touch in the natural input do not touch in the corrupted one either.
    """
    digest = int.from_bytes(blake2b(natural.model_id.encode(), digest_size=8).digest(), "little")
    rng = np.random.default_rng([seed, digest, number])
    pair = corrupt(natural.target, rng, config, natural.apart)
    return GraphPair(pair.input, pair.target, pair.strategy, natural.model_id)
