"""Which files a result is saved as: models, graph, report, settings and page. It writes nothing."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial
from time import perf_counter
from typing import Final, final

from grafu.articulation.physics import physics_of
from grafu.dataclass import dataclass
from grafu.export.files import ExportFiles
from grafu.export.formats import FORMATS, export
from grafu.geometry.budget import UNLIMITED, Budget, within
from grafu.graph.serialize import completion_to_json, dump_json
from grafu.pipeline.caught import with_caught
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.report import report_of
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings
from grafu.pipeline.standing import with_stability
from grafu.pipeline.verdict import with_notes
from grafu.visible import writable

MODEL_PAGE: Final = "report.html"
_PAGE: Final = 0.8  # of the time that is left after the formats


@final
@dataclass(frozen=True)
class Saved:
    """The files of one result, its report, and a small picture of it (PNG; empty without a page)."""

    files: ExportFiles
    report: Report
    picture: bytes = b""


def files_of(
    made: Functionalized,
    name: str,
    formats: Sequence[str],
    settings: Settings | None,
    page: bool = True,
    timings: Mapping[str, float] | None = None,
    budget: Budget = UNLIMITED,
) -> Saved:
    """Returns everything that is written for one result; what `budget` does not hold is left out, and noted.

    Args:
        made: what the pipeline made.
        name: the name of the results, which files, the report and the page carry.
        formats: names of export formats; see `grafu.export.formats`.
        settings: what was chosen, for `settings.json`; None: no such file, as for another system's motions.
        page: whether `report.html` is drawn.
        timings: seconds of stages before the pipeline, such as reading.
        budget: what is left for files: the first format, the graph and the report are made however long they take.

    Raises:
        ExportError: if a format is unknown, or cannot say what the object holds.
    """
    started = perf_counter()
    made = replace(made, object=replace(made.object, name=name))
    with budget.in_force():
        files = export(made.object, formats, made.completion)
    seconds = {**(timings or {}), "export": perf_counter() - started}
    report, picture = _with_physics(made, report_of(made, name, seconds), files.names, files.notes), b""
    if page:
        started = perf_counter()
        with budget.in_force():
            report, drawn, picture = within(
                _PAGE,
                partial(_page, made, report, settings, formats),
                partial(_page_of_words, made, report, settings, formats),
            )
        files = files.joined(drawn)
        report = report.with_changes(timings={**report.timings, "page": round(perf_counter() - started, 4)})
    return Saved(files.joined(_json_files(made, report, settings)), report, picture)


def report_before_saving(made: Functionalized, name: str, formats: Sequence[str]) -> Report:
    """Returns the report as it will be once these formats are written, but for what only writing them shows."""
    files = {file for one in formats for file in FORMATS[one].files}
    return _with_physics(made, report_of(made, name), files, physics_of(made.object).notes)


def _with_physics(made: Functionalized, report: Report, files: Collection[str], notes: Sequence[str]) -> Report:
    """Returns a report with what masses and shapes show, which files have the catches, and more notes."""
    return with_notes(with_caught(with_stability(report, made.object), made.object, files), *notes)


def _page(
    made: Functionalized, report: Report, settings: Settings | None, formats: Sequence[str]
) -> tuple[Report, ExportFiles, bytes]:
    """Returns the report, its page as a file, and a small picture of the model."""
    from grafu.viewer.model_page import model_page
    from grafu.viewer.pictures import take_stills, thumbnail

    stills = take_stills(made.asset, made.object)
    page = model_page(made.asset, made.object, made.completion, report, stills, settings, formats)
    return report, ExportFiles({MODEL_PAGE: writable(page).encode()}), thumbnail(stills)


def _page_of_words(
    made: Functionalized, report: Report, settings: Settings | None, formats: Sequence[str], why: str
) -> tuple[Report, ExportFiles, bytes]:
    """Returns the report, which states what its page lacks, the page without pictures of the model, and no picture."""
    from grafu.viewer.model_page import model_page

    noted = with_notes(report, f"{MODEL_PAGE} has no 3D view and no pictures: {why}")
    page = model_page(made.asset, made.object, made.completion, noted, None, settings, formats)
    return noted, ExportFiles({MODEL_PAGE: writable(page).encode()}), b""


def _json_files(made: Functionalized, report: Report, settings: Settings | None) -> ExportFiles:
    texts = {
        "graph.json": dump_json(completion_to_json(made.completion)),
        "report.json": dump_json(report.to_json()),
    }
    if settings is not None:
        texts["settings.json"] = dump_json(settings.to_json())
    return ExportFiles({name: text.encode() for name, text in texts.items()})
