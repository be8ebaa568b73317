"""Another direction for a part that is blocked, or a door that nothing holds, in the one that was decided.

It builds nothing.
"""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Final, cast

from grafu.graph.completion import BY_BOTH, BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import SIGNS, Edge, Hinge, HingeBorder, Rail, SignedAxis, Slide
from grafu.graph.edit import rehung
from grafu.graph.functional_graph import FunctionalGraph
from grafu.joints.plan import PlanConfig
from grafu.joints.report import Installed, RealizationReport
from grafu.pipeline.certainty import named_choice
from grafu.refusal import Reason, Refusal

_DIRECTIONS: Final = ("slide", "border")
"""The questions that decide where a part moves to; the face that a door opens to stays."""
_WHY: Final = {Reason.BLOCKED: "it is blocked", Reason.NO_ROOM: "nothing holds it"}
"""What a note states of the direction that was given up."""


def second_choices(
    completion: GraphCompletion, skipped: Iterable[Refusal], turn: int = 0, config: PlanConfig = PlanConfig()
) -> GraphCompletion | None:
    """Returns the completion with another direction for what is blocked: in each `turn` (0, 1, ...) the next likely.

    None where nothing is blocked that has one. What the user or the input stated has none. A door that finds no hold
    at a border, such as that between two doors without a divider, may find one at another.
    """
    why = {refusal.part: refusal.reason for refusal in skipped}
    swapped = {d.part: _swapped(d, turn) for d in completion.decisions if _is_stuck(d, why) and _has(d, turn, config)}
    if not swapped:
        return None
    graph = completion.completed
    edges = tuple(_turned(edge, swapped, graph) for edge in graph.edges)
    signs = {edge.child: str(edge.sign) for edge in edges if isinstance(edge, Hinge)}
    decisions = tuple(_decided(d, swapped, signs) for d in completion.decisions)
    return replace(completion, completed=replace(graph, edges=edges), decisions=decisions)


def other_faces(
    completion: GraphCompletion, skipped: Iterable[Refusal], config: PlanConfig = PlanConfig()
) -> GraphCompletion | None:
    """Returns the completion in which doors that are blocked open to the other face, where that is not ruled out.

    None where no door is. What the user or the input stated, and what a rule decided, has no other face.
    """
    blocked = {refusal.part for refusal in skipped if refusal.reason is Reason.BLOCKED}
    turned = {d.part: d for d in completion.decisions if d.part in blocked and _has_other_face(d, config)}
    if not turned:
        return None
    graph = completion.completed
    edges = tuple(
        replace(edge, sign=SIGNS[1 - edge.sign]) if isinstance(edge, Hinge) and edge.child in turned else edge
        for edge in graph.edges
    )
    decisions = tuple(
        replace(d, choice=d.runner_up, score=d.runner_up_score, runner_up=d.choice, runner_up_score=d.score, by=BY_BOTH)
        if d is turned.get(d.part)
        else d
        for d in completion.decisions
    )
    return replace(completion, completed=replace(graph, edges=edges), decisions=decisions)


def _has_other_face(decision: Decision, config: PlanConfig) -> bool:
    is_open = decision.question == "sign" and decision.by != BY_RULE and bool(decision.runner_up)
    return is_open and decision.runner_up_score >= config.other_direction


def noted(
    report: RealizationReport, first: GraphCompletion, second: GraphCompletion, skipped: Iterable[Refusal] = ()
) -> RealizationReport:
    """Returns the report in which each joint of a `second` choice states what the first one was.

    `skipped` are the refusals of the first.
    """
    why = {refusal.part: _WHY.get(refusal.reason, _WHY[Reason.BLOCKED]) for refusal in skipped}
    kept = {(d.part, d.question, d.choice) for d in second.decisions}
    hinges = {hinge.child: hinge for hinge in first.completed.hinges}
    given_up: dict[str, str] = {}
    for d in sorted(first.decisions, key=lambda d: d.question == "sign"):  # a sign is counted about its border
        if d.question in (*_DIRECTIONS, "sign") and (d.part, d.question, d.choice) not in kept:
            towards = named_choice(d, d.choice, first.completed, hinges.get(d.part))
            why_not = why.get(d.part, _WHY[Reason.BLOCKED])
            given_up.setdefault(d.part, f"towards the {towards} ({d.score:.0%}) {why_not}")
    outcomes = tuple(
        replace(done, notes=(*done.notes, given_up[done.moving]))
        if isinstance(done, Installed) and done.moving in given_up
        else done
        for done in report.outcomes
    )
    return replace(report, outcomes=outcomes)


def _is_stuck(decision: Decision, why: Mapping[str, Reason]) -> bool:
    """Whether a part cannot move where this was decided: it is blocked, or no border holds its hinges."""
    reason = why.get(decision.part)
    return reason is Reason.BLOCKED or (reason is Reason.NO_ROOM and decision.question == "border")


def _has(decision: Decision, turn: int, config: PlanConfig) -> bool:
    is_one = decision.question in _DIRECTIONS and turn < len(decision.others)
    return is_one and decision.others[turn][1] >= config.other_direction


def _swapped(decision: Decision, turn: int) -> Decision:
    """Returns the decision for what comes next; the runner-up is the likeliest of what was given up."""
    choice, score = decision.others[turn]
    given_up = ((decision.choice, decision.score), (decision.runner_up, decision.runner_up_score))
    runner_up, its = max((g for g in given_up if g[0] != choice), key=lambda g: g[1])
    by = decision.by or BY_BOTH
    return replace(decision, choice=choice, score=score, runner_up=runner_up, runner_up_score=its, by=by)


def _decided(decision: Decision, swapped: Mapping[str, Decision], signs: Mapping[str, str]) -> Decision:
    """Returns a decision as it is after the second choice; the sign of a hinge is counted about its new border."""
    other = swapped.get(decision.part)
    if other is not None and other.question == decision.question:
        return other
    if other is None or decision.question != "sign" or decision.choice == signs.get(decision.part):
        return decision
    return replace(decision, choice=decision.runner_up, runner_up=decision.choice)


def _turned(edge: Edge, swapped: Mapping[str, Decision], graph: FunctionalGraph) -> Edge:
    """Returns an edge that moves its child in the other direction; a door still opens to the same face."""
    decision = swapped.get(edge.child) if isinstance(edge, Hinge | Rail | Slide) else None
    if isinstance(edge, Rail | Slide) and decision is not None and decision.question == "slide":
        return replace(edge, axis=cast(SignedAxis, int(decision.choice)))
    if isinstance(edge, Hinge) and decision is not None and decision.question == "border":
        return rehung(edge, cast(HingeBorder, int(decision.choice)), graph)
    return edge
