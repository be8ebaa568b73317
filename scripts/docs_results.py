"""The text of docs/results.md, from the tables of a run of `grafu evaluate`; `scripts/figures.py` keeps it."""

import json
from pathlib import Path
from typing import Any

SHOWN = (
    "aligned",
    "reasonable",
    "collision",
    "collision_fixed",
    "connected",
    "connected_fixed",
    "works",
    "works_fixed",
)
LEAD = """\
# Results

<!-- drawn by scripts/docs.py from docs/figures.json -->

Development models are measured here, most of them from PartNet-Mobility. They are not part of the project and nothing
was trained on them, but the generator and the realization were developed with them, so the figures are optimistic.
[Evaluation](evaluation.md) states what each number means. The command:

    {command}

`make figures FIGURES="--only results --write"` runs it and draws its tables.

## What works, and what does not, in pictures

The first pieces of our generator, of a seed that no training saw, as a reader would load them: parts missing, some with
the name of another part. None was chosen: these are the first in which everything moves as it should,

![Five pieces that work, opened: drawers, doors, a corner cabinet](images/results_works.png)

and the first in which something does not: a door hangs on another side than it should, or a part that moves is taken
for one that does not. `grafu edit` sets it right ([edit in the browser](edit.md)); this draws both:

    python scripts/pictures.py results_works results_wrong

![Five pieces in which something does not work, each with its first fault](images/results_wrong.png)
"""
HARD = """\
## Harder models, too

These models were chosen because they are hard: each class of failure that was seen has an example here. The command:

    {command}

`make figures FIGURES="--only 'results of hard models' --write"` runs it and draws what follows. Its `worst.png` shows
the models under *What is wrong*, as annotated and as built, the parts that are wrong in red; its `ood.png` shows the
models farthest from the training distribution beside their nearest training models.
"""
HIDDEN = """\
## Harder models with labels hidden

Labels of the same models are hidden at random, a tenth to all of them, five draws each, and with a label the name. The
command takes an hour or two of one core, goes on where it was ended, and draws the curves as `masking.svg`:

    {command}

![Curves of GT-aligned, collision, connectivity and works over the labels hidden](images/hidden_labels.svg)
"""
_HARD_TABLES = ("outcomes", "static", "ood")


def results_text(out: Path) -> str:
    """Returns the page below its lead; `out` is as given to `grafu evaluate --out`."""
    tables = out / "tables"
    motion = json.loads((tables / "motion.json").read_text("utf-8"))
    sections = [_counts(motion), _motion(motion), _table(tables, "masking")]
    sections.append(_wrong(json.loads((tables / "models.json").read_text("utf-8"))))
    return "\n".join(sections)


def motion_text(out: Path) -> str:
    """Returns the table of motions alone."""
    return _motion(json.loads((out / "tables" / "motion.json").read_text("utf-8")))


def hard_text(out: Path) -> str:
    """Returns the tables of the harder models; `out` is as given to `grafu evaluate --out`."""
    tables = out / "tables"
    motion = json.loads((tables / "motion.json").read_text("utf-8"))
    sections = [_counts(motion), _motion(motion), *(_table(tables, name) for name in _HARD_TABLES)]
    sections.append(_wrong(json.loads((tables / "models.json").read_text("utf-8"))))
    return "\n".join(sections).replace("\n## ", "\n### ")


def hidden_text(out: Path) -> str:
    """Returns the table of hidden labels alone, without a heading; `out` is as given to `grafu evaluate --out`."""
    return (out / "tables" / "masking.md").read_text("utf-8").split("\n", 2)[2]


def _table(tables: Path, name: str) -> str:
    return (tables / f"{name}.md").read_text("utf-8").replace("# ", "## ", 1)


def _counts(motion: dict[str, Any]) -> str:
    """Returns how many models and parts there are, by category."""
    first = motion["rows"][0]["method"]
    rows = [row for row in motion["rows"] if (row["method"], row["over"]) == (first, "objects")]
    whole, *each = [f"{row['objects']} of {row['data']} ({row['parts']} parts that count)" for row in rows]
    return f"Models: {whole}{': ' if each else ''}{', '.join(each)}.\n"


def _motion(table: dict[str, Any]) -> str:
    """Returns the means over objects; brackets hold 95 % intervals."""
    titles = {column["name"]: column["title"] for column in table["columns"]}
    lines = [f"## {table['title']}", "", "| Method | Data | Objects | " + " | ".join(titles[n] for n in SHOWN) + " |"]
    lines.append("| --- | --- | ---: |" + " ---: |" * len(SHOWN))
    for row in table["rows"]:
        if row["over"] == "objects":
            cells = " | ".join(_ratio(row[name]) for name in SHOWN)
            lines.append(f"| {row['method']} | {row['data']} | {row['objects']} | {cells} |")
    return "\n".join([*lines, "", *(f"- {note}" for note in table["notes"]), ""])


def _ratio(cell: Any) -> str:
    if cell is None:
        return "–"
    if isinstance(cell, dict):
        return f"{100 * cell['value']:.1f} [{100 * cell['low']:.1f}, {100 * cell['high']:.1f}]"
    return f"{100 * cell:.1f}"


def _wrong(table: dict[str, Any]) -> str:
    """Returns what is wrong, by model and method."""
    lines = ["## What is wrong", ""]
    found = [row for row in table["rows"] if row["faults"] and row["method"] != "annotation"]
    lines += [f"- `{row['method']}`, {row['model']}: {row['faults']}." for row in found]
    return "\n".join([*lines, *(() if found else ("No model has a fault, with rule or network.",)), ""])
