"""Decodes probabilities into a completed graph: exclusive, consistent, and with an answer for every part.

Handles are assigned first, then the motions of doors and drawers. What each part is, is settled
before. Edges that the input states are kept as they are.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import final

from grafu.completion.answers import Motions, move_parts
from grafu.completion.columns import agreed_borders
from grafu.completion.decode_config import DecodeConfig
from grafu.completion.doors import slide_door
from grafu.completion.facts import ajar_decisions, piece_guess, rides
from grafu.completion.other_motions import other_motions
from grafu.completion.probabilities import Probabilities
from grafu.completion.rule_scene import RuleScene
from grafu.completion.selection import borders_of, choose_hinge, choose_parent, choose_rails
from grafu.completion.slots import NewPart, weighed
from grafu.completion.view import GraphView
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Slide
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.refusal import Refusal
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class DecodedGraph:
    """A graph whose handles have parents, beside their probabilities."""

    view: GraphView
    decisions: tuple[Decision, ...]
    refused: tuple[Refusal, ...]

    @property
    def held(self) -> frozenset[str]:
        """The doors and drawers that have a handle."""
        return frozenset(edge.parent for edge in self.view.graph.attachments)

    def stating(self, borders: Mapping[str, Scalars]) -> "DecodedGraph":
        """Returns the same with what is stated of the borders of some doors (`GraphView.borders`)."""
        return replace(self, view=replace(self.view, borders=borders))


def decode_graph(
    graph: FunctionalGraph,
    probabilities: Probabilities,
    given: frozenset[str],
    parents: Mapping[str, str],
    config: DecodeConfig = DecodeConfig(),
) -> DecodedGraph:
    """Returns a graph of labelled parts with its handles settled.

    `given` are the ids of the input's own parts; `parents` states for which door or drawer a handle was added.
    """
    view = GraphView(graph, probabilities, given, config)
    decisions: tuple[Decision, ...] = ()
    known = {edge.child for edge in view.graph.attachments}
    found: list[Attached] = []
    refused: list[Refusal] = []
    for handle in view.graph.labelled(PartLabel.HANDLE):
        if handle.id in known:
            continue
        if handle.id in parents and view.graph.node(parents[handle.id]).label.is_movable:
            found.append(Attached(parents[handle.id], handle.id))
            continue
        answer = choose_parent(handle, view)
        if isinstance(answer, Refusal):
            refused.append(answer)
        else:
            found.append(answer[0])
            decisions += (answer[1],)
    found += _on_handles(found, [refusal.part for refusal in refused], view.graph)
    kept = tuple(refusal for refusal in refused if refusal.part not in {edge.child for edge in found})
    held = GraphView(with_edges(view.graph, found), probabilities, given, config)
    return DecodedGraph(held, decisions, kept)


def _on_handles(found: Sequence[Attached], left: Sequence[str], graph: FunctionalGraph) -> list[Attached]:
    """Returns the edges of handles that are on no door or drawer, but touch a handle that is: grips on posts."""
    parent_of = {edge.child: edge.parent for edge in (*graph.attachments, *found)}
    edges: list[Attached] = []
    waiting = list(left)
    while waiting:
        next_to = {name: [n for n in graph.neighbours[name] if n in parent_of] for name in waiting}
        name = next((name for name in waiting if next_to[name]), None)
        if name is None:
            break
        parent_of[name] = parent_of[min(next_to[name])]
        edges.append(Attached(parent_of[name], name))
        waiting.remove(name)
    return edges


def complete_decoded(
    graph: FunctionalGraph, decoded: DecodedGraph, labelling: tuple[Decision, ...], added: Sequence[NewPart]
) -> GraphCompletion:
    """Returns the completion of `graph`: every door and drawer moves, or there is a reason why not.

    `labelling` are the decisions of what its unlabelled parts are.
    """
    view = decoded.view
    motions = _moved(view)
    while still := _still_carriers(view.graph, motions.edges) - view.still:
        view = replace(view, still=view.still | still)
        motions = _moved(view)
    completed, known = with_edges(view.graph, motions.edges), view.config.facts
    ajar = ajar_decisions(completed, view.probabilities, known)
    others, of_others = other_motions(view, completed)
    return GraphCompletion(
        graph,
        with_edges(completed, others),
        "network",
        tuple(part.node.id for part in added),
        (
            *(d for part in added for d in part.decisions),
            *labelling,
            *decoded.decisions,
            *motions.decisions,
            *of_others,
            *ajar,
        ),
        (*decoded.refused, *motions.refused),
        piece_guess(view.probabilities, known),
        rides(completed, view.given, view.probabilities, known),
        weighed(view),
    )


def _moved(view: GraphView) -> Motions:
    """Returns how each door and drawer moves, or why it does not."""
    scene = RuleScene(view.graph)
    doors = [node for node in view.graph.labelled(PartLabel.DOOR) if node.id in view.given]
    agreed = agreed_borders(doors, {door.id: borders_of(door, view) for door in doors}, view.config.columns)
    return move_parts(
        scene,
        lambda door: choose_hinge(door, view, scene, agreed.get(door.id, 1.0)),
        lambda drawer: choose_rails(drawer, view, scene),
        lambda door, other: slide_door(door, other, scene),
    )


def _still_carriers(graph: FunctionalGraph, edges: Sequence[Edge]) -> frozenset[str]:
    """Returns the doors that are to carry another one, though no edge moves them."""
    moving = {edge.child for edge in (*graph.motions, *edges) if not isinstance(edge, Contact)}
    carriers = {edge.parent for edge in edges if isinstance(edge, Hinge | Slide)}
    return frozenset(one for one in carriers if graph.node(one).label is PartLabel.DOOR) - moving
