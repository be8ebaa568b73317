"""All tables of a run in all forms, and the page that says how each figure was measured. It writes no files.

Nothing in them depends on the day, the machine's speed or the order of work: the same rows give the same bytes.
"""

from collections.abc import Callable
from typing import Final

from grafu.evaluation.bootstrap import RESAMPLES
from grafu.evaluation.masking_table import masking_table
from grafu.evaluation.methods import FOREIGN
from grafu.evaluation.models_table import models_table
from grafu.evaluation.motion_table import motion_table
from grafu.evaluation.ood_table import ood_table
from grafu.evaluation.results import Results
from grafu.evaluation.static_table import static_table
from grafu.evaluation.table import FORMS, Table, markdown
from grafu.evaluation.tasks import EvaluationPlan
from grafu.version import __version__

_BUILDERS: Final[dict[str, Callable[[Results], Table]]] = {
    "motion": motion_table,
    "masking": masking_table,
    "static": static_table,
    "models": models_table,
}
_HOW = f"""\
## How it was measured

- **Parts that count**: annotated hinges and slides that hang on what stands still, whose largest side is at least 8 %
  of the object's and whose second largest at least 2 %.
- **GT-aligned**: same type, signed direction within 10 degrees, and for hinges the same border as the annotation says.
- **Reasonable (twins)**: aligned, or what another annotation of the same geometry in this data says. **(or physical)**:
  or a motion that fits the part's category, is held along its hinge line or slide, leads outwards, can be pulled by its
  handle, and opens freely to 70 %.
- **Collision**: share of 50 poses from rest to full in which the part, without hardware, cuts into what stands still by
  more than 0.0005 of the largest side; **touch**: the same without tolerance. Parts that stand still have neither.
- **Connected**: never farther from what stands still than 0.005 of the largest side, anchored hardware counted in. A
  part that stands still is not connected.
- **Opening**: achieved over annotated range, this at most 90 degrees or 75 % of the part's depth. **Works**: aligned,
  no collision, connected, opening 70 % or more.
- **Plain columns** are of the stated axes and ranges on the meshes as they are, **+ fix** of what was built of them.
- **Intervals**: 95 %, {RESAMPLES:,} resamples of the objects.

Parts of a model on which a method failed count as standing still.
"""


def build_tables(plan: EvaluationPlan, results: Results) -> tuple[Table, ...]:
    """Returns the tables that were asked for, in the order of `TABLES`."""
    found = [build(results) for name, build in _BUILDERS.items() if name in plan.tables]
    if "ood" in plan.tables and results.training:
        found.append(ood_table(results, plan.ranked_method.spelled))
    return tuple(found)


def output_files(plan: EvaluationPlan, results: Results, tables: tuple[Table, ...], command: str) -> dict[str, bytes]:
    """Returns each file's bytes by its name: `index.md`, and `<table>.md`, `.csv`, `.json` and `.tex` of each table."""
    files = {f"{table.name}.{form}": write(table).encode() for table in tables for form, write in FORMS.items()}
    return {"index.md": _index(plan, results, tables, command).encode(), **files}


def _index(plan: EvaluationPlan, results: Results, tables: tuple[Table, ...], command: str) -> str:
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
        + (" Predictions of others are read from files." if any(m.name in FOREIGN for m in plan.methods) else ""),
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
        *_failures(results),
    ]
    return "\n".join(lines).rstrip() + "\n"


def _twins(results: Results) -> str:
    if not results.twins:
        return "No two models are one geometry."
    pairs = ", ".join(f"{a} and {b}" for a, b in results.twins)
    return f"Models of one geometry: {pairs}."


def _failures(results: Results) -> list[str]:
    if not results.failures:
        return []
    return ["## Failures", "", *(f"- {one.model or 'made'}: {one.what}: {one.error}" for one in results.failures), ""]
