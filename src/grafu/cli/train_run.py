"""Runs `train`: hands the options to the loop, counts its steps on a bar, and prints a line for each validation.

The best weights of a run as the file that the package ships.
"""

import argparse
import logging
import os
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

from grafu.cli.messages import complain, say
from grafu.cli.progress import with_progress
from grafu.export.whole_file import whole_file
from grafu.network.export import onnx_bytes
from grafu.processes.privacy import keep_private
from grafu.training.checkpoint import BestWeights, load_best
from grafu.training.config import CONFIGS, TrainingConfig
from grafu.training.loop import RunOptions, StepReport, train
from grafu.training.source import Source, source_to_train_on
from grafu.training.workers import Workers, has_device, joined_workers, use_threads


def exported(best: BestWeights) -> bytes:
    """Returns an ONNX file; weights are stored in 16 bits and computed with in 32."""
    keep_private()  # the exporter may look whether ONNX Runtime is there
    before = logging.root.manager.disable
    logging.disable(logging.WARNING)  # torch's exporter tells of packages that it does not need
    try:
        return onnx_bytes(best.network(), **asdict(best.config.features), half_weights=True)
    finally:
        logging.disable(before)


EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130
_MOST_JOBS = 8  # that many make models faster than a GPU learns from them
_TOLD = ("category", "hinge", "rail", "attached", "joint")


def run_training(options: argparse.Namespace) -> int:
    """Trains, and says how it goes; returns the exit code, 130 where it was stopped before its end.

    Raises:
        FunctionalizationError: if the run cannot be begun or gone on with.
    """
    config = _config(options)
    if not has_device(options.device):
        complain(f"`--device` must be one that is there: torch finds no `{options.device}`")
        return EXIT_BAD_INPUT
    source = source_to_train_on(options.data, config.seed, config.features.points)
    use_threads(options.threads)
    jobs = options.jobs or min(_MOST_JOBS, os.cpu_count() or 1)
    with joined_workers(options.device) as workers:
        reports = train(config, source, options.out, workers, RunOptions(jobs, options.resume))
        first = last = next(reports)
        _say(workers, _begun(options, config, source, workers, first))
        try:
            for report in with_progress(reports, config.steps - first.step, "steps", shown=workers.is_first):
                last = report
                if report.figures:
                    _say(workers, _judged(report))
        except ArithmeticError as error:
            complain(str(error))
            return EXIT_FAILED
        return _ended(last, config, options.out, workers)


def export_weights(folder: Path, target: Path) -> int:
    """Writes the best weights of a run as ONNX; returns 0.

    Raises:
        UnreadableAsset: if there are none.
        ExportError: if the file cannot be written.
    """
    best = load_best(folder)
    content = exported(best)
    with whole_file(target) as fresh:
        fresh.write_bytes(content)
    score = best.figures["score"]
    say(f"written to {target}: {len(content) / 1e6:.1f} MB, the weights of step {best.step} (score {score:.4f})")
    return EXIT_DONE


def _config(options: argparse.Namespace) -> TrainingConfig:
    asked: dict[str, Any] = {name: getattr(options, name) for name in ("steps", "seed")}
    return replace(CONFIGS[options.config], **{name: value for name, value in asked.items() if value is not None})


def _begun(
    options: argparse.Namespace, config: TrainingConfig, source: Source, workers: Workers, first: StepReport
) -> str:
    graphs = config.deal.models * config.deal.copies * workers.count
    before = f"from step {first.step} on, " if first.step else ""
    return (
        f"training `{options.config}` on {source.name}: {before}{config.steps} steps of {graphs} graphs, {workers.name}"
    )


def _judged(report: StepReport) -> str:
    figures = report.figures
    shares = (
        f"{variant} " + " ".join(f"{name} {figures[f'{variant}/{name}']:.3f}" for name in _TOLD)
        for variant in ("natural", "masked")
    )
    best = ", the best" if figures["score"] >= report.best else ""
    return f"step {report.step}: score {figures['score']:.4f}{best}, loss {figures['loss']:.3f}; {'; '.join(shares)}"


def _ended(last: StepReport, config: TrainingConfig, folder: Path, workers: Workers) -> int:
    if last.step < config.steps:
        if workers.is_first:
            complain(f"stopped after step {last.step} of {config.steps}; the same command with --resume goes on")
        return EXIT_INTERRUPTED
    _say(workers, f"{last.step} steps done, best score {last.best:.4f}; weights in {folder}; --export FILE writes ONNX")
    return EXIT_DONE


def _say(workers: Workers, line: str) -> None:
    if workers.is_first:
        say(line)
