"""Weighted votes for a fixed list of choices, and their ranking."""

from collections.abc import Hashable, Sequence
from typing import Generic, TypeVar, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Scalars

Choice = TypeVar("Choice", bound=Hashable)

# Every choice starts with this much, so that one weak vote does not make a certainty.
_PRIOR = 0.15


@final
@dataclass(frozen=True, slots=True)
class Ranking(Generic[Choice]):
    """The choice with the most votes, its fraction of them (0..1), and the next best (None where there is only one).

    `others` are all the others with their fractions, in the order in which they would be chosen, where that is known.
    """

    choice: Choice
    score: float
    runner_up: Choice | None = None
    runner_up_score: float = 0.0
    others: tuple[tuple[Choice, float], ...] = ()


@final
class Votes(Generic[Choice]):
    """Collects weighted votes; a negative weight counts against a choice. Ties fall to the choice listed first."""

    def __init__(self, choices: tuple[Choice, ...]) -> None:
        if not choices:
            raise ValueError("a vote needs at least one choice")
        self._weights: dict[Choice, float] = dict.fromkeys(choices, _PRIOR)

    def add(self, choice: Choice, weight: float) -> None:
        """Adds weight to a choice; one that is not on the list is ignored."""
        if choice in self._weights:
            self._weights[choice] += weight

    def ranking(self) -> Ranking[Choice]:
        """Returns the outcome; scores are fractions of the positive weights."""
        ranked = sorted(self._weights.items(), key=lambda item: -item[1])
        total = sum(max(weight, 0.0) for _, weight in ranked)
        ratios = [max(weight, 0.0) / total if total > 0 else 1.0 / len(ranked) for _, weight in ranked]
        if len(ranked) == 1:
            return Ranking(ranked[0][0], ratios[0])
        return Ranking(ranked[0][0], ratios[0], ranked[1][0], ratios[1])


def ranking_of(choices: Sequence[Choice], weights: Scalars) -> Ranking[Choice]:
    """Returns the choice of the largest weight and the next; scores are fractions of all weights; the first wins a tie.

    There is at least one choice, and no weight is negative.
    """
    total = float(weights.sum())
    ratios = weights / total if total > 0 else np.full(len(choices), 1.0 / len(choices))
    order = np.argsort(-ratios, kind="stable").tolist()
    scores = np.minimum(ratios, 1.0).tolist()
    if len(order) == 1:
        return Ranking(choices[0], scores[0])
    return Ranking(choices[order[0]], scores[order[0]], choices[order[1]], scores[order[1]])


def chosen_of(choices: Sequence[Choice], weights: Scalars, preferred: Scalars | None = None) -> Ranking[Choice]:
    """Returns the choice that `preferred` (the weights where it is None) is the largest for, and all the others.

    The runner-up is the best of the others by `weights`. Scores are fractions of `weights` alone, so that of a choice
    that they do not prefer is below its runner-up's.
    """
    preferred = weights if preferred is None else preferred
    total, best = float(weights.sum()), int(np.argmax(preferred))
    ratios = np.minimum(weights / total, 1.0) if total > 0 else np.full(len(choices), 1.0 / len(choices))
    others = np.argsort(-preferred, kind="stable")[1:]
    if not len(others):
        return Ranking(choices[best], float(ratios[best]))
    second = int(others[np.argmax(ratios[others])])
    then = tuple((choices[k], float(ratios[k])) for k in others.tolist())
    return Ranking(choices[best], float(ratios[best]), choices[second], float(ratios[second]), then)
