"""How figures fall as labels are hidden: each rate over several draws, and whether they fall steadily."""

from collections.abc import Mapping, Sequence
from statistics import fmean, stdev

from grafu.evaluation.bootstrap import Figure, difference_of, mean_of
from grafu.evaluation.figures import by_object
from grafu.evaluation.motion_table import MASKING, MODELS, SOURCE
from grafu.evaluation.results import PartOutcome, Results
from grafu.evaluation.table import Cell, Column, Table

_FIGURES = (
    Column("aligned_fixed", "GT-aligned", "ratio", "more"),
    Column("collision_fixed", "Collision", "ratio", "less"),
    Column("connected_fixed", "Connected", "ratio", "more"),
    Column("works_fixed", "Works", "ratio", "more"),
)
_COLUMNS = (
    Column("method", "Method"),
    Column("rate", "Labels hidden", "ratio"),
    Column("seeds", "Seeds", "count"),
    Column("objects", "Objects", "count"),
    *_FIGURES,
    Column("aligned_spread", "GT-aligned, deviation of seeds", "ratio"),
    Column("steady", "Never better than with fewer hidden"),
)
_NOTES = (
    "An object's figure is its mean over the seeds; brackets hold the 95 % interval of a bootstrap over objects.",
    "With all labels hidden there is nothing to draw: one seed stands for all. With none hidden the row is the motion "
    "table's.",
    "The last column compares, object by object, with every lower rate: yes where no figure is better by more than its "
    "95 % interval.",
)


def masking_table(results: Results) -> Table:
    """Returns a row per method and rate, and the paper's rows."""
    rows = [row for method in results.masked for row in _rows(method, results)]
    title = "Motions where labels are hidden at random"
    return Table("masking", title, _COLUMNS, (*rows, *_published()), _NOTES)


def _rows(method: str, results: Results) -> list[tuple[Cell, ...]]:
    draws: dict[float, list[Sequence[PartOutcome]]] = {}
    if method in results.made:
        draws[0.0] = [results.outcomes(method)]
    for ratio, seed in sorted(results.masked[method]):
        draws.setdefault(ratio, []).append(results.outcomes_masked(method, (ratio, seed)))
    seen: list[Mapping[str, Mapping[str, float]]] = []
    rows: list[tuple[Cell, ...]] = []
    for ratio, drawn in draws.items():
        means = {column.name: _over_seeds([by_object(one, column.name) for one in drawn]) for column in _FIGURES}
        spread = [fmean(one.values()) for one in (by_object(d, "aligned_fixed") for d in drawn) if one]
        steady = all(_no_better(means, earlier) for earlier in seen)
        figures = [mean_of(list(means[column.name].values())) for column in _FIGURES]
        count = len(means["aligned_fixed"])
        deviation = stdev(spread) if len(spread) > 1 else None
        rows.append((method, ratio, len(drawn), count, *figures, deviation, steady if seen else None))
        seen.append(means)
    return rows


def _over_seeds(draws: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Returns each object's mean over the draws in which it has a figure."""
    models = dict.fromkeys(model for draw in draws for model in draw)
    return {model: fmean(draw[model] for draw in draws if model in draw) for model in models}


def _no_better(later: Mapping[str, Mapping[str, float]], earlier: Mapping[str, Mapping[str, float]]) -> bool:
    return all(not _better(later[c.name], earlier[c.name], c.better) for c in _FIGURES)


def _better(later: Mapping[str, float], earlier: Mapping[str, float], better: str) -> bool:
    """Whether the later figures are better by more than chance."""
    both = [model for model in later if model in earlier]
    change: Figure | None = difference_of([later[m] for m in both], [earlier[m] for m in both])
    if change is None:
        return False
    return change.low > 0 if better == "more" else change.high < 0


def _published() -> list[tuple[Cell, ...]]:
    rows: list[tuple[Cell, ...]] = []
    for place, (data, models) in enumerate(MODELS.items()):
        for rate, figures in MASKING.items():
            rows.append((f"GraFu ({SOURCE}, {data})", rate, 5, models, *figures[place], None, None, None))
    return rows
