"""The trained network as a source of motions: it sees points on each part, which the graph does not keep."""

from dataclasses import replace

from grafu.asset.part import Asset
from grafu.completion.network import complete_by_network
from grafu.completion.session import open_network
from grafu.geometry.sampling import sample_surfaces
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph


def complete_by_weights(asset: Asset, graph: FunctionalGraph) -> GraphCompletion:
    """Returns the graph as the network that came with the package completes it.

    Raises:
        WeightsError: if none came with it.
    """
    network = open_network()
    clouds = sample_surfaces([asset.part(node.id).mesh for node in graph.nodes], network.features.points)
    pointed = tuple(replace(node, points=cloud) for node, cloud in zip(graph.nodes, clouds, strict=True))
    found = complete_by_network(replace(graph, nodes=pointed), network, network.features)
    bare = tuple(replace(node, points=None) for node in found.completed.nodes)
    return replace(found, input=graph, completed=replace(found.completed, nodes=bare))
