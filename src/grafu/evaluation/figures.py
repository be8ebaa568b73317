"""From outcomes of parts to figures of objects: a mean over an object's parts first, then over objects."""

from collections.abc import Callable, Sequence
from typing import Final

from grafu.evaluation.bootstrap import Figure, mean_of, ratio_of
from grafu.evaluation.results import PartOutcome, measured

Score = Callable[[PartOutcome], float | None]


def _ratio(name: str, fixed: bool) -> Score:
    """Returns a score that nothing gives to a part which is static (collision, touch)."""

    def score(outcome: PartOutcome) -> float | None:
        measure = measured(outcome, fixed)
        value = None if measure is None else getattr(measure, name)
        return None if value is None else float(value)

    return score


def _verdict(name: str, fixed: bool) -> Score:
    """Returns a score that is 0 for a part which is static (aligned, connected, opening, works)."""
    ratio = _ratio(name, fixed)
    return lambda outcome: ratio(outcome) or 0.0


SCORES: Final[dict[str, Score]] = {
    "aligned": lambda outcome: float(outcome.aligned),
    "aligned_fixed": _verdict("aligned", fixed=True),
    "twins": lambda outcome: float(outcome.aligned or outcome.agrees_with_a_twin),
    "reasonable": lambda outcome: float(outcome.reasonable),
    "collision": _ratio("collision", fixed=False),
    "collision_fixed": _ratio("collision", fixed=True),
    "touch": _ratio("touch", fixed=False),
    "touch_fixed": _ratio("touch", fixed=True),
    "connected": _verdict("connected", fixed=False),
    "connected_fixed": _verdict("connected", fixed=True),
    "opening": _verdict("opening", fixed=False),
    "opening_fixed": _verdict("opening", fixed=True),
    "works": _verdict("works", fixed=False),
    "works_fixed": _verdict("works", fixed=True),
}


def by_object(outcomes: Sequence[PartOutcome], score: str) -> dict[str, float]:
    """Returns the mean over each object's parts, by model; objects of which nothing is known are left out."""
    sums = _sums(outcomes, score)
    return {model: total / count for model, (total, count) in sums.items() if count}


def over_objects(outcomes: Sequence[PartOutcome], score: str) -> Figure | None:
    """Returns the mean over objects of the means over their parts: the paper's way."""
    return mean_of(list(by_object(outcomes, score).values()))


def over_parts(outcomes: Sequence[PartOutcome], score: str) -> Figure | None:
    """Returns the mean over all parts, with objects as what is drawn anew."""
    sums = _sums(outcomes, score).values()
    return ratio_of([total for total, _ in sums], [float(count) for _, count in sums])


def _sums(outcomes: Sequence[PartOutcome], score: str) -> dict[str, tuple[float, int]]:
    found: dict[str, tuple[float, int]] = {}
    for outcome in outcomes:
        total, count = found.get(outcome.model, (0.0, 0))
        value = SCORES[score](outcome)
        found[outcome.model] = (total, count) if value is None else (total + value, count + 1)
    return found
