"""The models farthest from what weights are trained on, what is odd about them, and whether distance costs success."""

import numpy as np
from scipy.stats import spearmanr

from grafu.evaluation.distribution import FEATURE_NAMES, TRAINING_SEED, Distribution
from grafu.evaluation.figures import by_object
from grafu.evaluation.results import Results
from grafu.evaluation.table import Cell, Column, Table

TOP = 5
_COLUMNS = (
    Column("rank", "Rank", "count"),
    Column("model", "Model"),
    Column("category", "Category"),
    Column("from_nearest", "Distance from nearest", "number"),
    Column("from_middle", "Distance from middle", "number"),
    Column("nearest", "Nearest training model"),
    Column("oddest", "Oddest features (z-score)"),
    Column("aligned", "GT-aligned", "share", "more"),
    Column("works", "Works + fix", "share", "more"),
)


def ood_table(results: Results, method: str, top: int = TOP) -> Table:
    """Returns the `top` models farthest from their nearest training model, with one method's success on them.

    Raises:
        ValueError: if there is no training distribution.
    """
    space = Distribution(results.training)
    outcomes = results.outcomes(method)
    aligned, works = by_object(outcomes, "aligned_fixed"), by_object(outcomes, "works_fixed")
    distances = {model: space.distance(facts.features) for model, facts in results.models.items() if facts.parts}
    ranked = sorted(distances, key=lambda model: (-distances[model].from_nearest, model))
    rows: list[tuple[Cell, ...]] = []
    for rank, model in enumerate(ranked[:top], 1):
        facts, far = results.models[model], distances[model]
        oddest = _oddest(space.scores(facts.features))
        nearest = f"synth_{TRAINING_SEED}_{far.nearest:07d}"
        figures = far.from_nearest, far.from_middle, nearest, oddest, aligned.get(model), works.get(model)
        rows.append((rank, model, facts.category, *figures))
    far_out = {model: distance.from_nearest for model, distance in distances.items()}
    notes = (
        f"Features: {', '.join(FEATURE_NAMES)}; each less the mean of {len(results.training)} made models (seed "
        f"{TRAINING_SEED}), over their standard deviation; distances are Euclidean. Success is that of `{method}`.",
        f"Rank correlation (Spearman) over {len(far_out)} models of the distance from the nearest with GT-aligned: "
        f"{_correlation(far_out, aligned)}; with what works: {_correlation(far_out, works)}.",
    )
    title = "Models farthest from the training distribution"
    return Table("ood", title, _COLUMNS, tuple(rows), notes)


def _oddest(scores: tuple[float, ...], count: int = 3) -> str:
    order = sorted(range(len(scores)), key=lambda k: (-abs(scores[k]), k))[:count]
    return ", ".join(f"{FEATURE_NAMES[k]} {scores[k]:+.1f}" for k in order)


def _correlation(distances: dict[str, float], success: dict[str, float]) -> str:
    """Returns the coefficient, or why there is none."""
    both = [(distances[model], success[model]) for model in distances if model in success]
    if len(both) < 3:
        return "too few models"
    far, good = np.array(both).T
    if np.ptp(good) == 0 or np.ptp(far) == 0:
        return "none, for all are equally good or equally far"
    return f"{float(spearmanr(far, good).statistic):+.2f}"
