"""The last value of every measured figure, kept in docs/figures.json, and what is read of a command's output.

Commands print Markdown. Of each the tables are kept, a cell as it was printed, and where a page repeats the whole text,
its lines. A figure is named `MEASURE: ROW / COLUMN`: the first table of the measure that has such a row and column.
"""

import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import final

ROOT = Path(__file__).parents[2]
STORE = ROOT / "docs" / "figures.json"
Table = list[list[str]]  # its header first


@final
@dataclass(frozen=True)
class Stored:
    """What a command printed last. `weights` begins the sha256 of the network's file then; empty: they do not matter.

    `carried` figures are older than this store: they were in a page, and were not printed again since.
    """

    command: str
    tables: list[Table]
    lines: list[str]
    weights: str = ""
    carried: bool = False

    def cell(self, row: str, column: str) -> str:
        """Returns a cell by its row's first cell and its column's head.

        Raises:
            KeyError: if no table has it.
        """
        for table in self.tables:
            for cells in table[1:]:
                if cells[0] == row and column in table[0]:
                    return cells[table[0].index(column)]
        raise KeyError(f"{row} / {column}")


def load_store(path: Path = STORE) -> dict[str, Stored]:
    """Returns what was printed last, by measure; nothing where there is no store yet."""
    if not path.is_file():
        return {}
    return {name: Stored(**kept) for name, kept in json.loads(path.read_text("utf-8")).items()}


def save_store(stored: dict[str, Stored], path: Path = STORE) -> None:
    """Writes the store, whole."""
    text = json.dumps({name: asdict(stored[name]) for name in sorted(stored)}, indent=1, ensure_ascii=False)
    partly = path.with_suffix(".part")
    partly.write_text(text + "\n", "utf-8")
    partly.replace(path)


def tables_in(text: str) -> list[Table]:
    """Returns the Markdown tables in a text, their rules left out."""
    tables: list[Table] = []
    above = ""
    for line in text.splitlines():
        if line.startswith("|"):
            cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
            if not above.startswith("|"):
                tables.append([])
            if any(cell.strip("-: ") for cell in cells):
                tables[-1].append(cells)
        above = line
    return tables


def drawn_table(table: Table) -> str:
    """Returns a table as Markdown."""
    head, *rows = table
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(
        f"| {' | '.join(cells)} |" if cells is not lines[1] else f"|{'---|' * len(head)}" for cells in lines
    )
