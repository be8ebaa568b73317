"""The supplement's feature vector of a graph: how many parts, of which category, how connected, how large."""

from typing import Final

import numpy as np

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
