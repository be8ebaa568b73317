"""How inputs are corrupted: which strategies how often, and by how much. It corrupts nothing itself."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Literal, final, get_args

from grafu.dataclass import dataclass

StrategyName = Literal[
    "drop_handles",
    "drop_top",
    "drop_bottom",
    "drop_doors",
    "drop_drawers",
    "drop_multi_cat",
    "random",
    "fully_anonymized",
    "mask_materials_keep_edges",
    "mask_random_edges_keep_types",
    "drop_nodes_keep_edge_types",
    "fully_functional_drop",
    "isolate_door",
    "random_share",
    "drop_completion",
]
"""The paper's twelve strategies in the order of its table, and three that only the authors' code has."""

STRATEGY_NAMES: tuple[StrategyName, ...] = get_args(StrategyName)


@final
@dataclass(frozen=True, slots=True)
class CorruptionConfig:
    """The paper's numbers (supplement, Data Augmentation) where it states them; else the authors' code's.

    Raises:
        ValueError: if a strategy is unknown, a number is negative, a probability above 1, or nothing can be drawn.
    """

    weights: tuple[tuple[StrategyName, float], ...] = ()
    """Weights in place of the base weights of the table; a strategy that is not named keeps its base weight."""

    edge_preserving_boost: float = 1.0
    """Factor on the strategies that keep the kinds of edges: 1 in the paper, 3 in the authors' code."""

    max_dropped: int | None = 4
    """Most nodes that a corruption takes away: the paper's four free slots. None: no limit, whole categories go."""

    label_masking: float = 0.15
    """Chance of each label to be masked beyond what the strategy does; the two masking strategies do without
    (the authors' code; the paper is silent)."""

    mirror_probability: float = 0.5
    """Chance that input and target are both replaced by their mirror images (paper)."""

    mirror_axes: tuple[int, ...] = (0, 1)
    """The axes across which the mirror image is drawn: X or Y in the paper, X only in the authors' code."""

    keep_functional_edges: bool = True
    """Whether `fully_functional_drop` spares every node at a hinge, rail or attached edge (paper); the authors' code
    takes any part that is no door and no drawer."""

    def __post_init__(self) -> None:
        unknown = [name for name, _ in self.weights if name not in STRATEGY_NAMES]
        if unknown:
            raise ValueError(f"`weights` must name strategies {STRATEGY_NAMES}: got `{unknown[0]}`")
        if any(weight < 0 for _, weight in self.weights) or self.edge_preserving_boost < 0:
            raise ValueError(f"`weights` and `edge_preserving_boost` must not be negative: got {self}")
        if self.max_dropped is not None and self.max_dropped < 1:
            raise ValueError(f"`max_dropped` must be at least 1, or None: got {self.max_dropped}")
        if not (0 <= self.label_masking <= 1 and 0 <= self.mirror_probability <= 1):
            raise ValueError(f"`label_masking` and `mirror_probability` must be in 0..1: got {self}")
        if not set(self.mirror_axes) <= {0, 1} or (self.mirror_probability > 0 and not self.mirror_axes):
            raise ValueError(f"`mirror_axes` must be axes out of 0 (X) and 1 (Y): got {self.mirror_axes}")

    def reweighted(self, weights: Mapping[StrategyName, float]) -> "CorruptionConfig":
        """Returns this config with these weights in place of those that it had for the same strategies."""
        return replace(self, weights=tuple((dict(self.weights) | dict(weights)).items()))


PAPER = CorruptionConfig()
"""The paper's twelve strategies with its weights."""

OFFICIAL = CorruptionConfig(
    weights=(
        ("drop_multi_cat", 0.0),
        ("random", 0.0),
        ("isolate_door", 0.05),
        ("random_share", 0.05),
        ("drop_completion", 0.1),
    ),
    edge_preserving_boost=3.0,
    mirror_axes=(0,),
    keep_functional_edges=False,
)
"""As in the authors' code, which departs from the paper in all of these."""
