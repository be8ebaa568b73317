"""Runs `synth` for a data set: makes models, counts them on a bar, and says what was made. It writes no file itself."""

import argparse
from collections.abc import Iterator
from concurrent.futures.process import BrokenProcessPool
from time import perf_counter

from grafu.cli.messages import complain
from grafu.cli.progress import with_progress
from grafu.cli.synth_summary import Tally, print_tally
from grafu.data.write import models_written, write_dataset
from grafu.data.write_plan import DatasetPlan, ModelSummary
from grafu.processes.signals import END_REQUESTS

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
