"""Graphs of very many nodes are laid out in little memory: no table of all pairs."""

import tracemalloc

import numpy as np

from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.render.graph_layout import node_places
from grafu.vocabulary import PartLabel


def graph_of(count: int) -> FunctionalGraph:
    middles = np.random.default_rng(0).uniform(0, 1, (count, 3))
    nodes = (PartNode(f"p{k}", PartLabel.SHELF, Box(at - 0.01, at + 0.01)) for k, at in enumerate(middles))
    return FunctionalGraph("many", tuple(nodes), ())


def test_two_thousand_nodes_take_little_memory_and_stay_in_the_picture() -> None:
    graph = graph_of(2000)
    tracemalloc.start()
    places = node_places(graph, (880, 560), 10.0, 12.0)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 5e6  # all pairs alone are 64 MB
    assert (places >= 10.0).all()
    assert (places <= [870.0, 550.0]).all()
