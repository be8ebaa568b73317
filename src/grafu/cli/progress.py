"""How far the work is, on stderr, where it is a terminal."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from types import MappingProxyType
from typing import Final, TypeVar, final

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    ProgressColumn,
    SpinnerColumn,
    Task,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)
from rich.text import Text

from grafu.visible import visible

T = TypeVar("T")
_STAGES: Final = MappingProxyType(
    {
        "load": "reading",
        "match": "matching the motions with the parts",
        "parse": "finding what touches",
        "complete": "deciding what moves",
        "plan": "deciding what is built",
        "close": "closing drawers that are drawn open",
        "body": "adding tops and drawer boxes",
        "realize": "placing hinges and rails, and opening them",
        "fittings": "adding handles and shelves",
        "export": "making the files",
        "write": "writing",
    }
)


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


@contextmanager
def with_stages(name: str) -> Iterator[Callable[[str], None]]:
    """Gives a function that takes each stage as it begins, and shows it beside the name and the elapsed time."""
    columns = (
        SpinnerColumn(),
        TextColumn("{task.fields[name]}: {task.description}", markup=False),
        TimeElapsedColumn(),
    )
    console = Console(stderr=True)
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        task = progress.add_task("starting", total=None, name=visible(name))
        yield lambda stage: progress.update(task, description=_STAGES.get(stage, stage))
