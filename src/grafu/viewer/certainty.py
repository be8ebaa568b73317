"""How sure a motion is, in words: what was decided about a part, and what would have come next. It decides nothing."""

from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import BORDERS, SIGNS, Hinge
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import AXIS_NAMES, border_to_face, opening_face

_SIDES = dict(zip(AXIS_NAMES, ("left", "right", "front", "back", "bottom", "top"), strict=True))
_ASKED = {"border": "pinned", "sign": "opens to the", "slide": "slides to the", "mount": "on", "parent": "carried by"}
_UNHEARD = 0.005  # a runner-up that would be written as 0 %


def certainty_words(completion: GraphCompletion, part: str) -> list[str]:
    """Returns a line for each question about how a part moves: the choice, its score, and the runner-up with its own.

    Sides are seen from the front: left is -X, the front is -Y.
    """
    order = list(_ASKED)
    asked = [d for d in completion.decisions if d.part == part and d.question in _ASKED]
    hinge = next((h for h in completion.completed.hinges if h.child == part), None)
    return [_words(d, completion.completed, hinge) for d in sorted(asked, key=lambda d: order.index(d.question))]


def _words(decision: Decision, graph: FunctionalGraph, hinge: Hinge | None) -> str:
    said = f"{_ASKED[decision.question]} {_named(decision, decision.choice, graph, hinge)} {decision.score:.0%}"
    if not decision.runner_up or decision.runner_up_score < _UNHEARD:
        return said
    return f"{said} ({_named(decision, decision.runner_up, graph, hinge)} {decision.runner_up_score:.0%})"


def _named(decision: Decision, choice: str, graph: FunctionalGraph, hinge: Hinge | None) -> str:
    """Returns a code as a side of the piece; what is no code is a name already."""
    if not choice.isdecimal() or decision.part not in graph:
        return choice
    code, thin = int(choice), graph.node(decision.part).box.thin_axis
    if decision.question == "slide" and code < len(AXIS_NAMES):
        return _SIDES[AXIS_NAMES[code]]
    if decision.question == "border" and code < len(BORDERS):
        return _SIDES[AXIS_NAMES[border_to_face(thin, BORDERS[code])]]
    if decision.question == "sign" and hinge is not None and code < len(SIGNS):
        return _SIDES[AXIS_NAMES[opening_face(thin, hinge.border, SIGNS[code])]]
    return choice
