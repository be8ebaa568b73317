"""What earlier runs wrote: for a run that goes on from there, and for the page of all models. It changes nothing."""

from collections.abc import Collection, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, final

from grafu.asset.options import Limits
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError, OptionError
from grafu.export.files import require_free
from grafu.export.marker import Marker, read_marker
from grafu.export.whole_file import is_hidden_name
from grafu.pipeline.report_schema import Report
from grafu.pipeline.result_folder import REPORT, read_report, read_settings
from grafu.pipeline.settings import Settings

_INSTEAD = "choose another --out, or give --overwrite"


@final
@dataclass(frozen=True)
class Earlier:
    """The results of one input: their report, the settings that they were made with, and what is grafu's of them."""

    folder: Path
    report: Report
    settings: Settings | None
    marker: Marker


def earlier_results(folder: Path, settings: Settings | None) -> Earlier | None:
    """Returns what an earlier run with these settings wrote, or None where there is nothing.

    Raises:
        ExportError: if what is there is not grafu's, is not whole, or was made with other settings.
    """
    if not (folder / REPORT).is_file():
        return None
    marker = read_marker(folder)
    if marker is None:
        require_free(folder, overwrite=True)
        return None
    report = _report_in(folder)
    if report is None:
        raise ExportError(f"`{folder}` holds a report of another form: {_INSTEAD}")
    made_with = _settings_in(folder)
    if _for_any_model(made_with) != _for_any_model(settings):
        raise ExportError(f"`{folder}` was made with other options: {_INSTEAD}")
    return Earlier(folder, report, made_with, marker)


def finished_in(out: Path, but: Collection[str] = ()) -> Iterator[tuple[str, Report]]:
    """Yields the names and reports of all finished models in a folder of results, but for those named."""
    if not out.is_dir():
        return
    for folder in sorted(out.iterdir()):
        if (
            folder.name not in but
            and not is_hidden_name(folder.name)
            and _is_finished(folder)
            and (report := _report_in(folder))
        ):
            yield folder.name, report


def _is_finished(folder: Path) -> bool:
    try:
        marker = read_marker(folder)
    except ExportError:
        return False
    return marker is not None and REPORT in marker.files


def _report_in(folder: Path) -> Report | None:
    try:
        return read_report(folder)
    except AssetError:
        return None


def _settings_in(folder: Path) -> Settings | None:
    try:
        return read_settings(folder)
    except (AssetError, OptionError) as error:
        raise ExportError(f"{error}: {_INSTEAD}") from None


def _for_any_model(settings: Settings | None) -> dict[str, Any]:
    """Returns the settings without what is decided of single parts, and without limits: they change no result."""
    if settings is None:
        return {}
    additions = replace(settings.additions, fronts={}, compartments={}, rejected=frozenset())
    reading = replace(settings.reading, limits=Limits())
    return replace(settings, reading=reading, labels={}, motions={}, joints={}, additions=additions).to_json()
