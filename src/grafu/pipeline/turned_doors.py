"""Doors that turn where they cannot slide: a door that was to slide, but is blocked or held by nothing, is hinged.

It builds nothing.
"""

from collections.abc import Iterable
from dataclasses import replace

from grafu.completion.doors import hang_door
from grafu.completion.rule_scene import RuleScene
from grafu.graph.completion import BY_RULE, GraphCompletion
from grafu.graph.edges import Edge, Slide
from grafu.graph.edit import with_edges, without_edges
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

_STUCK = frozenset({Reason.BLOCKED, Reason.NO_ROOM})


def turned_doors(completion: GraphCompletion, skipped: Iterable[Refusal]) -> GraphCompletion | None:
    """Returns the completion in which each sliding door that found no joint turns as the rule hinges it.

    None where there is no such door, or the rule hinges none. Doors that move in step with others stay as they are.
    """
    stuck = {refusal.part for refusal in skipped if refusal.reason in _STUCK}
    graph = completion.completed
    for slide in [edge for edge in graph.edges if isinstance(edge, Slide) and edge.child in stuck]:
        if graph.node(slide.child).label is not PartLabel.DOOR or slide.coupling is not None:
            continue
        completion = _turned(completion, slide)
    return None if completion.completed is graph else completion


def _turned(completion: GraphCompletion, slide: Slide) -> GraphCompletion:
    rest = without_edges(completion.completed, [slide])
    answer = hang_door(rest.node(slide.child), RuleScene(rest))
    if isinstance(answer, Refusal):
        return completion
    edges, decisions = answer
    of_door = {"slide", "mount", "border", "sign"}
    kept = (d for d in completion.decisions if d.part != slide.child or d.question not in of_door)
    said = (replace(d, by=BY_RULE) for d in decisions)
    hinges: tuple[Edge, ...] = tuple(edges)
    return replace(completion, completed=with_edges(rest, hinges), decisions=(*kept, *said))
