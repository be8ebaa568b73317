"""A bar over the stages of one model, on stderr where that is a terminal; its stages with their seconds in the log."""

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from time import perf_counter
from types import MappingProxyType
from typing import TYPE_CHECKING, Final, final

from grafu.cli.telling import beneath, clear_line, note
from grafu.visible import visible

if TYPE_CHECKING:
    from rich.progress import Progress

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
        "small parts": "placing knobs, buttons and wheels",
        "lift arms": "placing lift arms",
        "stays": "adding stays",
        "grasp frames": "finding where grippers take hold",
        "export": "making the files",
        "write": "writing",
        "page": "drawing the page",
    }
)
_FORCED: Final = frozenset({"FORCE_COLOR", "TTY_COMPATIBLE"})
_PLACES: Final = MappingProxyType({stage: place for place, stage in enumerate(_STAGES)})


def stage_words(stage: str) -> str:
    """Returns a stage in words."""
    return _STAGES.get(stage, stage)


@final
class _Stages:
    """The stage that is in work, and the bar that shows it, if there is one; not a value."""

    def __init__(self, name: str, verbose: bool, progress: "Progress | None" = None) -> None:
        self._name, self._verbose, self._progress = visible(name), verbose, progress
        self._task = None if progress is None else progress.add_task("starting", total=len(_STAGES), name=self._name)
        self._stage, self._began = "", 0.0

    def begin(self, stage: str) -> None:
        """Ends the stage before and shows this one."""
        self.end()
        self._stage, self._began = stage, perf_counter()
        if self._progress is not None and self._task is not None:
            self._progress.update(self._task, description=stage_words(stage), completed=_PLACES.get(stage))

    def end(self) -> None:
        """Ends the stage that is in work, if any: its seconds are logged, and printed where that is wanted."""
        if not self._stage:
            return
        line = f"{self._name}: {stage_words(self._stage)}: {perf_counter() - self._began:.2f} s"
        if self._verbose and self._progress is None:
            print(line, file=sys.stderr, flush=True)
            return
        note(line)
        if self._verbose and self._progress is not None:
            self._progress.console.print(line, markup=False, highlight=False, soft_wrap=True)


@contextmanager
def with_stages(name: str, verbose: bool = False, silent: bool = False) -> Iterator[Callable[[str], None]]:
    """Gives a function that takes each stage as it begins, and shows it beside the name and the elapsed time.

    Each stage goes into the log with its seconds as it ends, and is printed on stderr where it is `verbose`. There is
    no bar where it is `silent`, or stderr is no terminal.
    """
    clear_line()
    bar = None if silent else _bar()
    with bar or nullcontext():
        stages = _Stages(name, verbose, bar)
        yield stages.begin
        stages.end()


def _bar() -> "Progress | None":
    """Returns the bar; None where stderr is no terminal, and no variable by which rich takes it for one is set."""
    stream = beneath(sys.stderr)
    if not (stream.isatty() or _FORCED & os.environ.keys()):
        return None
    from rich.console import Console  # local: it takes long, and most runs show no bar
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    console = Console(file=stream)
    if not console.is_terminal:
        return None
    columns = (
        SpinnerColumn(),
        BarColumn(bar_width=20),
        TextColumn("{task.fields[name]}: {task.description}", markup=False),
        TimeElapsedColumn(),
    )
    return Progress(*columns, console=console, transient=True, redirect_stdout=False, redirect_stderr=False)
