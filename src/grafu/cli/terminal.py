"""What the terminal shows: how far the work is, on stderr where that is a terminal, and tables, in a pipe too.

What steers a terminal is shown as an escape, whatever is printed: names of files and parts are others' text.
"""

from collections.abc import Callable, Iterable, Iterator
from typing import Any, TypeVar, final

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.table import Table
from rich.text import Text

from grafu.visible import visible

T = TypeVar("T")
PIPE_WIDTH = 200  # a pipe or file has no width of its own; rich would fold at 80
NUMBERS = ("doors", "drawers", "skipped", "seconds", "opening", "models", "movable")


@final
class _RateColumn(ProgressColumn):
    """How many items per second, lately."""

    def render(self, task: Task) -> Text:
        return Text(f"{task.speed:.1f} per second," if task.speed else "")


def with_progress(
    items: Iterable[T], total: int, word: str = "inputs", shown: bool = True, size: Callable[[T], int] = lambda _: 1
) -> Iterator[T]:
    """Yields the items and counts them, each as `size` (say steps), on a bar, under this word, if it is to be shown."""
    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        _RateColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
    )
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not (shown and console.is_terminal)) as progress:
        task = progress.add_task(word, total=total)
        for item in items:
            progress.advance(task, size(item))
            yield item


@final
class _VisibleConsole(Console):
    """Prints strings, in tables too, with nothing in them that is hidden: one line stays one line."""

    def render_str(self, text: str, **options: Any) -> Text:
        """Returns the text as it is shown."""
        return super().render_str(visible(text), **options)


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
