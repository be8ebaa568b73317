"""How far a graph lies from those that weights are trained on: features over their spread, and the nearest of them.

The features are the supplement's: how many parts, of which category, how connected, how large.
"""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.graph.edges import Contact
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

FEATURE_NAMES: Final = (
    "nodes",
    *(label.value for label in PartLabel),
    "average degree",
    "width",
    "depth",
    "height",
)


def graph_features(graph: FunctionalGraph) -> tuple[float, ...]:
    """Returns the features of an input graph, in the order of `FEATURE_NAMES`; sides of the box are metres.

    Only contacts count as edges, for an input has no others.
    """
    count = len(graph.nodes)
    counts = [float(sum(node.label is label for node in graph.nodes)) for label in PartLabel]
    edges = sum(isinstance(edge, Contact) for edge in graph.edges)
    degree = 2 * edges / count if count else 0.0
    return (float(count), *counts, degree, *(float(side) for side in np.asarray(graph.box.size)))


TRAINING_SEED = 0  # of the synthetic furniture that stands for what is trained on; tests of weights use others
TRAINING_COUNT = 300


@final
@dataclass(frozen=True)
class Distance:
    """How far a graph lies out: from the middle of the distribution, and from its nearest member (which one).

    Both are Euclidean lengths in units of the features' standard deviations.
    """

    from_middle: float
    from_nearest: float
    nearest: int


@final
class Distribution:
    """The features of a training set, ready to be asked; a feature that never changes there counts in its own unit.

    Raises:
        ValueError: if there are no features, or they are not all as long.
    """

    def __init__(self, features: Sequence[Sequence[float]]) -> None:
        if not features or len({len(one) for one in features}) > 1:
            raise ValueError(f"a distribution needs feature vectors of one length: got {len(features)} of them")
        array = np.array(features, dtype=np.float64)
        spread = array.std(axis=0)
        self._middle, self._spread = array.mean(axis=0), np.where(spread > 0, spread, 1.0)
        self._members = self._scored(array)

    def scores(self, features: Sequence[float]) -> tuple[float, ...]:
        """Returns each feature's z-score."""
        return tuple(float(value) for value in self._scored(np.array(features, dtype=np.float64)))

    def distance(self, features: Sequence[float]) -> Distance:
        """Returns how far a feature vector lies out."""
        scored = self._scored(np.array(features, dtype=np.float64))
        apart = np.linalg.norm(self._members - scored, axis=1)
        nearest = int(np.argmin(apart))
        return Distance(float(np.linalg.norm(scored)), float(apart[nearest]), nearest)

    def _scored(self, values: np.ndarray) -> np.ndarray:
        return np.asarray((values - self._middle) / self._spread)
