"""Draws what docs/ repeats of the code and of what commands printed: whole pages, tables and figures within others.

A table within a page stands between `<!-- NAME: drawn by scripts/docs.py ... -->` and `<!-- end of NAME -->`, a figure
between `<!-- figure: MEASURE: ROW / COLUMN -->` and `<!-- end -->`. How to state a number: docs/figures.md.

python scripts/docs.py            write the pages
python scripts/docs.py --check    exit 1 where a page is out of date, states another number than the code, or states a
                                  figure that no command is named for
"""

import re
import sys
from collections.abc import Mapping
from dataclasses import fields
from functools import partial
from pathlib import Path

from docs_api import api_page
from docs_synthetic import distributions_page, families_table, strategies_table
from stated.configs import loss_choices, network_config, paper_departures, training_configs
from stated.constants import told
from stated.drawn import figures_page, results_page, tables, with_figures
from stated.measures import MEASURES
from stated.numbers import pages_in, spaced, unbound
from stated.store import load_store

from grafu import errors
from grafu.asset import options
from grafu.dataset.figures import COLUMNS
from grafu.export.formats import FORMATS
from grafu.pipeline import inspection, report_schema
from grafu.pipeline.report_record import ReportRecord, described
from grafu.refusal import Reason

DOCS = Path(__file__).parent.parent / "docs"

REPORT_HEAD = """\
# report.json

<!-- drawn by scripts/docs.py from src/grafu/pipeline/report_schema.py, report_standing.py and inspection.py -->

Every result holds a `report.json` of the form `grafu.report/1`; `grafu inspect --json` prints `grafu.inspection/1`.
Lengths are metres, angles radians; points and directions are in the output's frame ([conventions](conventions.md)). A
field is never removed or given another meaning within a version of the form; fields may be added.
"""
ERRORS_HEAD = """\
# Errors

<!-- drawn by scripts/docs.py from src/grafu/errors.py and src/grafu/refusal.py -->

Everything that grafu raises on purpose is one of these. The message is one line: what was given, what was expected, how
to fix it. The command prints it on stderr and exits with 2; with several inputs the others go on, and it exits with 1.
"""
REASONS_HEAD = """\
## Reasons, not errors

A part that cannot be made to move, or a thing that cannot be added, is no exception: it is listed in `skipped` of the
[report](report.md) with one of these reasons as its `cause`, and the rest of the piece is built.
"""


def main() -> int:
    """Writes or checks the pages; returns the exit code."""
    wrong = [] if "--check" not in sys.argv else stale_pages()
    if "--check" not in sys.argv:
        write_pages()
    wrong += other_commands() + untrue_sentences() + unbound_numbers()
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


def write_pages() -> None:
    """Writes the pages that are out of date."""
    for name, text in drawn_pages().items():
        path = DOCS / name
        if not path.exists() or path.read_text("utf-8") != text:
            path.write_text(text, "utf-8")


def stale_pages() -> list[str]:
    """Returns a line for each page that is not as it is drawn."""
    pages = drawn_pages()
    stale = [name for name in pages if not (DOCS / name).exists() or (DOCS / name).read_text("utf-8") != pages[name]]
    return [f"docs/{name} is out of date: run python scripts/docs.py" for name in stale]


def other_commands() -> list[str]:
    """Returns a line for each measure whose figures are missing or were printed by another command than it names."""
    store = load_store()
    return [
        f"the figures of `{m.name}` are not those of `{m.command}`: make figures FIGURES=\"--only '{m.name}' --write\""
        for m in MEASURES
        if m.name not in store or store[m.name].command != m.command
    ]


def untrue_sentences() -> list[str]:
    """Returns a line for each sentence that a page does not say with the numbers of the code."""
    return [
        f"docs/{page} must say `{sentence}`, as the code does (scripts/stated/constants.py)"
        for page, sentences in told().items()
        for sentence in sentences
        if not re.search(spaced(sentence), (DOCS / page).read_text("utf-8"))
    ]


def unbound_numbers() -> list[str]:
    """Returns a line for each number of a page that looks measured and is bound to nothing."""
    stated = told()
    pages = pages_in(DOCS).items()
    return [line for name, path in pages for line in unbound(name, path.read_text("utf-8"), stated.get(name, ()))]


def drawn_pages() -> dict[str, str]:
    """Returns every page of docs/ in which something is drawn, by name."""
    store = load_store()
    drawn = {
        "api.md": api_page(),
        "report.md": report_page(),
        "errors.md": errors_page(),
        "distributions.md": distributions_page(),
        "results.md": results_page(store),
        "figures.md": figures_page(store),
    }
    within = {
        ("synthetic.md", "families"): families_table(),
        ("inputs.md", "limits"): limits_table(),
        ("exports.md", "formats"): formats_table(),
        ("dataset.md", "strategies"): strategies_table(),
        ("datasets.md", "columns"): columns_table(),
        ("training.md", "configurations"): training_configs(),
        ("training.md", "loss choices"): loss_choices(),
        ("training.md", "departures"): paper_departures(),
        ("network.md", "configuration"): network_config(),
        **tables(store),
    }
    for path in sorted(DOCS.glob("*.md")):
        if path.name not in drawn:
            text = with_tables(path, {name: table for (page, name), table in within.items() if page == path.name})
            drawn[path.name] = with_figures(path, text, store)
    return drawn


def with_tables(page: Path, tables: Mapping[str, str]) -> str:
    """Returns a page with what stands between the marks of each name drawn anew."""
    text = page.read_text("utf-8")
    for name, table in tables.items():
        marks = re.compile(rf"(<!-- {name}: drawn by [^\n]* -->\n).*?(<!-- end of {name} -->\n)", re.DOTALL)
        text, count = marks.subn(partial(between, table), text)
        if count != 1:
            raise SystemExit(f"docs/{page.name} must hold the marks of `{name}` once: got {count} times")
    return text


def between(table: str, found: re.Match[str]) -> str:
    """Returns a table between its marks."""
    return f"{found[1]}\n{table}\n\n{found[2]}" if not table.endswith("\n") else f"{found[1]}\n{table}\n{found[2]}"


def formats_table() -> str:
    """Returns the table of the formats that are written."""
    rows = ["| `--formats` | files | what it is | needs |", "|---|---|---|---|"]
    for one in FORMATS.values():
        needs = f"`pip install 'grafu[{one.extra}]'`" if one.extra else "nothing more"
        files = ", ".join(f"`{name}`" for name in one.files)
        rows.append(f"| `{one.name}` | {files} | {one.about} | {needs} |")
    return "\n".join(rows) + "\n"


def limits_table() -> str:
    """Returns the table of what is read of one model at most."""
    rows = [
        f"| `{options.limit_name(f.name)}` | {f.default:,} | {f.metadata['counts']} |" for f in fields(options.Limits)
    ]
    return "\n".join(["| `--limit` | at most | of |", "|---|---|---|", *rows])


def columns_table() -> str:
    """Returns the table of the figures in the index of a set of results."""
    rows = [f"| `{column.name}` | {column.kind} | {column.meaning} |" for column in COLUMNS]
    return "\n".join(["| figure | type | what it is |", "|---|---|---|", *rows])


def report_page() -> str:
    """Returns docs/report.md."""
    report = records(report_schema.Report)
    rest = [record for record in records(inspection.Inspection) if record not in report]
    return "\n".join([REPORT_HEAD, *map(section, report), "# grafu inspect --json\n", *map(section, rest)])


def errors_page() -> str:
    """Returns docs/errors.md."""
    tree = "\n".join(branch(errors.FunctionalizationError, 0))
    rows = "\n".join(f"| `{reason.value}` | {reason.sentence} |" for reason in Reason)
    reasons = f"| reason | in a sentence |\n|---|---|\n{rows}"
    return f"{ERRORS_HEAD}\n```text\n{tree}\n```\n\n{REASONS_HEAD}\n{reasons}\n"


def branch(error: type[Exception], depth: int) -> list[str]:
    """Returns the lines of an exception and those below it."""
    states = (error.__doc__ or "").splitlines()[0]
    line = f"{'  ' * depth}{error.__name__}".ljust(32) + states
    return [line, *(below for child in error.__subclasses__() for below in branch(child, depth + 1))]


def records(top: type[ReportRecord]) -> list[type[ReportRecord]]:
    """Returns a record and those that its fields hold, each once, in order."""
    found = [top]
    for annotation, _ in described(top).values():
        found += [r for held in held_records(annotation) for r in records(held) if r not in found]
    return found


def held_records(annotation: object) -> list[type[ReportRecord]]:
    """Returns the records that an annotation names."""
    if isinstance(annotation, type) and issubclass(annotation, ReportRecord):
        return [annotation]
    return [record for inner in getattr(annotation, "__args__", ()) for record in held_records(inner)]


def section(record: type[ReportRecord]) -> str:
    """Returns one record as a heading, its sentence and a table of its fields."""
    rows = "\n".join(
        f"| `{name}` | {spelled(annotation)} | {meaning} |" for name, (annotation, meaning) in described(record).items()
    )
    title = f"## {record.__name__.removesuffix('Record')}"
    return f"{title}\n\n{record.__doc__}\n\n| field | type | meaning |\n|---|---|---|\n{rows}\n"


def spelled(annotation: object) -> str:
    """Returns the type of a field in words."""
    return words(annotation).replace("|", "\\|")


def words(annotation: object) -> str:
    """Returns an annotation in words."""
    arguments = getattr(annotation, "__args__", ())
    if annotation is type(None):
        return "null"
    if not arguments or held_records(annotation) == [annotation]:
        return getattr(annotation, "__name__", str(annotation)).removesuffix("Record")
    if arguments[-1] is Ellipsis:
        return f"list of {words(arguments[0])}"
    if all(isinstance(a, str) for a in arguments):
        return " | ".join(f"`{a}`" for a in arguments)
    if isinstance(annotation, type(dict[str, float])) and annotation.__origin__ is dict:
        return f"{words(arguments[0])} to {words(arguments[1])}"
    if isinstance(annotation, type(tuple[int])) and annotation.__origin__ is tuple:
        return f"{len(arguments)} x {words(arguments[0])}" if len(set(arguments)) == 1 else "list"
    return " | ".join(words(a) for a in arguments)


if __name__ == "__main__":
    sys.exit(main())
