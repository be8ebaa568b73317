"""The training loop, flat: a batch, a forward and a backward pass, a step; now and then a line, a validation, a file.

DIR/config.json            what was asked for
DIR/last.pt, DIR/best.pt   see `grafu.training.checkpoint`
DIR/train.csv, DIR/validation.csv, DIR/tensorboard/   see `grafu.training.logbook`
"""

import json
from collections.abc import Generator, Mapping
from contextlib import closing
from dataclasses import asdict, field
from pathlib import Path
from time import monotonic
from typing import final

import torch
from torch import Tensor, nn

from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.export.whole_file import write_whole
from grafu.network.grafu import GraFu
from grafu.network.stored import start_from
from grafu.training.batching import TrainingBatch, stream_batches
from grafu.training.checkpoint import Progress, has_progress, load_progress, require_own, save_best, save_progress
from grafu.training.config import TrainingConfig
from grafu.training.criterion import criterion
from grafu.training.logbook import STEPS, VALIDATION, Logbook, Meter
from grafu.training.optimiser import Optimiser, averaged, rate_at
from grafu.training.source import Source
from grafu.training.validation import validate, validation_batches, validation_source
from grafu.training.workers import Workers, stop_requests

_MOST_LOST = 50  # steps in a row with a loss or gradient that is no number: the run is beyond help


@final
@dataclass(frozen=True)
class RunOptions:
    """How a run is run; nothing of it changes the result but for rounding."""

    jobs: int = 1
    """Processes that make models; 1: this one makes them itself."""
    resume: bool = False
    save_every: float = 180.0
    """Seconds between two checkpoints: that much is lost at worst."""
    log_every: int = 20
    """Steps between two lines of the log."""


@final
@dataclass(frozen=True)
class StepReport:
    """How many steps are done, the best score so far; the means of the log, the figures of a validation, where due."""

    step: int
    best: float = 0.0
    means: dict[str, float] = field(default_factory=dict)
    figures: dict[str, float] = field(default_factory=dict)


def train(
    config: TrainingConfig,
    source: Source,
    folder: Path,
    workers: Workers,
    options: RunOptions = RunOptions(),
    start: Mapping[str, Tensor] | None = None,
) -> Generator[StepReport, None, None]:
    """Trains until all steps are done or a signal comes, and leaves the files of the run in the folder.

    A new run begins with the weights `start`, where they are given (`grafu.network.stored`), else with random ones. It
    yields once at the start and then after each step: take all that it yields to train to the end.

    Raises:
        ExportError: if the folder holds a run that is not to be resumed, or cannot be written.
        UnreadableAsset: if what is to be resumed, or a model, cannot be read.
        WeightsError: if the weights to start from are of another network.
        ArithmeticError: if losses stay no numbers.
    """
    torch.manual_seed(config.seed)
    progress = _begin(config, folder, workers, options.resume, start)
    keeper = _Keeper(config, source, folder, options, progress.step) if workers.is_first else None
    torch.manual_seed(config.seed + 1000 * workers.rank + progress.step)  # dropout differs between processes
    batches = stream_batches(source, config, progress.step, options.jobs, (workers.rank, workers.count))
    meter, is_stopping = Meter(), False
    with stop_requests() as asked, closing(batches):
        yield StepReport(progress.step, progress.best)
        while progress.step < config.steps and not is_stopping:
            with meter.timed("data"):
                batch = next(batches).to(workers.device)
            is_stopping = _learn(progress, batch, config, workers, meter, asked.is_made)
            if keeper is None:
                yield StepReport(progress.step, progress.best)
            else:
                yield keeper.after_step(progress, meter, is_stopping)
    if keeper is not None:
        keeper.close()
    workers.wait()


def _begin(
    config: TrainingConfig, folder: Path, workers: Workers, resume: bool, start: Mapping[str, Tensor] | None
) -> Progress:
    """Returns a run at its beginning, or where it was cut."""
    network = GraFu(config.network).to(workers.device)
    if start is not None and not has_progress(folder):
        start_from(network, start)
    average = averaged(network, config.optimiser.average)
    progress = Progress(network, Optimiser(network, config.optimiser), average)
    if has_progress(folder):
        if not resume:
            raise ExportError(f"`{folder}` holds a run already: choose another --out, or give --resume")
        load_progress(progress, config, folder)
    elif workers.is_first:
        require_own(folder, STEPS, VALIDATION)
        write_whole(json.dumps(asdict(config), indent=1) + "\n", folder / "config.json")
    workers.share_weights(network)
    return progress


def _learn(
    progress: Progress, batch: TrainingBatch, config: TrainingConfig, workers: Workers, meter: Meter, is_stopping: bool
) -> bool:
    """Takes one step on a batch; returns whether this or another process is to stop.

    Raises:
        ArithmeticError: if gradients stay no numbers.
    """
    parameters = list(progress.network.parameters())
    with meter.timed("forward"), _precise(config, workers.device):
        predictions = progress.network(batch.graphs)
    with meter.timed("loss"):
        terms = criterion(predictions, batch.targets, config.loss)
    with meter.timed("backward"):
        progress.optimiser.zero_grad()
        terms.total.backward()  # type: ignore[no-untyped-call]
    with meter.timed("step"):
        is_stopping = workers.average_gradients(parameters, is_stopping)
        norm = nn.utils.clip_grad_norm_(parameters, config.optimiser.clip)
        _step(progress, config, bool(norm.isfinite()))
    if progress.lost > _MOST_LOST:
        raise ArithmeticError(f"{progress.lost} steps in a row had gradients that are no numbers: lower the rate")
    meter.add(terms.by_name() | {"gradient": norm, "lost": float(progress.lost > 0)})
    return is_stopping


def _step(progress: Progress, config: TrainingConfig, is_sound: bool) -> None:
    """Moves the weights, unless the gradient is no number; then the step is lost."""
    asked = config.optimiser
    progress.optimiser.rate = asked.rate * rate_at(progress.step, config.steps, asked.warmup, asked.period)
    if is_sound:
        progress.optimiser.step()
        progress.average.update_parameters(progress.network)
    progress.lost = 0 if is_sound else progress.lost + 1
    progress.step += 1


@final
class _Keeper:
    """What the first process does for all: it writes the log, judges, and keeps the best weights and where it is."""

    def __init__(self, config: TrainingConfig, source: Source, folder: Path, options: RunOptions, step: int) -> None:
        self._config, self._folder, self._options = config, folder, options
        self._judged_by = validation_batches(validation_source(source, config.features.points), config)
        self._book = Logbook(folder, step)
        self._saved = monotonic()

    def after_step(self, progress: Progress, meter: Meter, is_stopping: bool) -> StepReport:
        """Does what is due after a step: writes the log, judges, and saves what the run goes on from."""
        step, is_last = progress.step, progress.step == self._config.steps
        means: dict[str, float] = {}
        figures: dict[str, float] = {}
        if step % self._options.log_every == 0 or is_last:
            means = meter.take() | {"rate": progress.optimiser.rate}
            self._book.step(step, means)
        if step % self._config.validation.every == 0 or is_last:
            figures = self._judge(progress)
        if is_stopping or is_last or monotonic() - self._saved > self._options.save_every:
            save_progress(progress, self._config, self._folder)
            self._saved = monotonic()
        return StepReport(step, progress.best, means, figures)

    def close(self) -> None:
        """Makes sure that all of the log is on disk."""
        self._book.close()

    def _judge(self, progress: Progress) -> dict[str, float]:
        """Returns the figures of the averaged weights, which are kept where none did better."""
        weights = progress.average.module.state_dict()
        judge = GraFu(self._config.network).to(next(progress.network.parameters()).device)
        judge.load_state_dict(weights)
        figures = validate(judge, self._judged_by, self._config.loss)
        self._book.validation(progress.step, figures)
        if figures["score"] > progress.best:
            progress.best = figures["score"]
            save_best(self._config, weights, progress.step, figures, self._folder)
        return figures


def _precise(config: TrainingConfig, device: torch.device) -> torch.autocast:
    """Returns the arithmetic of a forward pass."""
    wanted = config.precision == "bf16" or (config.precision == "auto" and multiplies_bfloat16(device))
    return torch.autocast(device.type, torch.bfloat16, enabled=wanted)


def multiplies_bfloat16(device: torch.device) -> bool:
    """Whether a device multiplies matrices of bfloat16 faster than those of float32."""
    if device.type == "cuda":
        return torch.cuda.is_bf16_supported()
    return device.type == "cpu" and torch.cpu._is_amx_tile_supported()
