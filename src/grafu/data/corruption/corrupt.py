"""One functional graph to corrupted pairs: a strategy is drawn, labels are masked, both sides mirrored.

Many pairs come from each model: the natural one, and corrupted copies. A copy depends on seed, model and number alone.
Where a network is judged, a model is asked about in three ways, which are drawn once and stay the same.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping
from hashlib import blake2b

import numpy as np

from grafu.data.corruption.config import PAPER, STRATEGY_NAMES, CorruptionConfig, StrategyName
from grafu.data.corruption.strategies import STRATEGIES, masked_each, probabilities
from grafu.data.pair import GraphPair, natural_pair
from grafu.errors import GraphError
from grafu.graph.edit import as_contacts, mirrored, relabelled, without_contacts, without_names
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel


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
    given = without_names(given, [node.id for node in given.nodes if node.label is PartLabel.UNKNOWN])
    return GraphPair(given, target, name, target.model_id)


def _perhaps_mirrored(target: FunctionalGraph, rng: np.random.Generator, config: CorruptionConfig) -> FunctionalGraph:
    if rng.random() >= config.mirror_probability:
        return target
    return mirrored(target, config.mirror_axes[int(rng.integers(len(config.mirror_axes)))])


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
    return GraphPair(pair.input, pair.target, pair.strategy, natural.model_id, natural.facts)


VARIANTS = ("natural", "masked", "lacking")
"""Each model as it was found, that with its labels hidden, and one from which the paper's corruptions took away."""

MASKED = "natural, labels masked"  # named beside the strategies of corruption

INCOMPLETE = CorruptionConfig(
    weights=tuple(
        (name, 0.0)
        for name in (
            "fully_anonymized",  # a variant of its own
            "mask_materials_keep_edges",
            "mask_random_edges_keep_types",
            "drop_nodes_keep_edge_types",
            "fully_functional_drop",  # in use, an input never knows the kinds of its edges
            "drop_doors",
            "drop_drawers",
        )
    ),
    mirror_probability=0.0,
    label_masking=PAPER.label_masking,
)


def asked_pairs(natural: GraphPair, number: int) -> Mapping[str, GraphPair]:
    """Returns the pairs of model `number` by variant."""
    return {
        "natural": natural,
        "masked": masked_pair(natural),
        "lacking": fold(natural, number, config=INCOMPLETE),
    }


def masked_pair(natural: GraphPair) -> GraphPair:
    """Returns a natural pair with every label of the input hidden, and the names that would state it."""
    hidden = {node.id: PartLabel.UNKNOWN for node in natural.input.nodes}
    given = without_names(relabelled(as_contacts(natural.input), hidden), hidden)
    return GraphPair(given, natural.target, MASKED, natural.model_id, natural.facts)
