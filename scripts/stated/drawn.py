"""Tables and figures of the pages, drawn from what the commands printed last (docs/figures.json)."""

import re
from collections.abc import Mapping
from pathlib import Path

from bench_figure import PRINTED
from docs_results import HARD, HIDDEN, LEAD

from stated.measures import MEASURES
from stated.store import Stored, Table, drawn_table

FIGURE = re.compile(r"(<!-- figure: ([^:\n]+): ([^\n]+?) / ([^\n]+?) -->)(.*?)(<!-- end -->)", re.DOTALL)
BESIDE_RULES = ("hinge", "rail", "attached", "border", "joint", "slide", "mount", "parent")
KINDS = ("natural", "masked", "lacking")
DECIDED = "where the input decides"
LEFT_OUT = ("labels given", "no labels")

Store = Mapping[str, Stored]


def with_figures(page: Path, text: str, store: Store) -> str:
    """Returns a page with every figure between its marks as it was printed last.

    Raises:
        SystemExit: if a mark names no figure.
    """

    def drawn(found: re.Match[str]) -> str:
        try:
            return f"{found[1]}{store[found[2]].cell(found[3], found[4])}{found[6]}"
        except KeyError:
            raise SystemExit(
                f"{page}: {found[1]} names no figure: expected MEASURE: ROW / COLUMN as in docs/figures.json, "
                f"a measure being one of {', '.join(store)}"
            ) from None

    return FIGURE.sub(drawn, text)


def tables(store: Store) -> dict[tuple[str, str], str]:
    """Returns the measured tables by page and name."""
    return {
        ("network.md", "synthetic"): copied(store["synthetic"], 0),
        ("network.md", "network and rules"): beside(store),
        ("network.md", "doors"): doors(store),
        ("network.md", "decided"): decided(store),
        ("network.md", "facts"): copied(store["synthetic"], 2),
        ("network.md", "added parts"): copied(store["synthetic"], 3),
        ("network.md", "motions"): motions(store),
        ("network.md", "causes"): causes(store),
        ("network.md", "calibration"): calibration(store),
        ("additions.md", "statics made"): copied(store["statics"], 0),
        ("additions.md", "statics real"): copied(store["statics"], 1),
        ("training.md", "losses"): copied(store["losses"], 0),
        ("training.md", "folds"): copied(store["folds"], 0),
        ("training.md", "departures measured"): copied(store["departures"], 0),
        ("benchmarks.md", "welded"): ours(store["welded"]),
        ("speed.md", "speed"): without_ratio(store["speed"]),
        ("cluster.md", "cluster"): copied(store["cluster"], 0),
        ("synthetic.md", "synthetic and real"): "\n".join(["```text", *store["synthetic and real"].lines, "```"]),
    }


def results_page(store: Store) -> str:
    """Returns docs/results.md."""
    parts = [(LEAD, store["results"]), (HARD, store["results of hard models"])]
    parts.append((HIDDEN, store["hidden labels of hard models"]))
    return "\n".join(_section(lead, kept) for lead, kept in parts)


def _section(lead: str, kept: Stored) -> str:
    """Returns what one command printed, below a lead that states the command."""
    command = (
        kept.command.replace("{models}", "$GRAFU_MODELS").replace("{out}", "results").replace(" --jobs {jobs}", "")
    )
    return "\n".join([lead.format(command=command), *kept.lines]).rstrip("\n") + "\n"


def copied(kept: Stored, number: int) -> str:
    """Returns one of the tables that a command printed."""
    return drawn_table(kept.tables[number])


def without_ratio(kept: Stored) -> str:
    """Returns the table of the bench without its last column, the ratio to the figures printed before."""
    return drawn_table([row[:PRINTED] for row in kept.tables[0]])


def ours(kept: Stored) -> str:
    """Returns the first table that a command printed without the rows that the paper prints."""
    return drawn_table([row for row in kept.tables[0] if not row[0].endswith("(the paper)")])


def beside(store: Store) -> str:
    """Returns the network's figures on synthetic furniture beside the rules'."""
    rows = [
        [name, *(f"{bare(store['synthetic'], name, k)} / {bare(store['synthetic by rules'], name, k)}" for k in KINDS)]
        for name in BESIDE_RULES
    ]
    return drawn_table([["figure", *KINDS], *rows])


def bare(kept: Stored, row: str, column: str) -> str:
    """Returns a figure without its interval."""
    return kept.cell(row, column).split(" ±")[0]


def doors(store: Store) -> str:
    """Returns how many doors turn as they should, by what the input shows of them."""
    mine, theirs = (
        next(t for t in store[name].tables if len(t[0]) == 3) for name in ("synthetic", "synthetic by rules")
    )
    rows = [[*a, b[2]] for a, b in zip(mine[1:], theirs[1:], strict=True)]
    return drawn_table([[mine[0][0], "doors", "turn as they should: network", "rules"], *rows])


def decided(store: Store) -> str:
    """Returns the edges and hinges where the input decides them, of the network and of the rules."""
    mine, theirs = (
        next(t for t in store[name].tables if t[0][0] == DECIDED) for name in ("synthetic", "synthetic by rules")
    )
    rows = [[*a, b[2]] for a, b in zip(mine[1:], theirs[1:], strict=True)]
    return drawn_table([[DECIDED, "there are", "network", "rules"], *rows])


def motions(store: Store) -> str:
    """Returns the fractions of real motions that are right, of the network and of the rules."""
    head = ["asked about", "motions", "network", "rules"]
    rows: Table = [
        [row[0], row[1], row[3], store["motions by rules"].cell(row[0], "fraction")]
        for row in store["motions"].tables[0][1:]
    ]
    return drawn_table([head, *rows])


def causes(store: Store) -> str:
    """Returns why motions of hard models are wrong: of the rules, the first network, and the weights that ship."""
    who = {
        "rules": "motions of hard models by rules",
        "the first network": "motions of hard models by the first network",
        "the weights that ship": "motions of hard models",
    }
    head = ["asked about", "motions of", *store["motions of hard models"].tables[1][0][1:], "right"]
    rows: Table = [
        [asked, name, *_row(store[measure].tables[1], asked), store[measure].cell(asked, "right")]
        for asked in ("labels given", "no labels")
        for name, measure in who.items()
    ]
    return drawn_table([head, *rows])


def calibration(store: Store) -> str:
    """Returns how far the confidences of motions are from how many are right, of both sets of models."""
    columns = ("motions", "fraction", "mean confidence", "calibration error", "if calibrated")
    sets = {"the 17 models": store["motions"], "hard models": store["motions of hard models"]}
    asked = [row[0] for row in store["motions"].tables[0][1:]]
    rows: Table = [[name, one, *(kept.cell(name, c) for c in columns)] for name in asked for one, kept in sets.items()]
    return drawn_table([["asked about", "models", "motions", "right", *columns[2:]], *rows])


def _row(table: Table, name: str) -> list[str]:
    return next(row[1:] for row in table if row[0] == name)


def figures_page(store: Store) -> str:
    """Returns docs/figures.md: every command that prints a figure of these pages, and every script."""
    rows = [
        [
            f"`{m.name}`",
            m.states,
            ", ".join(f"[{p}]({p})" for p in m.pages),
            f"`{m.command}`",
            f"{m.minutes} min",
            age(m.name, store),
        ]
        for m in MEASURES
    ]
    table = drawn_table([["measure", "what", "page", "command", "takes about", "figures are"], *rows])
    root = Path(__file__).parents[2]
    scripts = [[f"`scripts/{path.name}`", first_sentence(path)] for path in sorted((root / "scripts").glob("*.py"))]
    return HEAD + table + SCRIPTS + drawn_table([["script", "what it does"], *scripts]) + "\n"


def age(name: str, store: Store) -> str:
    """Returns whether figures were printed by the command as it is, or were in a page before."""
    if name not in store:
        return "not printed yet"
    return "carried over" if store[name].carried else "printed"


def first_sentence(path: Path) -> str:
    """Returns the first line of a script's docstring."""
    return path.read_text("utf-8").split('"""')[1].strip().splitlines()[0].rstrip(".,:;").replace("|", "\\|")


HEAD = """\
# Figures

<!-- drawn by scripts/docs.py from scripts/stated/measures.py and docs/figures.json -->

Every measured figure of these pages was printed by one of the commands below, and is kept in `docs/figures.json`. Pages
are drawn from there: a figure that is changed by hand is refused by `make check`, and so is one that names no command.

    GRAFU_MODELS=models make figures                                    # all, quickest first; only compares
    make figures FIGURES="--list"                                       # what there is, and how old it is
    make figures FIGURES="--only motions --write"                       # one, and into the pages
    make figures FIGURES="--page network.md --write"                    # those of a page
    make figures FIGURES="--quick"                                      # few models: do all commands work?

`{models}` is the folder of real models that `GRAFU_MODELS` names, `{out}` a folder below `build/figures`. A command
that finished is not run again for the same code and weights; one that was stopped is resumed where possible. Figures
that are `carried over` were in a page before this list existed, and have not been printed since.

"""
SCRIPTS = """

## To state a number in a page

* A figure that a command prints: `<!-- figure: MEASURE: ROW / COLUMN -->0.95<!-- end -->`; the measure is defined in
  `scripts/stated/measures.py`, row and column in its table in `docs/figures.json`. `python scripts/docs.py` writes
  the value.
* A table of such figures: one row in `tables` of `scripts/stated/drawn.py`, and its marks in the page.
* A number of the code: a line in `scripts/stated/constants.py` (or `constants_built.py`), the words of the
  page with `{}` for the number, and the value.
* What is no figure but looks like one (a definition, an example): `<!-- no figure: why -->` in the same
  paragraph, or in the line above a table.

## To look at many models

    python scripts/pictures.py sheets samples/*.glb models/pnm/* --out sheets --motion auto

writes one contact sheet for each model: as drawn, closed, half open, open (each joint as far as the others leave room,
in the order in which they can open), closed from behind, open from below, the text of the report, and each hinge and
rail close up, its joint open, from where it is seen best. Red is hardware on what is fixed, blue on what moves, yellow
a support; what hides hardware from all sides is drawn faint. Close-ups that do not fit go to a second sheet.

## Scripts

"""
