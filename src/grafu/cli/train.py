"""The verb `train`: trains the network, goes on with a run that was cut, or writes its best weights as ONNX.

What the verbs that train have in common: where models come from, what computes, and the packages that it takes.
"""

import argparse
import logging
import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from grafu.cli.input_options import positive_count
from grafu.cli.synth import whole_number
from grafu.cli.verb import complain, say
from grafu.errors import FunctionalizationError, WeightsError

if TYPE_CHECKING:
    from grafu.completion.features import FeatureConfig
    from grafu.network.grafu import GraFu
    from grafu.training.config import TrainingConfig
    from grafu.training.loop import StepReport
    from grafu.training.source import Source
    from grafu.training.workers import Workers

_PACKAGES = ("torch", "onnx")  # of the extra `train`; those of the rest are always there


def add_training_options(parser: argparse.ArgumentParser) -> None:
    """Adds `--data`, `--split` and `--device`."""
    parser.add_argument(
        "--data",
        default="synth",
        metavar="DIR",
        help="models to train on: `synth`, made on the spot; or a folder of shards or of a FurFun release "
        "(default: synth)",
    )
    parser.add_argument(
        "--split",
        default="",
        metavar="NAME",
        help="of a FurFun release: the split, such as subset_split (default: full)",
    )
    parser.add_argument(
        "--device", choices=("auto", "cpu", "cuda"), default="auto", help="what computes (default: auto)"
    )


@contextmanager
def training_packages() -> Iterator[None]:
    """Reports in one line which package of the extra `train` is missing, where the body imports one.

    Raises:
        FunctionalizationError: if one is.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] not in _PACKAGES:
            raise
        said = f"training needs `{error.name}`, which is not installed: pip install 'grafu[train]'"
        raise FunctionalizationError(said) from error


CONFIGS = ("base", "tune", "paper", "small", "tiny")

_DESCRIPTION = """\
Trains the network that completes functional graphs, and keeps in DIR what it needs to go on, the weights that did best
on furniture that it never trained on, and a log (CSV and TensorBoard). Stopped by Ctrl-C or a signal, or killed, it
goes on with --resume. A GPU is used where there is one, several with `torchrun --nproc-per-node N -m grafu.cli.main`.

With --export it trains nothing and writes the best weights of the run in DIR as one ONNX file, its probabilities
calibrated on the furniture that the weights were chosen by.
"""
_EXAMPLES = """\
examples:
  grafu train --config base --out runs/base --resume
  grafu train --config paper --data FurFun-233 --out runs/paper
  grafu train --out runs/base --export grafu.onnx
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "train", help="train the network (needs grafu[train])", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="the folder of the run")
    parser.add_argument(
        "--config",
        choices=CONFIGS,
        default="base",
        help="base: the shipped network; tune: the same from weights that exist (--start); paper: the paper's numbers; "
        "small: what `ablate` compares by; tiny: to see that all works (default: base)",
    )
    parser.add_argument("--resume", action="store_true", help="go on where the run in DIR was cut, if there is one")
    parser.add_argument(
        "--start",
        type=Path,
        metavar="FILE",
        help="begin a new run with the weights in FILE (`--export` of another run, or with --config paper a checkpoint "
        "of the authors', .pt), not with random ones",
    )
    add_training_options(parser)
    parser.add_argument(
        "--steps", type=positive_count, metavar="N", help="how many steps in all (default: the config's)"
    )
    parser.add_argument(
        "--seed", type=whole_number, metavar="S", help="which weights and models (default: the config's)"
    )
    parser.add_argument(
        "--jobs",
        type=positive_count,
        metavar="J",
        help="processes that make models (default: as many as cores, up to 8)",
    )
    parser.add_argument(
        "--threads", type=positive_count, metavar="T", help="threads that compute (default: one per core)"
    )
    parser.add_argument(
        "--export", type=Path, metavar="FILE", help="write the best weights of DIR as ONNX, train nothing"
    )
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Does what was asked for; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong, or files cannot be read or written.
    """
    with training_packages():
        return (
            export_weights(options.out, options.export, options.data, options.split)
            if options.export
            else run_training(options)
        )


def exported(network: "GraFu", features: "FeatureConfig", *, half: bool = True) -> bytes:
    """Returns an ONNX file; weights are stored in 16 bits, if `half`, and computed with in 32."""
    from grafu.network.export import onnx_bytes
    from grafu.processes.lifetime import keep_private

    keep_private()  # the exporter may look whether ONNX Runtime is there
    before = logging.root.manager.disable
    logging.disable(logging.WARNING)  # torch's exporter warns of packages that it does not need
    try:
        return onnx_bytes(network, **asdict(features), half_weights=half)
    finally:
        logging.disable(before)


ONEDNN_CACHE = "ONEDNN_PRIMITIVE_CACHE_CAPACITY"
EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130
_MOST_JOBS = 8  # that many make models faster than a GPU learns from them
_TOLD = ("category", "hinge", "rail", "attached", "joint")


def run_training(options: argparse.Namespace) -> int:
    """Trains, and states how it goes; returns the exit code, 130 where it was stopped before its end.

    Raises:
        FunctionalizationError: if the run cannot be begun or gone on with.
    """
    prepare_processor()
    from grafu.cli.item_bar import with_progress
    from grafu.training.loop import RunOptions, train
    from grafu.training.source import source_to_train_on
    from grafu.training.workers import has_device, joined_workers, use_threads

    config = _config(options)
    if not has_device(options.device):
        complain(f"`--device` must be one that is there: torch finds no `{options.device}`")
        return EXIT_BAD_INPUT
    source = source_to_train_on(options.data, config.seed, config.features.points, options.split)
    use_threads(options.threads)
    jobs = options.jobs or min(_MOST_JOBS, os.cpu_count() or 1)
    with joined_workers(options.device) as workers:
        reports = train(config, source, options.out, workers, RunOptions(jobs, options.resume), _start(options))
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


def prepare_processor() -> None:
    """Sets what makes training on a processor faster, where the user has not set it; before torch is imported."""
    from grafu.processes.allocator import keep_freed_memory

    keep_freed_memory()
    os.environ.setdefault(ONEDNN_CACHE, "16384")  # code of matrix products, of which each size has its own


def export_weights(folder: Path, target: Path, data: str = "synth", split: str = "") -> int:
    """Writes the best weights of a run as ONNX, calibrated on the data that they were chosen by; returns 0.

    Raises:
        UnreadableAsset: if there are none, or `data` cannot be read.
        ExportError: if the file cannot be written.
    """
    from grafu.export.whole_file import whole_file
    from grafu.training.calibration import calibrated, temperatures
    from grafu.training.checkpoint import load_best
    from grafu.training.source import source_to_train_on
    from grafu.training.validation import validation_batches, validation_source

    best = load_best(folder)
    points = best.config.features.points
    source = validation_source(source_to_train_on(data, best.config.seed, points, split), points)
    by_head = temperatures(best.network(), validation_batches(source, best.config), best.config.loss)
    content = exported(calibrated(best.network(), by_head), best.config.features)
    with whole_file(target) as fresh:
        fresh.write_bytes(content)
    score = best.figures["score"]
    say("temperatures: " + ", ".join(f"{name} {value:.2f}" for name, value in by_head.items()))
    say(f"written to {target}: {len(content) / 1e6:.1f} MB, the weights of step {best.step} (score {score:.4f})")
    return EXIT_DONE


def _start(options: argparse.Namespace) -> Mapping[str, Any] | None:
    from grafu.network.official_weights import SUFFIX, start_weights
    from grafu.network.stored import stored_weights

    if options.start is None:
        return None
    if options.start.suffix.lower() == SUFFIX:
        return start_weights(options.start, _config(options).network)
    if not options.start.is_file():
        raise WeightsError(f"`--start` must be a file that `grafu train --export` wrote: there is no {options.start}")
    return stored_weights(options.start.read_bytes())


def _config(options: argparse.Namespace) -> "TrainingConfig":
    from grafu.training.config import CONFIGS

    asked: dict[str, Any] = {name: getattr(options, name) for name in ("steps", "seed")}
    return replace(CONFIGS[options.config], **{name: value for name, value in asked.items() if value is not None})


def _begun(
    options: argparse.Namespace, config: "TrainingConfig", source: "Source", workers: "Workers", first: "StepReport"
) -> str:
    graphs = config.sampling.models * config.sampling.copies * workers.count
    before = f"from step {first.step} on, " if first.step else ""
    return (
        f"training `{options.config}` on {source.name}: {before}{config.steps} steps of {graphs} graphs, {workers.name}"
    )


def _judged(report: "StepReport") -> str:
    figures = report.figures
    ratios = (
        f"{variant} " + " ".join(f"{name} {figures[f'{variant}/{name}']:.3f}" for name in _TOLD)
        for variant in ("natural", "masked")
    )
    best = ", the best" if figures["score"] >= report.best else ""
    return f"step {report.step}: score {figures['score']:.4f}{best}, loss {figures['loss']:.3f}; {'; '.join(ratios)}"


def _ended(last: "StepReport", config: "TrainingConfig", folder: Path, workers: "Workers") -> int:
    if last.step < config.steps:
        if workers.is_first:
            complain(f"stopped after step {last.step} of {config.steps}; the same command with --resume goes on")
        return EXIT_INTERRUPTED
    _say(workers, f"{last.step} steps done, best score {last.best:.4f}; weights in {folder}; --export FILE writes ONNX")
    return EXIT_DONE


def _say(workers: "Workers", line: str) -> None:
    if workers.is_first:
        say(line)
