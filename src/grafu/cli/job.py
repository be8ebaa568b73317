"""One input from file to files: read, functionalize, export, write. It prints nothing and may run in another process.

What goes wrong comes back as a value, so that one bad input never stops the others.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, final

from grafu.asset.options import LoadOptions
from grafu.cli.gallery import open_gallery
from grafu.cli.messages import internal_fault, one_line
from grafu.errors import ExportError, FunctionalizationError
from grafu.pipeline.motion_source import MotionChoice

if TYPE_CHECKING:
    from grafu.articulation.articulated_object import ArticulatedObject
    from grafu.export.files import ExportFiles
    from grafu.pipeline.addition_config import AdditionConfig
    from grafu.pipeline.functionalize import Functionalized
    from grafu.pipeline.report_schema import Report
    from grafu.pipeline.settings import Settings

MODEL_PAGE = "report.html"


@final
@dataclass(frozen=True)
class JobOptions:
    """What all inputs of one call share; `alone` says that there is one only.

    `templates` is a folder of the user's own, or None; `additions` says what may be added (None: all by default),
    unless `settings` say it.
    """

    out: Path
    motion: MotionChoice = field(default_factory=MotionChoice)
    load: LoadOptions = LoadOptions()
    formats: tuple[str, ...] = ("glb", "urdf")
    templates: Path | None = None
    trim: bool = True
    page: bool = True
    additions: "AdditionConfig | None" = None
    settings: "Settings | None" = None
    overwrite: bool = False
    resume: bool = False
    debug: bool = False
    alone: bool = True


@final
@dataclass(frozen=True)
class Job:
    """One input and the name of its results."""

    input: Path
    name: str
    options: JobOptions

    @property
    def folder(self) -> Path:
        """Where the results go."""
        return self.options.out / self.name


@final
@dataclass(frozen=True)
class Succeeded:
    """The report of a job that is done, and how long it took from reading to writing, in seconds.

    `picture` is a small picture of the result for the page of the run; empty where no page was asked for. `earlier`
    says that an earlier run made it.
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


def _tell_nobody(_: object) -> None:
    """Hears of a stage or an object and does nothing."""


@final
@dataclass(frozen=True)
class Listener:
    """Who is told each stage as it begins, and what was made, before it is written."""

    on_stage: Callable[[str], None] = _tell_nobody
    on_object: "Callable[[ArticulatedObject], None]" = _tell_nobody


NOBODY = Listener()


def run_job(job: Job, listener: Listener = NOBODY) -> JobResult:
    """Returns what came of a job; a failure is a value, but for an interruption."""
    try:
        if job.options.resume and (earlier := _earlier(job)):
            return earlier
        started = perf_counter()
        report, picture = _functionalize(job, listener)
        return Succeeded(job, report, perf_counter() - started, picture)
    except FunctionalizationError as error:
        return Failed(job, one_line(str(error)), users_fault=True)
    except MemoryError:
        return Failed(job, "out of memory: simplify the input or run fewer --jobs at once", users_fault=True)
    except Exception as error:  # isolation is this module's task: the next input must still run
        return Failed(job, internal_fault(error, f"`{job.input}`", job.options.debug), users_fault=False)


def _earlier(job: Job) -> Succeeded | None:
    """Returns the results of an earlier run with the same options, or None where there are none.

    Raises:
        ExportError: if what is there was made with other options.
    """
    from grafu.cli.earlier import earlier_report
    from grafu.viewer.pictures import thumbnail_of_page

    options = job.options
    report = earlier_report(job.folder, settings_of(options), options.formats)
    if report is None:
        return None
    page = job.folder / MODEL_PAGE
    picture = thumbnail_of_page(page.read_text("utf-8")) if options.page and page.is_file() else b""
    return Succeeded(job, report, sum(report.timings.values()), picture, earlier=True)


def _functionalize(job: Job, listener: Listener) -> "tuple[Report, bytes]":
    from grafu.asset.load import load_asset
    from grafu.export.files import write_files
    from grafu.export.formats import export
    from grafu.pipeline.addition_config import AdditionConfig
    from grafu.pipeline.foreign import prediction_for
    from grafu.pipeline.functionalize import PipelineConfig, functionalize
    from grafu.pipeline.report import report_of
    from grafu.realization.config import RealizationConfig
    from grafu.templates.user_handles import load_handles

    options = job.options
    _require_absent(job)
    clock = _Stopwatch()
    listener.on_stage("load")
    asset = load_asset(job.input, options.load)
    clock.lap("load")
    own_handles = load_handles(options.templates) if options.templates else {}
    config = PipelineConfig(
        realization=RealizationConfig(trim=options.trim),
        additions=options.additions or AdditionConfig(),
        own_handles=own_handles,
    )
    if options.settings:
        config = options.settings.pipeline(own_handles)
    motion = options.motion
    source = prediction_for(motion, job.name, options.alone) if motion.source.is_foreign else motion.source
    result = functionalize(asset, source, open_gallery(options.templates), config, listener.on_stage)
    clock.lap("functionalize")
    listener.on_stage("export")
    listener.on_object(result.object)
    files = export(result.object, options.formats)
    clock.lap("export")
    outside = {name: seconds for name, seconds in clock.seconds.items() if name != "functionalize"}
    report, picture = report_of(result, job.name, outside), b""
    if options.page:
        page, picture = _page(result, report)
        files = files.joined(page)
        clock.lap("page")
        timings = {**report.timings, "page": round(clock.seconds["page"], 4)}
        report = report.model_copy(update={"timings": timings})
    listener.on_stage("write")
    write_files(files.joined(_json_files(result, report, options)), job.folder, options.overwrite)
    return report, picture


def _page(result: "Functionalized", report: "Report") -> "tuple[ExportFiles, bytes]":
    """Returns the page of a model as a file, and a small picture of it for the page of the run."""
    from grafu.export.files import ExportFiles
    from grafu.viewer.model_page import model_page
    from grafu.viewer.pictures import take_stills, thumbnail

    stills = take_stills(result.asset, result.object)
    page = model_page(result.asset, result.object, result.completion, report, stills)
    return ExportFiles({MODEL_PAGE: page.encode()}), thumbnail(stills)


class _Stopwatch:
    """Seconds between laps, by name."""

    def __init__(self) -> None:
        self.seconds: dict[str, float] = {}
        self._last = perf_counter()

    def lap(self, name: str) -> None:
        now = perf_counter()
        self.seconds[name], self._last = now - self._last, now


def _require_absent(job: Job) -> None:
    """Refuses an output that cannot be written before any work is done; `write_files` refuses it again at the end."""
    if job.options.out.exists() and not job.options.out.is_dir():
        raise ExportError(f"--out must be a folder: `{job.options.out}` is a file")
    if not job.options.overwrite and job.folder.is_dir() and any(job.folder.iterdir()):
        raise ExportError(
            f"the output `{job.folder}` exists already: choose another --out, or give --overwrite or --resume"
        )


def _json_files(result: "Functionalized", report: "Report", options: JobOptions) -> "ExportFiles":
    from grafu.export.files import ExportFiles
    from grafu.graph.serialize import completion_to_json, dump_json

    texts = {
        "graph.json": dump_json(completion_to_json(result.completion)),
        "report.json": dump_json(report.to_json()),
    }
    settings = settings_of(options)
    if settings is not None:
        texts["settings.json"] = dump_json(settings.to_json())
    return ExportFiles({name: text.encode() for name, text in texts.items()})


def settings_of(options: JobOptions) -> "Settings | None":
    """Returns what was chosen, for `--settings`; None where motions are another system's: no setting names these."""
    from grafu.pipeline.addition_config import AdditionConfig
    from grafu.pipeline.settings import Reading, Settings

    if options.settings is not None or options.motion.source.is_foreign:
        return options.settings
    load = options.load
    reading = Reading(load.up, load.front, load.scale, load.height, load.labels, load.parts)
    additions = options.additions or AdditionConfig()
    return Settings(options.motion.source, reading, options.trim, additions=additions)
