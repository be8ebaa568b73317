"""One functional graph to one corrupted pair: a strategy is drawn, labels are masked, both sides mirrored."""

import numpy as np

from grafu.data.corruption.config import PAPER, STRATEGY_NAMES, CorruptionConfig, StrategyName
from grafu.data.corruption.masking import masked_each
from grafu.data.corruption.strategies import STRATEGIES, probabilities
from grafu.data.pair import GraphPair
from grafu.errors import GraphError
from grafu.graph.edit import mirrored
from grafu.graph.functional_graph import FunctionalGraph


def corrupt(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig = PAPER) -> GraphPair:
    """Returns a pair of the target (or its mirror image) and a corrupted copy; boxes and points are shared.

    Raises:
        GraphError: if the target has no nodes.
        ValueError: if the config leaves no strategy.
    """
    name = STRATEGY_NAMES[int(rng.choice(len(STRATEGY_NAMES), p=probabilities(config)))]
    return corrupt_by(name, _perhaps_mirrored(target, rng, config), rng, config)


def corrupt_by(
    name: StrategyName,
    target: FunctionalGraph,
    rng: np.random.Generator,
    config: CorruptionConfig = PAPER,
) -> GraphPair:
    """Returns the pair of the target and its copy corrupted by one strategy; neither is mirrored.

    Raises:
        GraphError: if the target has no nodes.
    """
    if not target.nodes:
        raise GraphError(f"a graph to corrupt must have nodes: `{target.model_id}` has none")
    strategy = STRATEGIES[name]
    given = strategy.apply(target, rng, config)
    if strategy.family != "label masking" and config.label_masking > 0:
        given = masked_each(given, rng, config.label_masking)
    return GraphPair(given, target, name, target.model_id)


def _perhaps_mirrored(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    if rng.random() >= config.mirror_probability:
        return target
    return mirrored(target, config.mirror_axes[int(rng.integers(len(config.mirror_axes)))])
