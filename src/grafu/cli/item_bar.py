"""A bar over items of one kind, on stderr where that is a terminal: how many are done, how fast, how long it takes."""

from collections.abc import Callable, Iterable, Iterator
from typing import TypeVar, final

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
from rich.text import Text

T = TypeVar("T")


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
