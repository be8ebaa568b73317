"""Round doors hang on their left or right side: that of a washing machine neither drops nor lifts.

Vertices tell their shape. It builds nothing.
"""

from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.config_checks import require_positive
from grafu.graph.completion import BY_BOTH, Decision, GraphCompletion
from grafu.graph.edges import Hinge, HingeBorder
from grafu.graph.edit import rehung
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import border_to_face, face_to_border, plane_axes, signed_axis

_UP = 2


@final
@dataclass(frozen=True, slots=True)
class RoundDoorConfig:
    """When a door is round.

    Raises:
        ValueError: if a number is not above 0.
    """

    square: float = 0.9
    """Least ratio of the sides of the box around it."""
    corner: float = 1.55
    """How far it reaches into the corners of that box at most: the sum of the distances from the middle along both
    sides, each over the half side. A circle has 1.41, a square 2."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


def with_round_doors(
    completion: GraphCompletion, asset: Asset, config: RoundDoorConfig = RoundDoorConfig()
) -> GraphCompletion:
    """Returns the completion in which upright round doors that would drop or lift hang on a side, the likelier one.

    A door still opens to the same face. Where no score tells the sides apart, it hangs on the left.
    """
    graph = completion.completed
    given = {part.id: part for part in asset.parts}
    hinges = {hinge.child: hinge for hinge in graph.hinges if hinge.child in given and hinge.coupling is None}
    new = {
        child: _on_a_side(hinge, completion)
        for child, hinge in hinges.items()
        if _drops_or_lifts(hinge, graph) and is_round(given[child], config)
    }
    if not new:
        return completion
    edges = tuple(
        rehung(e, new[e.child][0], graph) if isinstance(e, Hinge) and e.child in new else e for e in graph.edges
    )
    signs = {edge.child: str(edge.sign) for edge in edges if isinstance(edge, Hinge)}
    decisions = tuple(_decided(d, new[d.part], signs[d.part]) if d.part in new else d for d in completion.decisions)
    return replace(completion, completed=replace(graph, edges=edges), decisions=decisions)


def is_round(part: Part, config: RoundDoorConfig = RoundDoorConfig()) -> bool:
    """Whether the outline of a part, seen across its thin side, is a circle, more or less."""
    box = part.box
    axes = list(plane_axes(box.thin_axis))
    half = box.half[axes]
    if half.min() < config.square * half.max() or half.min() <= 0:
        return False
    reach = np.abs(part.mesh.vertices[:, axes] - box.center[axes]) / half
    return float(reach.sum(axis=1).max()) <= config.corner


def _drops_or_lifts(hinge: Hinge, graph: FunctionalGraph) -> bool:
    thin = graph.node(hinge.child).box.thin_axis
    return thin != _UP and border_to_face(thin, hinge.border) // 2 == _UP


def _on_a_side(hinge: Hinge, completion: GraphCompletion) -> tuple[HingeBorder, float]:
    """Returns the likelier upright border of a door, and its score."""
    thin = completion.completed.node(hinge.child).box.thin_axis
    level = next(axis for axis in plane_axes(thin) if axis != _UP)
    sides = [face_to_border(thin, signed_axis(level, positive)) for positive in (False, True)]
    decision = completion.decision(hinge.child, "border")
    scores = {} if decision is None else dict([*decision.others, (decision.runner_up, decision.runner_up_score)])
    return max(((side, scores.get(str(side), 0.0)) for side in sides), key=lambda found: found[1])


def _decided(decision: Decision, side: tuple[HingeBorder, float], sign: str) -> Decision:
    """Returns a decision on a door that hangs on a side now; its sign is counted about the new border."""
    if decision.question == "border":
        others = tuple(other for other in decision.others if other[0] != str(side[0]))
        return Decision(
            decision.part, "border", str(side[0]), side[1], decision.choice, decision.score, BY_BOTH, others
        )
    if decision.question == "sign" and decision.choice != sign:
        return replace(decision, choice=sign, runner_up=decision.choice)
    return decision
