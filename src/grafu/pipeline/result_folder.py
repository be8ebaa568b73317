"""A folder that `grafu functionalize` wrote, read back: the object, its report, and what a change of it needs.

It changes nothing and runs nothing.
"""

import os
from pathlib import Path
from typing import final

from pydantic import ValidationError

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.json_files import read_own
from grafu.asset.options import LoadOptions
from grafu.dataclass import dataclass
from grafu.errors import UnreadableAsset
from grafu.export.glb_object import read_glb_object
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings, settings_from_bytes

REPORT, MODEL, SETTINGS, SOURCE = "report.json", "model.glb", "settings.json", "source.glb"
_NAMED = 4  # results of a folder that a refusal names


@final
@dataclass(frozen=True)
class ResultFolder:
    """What a folder of results holds.

    `source` is the input that was functionalized, None where it is gone; `settings` what was chosen for it. Where a
    change cannot be built from them `fixed` states why, in one line; it is empty otherwise.
    """

    object: ArticulatedObject
    report: Report
    settings: Settings
    source: Path | None
    fixed: str = ""


def read_result(folder: Path) -> ResultFolder:
    """Returns what a folder of results holds.

    `settings.json` states what was chosen; without it the settings are those that read the input as it was read. The
    input is `source.glb` in the folder, else the file that the report names: if its path is relative, from the working
    folder or from one above the results.

    Raises:
        UnreadableAsset: if it is no such folder, or its files are damaged or of different runs.
        OptionError: if its settings are wrong.
    """
    _require_result(folder)
    report = read_report(folder)
    made = read_glb_object(folder / MODEL)
    if {joint.id for joint in made.moving_joints} != {joint.id for joint in report.joints}:
        raise UnreadableAsset(f"{MODEL} and {REPORT} in {folder} are of different runs: their joints differ")
    source = _source_of(folder, report)
    return ResultFolder(made, report, _settings_of(folder, report), source, _why_fixed(report, source))


def read_choices(folder: Path) -> tuple[Report, Settings, Path]:
    """Returns the report, the settings and the input of a folder of results; the object itself is not read.

    Raises:
        UnreadableAsset: as `read_result`, and if a change cannot be built from them, with the reason.
        OptionError: if its settings are wrong.
    """
    _require_result(folder)
    report = read_report(folder)
    source = _source_of(folder, report)
    fixed = _why_fixed(report, source)
    if source is None or fixed:
        raise UnreadableAsset(f"{folder}: {fixed}")
    return report, _settings_of(folder, report), source


def read_report(folder: Path) -> Report:
    """Returns the report in a folder of results.

    Raises:
        UnreadableAsset: if it is missing, cannot be read, or is damaged.
        AssetTooLarge: if it is larger than any report.
    """
    data = read_own(folder / REPORT, "a report of grafu")
    try:
        return Report.read_json(data)
    except ValidationError as error:
        raise UnreadableAsset(f"{folder / REPORT} is no report of grafu: {_first_line(error)}") from None


def read_settings(folder: Path) -> Settings | None:
    """Returns the settings in a folder of results, None where it holds none.

    Raises:
        AssetError: if they cannot be read.
        OptionError: if they are damaged.
    """
    path = folder / SETTINGS
    return settings_from_bytes(read_own(path, "settings of grafu"), path) if os.path.lexists(path) else None


def _require_result(folder: Path) -> None:
    if not folder.is_dir():
        raise UnreadableAsset(f"a result is a folder that `grafu functionalize` wrote: {folder} is none")
    missing = [name for name in (REPORT, MODEL) if not (folder / name).is_file()]
    if not missing:
        return
    inside = sorted(report.parent.name for report in folder.glob(f"*/{REPORT}"))
    if REPORT in missing and inside:
        named = ", ".join(inside[:_NAMED]) + (", ..." if len(inside) > _NAMED else "")
        raise UnreadableAsset(f"{folder} holds {len(inside)} results: choose one of its folders ({named})")
    hint = "run again with --formats glb" if missing == [MODEL] else "choose one that `grafu functionalize` wrote"
    raise UnreadableAsset(f"{folder} is no folder of a result, for it has no {' and no '.join(missing)}: {hint}")


def _settings_of(folder: Path, report: Report) -> Settings:
    if stated := read_settings(folder):
        return stated
    frame, source = report.frame, report.motion.source
    reading = LoadOptions(up=frame.up, front=frame.front, scale=frame.scale)
    return Settings(reading=reading) if source.is_foreign else Settings(source, reading)


def _source_of(folder: Path, report: Report) -> Path | None:
    kept, named = folder / SOURCE, Path(report.input.path)
    above = [] if named.is_absolute() else [parent / named for parent in folder.resolve().parents]
    return next((path.resolve() for path in (kept, named, *above) if path.exists()), None)


def _why_fixed(report: Report, source: Path | None) -> str:
    if source is None:
        return f"it cannot be changed: its input is gone, neither {SOURCE} nor {report.input.path} is there"
    if report.motion.source.is_foreign:
        return f"it cannot be changed: its motions came from {report.motion.source}, whose file is not in the folder"
    return ""


def _first_line(error: ValidationError) -> str:
    return str(error).splitlines()[0]
