"""What a completion returns: the graph before and after, the confidence of each decision, and what was refused."""

from dataclasses import field
from typing import Literal, final

from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.graph.edges import Hinge, MotionEdge, Turn
from grafu.graph.functional_graph import FunctionalGraph
from grafu.refusal import Refusal
from grafu.vocabulary import PartLabel, PieceKind

BY_RULE, BY_BOTH = "rule", "network and rule"
"""`Decision.by`: a rule answers in the network's place, or leans its choice."""
Question = Literal["label", "exists", "parent", "mount", "border", "sign", "slide", "turn", "ajar"]


@final
@dataclass(frozen=True, slots=True)
class Decision:
    """One answer about one part: the choice, its score in 0..1, and the next best choice where there is one.

    `choice` and `runner_up` are words: a label, a node id, a border, sign or signed axis as its code, open or closed.
    `by` names who answered where that is not the completion's source alone: `rule`, whose scores they are then, or
    `network and rule` where the network itself prefers the runner-up; the scores are the network's. `others` are what
    else was weighed, with its score, in the order in which it would be chosen; files do not hold them.

    Raises:
        GraphError: if a score is not in 0..1.
    """

    part: str
    question: Question
    choice: str
    score: float
    runner_up: str = ""
    runner_up_score: float = 0.0
    by: str = ""
    others: tuple[tuple[str, float], ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        for score in (self.score, self.runner_up_score):
            if not 0.0 <= score <= 1.0:
                raise GraphError(f"the scores of a decision must be in 0..1: got {score} for `{self.part}`")


def decision_of(edge: MotionEdge) -> Decision:
    """Returns the decision on a motion that the input or the user states."""
    if isinstance(edge, Hinge):
        return Decision(edge.child, "border", str(edge.border), 1.0)
    return Decision(edge.child, "turn" if isinstance(edge, Turn) else "slide", str(edge.axis), 1.0)


@final
@dataclass(frozen=True, slots=True)
class PieceGuess:
    """What the whole piece is, with the network's probabilities of that and of the next best kind."""

    kind: PieceKind
    score: float
    runner_up: PieceKind
    runner_up_score: float


@final
@dataclass(frozen=True, repr=False)
class GraphCompletion:
    """A completed graph and how it was completed.

    `source` names what completed it (rule, network). No door and no drawer of the completed graph is left without a
    motion in silence: each has its edge or stands in `refused`. `piece` is what the whole is, where that is known;
    `rides` are pairs (moving part, part that moves as one with it) that no edge states. `weighed` are labels of parts
    that were not added, each with the highest probability that one is missing.

    Raises:
        GraphError: if a node of the input is missing, `added` is not exactly what is new, a decision or refusal names
            no node, a probability is not in 0..1, or a movable part is neither moved nor refused.
    """

    input: FunctionalGraph
    completed: FunctionalGraph
    source: str
    added: tuple[str, ...] = ()
    decisions: tuple[Decision, ...] = ()
    refused: tuple[Refusal, ...] = ()
    piece: PieceGuess | None = None
    rides: tuple[tuple[str, str], ...] = ()
    weighed: tuple[tuple[PartLabel, float], ...] = ()

    def __repr__(self) -> str:
        return f"<GraphCompletion by {self.source}: {self.completed!r}, {len(self.added)} nodes added>"

    def __post_init__(self) -> None:
        before, after = {n.id for n in self.input.nodes}, {n.id for n in self.completed.nodes}
        if not before <= after:
            raise GraphError(f"a completion must keep every node of its input: it lost {sorted(before - after)}")
        if set(self.added) != after - before:
            raise GraphError(f"`added` must be the new nodes {sorted(after - before)}: got {sorted(self.added)}")
        named = (
            {d.part for d in self.decisions} | {r.part for r in self.refused} | {p for pair in self.rides for p in pair}
        )
        if not named <= after:
            raise GraphError(f"decisions, refusals and rides must name nodes: there is no {sorted(named - after)}")
        if not all(0.0 <= probability <= 1.0 for _, probability in self.weighed):
            raise GraphError(f"probabilities of parts that were weighed must be in 0..1: got {self.weighed}")
        silent = self._silent_parts()
        if silent:
            raise GraphError(f"every door and drawer needs its motion or a refusal: {silent} have neither")

    def _silent_parts(self) -> list[str]:
        answered = self.completed.moving | {r.part for r in self.refused}
        return [n.id for n in self.completed.nodes if n.label.is_movable and n.id not in answered]

    def decision(self, part: str, question: Question) -> Decision | None:
        """Returns the decision on this question about this part, or None where none was taken."""
        return next((d for d in self.decisions if d.part == part and d.question == question), None)
