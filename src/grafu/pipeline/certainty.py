"""The confidence of motions: what was decided about parts, and the runner-up, in words. It decides nothing."""

from collections.abc import Set
from typing import TYPE_CHECKING

from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import BORDERS, SIGNS, Hinge
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import AXIS_NAMES, border_to_face, opening_face
from grafu.pipeline.words import percent
from grafu.vocabulary import MOVABLE_VALUES

if TYPE_CHECKING:
    from grafu.pipeline.report_schema import GuessRecord

_SIDES = dict(zip(AXIS_NAMES, ("left", "right", "front", "back", "bottom", "top"), strict=True))
_ASKED = {
    "border": "hinge side",
    "sign": "opens to the",
    "slide": "slides to the",
    "turn": "turns about",
    "mount": "on",
    "parent": "carried by",
}
_OF_MOTION = ("border", "sign", "slide")  # what carries a part is measured on the meshes
_STATED = 1.0  # the score of what was not guessed
_UNHEARD = 0.005  # a runner-up that would be written as 0 %


def certainty_words(completion: GraphCompletion, part: str) -> list[str]:
    """Returns a line for each question about how a part moves: the choice, its score, and the runner-up with its own.

    Sides are seen from the front: left is -X, the front is -Y.
    """
    order = list(_ASKED)
    asked = [d for d in completion.decisions if d.part == part and d.question in _ASKED]
    hinge = next((h for h in completion.completed.hinges if h.child == part), None)
    return [_words(d, completion.completed, hinge) for d in sorted(asked, key=lambda d: order.index(d.question))]


def guesses_of(completion: GraphCompletion, stated: Set[str] = frozenset()) -> "tuple[GuessRecord, ...]":
    """Returns the decisions that motions rest on: how parts move, and which are taken for doors and drawers, or nearly.

    What is `stated` of parts is no guess. Sides are seen from the front, as in `certainty_words`.
    """
    hinges = {hinge.child: hinge for hinge in completion.completed.hinges}
    moving = completion.completed.moving
    return tuple(
        _guess(decision, completion.completed, hinges.get(decision.part))
        for decision in completion.decisions
        if decision.part not in stated and _is_of_motion(decision, moving)
    )


def _is_of_motion(decision: Decision, moving: Set[str]) -> bool:
    if decision.question == "label":
        return not MOVABLE_VALUES.isdisjoint((decision.choice, decision.runner_up))
    return decision.question in _OF_MOTION and decision.part in moving and decision.score < _STATED


def _guess(decision: Decision, graph: FunctionalGraph, hinge: Hinge | None) -> "GuessRecord":
    from grafu.pipeline.report_schema import GuessRecord

    return GuessRecord(
        part=decision.part,
        question=decision.question,
        choice=named_choice(decision, decision.choice, graph, hinge),
        score=decision.score,
        runner_up=decision.runner_up and named_choice(decision, decision.runner_up, graph, hinge),
        runner_up_score=decision.runner_up_score,
    )


def _words(decision: Decision, graph: FunctionalGraph, hinge: Hinge | None) -> str:
    said = (
        f"{_ASKED[decision.question]} {named_choice(decision, decision.choice, graph, hinge)} {percent(decision.score)}"
    )
    if not decision.runner_up or decision.runner_up_score < _UNHEARD:
        return said
    return f"{said} ({named_choice(decision, decision.runner_up, graph, hinge)} {percent(decision.runner_up_score)})"


def named_choice(decision: Decision, choice: str, graph: FunctionalGraph, hinge: Hinge | None = None) -> str:
    """Returns a code as a side of the piece; what is no code is a name already. A sign needs the hinge it is of."""
    if not choice.isdecimal() or decision.part not in graph:
        return choice
    code, thin = int(choice), graph.node(decision.part).box.thin_axis
    if decision.question == "turn" and code < len(AXIS_NAMES):
        return AXIS_NAMES[code]
    if decision.question == "slide" and code < len(AXIS_NAMES):
        return _SIDES[AXIS_NAMES[code]]
    if decision.question == "border" and code < len(BORDERS):
        return _SIDES[AXIS_NAMES[border_to_face(thin, BORDERS[code])]]
    if decision.question == "sign" and hinge is not None and code < len(SIGNS):
        return _SIDES[AXIS_NAMES[opening_face(thin, hinge.border, SIGNS[code])]]
    return choice
