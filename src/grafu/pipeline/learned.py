"""The trained network as a source of motions: it sees points on each part, which the graph does not keep."""

from dataclasses import replace
from pathlib import Path

from grafu.asset.part import Asset
from grafu.completion.network import complete_by_network
from grafu.completion.session import SHIPPED_WEIGHTS, open_network
from grafu.geometry.sampling import sample_surfaces
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph


def complete_by_weights(asset: Asset, graph: FunctionalGraph, weights: Path | None = None) -> GraphCompletion:
    """Returns the graph as the network completes it: that in the file `weights`, or the one that came with the package.

    Raises:
        WeightsError: if the file is missing, or is no such network.
    """
    network = open_network(weights or SHIPPED_WEIGHTS)
    clouds = sample_surfaces([asset.part(node.id).mesh for node in graph.nodes], network.features.points)
    pointed = tuple(replace(node, points=cloud) for node, cloud in zip(graph.nodes, clouds, strict=True))
    found = complete_by_network(replace(graph, nodes=pointed), network, network.features)
    bare = tuple(replace(node, points=None) for node in found.completed.nodes)
    return replace(found, input=graph, completed=replace(found.completed, nodes=bare))
