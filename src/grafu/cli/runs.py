"""The jobs of `functionalize`, one or several at a time: each is shown while it is in work, and stated as it ends."""

import argparse
import os
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path

from grafu.cli.job import Failed, Job, JobResult, Listener, jobs_of_pieces, run_job, with_places_apart
from grafu.cli.telling import note, print_json
from grafu.cli.verb import complain


def tell(options: argparse.Namespace, *ended: JobResult) -> None:
    """Prints the line of JSON of each input that ended, where that is wanted."""
    from grafu.cli.outcome import outcome_values

    for result in ended if options.json_lines else ():
        print_json(outcome_values(result))


def _is_silent(options: argparse.Namespace) -> bool:
    """Whether no bar is shown: it is not wanted, or would stand between the lines of JSON."""
    return bool(options.quiet or options.json_lines)


def run_alone(job: Job, options: argparse.Namespace) -> JobResult:
    """Returns the outcome of the only job; its stages are shown meanwhile."""
    from grafu.cli.outcome import outcome_words
    from grafu.cli.stage_bar import with_stages

    with with_stages(job.name, options.verbose, _is_silent(options)) as on_stage:
        result = run_job(job, Listener(on_stage))
    note(outcome_words(result))
    tell(options, result)
    return result


def pieces_apart(
    jobs: Sequence[Job], inputs: Sequence[Path], options: argparse.Namespace
) -> tuple[list[Job], list[Failed]]:
    """Returns a job for each piece of furniture of all inputs, and the inputs that could not be read."""
    from grafu.cli.model_bar import model_bar
    from grafu.cli.pool import run_all, stopped

    if not jobs:
        return [], []
    limits, workers = jobs[0].options.limits, options.jobs or os.cpu_count() or 1
    names = {job.input: job.name for job in jobs}
    failed: list[Failed] = []
    pieces: list[Job] = []
    with (
        model_bar(len(jobs), "reading", _is_silent(options)) as bar,
        closing(run_all(jobs, workers, jobs_of_pieces, stopped, limits, lambda job: bar.begins(job.name))) as ended,
    ):
        for found in ended:
            if isinstance(found, Failed):
                failed.append(found)
            else:
                pieces.extend(found)
            bar.ends(names[found.job.input if isinstance(found, Failed) else found[0].input])
    places = {path: k for k, path in enumerate(inputs)}
    pieces.sort(key=lambda job: (places[job.input], job.options.settings.reading.piece or 0))
    apart, refused = with_places_apart(pieces, inputs)
    tell(options, *failed, *refused)
    return apart, failed + refused


def run_several(jobs: list[Job], options: argparse.Namespace) -> list[JobResult]:
    """Returns the outcome of each job, as they end; what is in work is shown meanwhile.

    Raises:
        KeyboardInterrupt: if it is interrupted; what was done stays.
    """
    from grafu.export.whole_file import clear_remains

    workers = options.jobs or os.cpu_count() or 1
    results: list[JobResult] = []
    if not jobs:
        return results
    try:
        _collect(results, jobs, workers, options)
    except KeyboardInterrupt:
        complain(f"{len(results)} of {len(jobs)} inputs were done; with --resume the same command goes on from there")
        raise
    finally:
        clear_remains(options.out)  # of workers that were stopped
    return results


def _collect(results: list[JobResult], jobs: list[Job], workers: int, options: argparse.Namespace) -> None:
    from grafu.cli.model_bar import model_bar
    from grafu.cli.outcome import outcome_words, stages_of
    from grafu.cli.pool import run_jobs

    with (
        model_bar(len(jobs), "inputs", _is_silent(options)) as bar,
        closing(run_jobs(jobs, workers, on_begin=lambda job: bar.begins(job.name))) as ended,
    ):
        for result in ended:
            results.append(result)
            for line in stages_of(result):
                bar.say(line) if options.verbose else note(line)
            bar.ends(result.job.name, outcome_words(result))
            tell(options, result)
