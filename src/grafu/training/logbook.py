"""What a run writes down as it goes: a CSV of its steps, one of its validations, and the same for TensorBoard.

A line of steps holds means since the last one: losses, and where the time went. A run that goes on where it was cut
forgets the lines after the step that it goes on from: each step stands once.
"""

import csv
import os
from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from io import StringIO
from pathlib import Path
from time import perf_counter
from typing import Any, final

from torch import Tensor

from grafu.asset.json_files import read_own
from grafu.errors import UnreadableAsset


@final
class Meter:
    """Sums numbers by name; numbers of a GPU are fetched only when their mean is asked for."""

    def __init__(self) -> None:
        self._begin()

    def add(self, values: Mapping[str, Tensor | float]) -> None:
        """Counts the numbers of one step."""
        self._steps += 1
        for name, value in values.items():
            self._values[name].append(value)

    @contextmanager
    def timed(self, name: str) -> Iterator[None]:
        """Adds the time that the block takes; on a GPU that is until its work is handed over, not until it is done."""
        started = perf_counter()
        try:
            yield
        finally:
            self._seconds[name] += perf_counter() - started

    def take(self) -> dict[str, float]:
        """Returns the means per step, seconds per step as `seconds/NAME`, and `steps_per_second`; then starts again."""
        steps, elapsed = max(1, self._steps), perf_counter() - self._started
        means = {name: sum(float(v) for v in values) / len(values) for name, values in self._values.items()}
        means |= {f"seconds/{name}": seconds / steps for name, seconds in self._seconds.items()}
        means["steps_per_second"] = self._steps / elapsed if elapsed > 0 else 0.0
        self._begin()
        return means

    def _begin(self) -> None:
        self._values: defaultdict[str, list[Tensor | float]] = defaultdict(list)
        self._seconds: defaultdict[str, float] = defaultdict(float)
        self._steps = 0
        self._started = perf_counter()


STEPS, VALIDATION = "train.csv", "validation.csv"
_MOST_BYTES = 512 * 2**20


@final
class Logbook:
    """Writes to the folder of a run; `step` is the number of steps that are done.

    TensorBoard's files go into `DIR/tensorboard` where it is installed.

    Raises:
        AssetError: if a file of its own in the folder cannot be read.
    """

    def __init__(self, folder: Path, step: int = 0) -> None:
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)
        for name in (STEPS, VALIDATION):
            _forget_after(folder / name, step)
        self._board = _board(folder / "tensorboard", step)

    def step(self, step: int, values: Mapping[str, float]) -> None:
        """Writes numbers of training."""
        self._write(STEPS, "train", step, values)

    def validation(self, step: int, values: Mapping[str, float]) -> None:
        """Writes numbers of a validation."""
        self._write(VALIDATION, "validation", step, values)

    def close(self) -> None:
        """Makes sure that all is on disk."""
        if self._board is not None:
            self._board.close()

    def _write(self, name: str, group: str, step: int, values: Mapping[str, float]) -> None:
        path = self._folder / name
        row = {"step": str(step)} | {key: f"{value:.6g}" for key, value in values.items()}
        header = _header(path)
        with path.open("a", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, header or list(row), restval="", extrasaction="ignore")
            if header is None:
                writer.writeheader()
            writer.writerow(row)
        if self._board is not None:
            for key, value in values.items():
                self._board.add_scalar(f"{group}/{key}", value, step)


def _header(path: Path) -> list[str] | None:
    if not path.exists():
        return None
    with path.open(newline="", encoding="utf-8") as file:
        return next(csv.reader(file), None)


def _forget_after(path: Path, step: int) -> None:
    """Raises UnreadableAsset if there is a file that is no table of a run."""
    if not os.path.lexists(path):
        return
    rows = _rows(path)
    kept = rows[:1] + [
        row for row in rows[1:] if row and row[0].isdecimal() and len(row[0]) < 19 and int(row[0]) <= step
    ]
    if step == 0 or not rows:
        path.unlink()
        return
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(kept)


def _rows(path: Path) -> list[list[str]]:
    try:
        return list(csv.reader(StringIO(read_own(path, "a table of a run", _MOST_BYTES).decode(), newline="")))
    except (UnicodeDecodeError, csv.Error) as error:
        raise UnreadableAsset(f"{path} is damaged ({error}): expected a table of a run; remove it") from None


def _board(folder: Path, step: int) -> Any:
    """Returns TensorBoard's writer, or None where it is not installed."""
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        return None
    return SummaryWriter(str(folder), purge_step=step + 1)
