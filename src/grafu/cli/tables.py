"""How tables look on the terminal, and in a pipe. It knows nothing of what stands in them."""

from rich.console import Console
from rich.table import Table

PIPE_WIDTH = 200  # a pipe or file has no width of its own; rich would fold at 80
NUMBERS = ("doors", "drawers", "skipped", "seconds", "opening", "models", "movable")


def wide_console() -> Console:
    """Returns stdout as rich writes to it; what is not a terminal is wide enough for every table."""
    console = Console()
    return console if console.is_terminal else Console(width=PIPE_WIDTH)


def plain_table(*columns: str) -> Table:
    """Returns a table without lines; the first column (the ids that people copy) is never folded."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    for i, name in enumerate(columns):
        table.add_column(name, justify="right" if name in NUMBERS else "left", overflow="fold", no_wrap=i == 0)
    return table
