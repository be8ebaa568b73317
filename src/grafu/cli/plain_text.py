"""What is printed where nothing is a terminal, as `rich` prints it there: to import that takes longer than to print.

Lines of plain letters that need not be folded look the same either way; all else is left to `rich`.
"""

import os
import re
import sys
from typing import Final, final

from grafu.cli.pipe_layout import NUMBERS, PIPE_WIDTH
from grafu.cli.verb import say
from grafu.dataclass import dataclass

_FORCED: Final = frozenset({"FORCE_COLOR", "TTY_COMPATIBLE"})  # what makes of any stream a terminal
_WESTERN: Final = re.compile("[ -~\xa1-\xac\xae-\xff]*")  # each letter as wide as another
_BETWEEN: Final = "  "


@final
@dataclass(frozen=True, slots=True)
class TextTable:
    """The titles of columns, and rows of cells; nothing in them is markup."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]

    @property
    def lines(self) -> list[str]:
        """The lines of the table: each column as wide as its widest cell, numbers to the right."""
        widths = [max(map(len, cells)) for cells in zip(self.columns, *self.rows, strict=True)]
        return [
            _BETWEEN.join(
                cell.rjust(width) if title in NUMBERS else cell.ljust(width)
                for cell, width, title in zip(row, widths, self.columns, strict=True)
            )
            for row in (self.columns, *self.rows)
        ]


def print_table(table: TextTable) -> None:
    """Prints a table on stdout."""
    lines = table.lines
    if _looks_the_same(*lines):
        for line in lines:
            say(line)
        return
    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console

    drawn = plain_table(*table.columns)
    for row in table.rows:
        drawn.add_row(*map(escape, row))
    wide_console().print(drawn)


def print_line(line: str, folds: bool = True) -> None:
    """Prints a line on stdout; where it is too long it is folded, unless it is a path."""
    if _looks_the_same(line):
        say(line)
        return
    from grafu.cli.terminal import wide_console

    wide_console().print(line, soft_wrap=not folds, markup=False, highlight=False)


def _looks_the_same(*lines: str) -> bool:
    """Whether lines look the same printed as they are: stdout is no terminal or notebook, and nothing is folded."""
    is_shown = sys.stdout.isatty() or "IPython" in sys.modules or not _FORCED.isdisjoint(os.environ)
    return not is_shown and all(len(line) <= PIPE_WIDTH and _WESTERN.fullmatch(line) for line in lines)
