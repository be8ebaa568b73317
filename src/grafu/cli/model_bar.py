"""A bar over several models that names those in work; a line for each as it ends, where stderr is no terminal."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import final

from rich.console import Console
from rich.progress import (
    BarColumn,
    MofNCompleteColumn,
    Progress,
    SpinnerColumn,
    TextColumn,
    TimeElapsedColumn,
    TimeRemainingColumn,
)

from grafu.cli.telling import beneath, clear_line, note
from grafu.visible import visible

_NAMED = 4  # models in work that a bar names
_LONGEST = 40  # characters of their names


@final
class ModelBar:
    """What is done and what is in work, as the bar shows it; not a value."""

    def __init__(self, progress: Progress, total: int, word: str, lines: bool) -> None:
        self._progress, self._lines, self._total, self._done = progress, lines, total, 0
        self._in_work: list[str] = []
        self._task = progress.add_task(word, total=total, names="")

    def begins(self, name: str) -> None:
        """Names a model that is in work now."""
        self._in_work.append(visible(name))
        self._show()

    def ends(self, name: str, words: str = "") -> None:
        """Counts a model as done; the words, if any, are logged, and are a line of their own where there is no bar."""
        if visible(name) in self._in_work:
            self._in_work.remove(visible(name))
        self._done += 1
        self._show()
        line = f"[{self._done}/{self._total}] {words}"
        if words and self._lines:
            self.say(line)
        elif words:
            note(line)

    def say(self, line: str) -> None:
        """Prints a line on stderr, above the bar where there is one, and logs it."""
        if self._progress.disable:
            print(visible(line), file=sys.stderr, flush=True)
            return
        note(line)
        self._progress.console.print(visible(line), markup=False, highlight=False, soft_wrap=True)

    def _show(self) -> None:
        named = ", ".join(self._in_work[:_NAMED])
        more = "" if len(self._in_work) <= _NAMED else f" and {len(self._in_work) - _NAMED} more"
        short = named if len(named) <= _LONGEST else f"{named[: _LONGEST - 1]}…"
        self._progress.update(self._task, completed=self._done, names=f"{short}{more}")


@contextmanager
def model_bar(total: int, word: str, silent: bool = False) -> Iterator[ModelBar]:
    """Gives a bar over so many models, under this word; nothing is shown if it is to be `silent`."""
    clear_line()
    console = Console(file=beneath(sys.stderr))
    shown = console.is_terminal and not silent
    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}"),
        BarColumn(bar_width=20),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(),
        TextColumn("{task.fields[names]}", markup=False),
    )
    with Progress(
        *columns, console=console, transient=True, disable=not shown, redirect_stdout=False, redirect_stderr=False
    ) as progress:
        yield ModelBar(progress, total, word, lines=not (shown or silent))
