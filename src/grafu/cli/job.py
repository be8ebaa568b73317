"""One input from file to files: read, functionalize, export, write. It prints nothing and may run in another process.

What goes wrong comes back as a value, so that one bad input never stops the others.
"""

from collections import defaultdict
from collections.abc import Callable, Sequence
from dataclasses import field, replace
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, TypeVar, final

from grafu.cli.limit_options import too_large
from grafu.cli.verb import internal_fault, one_line
from grafu.collecting import without_collecting
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError, FunctionalizationError
from grafu.export.formats import DEFAULT_FORMATS
from grafu.export.output_names import InputPlaces, output_name, same_place, told_apart, with_ending
from grafu.pipeline.motion_source import MotionSource, SourceOption
from grafu.processes.limits import ProcessLimits
from grafu.processes.worker import ignore

if TYPE_CHECKING:
    from grafu.articulation.articulated_object import ArticulatedObject
    from grafu.asset.foreign.motions import ForeignMotions
    from grafu.pipeline.pipeline_config import PipelineConfig
    from grafu.pipeline.report_schema import Report
    from grafu.pipeline.settings import Settings

T = TypeVar("T")
MODEL_PAGE = "report.html"
_MOST_PAGE = 256 * 2**20  # bytes of a page that a picture is taken from


def _default_settings() -> "Settings":
    from grafu.pipeline.settings import Settings

    return Settings()


@final
@dataclass(frozen=True)
class JobOptions:
    """What all inputs of one call share; `alone` states that there is one only.

    `templates` is a folder of the user's own, or None. `prediction` is the file of another system's motions, which no
    setting names; None: motions come from the source of the settings.
    """

    out: Path
    settings: "Settings" = field(default_factory=_default_settings)
    prediction: SourceOption | None = None
    formats: tuple[str, ...] = DEFAULT_FORMATS
    templates: Path | None = None
    page: bool = True
    overwrite: bool = False
    resume: bool = False
    debug: bool = False
    alone: bool = True
    limits: ProcessLimits = ProcessLimits()

    @property
    def saved_settings(self) -> "Settings | None":
        """What is saved beside a result; None where motions are another system's: settings would not give the same."""
        return None if self.prediction else self.settings


@final
@dataclass(frozen=True)
class Job:
    """One input and the name of its results; `stated` is what the report names as its path, if not the input itself."""

    input: Path
    name: str
    options: JobOptions
    stated: str = ""

    @property
    def folder(self) -> Path:
        """Where the results go."""
        return self.options.out / self.name


@final
@dataclass(frozen=True)
class Succeeded:
    """The report of a job that is done, and how long it took from reading to writing, in seconds.

    `picture` is a small picture of the result for the page of the run; empty where no page was asked for. `earlier`
    states that an earlier run made it.
    """

    job: Job
    report: "Report"
    seconds: float
    picture: bytes = b""
    earlier: bool = False


@final
@dataclass(frozen=True)
class Failed:
    """A job that wrote nothing: why, in one line, and whether the input (or else we) is at fault."""

    job: Job
    why: str
    users_fault: bool


JobResult = Succeeded | Failed


@final
@dataclass(frozen=True)
class Listener:
    """What is called with each stage as it begins, and with the result before it is written."""

    on_stage: Callable[[str], None] = ignore
    on_object: "Callable[[ArticulatedObject], None]" = ignore


SILENT = Listener()


def run_job(job: Job, listener: Listener = SILENT) -> JobResult:
    """Returns the outcome of a job; a failure is a value, except for an interruption."""
    return _isolated(job, partial(_run, listener=listener))


def jobs_of_pieces(job: Job) -> tuple[Job, ...] | Failed:
    """Returns a job for each piece of furniture of the input; the job itself where there is one only."""
    return _isolated(job, _for_each_piece)


def _for_each_piece(job: Job) -> tuple[Job, ...]:
    from grafu.asset.load import endings_in

    settings = job.options.settings
    endings = endings_in(job.input, settings.reading)
    if settings.reading.piece is not None or len(endings) == 1:
        return (replace(job, name=with_ending(job.name, endings[0])),)
    of_piece = (replace(settings, reading=replace(settings.reading, piece=k)) for k in range(1, len(endings) + 1))
    options = (replace(job.options, settings=one, alone=False) for one in of_piece)
    return tuple(
        Job(job.input, with_ending(job.name, ending), own) for ending, own in zip(endings, options, strict=True)
    )


def _run(job: Job, listener: Listener) -> JobResult:
    resumed = _resumed(job) if job.options.resume else job
    if isinstance(resumed, Succeeded):
        return resumed
    started = perf_counter()
    report, picture = _functionalize(resumed, listener)
    return Succeeded(resumed, report, perf_counter() - started, picture)


def _isolated(job: Job, do: Callable[[Job], T]) -> T | Failed:
    """Returns what is done for a job, or why it could not be done."""
    try:
        return do(job)
    except FunctionalizationError as error:
        return Failed(job, one_line(str(error)), users_fault=True)
    except MemoryError:
        return Failed(job, too_large(job.options.limits), users_fault=True)
    except Exception as error:  # isolation is this module's task: the next input must still run
        return Failed(job, internal_fault(error, f"`{job.input}`", job.options.debug), users_fault=False)


def _resumed(job: Job) -> Job | Succeeded:
    """Returns the results of an earlier run with the same options, or the job that makes what these lack, or the job.

    What is lacking is made anew with all that was there, as the model was decided then.

    Raises:
        ExportError: if what is there was made with other options.
    """
    from grafu.cli.earlier import earlier_results

    options = job.options
    earlier = earlier_results(job.folder, options.saved_settings)
    if earlier is None:
        return job
    has_page = (job.folder / MODEL_PAGE).is_file()
    if not earlier.marker.lacks(job.folder, options.formats) and (has_page or not options.page):
        picture = small_picture_in(job.folder) if options.page else b""
        return Succeeded(job, earlier.report, sum(earlier.report.timings.values()), picture, earlier=True)
    formats = tuple(dict.fromkeys((*earlier.marker.formats, *options.formats)))
    options = replace(options, formats=formats, page=options.page or has_page, overwrite=True, resume=False)
    if made_with := earlier.settings:
        reading = replace(made_with.reading, limits=options.settings.reading.limits)
        options = replace(options, settings=replace(made_with, reading=reading))
    return replace(job, options=options)


def small_picture_in(folder: Path) -> bytes:
    """Returns a small picture from the page of a model that an earlier run made; empty where there is none."""
    from grafu.asset.json_files import read_own
    from grafu.viewer.pictures import thumbnail_of_page

    try:
        return thumbnail_of_page(read_own(folder / MODEL_PAGE, "a page of grafu", _MOST_PAGE))
    except AssetError:  # no page, or a damaged one
        return b""


def _functionalize(job: Job, listener: Listener) -> "tuple[Report, bytes]":
    with without_collecting():
        from grafu.api.saving import files_of
        from grafu.asset.load import load_asset
        from grafu.export.files import write_files
        from grafu.geometry.budget import UNLIMITED, Budget
        from grafu.pipeline.functionalize import functionalize
        from grafu.templates.gallery import open_gallery

    _require_free(job)
    options, started = job.options, perf_counter()
    budget = Budget.lasting(options.limits.seconds) if options.limits.seconds else UNLIMITED
    listener.on_stage("load")
    asset = load_asset(job.input, options.settings.reading)
    asset = replace(asset, path=job.stated) if job.stated else asset
    timings = {"load": perf_counter() - started}
    config, source = _config(options), _motions(job)
    made = functionalize(asset, source, open_gallery(options.templates), config, listener.on_stage, budget=budget)
    listener.on_stage("export")
    listener.on_object(made.object)
    saved = files_of(made, job.name, options.formats, options.saved_settings, options.page, timings, budget)
    listener.on_stage("write")
    write_files(saved.files, job.folder, options.overwrite)
    return saved.report, saved.picture


def _motions(job: Job) -> "MotionSource | ForeignMotions":
    options, settings = job.options, job.options.settings
    if options.prediction is None:
        return settings.motion
    from grafu.pipeline.foreign import prediction_for

    return prediction_for(options.prediction, job.name, options.alone, settings.reading.limits)


def _config(options: JobOptions) -> "PipelineConfig":
    from grafu.pipeline.pipeline_config import PipelineConfig
    from grafu.templates.gallery import own_handles

    return PipelineConfig(options.settings, own_handles(options.templates))


def _require_free(job: Job) -> None:
    """Refuses an output that cannot be written before any work is done; `write_files` refuses it again at the end."""
    from grafu.export.files import require_free

    if job.options.out.exists() and not job.options.out.is_dir():
        raise ExportError(f"--out must be a folder: `{job.options.out}` is a file")
    try:
        require_free(job.folder, job.options.overwrite)
    except ExportError as error:
        raise ExportError(str(error).replace("give --overwrite", "give --overwrite or --resume")) from None


def jobs_of(inputs: Sequence[Path], shared: JobOptions) -> tuple[list[Job], list[Failed]]:
    """Returns the jobs, and those inputs that are refused for the name or the place of their results.

    Raises:
        AssetError: if the results of two inputs would go to one place.
    """
    refused, jobs = list[Failed](), list[Job]()
    for path in inputs:
        try:
            jobs.append(Job(path, output_name(path), shared))
        except AssetError as error:
            refused.append(Failed(Job(path, path.name, shared), one_line(str(error)), users_fault=True))
    names = told_apart([job.input for job in jobs], [job.name for job in jobs])
    kept, more = with_places_apart([replace(j, name=n) for j, n in zip(jobs, names, strict=True)], inputs)
    return kept, refused + more


def with_places_apart(jobs: Sequence[Job], inputs: Sequence[Path]) -> tuple[list[Job], list[Failed]]:
    """Returns the jobs, and those that are refused because their results would go to the place of an input.

    Raises:
        AssetError: if the results of two would go to one place.
    """
    named: dict[str, list[Job]] = defaultdict(list)
    for job in jobs:
        named[same_place(job.name)].append(job)
    for alike in named.values():
        if len(alike) > 1:
            raise AssetError(
                f"inputs, or their folders, must have different names, for results go to DIR/<name>: got "
                f"{alike[0].input} and {alike[1].input}; run them into different --out"
            )
    places = InputPlaces(inputs)
    judged = [(job, places.why_not_apart(job.folder)) for job in jobs]
    refused = [Failed(job, why, users_fault=True) for job, why in judged if why]
    return [job for job, why in judged if not why], refused
