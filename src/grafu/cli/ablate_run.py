"""Runs `ablate`: plans the runs, counts their steps on a bar, says how each ended, and keeps the tables up to date."""

import argparse
import os
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path

from grafu.cli.messages import complain, say
from grafu.cli.progress import with_progress
from grafu.data.corruption.corrupt import VARIANTS
from grafu.export.whole_file import write_whole
from grafu.training.ablation import MEAN, Result, csv_table, experiments, markdown_table, training_models
from grafu.training.ablation_run import AblationRun, begin_ablation, do_runs, known_figures
from grafu.training.config import CONFIGS, TrainingConfig
from grafu.training.source import source_to_train_on
from grafu.training.workers import has_device

EXIT_DONE, EXIT_FAILED, EXIT_BAD_INPUT, EXIT_INTERRUPTED = 0, 1, 2, 130
_MOST_JOBS = 8
_TOLD = ("category", "hinge", "rail", "attached", "joint", "added")


def run_ablation(options: argparse.Namespace) -> int:
    """Trains what is not finished, and prints the table; returns the exit code, 130 where it was stopped before.

    Raises:
        FunctionalizationError: if the folder holds other runs, or models cannot be read.
    """
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
    table = _write_tables(options.out, title, runs, results)
    if len(results) + failed < len(runs):
        complain(f"stopped with {len(results)} of {len(runs)} runs finished; the same command goes on")
        return EXIT_INTERRUPTED
    for line in ("", *table.split("\n"), f"written to {options.out / 'table.md'} and table.csv"):
        say(line)
    return EXIT_FAILED if failed else EXIT_DONE


def _planned(options: argparse.Namespace, config: TrainingConfig) -> list[AblationRun]:
    """Returns all runs, seed by seed: each seed gives a whole table."""
    rows = experiments(options.kind, config)
    seeds = dict.fromkeys(options.seeds)
    points = config.features.points
    sources = {seed: training_models(options.kind, source_to_train_on(options.data, seed, points)) for seed in seeds}
    return [
        AblationRun(row, seed, sources[seed], options.out / row.name / f"seed_{seed}", options.device)
        for seed in seeds
        for row in rows
    ]


def _known(run: AblationRun) -> Result | None:
    figures = known_figures(run)
    return None if figures is None else Result(run.experiment, run.seed, figures)


def _train(options: argparse.Namespace, runs: Sequence[AblationRun], results: dict[Path, Result], title: str) -> int:
    """Does the runs that have no result, and adds theirs; returns how many failed."""
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
                result = results[run.folder] = Result(run.experiment, run.seed, event.figures)
                say(_told(result))
                _write_tables(options.out, title, runs, results)
    return failed


def _told(result: Result) -> str:
    figures = result.of(MEAN)
    told = " ".join(f"{name} {figures[name]:.3f}" for name in _TOLD)
    return f"{result.experiment.name}, seed {result.seed}: score {result.figures['score']:.4f}; {told}"


def _write_tables(folder: Path, title: str, runs: Sequence[AblationRun], results: Mapping[Path, Result]) -> str:
    """Writes both tables of what there is, in the order of the runs; returns the one to read."""
    known = [results[run.folder] for run in runs if run.folder in results]
    table = markdown_table(known)
    write_whole(f"{title}\n\n{table}", folder / "table.md")
    write_whole(csv_table(known), folder / "table.csv")
    return table


def _asked(options: argparse.Namespace, config: TrainingConfig) -> dict[str, str]:
    data = options.data if options.data == "synth" else str(Path(options.data).resolve())
    return {"kind": options.kind, "config": options.config, "steps": str(config.steps), "data": data}


def _title(options: argparse.Namespace, config: TrainingConfig, runs: Sequence[AblationRun]) -> str:
    seeds = list(dict.fromkeys(run.seed for run in runs))
    trained = runs[0].source.name + (" and so on" if len(seeds) > 1 else "")
    return (
        f"Ablation of {options.kind}: config `{options.config}`, {config.steps} steps of "
        f"{config.deal.models * config.deal.copies} graphs, {'seed' if len(seeds) == 1 else 'seeds'} "
        f"{', '.join(map(str, seeds))}, trained on {trained}; figures are means over what validation shows "
        f"({', '.join(VARIANTS)})."
    )
