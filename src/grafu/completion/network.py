"""Completes a graph by the trained network: say what each part is, look again, add what is missing, then decide.

Labels come first, because the network sees better what goes where when it is told what the parts are. Free slots are
asked again, with what they added now seen as parts, until none fires: there is no most of handles. The last look is
the mean of two, at the graph and at its mirror image: who is right about the one is not always about the other.
"""

import numpy as np

from grafu.completion.beliefs import Beliefs, averaged, beliefs_of, mirrored_back
from grafu.completion.decode import complete_reading, read_graph
from grafu.completion.decode_config import DecodeConfig
from grafu.completion.features import FeatureConfig, GraphFeatures, graph_features, mirrored
from grafu.completion.labelling import choose_labels
from grafu.completion.session import GraphNetwork
from grafu.completion.slots import NewPart, new_parts, with_parts
from grafu.geometry.budget import fits, present_budget, require_room, require_time
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edit import relabelled
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

_ACROSS = 0  # furniture is alike on its left and right, not in front and behind
_MOVERS_PER_ROUND = 4  # handles that one look can add: the paper's free slots
_PAIR_BYTES = 4_500  # of each two parts, while the network looks
_ADDING = 0.6  # of the time: asking again for what is missing


def complete_by_network(
    graph: FunctionalGraph, network: GraphNetwork, features: FeatureConfig, config: DecodeConfig = DecodeConfig()
) -> GraphCompletion:
    """Returns the graph with labels, handles, missing parts, and a motion or a refusal for each door and drawer.

    `features` says how many points the network wants to see. Nodes should have points; those without are seen as their
    boxes. Scores of decisions are the network's probabilities, renormalised over what could be chosen.

    Raises:
        TooComplex: if there are so many parts, each seen beside each, that the budget in force does not hold them.
    """
    if not graph.nodes:
        return GraphCompletion(graph, graph, "network")
    require_room(len(graph.nodes) ** 2, _PAIR_BYTES, f"the network's look at {len(graph.nodes):,} parts")
    adding = present_budget().share(_ADDING)
    seen, labelling = label_parts(graph, network, features, config)
    added: list[NewPart] = []
    given = frozenset(node.id for node in graph.nodes)
    rounds = 0
    while True:
        sight, beliefs = look(seen, network, features)
        parents = {part.node.id: part.parent for part in added if part.parent is not None}
        reading = read_graph(seen, beliefs, given, parents, config)
        most = config.rounds + len(reading.view.movers) // _MOVERS_PER_ROUND
        goes_on = rounds < most and adding.left > 0 and fits(len(seen.nodes) ** 2, _PAIR_BYTES)
        found = new_parts(reading.view, reading.held) if goes_on else ()
        if not found:
            if config.mirror:
                reading = read_graph(seen, with_image(beliefs, seen, sight, network), given, parents, config)
            return complete_reading(graph, reading, labelling, added)
        seen, rounds = with_parts(seen, found), rounds + 1
        added += found


def label_parts(
    graph: FunctionalGraph, network: GraphNetwork, features: FeatureConfig, config: DecodeConfig
) -> tuple[FunctionalGraph, tuple[Decision, ...]]:
    """Returns the graph with a label for each unlabelled part, and how sure each is; one look where there is any."""
    if all(node.label is not PartLabel.UNKNOWN for node in graph.nodes):
        return graph, ()
    _, beliefs = look(graph, network, features)
    labels, decisions = choose_labels(graph, beliefs, config)
    return relabelled(graph, labels), decisions


def look(graph: FunctionalGraph, network: GraphNetwork, features: FeatureConfig) -> tuple[GraphFeatures, Beliefs]:
    """Returns how a graph is seen, and what a network believes about it."""
    require_time()
    sight = graph_features(graph, features)
    return sight, beliefs_of(network(sight))


def with_image(beliefs: Beliefs, graph: FunctionalGraph, sight: GraphFeatures, network: GraphNetwork) -> Beliefs:
    """Returns the mean of what a network believes about a graph, as it is seen, and about its mirror image."""
    image = beliefs_of(network(mirrored(sight, _ACROSS)))
    thin = np.array([node.box.thin_axis for node in graph.nodes], dtype=np.int64)
    return averaged(beliefs, mirrored_back(image, thin, _ACROSS), len(graph.nodes))
