"""What a run writes down as it goes: a CSV of its steps, one of its validations, and the same for TensorBoard.

A run that goes on where it was cut forgets the lines after the step that it goes on from: each step stands once.
"""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import Any, final

STEPS, VALIDATION = "train.csv", "validation.csv"


@final
class Logbook:
    """Writes to the folder of a run; `step` is the number of steps that are done.

    TensorBoard's files go into `DIR/tensorboard` where it is installed.
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
    if not path.exists():
        return
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    kept = rows[:1] + [row for row in rows[1:] if row and row[0].isdigit() and int(row[0]) <= step]
    if step == 0 or not rows:
        path.unlink()
        return
    with path.open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows(kept)


def _board(folder: Path, step: int) -> Any:
    """Returns TensorBoard's writer, or None where it is not installed."""
    try:
        from torch.utils.tensorboard import SummaryWriter
    except ImportError:
        return None
    return SummaryWriter(str(folder), purge_step=step + 1)
