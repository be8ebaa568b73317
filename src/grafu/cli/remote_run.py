"""`functionalize` for models or results at URLs, or on the machines of a cluster: jobs out, a line for each back."""

import argparse
import os
from collections.abc import Callable, Generator, Iterator, Sequence
from collections.abc import Set as AbstractSet
from contextlib import closing, contextmanager, suppress
from dataclasses import replace
from pathlib import Path

from grafu.cli.job import JobOptions
from grafu.cli.limit_options import why_stopped
from grafu.cli.outcome import Ended
from grafu.cli.pool import prepare_for_models, run_all
from grafu.cli.remote_job import RemoteJob, failed_job, run_remote_job
from grafu.cli.telling import clear_line, note, print_json
from grafu.cli.verb import complain
from grafu.cluster.storage import matches, names_in, require_writable
from grafu.cluster.urls import Place, Url
from grafu.errors import AssetError, FunctionalizationError, OptionError
from grafu.export.output_names import name_that_is_safe, output_name, same_place, telling_name, told_apart
from grafu.processes.limits import Ending


def run_remote(options: argparse.Namespace, shared: JobOptions) -> int:
    """Functionalizes every input and prints the summary; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong, or a storage or the cluster cannot be used.
    """
    from grafu.cli.summary import print_rows

    _require_possible(options, shared)
    sources = _sources(options.inputs)
    shared = replace(shared, alone=len(sources) == 1)
    if isinstance(options.out, Url):
        require_writable(options.out)
    jobs, ended = _jobs(sources, options.out, shared)
    for one in ended:
        _tell(one, options)
    with _executor(options) as execute:
        ended += _run_all(jobs, execute, options)
    order = {str(source): k for k, source in enumerate(sources)}
    ended.sort(key=lambda one: order[one.values["input"]])
    clear_line()
    if len(ended) > 1 or not ended[0].why:
        print_rows([one.row for one in ended])
    return _exit_code(ended)


def _require_possible(options: argparse.Namespace, shared: JobOptions) -> None:
    if options.check:
        raise OptionError(
            "`--check` is for results of this machine: leave it out, and run `grafu check` where they are"
        )
    if shared.settings.reading.pieces == "split":
        raise OptionError("`--pieces split` is for models on this machine: leave out `--cluster` and URLs")


def _sources(inputs: Sequence[Place]) -> tuple[Place, ...]:
    """Returns the models that the inputs name, each once."""
    found: dict[str, Place] = {}
    for given in inputs:
        for one in matches(given) if isinstance(given, Url) else (Path(os.path.abspath(given)),):
            found.setdefault(str(one), one)
    return tuple(found.values())


def _jobs(sources: Sequence[Place], out: Place, shared: JobOptions) -> tuple[list[RemoteJob], list[Ended]]:
    """Returns the jobs, and those inputs that are refused for the name or the place of their results.

    Raises:
        AssetError: if the results of two inputs would go to one place, or the output cannot be listed.
    """
    out = out if isinstance(out, Url) else Path(os.path.abspath(out))
    there = names_in(out, "write") if isinstance(out, Url) else _names_below(out)
    jobs: list[RemoteJob] = []
    refused: list[Ended] = []
    for source in sources:
        try:
            jobs.append(RemoteJob(source, _name(source), out, shared))
        except AssetError as error:
            refused.append(failed_job(RemoteJob(source, source.name, out, shared), str(error), users_fault=True))
    names = told_apart([_as_path(job.source) for job in jobs], [job.name for job in jobs])
    jobs = [replace(job, name=name, present=name in there) for job, name in zip(jobs, names, strict=True)]
    _require_places_apart(jobs)
    kept: list[RemoteJob] = []
    held = {place for source in sources for place in _places_of(source)}
    for job in jobs:
        if why := _why_not_apart(job, held):
            refused.append(failed_job(job, why, users_fault=True))
        else:
            kept.append(job)
    return kept, refused


def _names_below(out: Path) -> frozenset[str]:
    try:
        return frozenset(os.listdir(out))
    except OSError:
        return frozenset()


def _name(source: Place) -> str:
    if isinstance(source, Path):
        return output_name(source)
    path = source.as_path
    return name_that_is_safe((telling_name(path) if path.suffix else path.stem) or path.name, str(source))


def _as_path(source: Place) -> Path:
    return source if isinstance(source, Path) else source.as_path


def _require_places_apart(jobs: Sequence[RemoteJob]) -> None:
    seen: dict[str, RemoteJob] = {}
    for job in jobs:
        other = seen.setdefault(same_place(job.name), job)
        if other is not job:
            raise AssetError(
                f"inputs, or their folders, must have different names, for results go to DIR/<name>: got "
                f"{other.source} and {job.source}; run them into different --out"
            )


def _why_not_apart(job: RemoteJob, held: AbstractSet[str]) -> str:
    """Returns why results cannot go to their place, empty where it neither is nor holds an input."""
    if next(_places_of(job.place)) in held:
        return f"the results would go to `{job.place}`, and so replace an input or what holds one: choose another --out"
    return ""


def _places_of(place: Place) -> Iterator[str]:
    """Yields a place, with links followed, and all that is above it."""
    if isinstance(place, Path):
        real = Path(os.path.realpath(place))
        yield from map(str, (real, *real.parents))
        return
    yield str(place)
    while place != place.parent:
        place = place.parent
        yield str(place)


Execute = Callable[[list[RemoteJob], Callable[[RemoteJob], None]], Generator[Ended, None, None]]


@contextmanager
def _executor(options: argparse.Namespace) -> Iterator[Execute]:
    """Gives what runs jobs: processes of this machine, or those of a cluster."""
    workers = options.jobs or os.cpu_count() or 1
    if options.cluster is None:
        yield lambda jobs, on_begin: run_all(jobs, workers, run_remote_job, _stopped, jobs[0].options.limits, on_begin)
        return
    from grafu.cluster.ray_tasks import Work, cluster_at, run_on_cluster

    with cluster_at(options.cluster, workers) as ray:

        def execute(jobs: list[RemoteJob], on_begin: Callable[[RemoteJob], None]) -> Generator[Ended, None, None]:
            work = Work(run_remote_job, jobs[0].options.limits, prepare_for_models)
            with closing(run_on_cluster(ray, jobs, work, on_begin=on_begin, again=RemoteJob.tried_again)) as outcomes:
                for job, outcome in outcomes:
                    yield outcome.results[0] if outcome.ending is Ending.DONE else _stopped(job, outcome.ending)

        yield execute


def _stopped(job: RemoteJob, ending: Ending) -> Ended:
    at_fault = ending in (Ending.LATE, Ending.LARGE)
    return failed_job(job, why_stopped(ending, job.options.limits), users_fault=at_fault)


def _run_all(jobs: list[RemoteJob], execute: Execute, options: argparse.Namespace) -> list[Ended]:
    """Returns how each job ended; what is in work is shown meanwhile, and what was interrupted is taken away."""
    begun: dict[str, RemoteJob] = {}
    ended: list[Ended] = []
    if not jobs:
        return ended
    try:
        _collect(ended, begun, jobs, execute, options)
    except KeyboardInterrupt:
        complain(f"{len(ended)} of {len(jobs)} inputs were done; with --resume the same command goes on from there")
        raise
    finally:
        _clear(options.out, list(begun.values()))
    return ended


def _collect(
    ended: list[Ended],
    begun: dict[str, RemoteJob],
    jobs: list[RemoteJob],
    execute: Execute,
    options: argparse.Namespace,
) -> None:
    from grafu.cli.model_bar import model_bar

    with model_bar(len(jobs), "inputs", bool(options.quiet or options.json_lines)) as bar:

        def begins(job: RemoteJob) -> None:
            begun[job.name] = job
            bar.begins(job.name)

        with closing(execute(jobs, begins)) as results:
            for one in results:
                begun.pop(one.name, None)
                ended.append(one.in_short())
                for line in one.stages:
                    bar.say(line) if options.verbose else note(line)
                bar.ends(one.name, one.words)
                _tell(one, options)


def _tell(one: Ended, options: argparse.Namespace) -> None:
    if options.json_lines:
        print_json(one.values)


def _clear(out: Place, unfinished: Sequence[RemoteJob]) -> None:
    """Takes away what jobs that were interrupted left at their places."""
    from grafu.cluster.result_upload import remove_unfinished
    from grafu.export.whole_file import clear_remains

    if isinstance(out, Path):
        clear_remains(out)
        return
    for job in unfinished:
        if isinstance(job.place, Url):
            with suppress(FunctionalizationError):  # the next run treats it as unfinished
                remove_unfinished(job.place)


def _exit_code(ended: Sequence[Ended]) -> int:
    failed = [one for one in ended if one.why]
    for one in failed:
        complain(one.why if len(ended) == 1 else f"{one.values['input']}: {one.why}")
    if not failed:
        return 0
    return 2 if len(ended) == 1 and failed[0].users_fault else 1
