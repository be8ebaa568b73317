"""The verb `ablate`: trains one network per experiment on a small budget, and puts their figures into one table."""

import argparse
import os
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.input_options import positive_count
from grafu.cli.synth import whole_number
from grafu.cli.train import CONFIGS, add_training_options, training_packages
from grafu.cli.verb import complain, say

if TYPE_CHECKING:
    from grafu.training.ablation import AblationResult
    from grafu.training.ablation_run import AblationRun
    from grafu.training.config import TrainingConfig

KINDS = ("losses", "folds", "departures")

_DESCRIPTION = """\
Trains one network for each experiment, all for the same number of steps, and writes their figures to DIR/table.md and
DIR/table.csv, anew after each that is finished. Stopped or killed, the same command goes on; what is finished is not
trained again, so that another seed may be asked for later.

losses: the paper's six hold-outs of loss terms; then the choices in which paper, authors' code and `base` differ
folds:  0, 5, 10, 17, 20 corrupted copies of each of 200 synthetic models, and new copies every time
departures: what `base` does otherwise than the paper, taken back one by one, and all at once

The default, config `small` for 2000 steps, takes about an hour on two cores for `losses`, and shows the
trend; for the last figure train longer: --config base --steps 20000.
"""
_EXAMPLES = """\
examples:
  grafu ablate losses --out runs/losses
  grafu ablate losses --seeds 1 2 3 --out runs/losses
  grafu ablate folds --config paper --data FurFun-233 --real models --out runs/folds
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "ablate",
        help="measure the effect of each loss and of corrupted copies",
        description=_DESCRIPTION,
        epilog=_EXAMPLES,
    )
    parser.add_argument("kind", choices=KINDS, metavar="{losses,folds,departures}", help="what is varied")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="the folder of all runs and tables")
    parser.add_argument("--config", choices=CONFIGS, default="small", help="what is varied from (default: small)")
    parser.add_argument("--steps", type=positive_count, metavar="N", help="steps of each run (default: the config's)")
    parser.add_argument(
        "--seeds",
        type=whole_number,
        nargs="+",
        default=[1],
        metavar="S",
        help="every experiment once with each: which weights and models (default: 1)",
    )
    add_training_options(parser)
    parser.add_argument(
        "--real",
        nargs="+",
        default=[],
        metavar="DATA",
        help="also count the motions of these annotated models that each network states right (as for grafu evaluate)",
    )
    parser.add_argument(
        "--jobs", type=positive_count, metavar="J", help="runs at once (default: as many as cores, up to 8)"
    )
    parser.add_argument(
        "--threads", type=positive_count, default=1, metavar="T", help="threads that each run computes on (default: 1)"
    )
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Trains what is not finished and prints the table; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong, or files cannot be read or written.
    """
    with training_packages():
        return run_ablation(options)


EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130
_MOST_JOBS = 8
_TOLD = ("category", "hinge", "rail", "attached", "joint", "added")


def run_ablation(options: argparse.Namespace) -> int:
    """Trains what is not finished, and prints the table; returns the exit code, 130 where it was stopped before.

    Raises:
        FunctionalizationError: if the folder holds other runs, or models cannot be read.
    """
    from grafu.training.ablation_run import begin_ablation
    from grafu.training.config import CONFIGS
    from grafu.training.workers import has_device

    if not has_device(options.device):
        complain(f"`--device` must be one that is there: torch finds no `{options.device}`")
        return EXIT_BAD_INPUT
    config = replace(CONFIGS[options.config], **({"steps": options.steps} if options.steps else {}))
    runs = _planned(options, config)
    begin_ablation(options.out, _asked(options, config))
    results = {run.folder: result for run in runs if (result := _known(run))}
    title = _title(options, config, runs)
    say(f"{title} {len(runs)} runs, {len(results)} of them finished before.")
    failed = _train(options, runs, results, title)
    if options.real:
        from grafu.cli.ablate_real import scored_on_real

        results = scored_on_real(options.real, runs, results)
    table = _write_tables(options.out, title, runs, results)
    if len(results) + failed < len(runs):
        complain(f"stopped with {len(results)} of {len(runs)} runs finished; the same command goes on")
        return EXIT_INTERRUPTED
    for line in ("", *table.split("\n"), f"written to {options.out / 'table.md'} and table.csv"):
        say(line)
    return EXIT_FAILED if failed else EXIT_DONE


def _planned(options: argparse.Namespace, config: "TrainingConfig") -> "list[AblationRun]":
    """Returns all runs, seed by seed: each seed gives a whole table."""
    from grafu.training.ablation import experiments, training_models
    from grafu.training.ablation_run import AblationRun
    from grafu.training.source import source_to_train_on

    rows = experiments(options.kind, config)
    seeds = dict.fromkeys(options.seeds)
    points = config.features.points
    sources = {
        seed: training_models(options.kind, source_to_train_on(options.data, seed, points, options.split))
        for seed in seeds
    }
    return [
        AblationRun(row, seed, sources[seed], options.out / row.name / f"seed_{seed}", options.device)
        for seed in seeds
        for row in rows
    ]


def _known(run: "AblationRun") -> "AblationResult | None":
    from grafu.training.ablation import AblationResult
    from grafu.training.ablation_run import known_figures

    figures = known_figures(run)
    return None if figures is None else AblationResult(run.experiment, run.seed, figures)


def _train(
    options: argparse.Namespace, runs: "Sequence[AblationRun]", results: "dict[Path, AblationResult]", title: str
) -> int:
    """Does the runs that have no result, and adds theirs; returns how many failed."""
    from grafu.cli.item_bar import with_progress
    from grafu.training.ablation import AblationResult
    from grafu.training.ablation_run import do_runs

    left = [run for run in runs if run.folder not in results]
    jobs = options.jobs or min(_MOST_JOBS, os.cpu_count() or 1)
    failed = 0
    with closing(do_runs(left, max(1, min(jobs, len(left))), options.threads)) as events:
        steps = sum(run.config.steps for run in left)
        for run, event in with_progress(events, steps, "steps", size=lambda one: one[1].steps):
            if event.failure:
                complain(f"{run.experiment.name}, seed {run.seed}: {event.failure}")
                failed += 1
            elif event.figures is not None:
                result = results[run.folder] = AblationResult(run.experiment, run.seed, event.figures)
                say(_told(result))
                _write_tables(options.out, title, runs, results)
    return failed


def _told(result: "AblationResult") -> str:
    from grafu.training.ablation import MEAN

    figures = result.of(MEAN)
    told = " ".join(f"{name} {figures[name]:.3f}" for name in _TOLD)
    return f"{result.experiment.name}, seed {result.seed}: score {result.figures['score']:.4f}; {told}"


def _write_tables(
    folder: Path, title: str, runs: "Sequence[AblationRun]", results: "Mapping[Path, AblationResult]"
) -> str:
    """Writes both tables of what there is, in the order of the runs; returns the one to read."""
    from grafu.export.whole_file import write_whole
    from grafu.training.ablation import csv_table, markdown_table

    known = [results[run.folder] for run in runs if run.folder in results]
    table = markdown_table(known)
    write_whole(f"{title}\n\n{table}", folder / "table.md")
    write_whole(csv_table(known), folder / "table.csv")
    return table


def _asked(options: argparse.Namespace, config: "TrainingConfig") -> dict[str, str]:
    data = options.data if options.data == "synth" else str(Path(options.data).resolve())
    return {"kind": options.kind, "config": options.config, "steps": str(config.steps), "data": data}


def _title(options: argparse.Namespace, config: "TrainingConfig", runs: "Sequence[AblationRun]") -> str:
    from grafu.data.corruption.corrupt import VARIANTS

    seeds = list(dict.fromkeys(run.seed for run in runs))
    trained = runs[0].source.name + (" and so on" if len(seeds) > 1 else "")
    return (
        f"Ablation of {options.kind}: config `{options.config}`, {config.steps} steps of "
        f"{config.sampling.models * config.sampling.copies} graphs, {'seed' if len(seeds) == 1 else 'seeds'} "
        f"{', '.join(map(str, seeds))}, trained on {trained}; figures are means over what validation shows "
        f"({', '.join(VARIANTS)})."
    )
