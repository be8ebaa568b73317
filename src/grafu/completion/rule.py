"""Completes a graph by rules of geometry: the baseline and the fallback of the network.

It looks at labels, boxes and contacts. Every door leaves with a hinge or a refusal, every drawer with its rails, every
handle with its door or drawer. Edges that the input states already are kept as they are.
"""

from grafu.completion.answers import move_parts
from grafu.completion.doors import hang_door
from grafu.completion.drawers import run_drawer
from grafu.completion.guess import guess_labels
from grafu.completion.handles import attach_handles
from grafu.completion.rule_scene import RuleScene
from grafu.graph.completion import GraphCompletion
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph


def complete_by_rule(graph: FunctionalGraph) -> GraphCompletion:
    """Returns the graph with a motion, or a stated reason against it, for every door and drawer.

    Parts without a label become doors, drawers or handles where their shape and place say so clearly. Scores are
    fractions of votes in 0..1: they rank decisions and are no probabilities.
    """
    labels, label_decisions = guess_labels(graph)
    attached = attach_handles(relabelled(graph, labels))
    scene = RuleScene(attached.graph)
    motions = move_parts(scene, lambda door: hang_door(door, scene), lambda drawer: run_drawer(drawer, scene))
    return GraphCompletion(
        graph,
        with_edges(scene.graph, motions.edges),
        "rule",
        (),
        (*label_decisions, *attached.decisions, *motions.decisions),
        (*attached.refused, *motions.refused),
    )
