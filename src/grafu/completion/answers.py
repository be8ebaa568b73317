"""What is answered about parts: a ranking as a decision, and of every door and drawer its edges or the reason against.

Rules and network share it; it decides nothing itself but that a door which laps another slides.
"""

from collections.abc import Callable
from typing import Any, final

from grafu.completion.rows import slides_past
from grafu.completion.rule_scene import RuleScene
from grafu.completion.votes import Ranking
from grafu.dataclass import dataclass
from grafu.geometry.budget import present_budget
from grafu.graph.completion import Decision, Question
from grafu.graph.edges import Edge
from grafu.graph.functional_graph import PartNode
from grafu.refusal import Reason, Refusal
from grafu.vocabulary import PartLabel

MotionAnswer = tuple[tuple[Edge, ...], tuple[Decision, ...]] | Refusal
"""The edges of a moving part with the confidence of each choice; or why there are none."""

_DECIDING = 0.9  # of the time that is left: with so many doors, some decided are worth more than none
_TIME_IS_UP = "with so many doors and drawers there was no time left to decide how it moves"


@final
@dataclass(frozen=True, slots=True)
class Motions:
    """The answers about all doors and drawers of a graph."""

    edges: tuple[Edge, ...]
    decisions: tuple[Decision, ...]
    refused: tuple[Refusal, ...]


def move_parts(
    scene: RuleScene,
    hang: Callable[[PartNode], MotionAnswer],
    run: Callable[[PartNode], MotionAnswer],
    slide: Callable[[PartNode, PartNode], MotionAnswer],
) -> Motions:
    """Returns the answer of `hang` for each door, of `run` for each drawer, of `slide` for a door that laps another.

    Those with a motion edge are left out; those that come when time is up are refused.
    """
    budget = present_budget().fraction(_DECIDING)
    edges: list[Edge] = []
    decisions: list[Decision] = []
    refused: list[Refusal] = []
    stated = {hinge.child for hinge in scene.graph.hinges} | {rail.child for rail in scene.graph.rails}
    for node in scene.graph.labelled(PartLabel.DOOR, PartLabel.DRAWER):
        if node.id in stated:
            continue
        if budget.left == 0:
            refused.append(Refusal(node.id, Reason.TOO_COMPLEX, _TIME_IS_UP))
            continue
        answer = _hung(node, scene, hang, slide) if node.label is PartLabel.DOOR else run(node)
        if isinstance(answer, Refusal):
            refused.append(answer)
        else:
            edges += answer[0]
            decisions += answer[1]
    return Motions(tuple(edges), tuple(decisions), tuple(refused))


def decision_of(part: str, question: Question, ranking: Ranking[Any], by: str = "") -> Decision:
    """Returns a ranking as the answer to a question about a part; `by` as in `Decision`."""
    runner_up = "" if ranking.runner_up is None else str(ranking.runner_up)
    others = tuple((str(choice), score) for choice, score in ranking.others)
    return Decision(part, question, str(ranking.choice), ranking.score, runner_up, ranking.runner_up_score, by, others)


def _hung(
    door: PartNode,
    scene: RuleScene,
    hang: Callable[[PartNode], MotionAnswer],
    slide: Callable[[PartNode, PartNode], MotionAnswer],
) -> MotionAnswer:
    other = slides_past(door, scene)
    return hang(door) if other is None else slide(door, other)
