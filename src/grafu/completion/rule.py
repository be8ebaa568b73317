"""Completes a graph by the carpenter's rules: the baseline, and the fallback, of the learned completion.

It looks at labels, boxes and contacts. Every door leaves with a hinge or a refusal, every drawer with its rails, every
handle with its door or drawer. Edges that the input states already are kept as they are.
"""

from grafu.completion.doors import hang_door
from grafu.completion.drawers import run_drawer
from grafu.completion.guess import guess_labels
from grafu.completion.handles import attach_handles
from grafu.completion.scene import Scene
from grafu.graph.completion import Decision, GraphCompletion, RefusedMotion
from grafu.graph.edges import Edge
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel


def complete_by_rule(graph: FunctionalGraph) -> GraphCompletion:
    """Returns the graph with a motion, or a stated reason against it, for every door and drawer.

    Parts without a label become doors, drawers or handles where their shape and place say so clearly. Scores are
    shares of votes in 0..1: they rank decisions, they are no probabilities.
    """
    labels, label_decisions = guess_labels(graph)
    attached = attach_handles(relabelled(graph, labels))
    scene = Scene(attached.graph)
    edges, decisions, refused = _move_parts(scene)
    return GraphCompletion(
        graph,
        with_edges(scene.graph, edges),
        "rule",
        (),
        (*label_decisions, *attached.decisions, *decisions),
        (*attached.refused, *refused),
    )


def _move_parts(scene: Scene) -> tuple[list[Edge], list[Decision], list[RefusedMotion]]:
    edges: list[Edge] = []
    decisions: list[Decision] = []
    refused: list[RefusedMotion] = []
    stated = {h.child for h in scene.graph.hinges} | {r.child for r in scene.graph.rails}
    for node in scene.graph.labelled(PartLabel.DOOR, PartLabel.DRAWER):
        if node.id in stated:
            continue
        answer = hang_door(node, scene) if node.label is PartLabel.DOOR else run_drawer(node, scene)
        if isinstance(answer, RefusedMotion):
            refused.append(answer)
            continue
        found, why = answer
        edges += found if isinstance(found, tuple) else (found,)
        decisions += why
    return edges, decisions, refused
