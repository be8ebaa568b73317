"""Tables of an evaluation beside that of motions: each model, what was statically missing, labels that are hidden."""

from collections.abc import Mapping, Sequence
from statistics import fmean, stdev

from grafu.evaluation.bootstrap import Figure, difference_of, mean_of
from grafu.evaluation.figures import by_object
from grafu.evaluation.measures import OPENS
from grafu.evaluation.motion_table import MASKING, MODELS, OUTCOMES, SOURCE
from grafu.evaluation.results import PartOutcome, Results
from grafu.evaluation.table import Cell, Column, ResultTable

_EACH_MODEL = (
    Column("method", "Method"),
    Column("model", "Model"),
    Column("category", "Category"),
    Column("parts", "Parts", "count"),
    Column("aligned", "Aligned", "count", "more"),
    Column("reasonable", "Reasonable only", "count"),
    Column("wrong", "Wrong", "count", "less"),
    Column("works", "Works + fix", "count", "more"),
    Column("faults", "What is wrong"),
)
_EACH_MODEL_NOTES = (
    "Wrong: neither the annotation's motion, nor that of another annotation of the same geometry, nor one that passes "
    "the physical test. `Works` is of what was built.",
)


def models_table(results: Results) -> ResultTable:
    """Returns a row per method and model; within a method the worst come first."""
    rows: list[tuple[Cell, ...]] = []
    for method in results.made:
        by_model: dict[str, list[PartOutcome]] = {}
        for outcome in results.outcomes(method):
            by_model.setdefault(outcome.model, []).append(outcome)
        rows += sorted((_model_row(method, by_model[model]) for model in sorted(by_model)), key=_badness)
    return ResultTable("models", "Every model, worst first", _EACH_MODEL, tuple(rows), _EACH_MODEL_NOTES)


def _model_row(method: str, outcomes: Sequence[PartOutcome]) -> tuple[Cell, ...]:
    first = outcomes[0]
    aligned = sum(o.aligned for o in outcomes)
    reasonable = sum(o.reasonable for o in outcomes) - aligned
    works = sum(o.record.fixed is not None and o.record.fixed.works for o in outcomes)
    counts = len(outcomes), aligned, reasonable, len(outcomes) - aligned - reasonable, works
    return (method, first.model, first.category, *counts, _faults(outcomes))


def _badness(row: tuple[Cell, ...]) -> tuple[float, ...]:
    """Returns what sorts a row: many wrong parts first, then few that work, then many that are merely reasonable."""
    parts, _, reasonable, wrong, works = (float(str(cell)) for cell in row[3:8])
    return -wrong / parts, works / parts, -reasonable / parts


def _faults(outcomes: Sequence[PartOutcome]) -> str:
    if outcomes[0].error:
        return f"failed: {outcomes[0].error}"
    sentences = [f"{o.truth.part}: {faults}" for o in outcomes if (faults := "; ".join(part_faults(o)))]
    return ". ".join(sentences)


def part_faults(outcome: PartOutcome) -> list[str]:
    """Returns in words what one part does not do as it should."""
    fixed = outcome.record.fixed
    if fixed is None or fixed.found is None:
        return [f"is static ({outcome.record.skipped or 'no reason is known'})"]
    faults = []
    if not fixed.aligned:
        kind = "reasonable" if outcome.reasonable else "wrong"
        why = f", {outcome.record.objection}" if outcome.record.objection and kind == "wrong" else ""
        faults.append(f"{kind} motion ({fixed.found.type.value} for {outcome.truth.motion.type.value}{why})")
    if fixed.collision:
        faults.append(f"collides in {fixed.collision:.0%} of the poses")
    if not fixed.connected:
        faults.append("comes loose")
    if fixed.aligned and fixed.opening < OPENS:
        faults.append(f"opens to {fixed.opening:.0%}")
    return faults


_OUTCOMES = (
    Column("method", "Method"),
    Column("models", "Models", "count"),
    Column("aligned", "GT-aligned", "ratio", "more"),
    Column("twins", "Reasonable (twins)", "ratio"),
    Column("wrong_twins", "Wrong (twins)", "ratio", "less"),
    Column("physical", "Reasonable (or physical)", "ratio"),
    Column("wrong_physical", "Wrong (or physical)", "ratio", "less"),
)
_OUTCOMES_NOTES = (
    "GT-aligned: models in which every part that counts moves as annotated. Reasonable: the others in which each part "
    "moves so, or as another annotation of the same geometry states (twins), or passes the physical test (or "
    "physical). Wrong: all else. The three fractions of one definition sum to 100 %.",
    "The paper's models were judged by people, with other annotations of the same geometry as reference.",
    "Brackets hold the 95 % interval of a bootstrap over objects.",
)


def outcomes_table(results: Results) -> ResultTable:
    """Returns the fractions of models that are aligned, reasonable and wrong: a row per method, and the paper's."""
    rows: list[tuple[Cell, ...]] = []
    for method in results.made:
        by_model: dict[str, list[PartOutcome]] = {}
        for outcome in results.outcomes(method):
            by_model.setdefault(outcome.model, []).append(outcome)
        if by_model:
            rows.append((method, len(by_model), *_outcome_cells([by_model[model] for model in sorted(by_model)])))
    shown = (OUTCOMES[0], OUTCOMES[1], OUTCOMES[2], None, None)
    rows.append((f"GraFu ({SOURCE}, PN-M)", MODELS["PN-M"], *shown))
    return ResultTable("outcomes", "Models by how right they are", _OUTCOMES, tuple(rows), _OUTCOMES_NOTES)


def _outcome_cells(models: Sequence[Sequence[PartOutcome]]) -> tuple[Cell, ...]:
    aligned = [all(o.aligned for o in model) for model in models]
    twins = [all(o.aligned or o.agrees_with_a_twin for o in model) for model in models]
    physical = [all(o.reasonable for o in model) for model in models]
    cells: list[Cell] = [mean_of([float(one) for one in aligned])]
    for good in (twins, physical):
        cells.append(mean_of([float(one and not first) for one, first in zip(good, aligned, strict=True)]))
        cells.append(mean_of([float(not one) for one in good]))
    return tuple(cells)


_FIGURES = (
    Column("aligned_fixed", "GT-aligned", "ratio", "more"),
    Column("collision_fixed", "Collision", "ratio", "less"),
    Column("connected_fixed", "Connected", "ratio", "more"),
    Column("works_fixed", "Works", "ratio", "more"),
)
_MASKING = (
    Column("method", "Method"),
    Column("rate", "Labels hidden", "ratio"),
    Column("seeds", "Seeds", "count"),
    Column("objects", "Objects", "count"),
    *_FIGURES,
    Column("aligned_spread", "GT-aligned, deviation of seeds", "ratio"),
    Column("steady", "Never better than with fewer hidden"),
)
_MASKING_NOTES = (
    "An object's figure is its mean over the seeds; brackets hold the 95 % interval of a bootstrap over objects.",
    "With all labels hidden there is nothing to draw: one seed stands for all. With none hidden the row is the motion "
    "table's.",
    "The last column compares, object by object, with every lower rate: yes where no figure is better by more than its "
    "95 % interval.",
)


def masking_table(results: Results) -> ResultTable:
    """Returns a row per method and rate, and the paper's rows."""
    rows = [row for method in results.masked for row in _masking_rows(method, results)]
    title = "Motions where labels are hidden at random"
    return ResultTable("masking", title, _MASKING, (*rows, *_published_masking()), _MASKING_NOTES)


def _masking_rows(method: str, results: Results) -> list[tuple[Cell, ...]]:
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


def _published_masking() -> list[tuple[Cell, ...]]:
    rows: list[tuple[Cell, ...]] = []
    for place, (data, models) in enumerate(MODELS.items()):
        for rate, figures in MASKING.items():
            rows.append((f"GraFu ({SOURCE}, {data})", rate, 5, models, *figures[place], None, None, None))
    return rows
