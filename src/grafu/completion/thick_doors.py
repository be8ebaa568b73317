"""What is only guessed to be a door, and is too thick for one, is a drawer where it reaches back as one does."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Final, final

from grafu.asset.part import Asset
from grafu.completion.guessed_shapes import is_thick
from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_ratios
from grafu.graph.completion import BY_BOTH, Decision, GraphCompletion
from grafu.graph.edges import Hinge, Rail
from grafu.graph.edit import relabelled, with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel

_DEPTH: Final = 1
_FRONT: Final = 2  # the face that looks to -Y


@final
@dataclass(frozen=True, slots=True)
class ThickDoorConfig:
    """From where to where a drawer reaches.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    deep: float = 0.5
    """Its least depth (fraction of that of the whole)."""
    before: float = 0.15
    """Its front is no farther than this behind that of the whole (the same fraction)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def with_thick_doors(
    completion: GraphCompletion, asset: Asset, config: ThickDoorConfig = ThickDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which guessed doors that are too thick, and as deep as drawers, are drawers.

    They slide out to the front. What the input labels as a door stays one.
    """
    graph = completion.completed
    guessed = bare_doors(completion)
    doors = [
        hinge
        for hinge in graph.hinges
        if hinge.child in guessed
        and hinge.coupling is None
        and _reaches_back(hinge.child, graph, config)
        and is_thick(asset.part(hinge.child).mesh)
    ]
    return as_drawers(completion, doors) if doors else completion


def bare_doors(completion: GraphCompletion) -> set[str]:
    """Returns the guessed doors on which no other hangs: no hinge is on a drawer."""
    guessed = {d.part for d in completion.decisions if d.question == "label" and d.choice == PartLabel.DOOR}
    return guessed - {edge.parent for edge in completion.completed.motions}


def _reaches_back(door: str, graph: FunctionalGraph, config: ThickDoorConfig) -> bool:
    box, depth = graph.node(door).box, float(graph.box.size[_DEPTH])
    is_in_front = box.low[_DEPTH] - graph.box.low[_DEPTH] <= config.before * depth
    return bool(is_in_front and box.size[_DEPTH] >= config.deep * depth)


def as_drawers(completion: GraphCompletion, doors: Sequence[Hinge]) -> GraphCompletion:
    """Returns the completion in which doors (of `bare_doors`) are drawers that slide out to the front."""
    rails = [Rail(hinge.parent, hinge.child, _FRONT) for hinge in doors]
    drawers = {rail.child for rail in rails}
    graph = relabelled(completion.completed, dict.fromkeys(drawers, PartLabel.DRAWER))
    decisions = (_of_drawer(d) if d.part in drawers else d for d in completion.decisions)
    kept = tuple(decision for decision in decisions if decision is not None)
    return replace(completion, completed=with_edges(graph, rails), decisions=kept)


def _of_drawer(decision: Decision) -> Decision | None:
    """Returns a decision on a door as it is on a drawer; None: a drawer has no such."""
    if decision.question == "label":
        scores = dict([*decision.others, (decision.runner_up, decision.runner_up_score)])
        return Decision(
            decision.part,
            "label",
            PartLabel.DRAWER.value,
            scores.get(PartLabel.DRAWER.value, 0.0),
            decision.choice,
            decision.score,
            BY_BOTH,
        )
    if decision.question == "sign":
        return Decision(decision.part, "slide", str(_FRONT), decision.score, by=BY_BOTH)
    return None if decision.question == "border" else decision
