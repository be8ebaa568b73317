"""Runs `synth` for a data set: makes models, counts them on a bar, and says what was made.

What `synth` prints about a data set when it is done: a row for each family, and the sum.
"""

import argparse
from collections import Counter, defaultdict
from collections.abc import Iterator
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from statistics import median
from time import perf_counter
from typing import final

from rich.markup import escape
from rich.table import Table

from grafu.cli.messages import complain
from grafu.cli.progress import with_progress
from grafu.cli.tables import plain_table, wide_console
from grafu.data.write import models_written, write_dataset
from grafu.data.write_plan import DatasetPlan, ModelSummary
from grafu.processes.signals import END_REQUESTS

_NAMED_FAULTS = 10  # faulty models that are named; the rest is counted


@final
class Tally:
    """Counts over the models of a run, family by family; it keeps no model."""

    def __init__(self) -> None:
        self.parts: defaultdict[str, Counter[int]] = defaultdict(Counter)  # how many models have so many parts
        self.movable: Counter[str] = Counter()
        self.defects: defaultdict[str, Counter[str]] = defaultdict(Counter)  # how many models have such a defect
        self.fresh = 0
        self.doubles = 0
        self.faulty: dict[str, tuple[str, ...]] = {}
        self._seen: set[bytes] = set()

    def add(self, summary: ModelSummary) -> None:
        """Counts a model."""
        self.parts[summary.family][summary.given] += 1
        self.movable[summary.family] += summary.movable
        self.defects[summary.family].update(set(summary.defects))
        self.fresh += summary.fresh
        self.doubles += summary.shape in self._seen
        self._seen.add(summary.shape)
        if summary.faults:
            self.faulty[summary.model_id] = summary.faults

    @property
    def models(self) -> int:
        """How many models were counted."""
        return sum(counts.total() for counts in self.parts.values())


def print_tally(tally: Tally, seconds: float, out: Path, before: int) -> None:
    """Prints the families and the sum on stdout; `before`: how many models earlier runs had made."""
    console = wide_console()
    if tally.models:
        console.print(_families(tally))
        console.print(_sum(tally), soft_wrap=True, markup=False, highlight=False)
    for line in (*_faults(tally), _made(tally, seconds, before), f"written to {out}"):
        console.print(line, soft_wrap=True, markup=False, highlight=False)


def _families(tally: Tally) -> Table:
    table = plain_table("family", "models", "parts", "movable", "defects")
    for family in sorted(tally.parts):
        counts = tally.parts[family]
        models = counts.total()
        movable = f"{tally.movable[family] / models:.1f}"
        table.add_row(escape(family), str(models), _range(counts), movable, _defects(tally.defects[family], models))
    return table


def _sum(tally: Tally) -> str:
    every = sum(tally.parts.values(), Counter[int]())
    parts = sum(number * models for number, models in every.items())
    defects = sum(tally.defects.values(), Counter[str]())
    doubles = f", {tally.doubles} of them doubles" if tally.doubles else ", no two alike"
    return (
        f"{tally.models} models{doubles}: {parts} parts ({_range(every)} in each), {tally.movable.total()} doors and "
        f"drawers; with defects: {_defects(defects, tally.models) or 'none'}"
    )


def _faults(tally: Tally) -> list[str]:
    named = list(tally.faulty.items())[:_NAMED_FAULTS]
    lines = [f"faulty: {model_id}: {'; '.join(faults)}" for model_id, faults in named]
    return [*lines, f"{len(tally.faulty)} models have faults beyond their defects"] if lines else []


def _made(tally: Tally, seconds: float, before: int) -> str:
    if not tally.fresh:
        return f"nothing to make: {before} models are there"
    kept = f"; {before} were there before" if before else ""
    return f"{tally.fresh} made in {seconds:.1f} s: {tally.fresh / seconds:.1f} models per second{kept}"


def _range(counts: Counter[int]) -> str:
    """Returns the least, the median and the largest number."""
    numbers = sorted(counts.elements())
    return f"{numbers[0]} · {median(numbers):.0f} · {numbers[-1]}"


def _defects(counts: Counter[str], models: int) -> str:
    return ", ".join(f"{kind} {number / models:.0%}" for kind, number in sorted(counts.items()))


EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130


def run_dataset(options: argparse.Namespace) -> int:
    """Makes the data set, or the rest of it, and prints a summary; returns the exit code, 1 where --check found faults.

    Raises:
        FunctionalizationError: if the folder cannot be gone on with, or not be written.
    """
    plan = DatasetPlan(options.seed, options.count, options.points, options.models_per_shard, options.format)
    tally, started = Tally(), perf_counter()
    try:
        for summary in with_progress(_summaries(plan, options), plan.count, "models"):
            tally.add(summary)
    except KeyboardInterrupt:
        complain(f"interrupted; {_kept(options)}")
        return EXIT_INTERRUPTED
    except BrokenProcessPool:
        if END_REQUESTS.are_made:  # the same request ended the workers
            complain(f"interrupted; {_kept(options)}")
            return EXIT_INTERRUPTED
        complain(f"a process died (out of memory, or a crash in a native library): try fewer --jobs; {_kept(options)}")
        return EXIT_FAILED
    seconds = perf_counter() - started
    print_tally(tally, seconds, options.out, before=models_written(options.out) - tally.fresh)
    return EXIT_FAILED if tally.faulty else EXIT_DONE


def _summaries(plan: DatasetPlan, options: argparse.Namespace) -> Iterator[ModelSummary]:
    return write_dataset(plan, options.out, options.jobs, options.overwrite, options.check)


def _kept(options: argparse.Namespace) -> str:
    """Says what there is and how to go on."""
    count = models_written(options.out)
    return f"{count} models stand in whole files in {options.out}; the same command without --overwrite goes on"
