"""Unlabelled boards of one size in a row or column are of one kind: they get the mean of their labels' weights.

Of four equal fronts one above the other the network may take two for drawers and two for bars.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.components import linked
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.graph.functional_graph import FunctionalGraph
from grafu.shapes import Bool, Float64
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class AlikeConfig:
    """Which boards are alike.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or `least` not above 0.
    """

    same: float = 0.02
    """How far sizes, and places across the row, differ at most (fraction of the board's largest side)."""
    apart: float = 0.1
    """How wide the gap to the next one is at most (fraction of the board's side along the row)."""
    thin: float = 0.3
    """How thick a board is at most (fraction of its middle side)."""
    least: int = 3
    """So many alike are needed: of two that differ neither is in the majority."""

    def __post_init__(self) -> None:
        require_ratios(self, "same", "apart", "thin")
        require_positive(self, "least")


def with_alike(
    weights: Float64[np.ndarray, "n labels"], graph: FunctionalGraph, config: AlikeConfig = AlikeConfig()
) -> Float64[np.ndarray, "n labels"]:
    """Returns the weights of labels in which boards that are alike, next to one another, have the same."""
    unlabelled = [k for k, node in enumerate(graph.nodes) if node.label is PartLabel.UNKNOWN]
    boards = [k for k in unlabelled if _is_board(graph.nodes[k].box.size, config)]
    if len(boards) < config.least:
        return weights
    number = linked(len(boards), *np.nonzero(_next_to_alike(graph, boards, config)))
    made = weights.copy()
    for group in range(int(number.max()) + 1):
        members = np.array(boards)[number == group]
        if len(members) >= config.least:
            made[members] = made[members].mean(axis=0)
    return made


def _is_board(size: Float64[np.ndarray, "3"], config: AlikeConfig) -> bool:
    thin, middle, _ = np.sort(size)
    return bool(thin <= config.thin * middle)


def _next_to_alike(graph: FunctionalGraph, boards: list[int], config: AlikeConfig) -> Bool[np.ndarray, "n n"]:
    """Returns which boards are of one size, in one row or column of one plane, and next to one another in it."""
    boxes = [graph.nodes[k].box for k in boards]
    size = np.array([box.size for box in boxes])
    centre = np.array([box.center for box in boxes])
    near = config.same * size.max(axis=1)[:, None]
    same = (np.abs(size[:, None] - size[None]) <= near[..., None]).all(axis=2)
    moved = np.abs(centre[:, None] - centre[None])
    found = np.zeros(same.shape, dtype=bool)
    for along in range(3):
        across = [axis for axis in range(3) if axis != along]
        gap = moved[..., along] - size[:, None, along]
        beside = (gap >= -near) & (gap <= config.apart * size[:, None, along])
        is_thin = size.argmin(axis=1)[:, None] == along  # boards that lie on one another are a stack, no row
        found |= same & beside & (moved[..., across] <= near[..., None]).all(axis=2) & ~is_thin
    return found
