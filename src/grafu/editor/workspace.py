"""A model that is edited, and its folder of results: opened, and its settings saved at every step, whole."""

import os
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import final

from grafu.asset.load import detect
from grafu.asset.options import LoadOptions
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError, OptionError, UnreadableAsset
from grafu.export.files import ExportFiles, require_free, write_files
from grafu.export.output_names import output_name, same_place, why_not_apart
from grafu.export.whole_file import clear_remains, write_whole
from grafu.graph.serialize import dump_json
from grafu.pipeline.report_schema import Report
from grafu.pipeline.result_folder import REPORT, SETTINGS, read_choices, read_report, read_settings
from grafu.pipeline.settings import Settings


@final
@dataclass(frozen=True)
class Workspace:
    """One model that is edited.

    `source` is the input, `folder` that of its results, where the settings are saved. `settings` are those that it was
    opened with, `report` is that of the results in the folder (None: there are none yet).
    """

    name: str
    source: Path
    folder: Path
    settings: Settings
    report: Report | None = None

    @property
    def untouched(self) -> Settings:
        """The settings that only state how the input is read and where motions come from."""
        return Settings(self.settings.motion, self.settings.reading, weights=self.settings.weights)

    def save(self, settings: Settings) -> None:
        """Writes the settings into the folder of results, whole; a folder that is not there yet is made.

        Raises:
            ExportError: if they cannot be written, or the folder holds what grafu did not write.
        """
        text = dump_json(settings.to_json())
        require_free(self.folder, overwrite=True)
        if self.folder.is_dir():
            write_whole(text, self.folder / SETTINGS)
        else:
            write_files(ExportFiles({SETTINGS: text.encode()}), self.folder)


def _say_nothing(_: str) -> None:
    """Hears of a result that is left out and does nothing."""


def open_all(
    paths: Sequence[Path],
    out: Path,
    reading: LoadOptions = LoadOptions(),
    on_left_out: Callable[[str], None] = _say_nothing,
) -> tuple[Workspace, ...]:
    """Returns what is edited, each of its own name and folder: results, folders of results, and models.

    `out` is where the results of models go, `out/<name>/`; what an earlier session decided there is taken up again.
    `reading` is how models are read that have no settings yet. Of a folder of results those that cannot be edited are
    left out; `on_left_out` is called with the reason for each.

    Raises:
        AssetError: if an input is not there, is neither a result nor a kind of model that is read, or two would be
            edited in one folder.
        ExportError: if a folder cannot hold results.
        OptionError: if saved settings are damaged.
    """
    found = [one for path in paths for one in _opened(path, out, reading, on_left_out)]
    places: dict[str, Workspace] = {}
    for one in found:
        place = same_place(os.path.realpath(one.folder))
        if place in places:
            raise UnreadableAsset(
                f"two models would be edited in {one.folder}: {places[place].source} and {one.source}; open them apart"
            )
        places[place] = one
    return tuple(found)


def _opened(path: Path, out: Path, reading: LoadOptions, on_left_out: Callable[[str], None]) -> list[Workspace]:
    if not os.path.lexists(path):
        raise UnreadableAsset(f"there is no {path}: give a model or a folder of results")
    if (path / REPORT).is_file():
        return [_result(path)]
    inside = sorted(report.parent for report in path.glob(f"*/{REPORT}")) if path.is_dir() else []
    return _those_that_can_be(inside, on_left_out) if inside else [_model(path, out, reading)]


def _those_that_can_be(folders: Sequence[Path], on_left_out: Callable[[str], None]) -> list[Workspace]:
    found, why = [], ""
    for folder in folders:
        try:
            found.append(_result(folder))
        except (AssetError, OptionError) as error:
            why = str(error)
            on_left_out(why)
    if not found:
        raise UnreadableAsset(f"none of {len(folders)} results can be edited: {why}")
    return found


def _result(folder: Path) -> Workspace:
    report, settings, source = read_choices(folder)
    return Workspace(folder.resolve().name, source, folder, settings, report)


def _model(path: Path, out: Path, reading: LoadOptions) -> Workspace:
    detect(path)  # what is no model is refused before a browser opens
    name = output_name(path)
    folder = out / name
    if why := why_not_apart(folder, [path]):
        raise ExportError(why)
    require_free(folder, overwrite=True)
    clear_remains(out)
    saved = read_settings(folder) if folder.is_dir() else None
    settings = Settings(reading=reading) if saved is None else _with_limits(saved, reading)
    report = read_report(folder) if (folder / REPORT).is_file() else None
    return Workspace(name, path.resolve(), folder, settings, report)


def _with_limits(settings: Settings, reading: LoadOptions) -> Settings:
    return replace(settings, reading=replace(settings.reading, limits=reading.limits))
