"""Each model on a line, worst first: how many parts are aligned, merely reasonable, or wrong, and why."""

from collections.abc import Sequence

from grafu.evaluation.measures import OPENS
from grafu.evaluation.results import PartOutcome, Results
from grafu.evaluation.table import Cell, Column, Table

_COLUMNS = (
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
_NOTES = (
    "Wrong: neither the annotation's motion, nor that of another annotation of the same geometry, nor one that passes "
    "the physical test. `Works` is of what was built.",
)


def models_table(results: Results) -> Table:
    """Returns a row per method and model; within a method the worst come first."""
    rows: list[tuple[Cell, ...]] = []
    for method in results.made:
        by_model: dict[str, list[PartOutcome]] = {}
        for outcome in results.outcomes(method):
            by_model.setdefault(outcome.model, []).append(outcome)
        rows += sorted((_row(method, by_model[model]) for model in sorted(by_model)), key=_badness)
    return Table("models", "Every model, worst first", _COLUMNS, tuple(rows), _NOTES)


def _row(method: str, outcomes: Sequence[PartOutcome]) -> tuple[Cell, ...]:
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
    said = [f"{o.truth.part}: {told}" for o in outcomes if (told := "; ".join(_faults_of(o)))]
    return ". ".join(said)


def _faults_of(outcome: PartOutcome) -> list[str]:
    """Returns in words what one part does not do as it should."""
    fixed = outcome.record.fixed
    if fixed is None or fixed.found is None:
        return [f"is static ({outcome.record.skipped or 'no reason is known'})"]
    told = []
    if not fixed.aligned:
        kind = "reasonable" if outcome.reasonable else "wrong"
        why = f", {outcome.record.objection}" if outcome.record.objection and kind == "wrong" else ""
        told.append(f"{kind} motion ({fixed.found.type.value} for {outcome.truth.motion.type.value}{why})")
    if fixed.collision:
        told.append(f"collides in {fixed.collision:.0%} of the poses")
    if not fixed.connected:
        told.append("comes loose")
    if fixed.aligned and fixed.opening < OPENS:
        told.append(f"opens to {fixed.opening:.0%}")
    return told
