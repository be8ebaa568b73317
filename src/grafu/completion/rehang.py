"""Doors that shape hangs on another border than was predicted."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import final

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.graph.completion import BY_RULE, Decision, GraphCompletion
from grafu.graph.edges import Hinge, HingeBorder
from grafu.graph.edit import rehung
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import border_to_face, face_to_border, level_axis, signed_axis

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class RehangConfig:
    """How confident shape is where it contradicts what was predicted.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    right: float = 0.75
    """Probability that the border is right which shape decides on. Of ten such doors eight hang so (five of five real
    ones, three of five of 600 made pieces); by the rule of succession that is 9 of 12."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def hung_on(
    completion: GraphCompletion,
    borders: Mapping[str, HingeBorder | tuple[HingeBorder, float]],
    config: RehangConfig = RehangConfig(),
) -> GraphCompletion:
    """Returns the completion in which doors hang on other borders, by id, and a rule has decided so.

    Where shape leaves more than one border to a door, the conditional probability of this one stands beside it. A door
    still opens to the same face; what was predicted is its next likely border.
    """
    if not borders:
        return completion
    graph = completion.completed
    new = {door: found if isinstance(found, tuple) else (found, 1.0) for door, found in borders.items()}
    edges = tuple(
        rehung(e, new[e.child][0], graph) if isinstance(e, Hinge) and e.child in new else e for e in graph.edges
    )
    signs = {edge.child: str(edge.sign) for edge in edges if isinstance(edge, Hinge)}
    decisions = tuple(
        _decided(d, new[d.part][0], config.right * new[d.part][1], signs[d.part]) if d.part in new else d
        for d in completion.decisions
    )
    return replace(completion, completed=replace(graph, edges=edges), decisions=decisions)


def stands_on_a_level_border(hinge: Hinge, graph: FunctionalGraph) -> bool:
    """Whether an upright door drops or lifts: its hinge is on its lower or upper border."""
    thin = graph.node(hinge.child).box.thin_axis
    return thin != _UP and border_to_face(thin, hinge.border) // 2 == _UP


def upright_borders(thin: int) -> tuple[HingeBorder, HingeBorder]:
    """Returns the two upright borders of an upright door, that to the negative side of its level axis first."""
    level = level_axis(thin)
    negative, positive = (face_to_border(thin, signed_axis(level, to_positive)) for to_positive in (False, True))
    return negative, positive


def likelier_side(hinge: Hinge, completion: GraphCompletion) -> tuple[HingeBorder, float]:
    """Returns the likelier upright border of a door, and its probability if the door hangs on an upright one.

    That is the left one where no score tells them apart.
    """
    sides = upright_borders(completion.completed.node(hinge.child).box.thin_axis)
    scores = _other_scores(completion, hinge.child)
    own = [scores.get(str(side), 0.0) for side in sides]
    best = max(range(len(sides)), key=own.__getitem__)
    return sides[best], own[best] / sum(own) if sum(own) > 0 else 1 / len(sides)


def _other_scores(completion: GraphCompletion, door: str) -> dict[str, float]:
    """Returns the scores of the borders that were not chosen for a door; empty where none are known."""
    decision = completion.decision(door, "border")
    return {} if decision is None else dict([*decision.others, (decision.runner_up, decision.runner_up_score)])


def _decided(decision: Decision, border: HingeBorder, score: float, sign: str) -> Decision:
    """Returns a decision on a door that hangs on another border now; its sign is counted about that."""
    if decision.question == "border":
        others = tuple(other for other in decision.others if other[0] != str(border))
        predicted = min(decision.score, 1.0 - score)
        return Decision(decision.part, "border", str(border), score, decision.choice, predicted, BY_RULE, others)
    if decision.question == "sign" and decision.choice != sign:
        return replace(decision, choice=sign, runner_up=decision.choice)
    return decision


def hung_on_sides(completion: GraphCompletion, is_such: Callable[[str], bool]) -> GraphCompletion:
    """Returns the completion in which such doors as would drop or lift hang on a side, the likelier one.

    A door still opens to the same face. Leaves that fold stay as they are predicted.
    """
    graph = completion.completed
    borders = {
        hinge.child: likelier_side(hinge, completion)
        for hinge in graph.hinges
        if hinge.coupling is None and stands_on_a_level_border(hinge, graph) and is_such(hinge.child)
    }
    return hung_on(completion, borders)
