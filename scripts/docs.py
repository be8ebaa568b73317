"""Draws what docs/ repeats of the code: whole pages (report, errors, distributions) and tables within others.

A table within a page stands between `<!-- NAME: drawn by scripts/docs.py ... -->` and `<!-- end of NAME -->`.

python scripts/docs.py            write the pages
python scripts/docs.py --check    exit 1 where a page is out of date
"""

import re
import sys
from pathlib import Path

from docs_synthetic import distributions_page, families_table, strategies_table
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from grafu import errors
from grafu.pipeline import inspection, report_schema

DOCS = Path(__file__).parent.parent / "docs"

REPORT_HEAD = """\
# report.json

<!-- drawn by scripts/docs.py from src/grafu/pipeline/report_schema.py and inspection.py -->

Every result holds a `report.json` of the form `grafu.report/1`; `grafu inspect --json` prints `grafu.inspection/1`.
Lengths are metres, angles radians; points and directions are in the output's frame ([conventions](conventions.md)). A
field is never removed or given another meaning within a version of the form; fields may be added.
"""
ERRORS_HEAD = """\
# Errors

<!-- drawn by scripts/docs.py from src/grafu/errors.py -->

Everything that grafu raises on purpose is one of these. The message is one line: what was given, what was expected, how
to fix it. The command prints it on stderr and exits with 2; with several inputs the others go on, and it exits with 1.
"""
REASONS_HEAD = """\
## Reasons, not errors

A part that cannot be made to move is no exception: it stands in `skipped` of the [report](report.md), with one of these
reasons, and the rest of the piece is built.
"""


def main() -> int:
    """Writes or checks the pages; returns the exit code."""
    pages = {
        "report.md": report_page(),
        "errors.md": errors_page(),
        "distributions.md": distributions_page(),
        "synthetic.md": with_table("synthetic.md", "families", families_table()),
        "dataset.md": with_table("dataset.md", "strategies", strategies_table()),
    }
    stale = [name for name, text in pages.items() if not (DOCS / name).exists() or (DOCS / name).read_text() != text]
    if "--check" in sys.argv:
        for name in stale:
            print(f"docs/{name} is out of date: run python scripts/docs.py", file=sys.stderr)
        return 1 if stale else 0
    for name in stale:
        (DOCS / name).write_text(pages[name])
    return 0


def with_table(page: str, name: str, drawn: str) -> str:
    """Returns a page of docs/ with what stands between the marks of this name drawn anew."""
    marks = re.compile(rf"(<!-- {name}: drawn by [^\n]* -->\n).*?(<!-- end of {name} -->\n)", re.DOTALL)
    text, count = marks.subn(lambda found: f"{found[1]}\n{drawn}\n{found[2]}", (DOCS / page).read_text())
    if count != 1:
        raise SystemExit(f"docs/{page} must hold the marks of `{name}` once: got {count} times")
    return text


def report_page() -> str:
    """Returns docs/report.md."""
    report = records(report_schema.Report)
    rest = [record for record in records(inspection.Inspection) if record not in report]
    return "\n".join([REPORT_HEAD, *map(section, report), "# grafu inspect --json\n", *map(section, rest)])


def errors_page() -> str:
    """Returns docs/errors.md."""
    tree = "\n".join(branch(errors.FunctionalizationError, 0))
    reasons = "\n".join(f"- `{reason.value}`" for reason in report_schema.SkipReason)
    return f"{ERRORS_HEAD}\n```text\n{tree}\n```\n\n{REASONS_HEAD}\n{reasons}\n"


def branch(error: type[Exception], depth: int) -> list[str]:
    """Returns the lines of an exception and those below it."""
    says = (error.__doc__ or "").splitlines()[0]
    line = f"{'  ' * depth}{error.__name__}".ljust(32) + says
    return [line, *(below for child in error.__subclasses__() for below in branch(child, depth + 1))]


def records(top: type[BaseModel]) -> list[type[BaseModel]]:
    """Returns a record and those that its fields hold, each once, in order."""
    found = [top]
    for field in top.model_fields.values():
        found += [r for held in held_records(field.annotation) for r in records(held) if r not in found]
    return found


def held_records(annotation: object) -> list[type[BaseModel]]:
    """Returns the records that an annotation names."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [record for inner in getattr(annotation, "__args__", ()) for record in held_records(inner)]


def section(record: type[BaseModel]) -> str:
    """Returns one record as a heading, its sentence and a table of its fields."""
    rows = "\n".join(
        f"| `{field.serialization_alias or name}` | {spelled(field)} | {field.description} |"
        for name, field in record.model_fields.items()
    )
    title = f"## {record.__name__.removesuffix('Record')}"
    return f"{title}\n\n{record.__doc__}\n\n| field | type | meaning |\n|---|---|---|\n{rows}\n"


def spelled(field: FieldInfo) -> str:
    """Returns a field's type in words."""
    return words(field.annotation).replace("|", "\\|")


def words(annotation: object) -> str:
    """Returns an annotation in words."""
    arguments = getattr(annotation, "__args__", ())
    if annotation is type(None):
        return "null"
    if not arguments or (hasattr(annotation, "model_fields")):
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
