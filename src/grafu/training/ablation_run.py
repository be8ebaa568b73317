"""One run of an ablation: trained until its end in a folder of its own, never twice, and its figures kept there.

OUT/<experiment>/seed_<S>/               the files of the run, see `grafu.training.loop`
OUT/<experiment>/seed_<S>/figures.json   what its best weights reach in validation; there once it is finished
"""

import json
import math
from collections.abc import Generator, Mapping
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import final

from grafu.errors import ExportError, FunctionalizationError, UnreadableAsset
from grafu.export.whole_file import write_whole
from grafu.training.ablation import Experiment
from grafu.training.checkpoint import has_progress, load_best, read_config
from grafu.training.config import TrainingConfig
from grafu.training.loop import RunOptions, train
from grafu.training.source import Source
from grafu.training.workers import joined_workers

SCHEMA = "grafu.ablation/1"
FIGURES = "figures.json"


@final
@dataclass(frozen=True)
class AblationRun:
    """One experiment with one seed, on one source, in one folder; `device` as `joined_workers` takes it."""

    experiment: Experiment
    seed: int
    source: Source
    folder: Path
    device: str = "auto"

    @property
    def config(self) -> TrainingConfig:
        """The experiment's config with this seed."""
        return replace(self.experiment.config, seed=self.seed)


@final
@dataclass(frozen=True)
class RunEvent:
    """What happened to a run: it did `steps` steps more, or ended with figures, or cannot go on."""

    steps: int = 0
    figures: Mapping[str, float] | None = None
    failure: str = ""

    @property
    def is_last(self) -> bool:
        """Whether nothing more happens to the run."""
        return self.figures is not None or bool(self.failure)


def known_figures(run: AblationRun) -> dict[str, float] | None:
    """Returns the figures of a finished run, None where it is to be begun or gone on with.

    Raises:
        UnreadableAsset: if its folder holds a run that was asked to do otherwise, or a damaged file.
    """
    path, config = run.folder / FIGURES, run.folder / "config.json"
    if not path.is_file() and not has_progress(run.folder):
        return None
    if read_config(_read(config), config) != run.config:
        raise UnreadableAsset(f"`{run.folder}` holds a run of other steps or another config: choose another --out")
    if not path.is_file():
        return None
    stated = _read(path)
    if not isinstance(stated, dict) or stated.get("schema") != SCHEMA:
        raise UnreadableAsset(f"`{path}` must be of the form `{SCHEMA}`: remove it")
    return {name: math.nan if value is None else float(value) for name, value in stated["figures"].items()}


def do_run(run: AblationRun) -> Generator[RunEvent, None, None]:
    """Trains until the end, from where it was cut if it was; what goes wrong is the last event, and is not raised.

    When a signal asks it to stop there is no last event, and the same call goes on later.
    """
    try:
        yield from _train(run)
    except (FunctionalizationError, ArithmeticError) as error:
        yield RunEvent(failure=str(error))


def _train(run: AblationRun) -> Generator[RunEvent, None, None]:
    done = 0
    with (
        joined_workers(run.device) as workers,
        closing(train(run.config, run.source, run.folder, workers, RunOptions(resume=True))) as reports,
    ):
        for report in reports:
            yield RunEvent(steps=report.step - done)
            done = report.step
    if done < run.config.steps:
        return
    best = load_best(run.folder)
    named = {name: None if math.isnan(value) else value for name, value in best.figures.items()}
    stated = {"schema": SCHEMA, "step": best.step, "figures": named}
    write_whole(json.dumps(stated, indent=1) + "\n", run.folder / FIGURES)
    yield RunEvent(figures=best.figures)


def _read(path: Path) -> object:
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise UnreadableAsset(f"`{path}` cannot be read: remove its folder, or choose another --out") from error


def begin_ablation(folder: Path, asked: Mapping[str, str]) -> None:
    """Notes in OUT/ablation.json what is asked for, so that no folder gets the tables of two ablations.

    Raises:
        ExportError: if the folder holds another ablation, or cannot be written.
    """
    path = folder / "ablation.json"
    wanted = {"schema": SCHEMA} | dict(asked)
    if not path.is_file():
        if others := [name for name in ("table.md", "table.csv") if (folder / name).exists()]:
            raise ExportError(f"`{folder}` holds `{others[0]}` and no ablation: choose another --out")
        write_whole(json.dumps(wanted, indent=1) + "\n", path)
    elif _read(path) != wanted:
        raise ExportError(f"`{folder}` holds another ablation ({path.name} says which): choose another --out")
