"""One functional graph to one corrupted pair: a strategy is drawn, labels are masked, both sides mirrored."""

from collections.abc import Collection

import numpy as np

from grafu.data.corruption.config import PAPER, STRATEGY_NAMES, CorruptionConfig, StrategyName
from grafu.data.corruption.masking import masked_each
from grafu.data.corruption.strategies import STRATEGIES, probabilities
from grafu.data.pair import GraphPair
from grafu.errors import GraphError
from grafu.graph.edit import mirrored, without_contacts
from grafu.graph.functional_graph import FunctionalGraph


def corrupt(
    target: FunctionalGraph,
    rng: np.random.Generator,
    config: CorruptionConfig = PAPER,
    apart: Collection[frozenset[str]] = (),
) -> GraphPair:
    """Returns a pair of the target (or its mirror image) and a corrupted copy; boxes and points are shared.

    `apart` are pairs of parts that do not touch: where a strategy makes contacts of edges, theirs vanishes instead.
    Without it the contact between a drawer and a wall a centimetre away would tell where its rail goes.

    Raises:
        GraphError: if the target has no nodes.
        ValueError: if the config leaves no strategy.
    """
    name = STRATEGY_NAMES[int(rng.choice(len(STRATEGY_NAMES), p=probabilities(config)))]
    return corrupt_by(name, _perhaps_mirrored(target, rng, config), rng, config, apart)


def corrupt_by(
    name: StrategyName,
    target: FunctionalGraph,
    rng: np.random.Generator,
    config: CorruptionConfig = PAPER,
    apart: Collection[frozenset[str]] = (),
) -> GraphPair:
    """Returns the pair of the target and its copy corrupted by one strategy, as `corrupt` does; neither is mirrored.

    Raises:
        GraphError: if the target has no nodes.
    """
    if not target.nodes:
        raise GraphError(f"a graph to corrupt must have nodes: `{target.model_id}` has none")
    strategy = STRATEGIES[name]
    given = without_contacts(strategy.apply(target, rng, config), apart)
    if strategy.family != "label masking" and config.label_masking > 0:
        given = without_contacts(masked_each(given, rng, config.label_masking), apart)
    return GraphPair(given, target, name, target.model_id)


def _perhaps_mirrored(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    if rng.random() >= config.mirror_probability:
        return target
    return mirrored(target, config.mirror_axes[int(rng.integers(len(config.mirror_axes)))])
