"""Parts that mirror one another from left to right: such as the two boards beside the drawer of a table."""

from typing import Final

import numpy as np

from grafu.graph.completion import Decision, GraphCompletion
from grafu.vocabulary import MOVABLE_VALUES, PartLabel

_MIRRORED: Final = np.array([-1.0, 1.0, 1.0])


def static_twin(guess: Decision, completion: GraphCompletion, near: float) -> str:
    """Returns the part that mirrors a guessed door or drawer and stays; empty for none.

    It counts where both together are likelier to stay than to move, by their labels.

    Args:
        guess: the decision on the label of the door or drawer.
        completion: what was completed; its furniture faces -Y.
        near: by how much sizes and places of the two differ at most, metres.
    """
    graph = completion.completed
    box = graph.node(guess.part).box
    middle = float(completion.input.box.center[0]) * (1.0 - _MIRRORED)
    for other in graph.nodes:
        if other.id == guess.part or other.label.is_movable or other.label is PartLabel.HANDLE:
            continue
        off = np.concatenate([other.box.size - box.size, other.box.center * _MIRRORED + middle - box.center])
        decision = completion.decision(other.id, "label")
        if decision is not None and float(np.abs(off).max()) <= near and _moves(guess) + _moves(decision) < 1.0:
            return other.id
    return ""


def _moves(decision: Decision) -> float:
    """Returns how likely the part of a decision on its label is a door or a drawer."""
    scores = dict([*decision.others, (decision.runner_up, decision.runner_up_score), (decision.choice, decision.score)])
    return sum((score for label, score in scores.items() if label in MOVABLE_VALUES), 0.0)
