"""All tables of a run in all forms, and the page that states how each figure was measured.

Nothing in them depends on the day, the machine's speed or the order of work: the same rows give the same bytes.

The models farthest from what weights are trained on, what is odd about them, and whether distance costs success.
"""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np
from scipy.stats import spearmanr

from grafu.evaluation.bootstrap import RESAMPLES
from grafu.evaluation.distribution import FEATURE_NAMES, TRAINING_SEED, Distribution
from grafu.evaluation.figures import by_object
from grafu.evaluation.methods import FOREIGN
from grafu.evaluation.motion_table import motion_table
from grafu.evaluation.result_tables import masking_table, models_table, outcomes_table
from grafu.evaluation.results import Results
from grafu.evaluation.static_table import static_table
from grafu.evaluation.table import FORMS, Cell, Column, ResultTable, markdown
from grafu.evaluation.tasks import EvaluationPlan
from grafu.evaluation.usage_table import usage_table
from grafu.pipeline.words import counted
from grafu.version import __version__

TOP = 5
_COLUMNS = (
    Column("rank", "Rank", "count"),
    Column("model", "Model"),
    Column("category", "Category"),
    Column("from_nearest", "Distance from nearest", "number"),
    Column("from_middle", "Distance from middle", "number"),
    Column("nearest", "Nearest training model"),
    Column("oddest", "Oddest features (z-score)"),
    Column("aligned", "GT-aligned", "ratio", "more"),
    Column("works", "Works + fix", "ratio", "more"),
)


def ood_table(results: Results, method: str, top: int = TOP) -> ResultTable:
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
        f"Features: {', '.join(FEATURE_NAMES)}; each less the mean of {len(results.training)} synthetic models (seed "
        f"{TRAINING_SEED}), over their standard deviation; distances are Euclidean. Success is that of `{method}`.",
        f"Rank correlation (Spearman) over {len(far_out)} models of the distance from the nearest with GT-aligned: "
        f"{_correlation(far_out, aligned)}; with what works: {_correlation(far_out, works)}.",
    )
    title = "Models farthest from the training distribution"
    return ResultTable("ood", title, _COLUMNS, tuple(rows), notes)


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


PICTURES: Final = {
    "masking.svg": "Curves of hidden labels, with the 95 % interval; points: the paper, PN-M",
    "ood.png": "Models farthest from the training distribution, and the nearest training model of each",
    "worst.png": "What is wrong, in red: as annotated, and as built",
}
_BUILDERS: Final[dict[str, Callable[[Results], ResultTable]]] = {
    "motion": motion_table,
    "outcomes": outcomes_table,
    "masking": masking_table,
    "static": static_table,
    "models": models_table,
}
_HOW = f"""\
## How it was measured

- **Parts that count**: annotated hinges and slides that hang on what is static, whose largest side is at least 8 %
  of the object's and whose second largest at least 2 %.
- **GT-aligned**: same type, signed direction within 10 degrees, and for hinges the same border as the annotation
states.
- **Reasonable (twins)**: aligned, or what another annotation of the same geometry in this data states. **(or
  physical)**: or a motion that fits the part's category, is held along its hinge line or slide, leads outwards, can be
  pulled by its handle, and opens freely to 70 %.
- **Collision**: fraction of 50 poses from rest to full in which the part, without hardware, cuts into static parts by
  more than 0.0005 of the largest side; **touch**: the same without tolerance. Parts that are static have neither.
- **Connected**: never farther from what is static than 0.005 of the largest side, anchored hardware counted in. A
  part that is static is not connected.
- **Opening**: achieved over annotated range, this at most 90 degrees or 75 % of the part's depth. **Works**: aligned,
  no collision, connected, opening 70 % or more.
- **Plain columns** are of the stated axes and ranges on the meshes as they are, **+ fix** of what was built of them.
- **Intervals**: 95 %, {RESAMPLES:,} resamples of the objects.

Parts of a model on which a method failed count as static.
"""


def build_tables(plan: EvaluationPlan, results: Results) -> tuple[ResultTable, ...]:
    """Returns the tables that were asked for, in the order of `TABLES`, and last what language models used up."""
    found = [build(results) for name, build in _BUILDERS.items() if name in plan.tables]
    if "ood" in plan.tables and results.training:
        found.append(ood_table(results, plan.ranked_method.spelled))
    if any(method.model is not None for method in plan.methods):
        found.append(usage_table(results, plan.methods))
    return tuple(found)


def output_files(
    plan: EvaluationPlan, results: Results, tables: tuple[ResultTable, ...], command: str, pictures: Sequence[str] = ()
) -> dict[str, bytes]:
    """Returns each file's bytes by its name: `index.md`, and `<table>.md`, `.csv`, `.json` and `.tex` of each table.

    `pictures` are the names of those of `PICTURES` that lie beside them.
    """
    files = {f"{table.name}.{form}": write(table).encode() for table in tables for form, write in FORMS.items()}
    return {"index.md": _index(plan, results, tables, command, pictures).encode(), **files}


def _index(
    plan: EvaluationPlan, results: Results, tables: tuple[ResultTable, ...], command: str, pictures: Sequence[str]
) -> str:
    parts = sum(len(facts.parts) for facts in results.models.values())
    counted = sum(bool(facts.parts) for facts in results.models.values())
    lines = [
        "# Evaluation",
        "",
        f"{len(plan.models)} models of `{plan.data}`; {counted} of them have parts that count, {parts} parts in all. "
        f"grafu {__version__}.",
        "",
        "```",
        command,
        "```",
        "",
        f"Methods: {', '.join(f'`{method.spelled}`' for method in plan.methods)}."
        + (" Predictions of others are read from files." if any(m.name in FOREIGN for m in plan.methods) else "")
        + (" Language models are asked once; their replies are kept." if any(m.model for m in plan.methods) else ""),
        "",
        _twins(results),
        "",
        "Each table as Markdown, CSV, JSON and LaTeX: "
        + ", ".join(
            f"[{table.name}]({table.name}.md) ([csv]({table.name}.csv), [json]({table.name}.json), "
            f"[tex]({table.name}.tex))"
            for table in tables
        )
        + ".",
        "",
        _HOW,
        *(markdown(table).replace("# ", "## ", 1) for table in tables if table.name != "models"),
        *(f"## {PICTURES[name]}\n\n![{PICTURES[name]}]({name})\n" for name in pictures),
        *_not_run(results),
        *_failures(results),
    ]
    return "\n".join(lines).rstrip() + "\n"


def _twins(results: Results) -> str:
    if not results.twins:
        return "No two models are one geometry."
    pairs = ", ".join(f"{a} and {b}" for a, b in results.twins)
    return f"Models of one geometry: {pairs}."


def _not_run(results: Results) -> list[str]:
    if not results.not_run:
        return []
    lines = [
        f"- {method}: on {counted(len(reasons), 'model')}: {'; '.join(sorted(set(reasons.values())))}"
        for method, reasons in results.not_run.items()
    ]
    return ["## Not run", "", *lines, ""]


def _failures(results: Results) -> list[str]:
    if not results.failures:
        return []
    return ["## Failures", "", *(f"- {one.model or 'made'}: {one.what}: {one.error}" for one in results.failures), ""]
