"""The input's own joints as a completed graph, so that every motion source ends in the same value. It builds nothing.

Which edges the joints stand for is decided in `grafu.graph.annotated`.
"""

from grafu.asset.part import Asset
from grafu.graph.annotated import annotated_edges
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Hinge, Rail, Slide
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph


def complete_by_annotation(asset: Asset, graph: FunctionalGraph, source: str = "annotation") -> GraphCompletion:
    """Returns the graph with an edge for each annotated joint and each handle that rides on a part.

    A joint that the codes cannot say (a door that turns across its plane), and a door or drawer without a joint,
     are refused here with the reason; a plan made from the annotation itself may still build it.
    `source` names who stated the joints, where that was not the input.
    """
    stated = annotated_edges(asset, graph)
    motions = {edge.child: edge for edge in reversed(stated.edges) if not isinstance(edge, Attached)}
    decisions = tuple(_decision(edge) for edge in reversed(motions.values()))
    completed = with_edges(graph, stated.edges)
    return GraphCompletion(graph, completed, source, decisions=decisions, refused=stated.refused)


def _decision(edge: Hinge | Rail | Slide) -> Decision:
    if isinstance(edge, Hinge):
        return Decision(edge.child, "border", str(edge.border), 1.0)
    return Decision(edge.child, "slide", str(edge.axis), 1.0)
