"""What is printed as a table, on a terminal and in a pipe.

What steers a terminal is shown as an escape, whatever is printed: names of files and parts are others' text.
"""

from typing import Any, NoReturn, final

from rich.console import Console
from rich.table import Table
from rich.text import Text

from grafu.cli.pipe_layout import NUMBERS, PIPE_WIDTH
from grafu.visible import visible


@final
class _VisibleConsole(Console):
    """Prints strings, in tables too, with nothing in them that is hidden: one line stays one line."""

    def render_str(self, text: str, **options: Any) -> Text:
        """Returns the text as it is shown."""
        return super().render_str(visible(text), **options)

    def on_broken_pipe(self) -> NoReturn:
        """Leaves it to the verb's last door: rich would end the process here, with nothing cleared away."""
        raise BrokenPipeError


def wide_console() -> Console:
    """Returns stdout as rich writes to it; what is not a terminal is wide enough for every table."""
    console = _VisibleConsole(emoji=False)
    return console if console.is_terminal else _VisibleConsole(width=PIPE_WIDTH, emoji=False)


def plain_table(*columns: str) -> Table:
    """Returns a table without lines; the first column (the ids that people copy) is never folded."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    for i, name in enumerate(columns):
        table.add_column(name, justify="right" if name in NUMBERS else "left", overflow="fold", no_wrap=i == 0)
    return table
