"""What an earlier run wrote for an input, for one that goes on from there. It changes nothing."""

import json
from dataclasses import replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

from pydantic import ValidationError

from grafu.errors import ExportError
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings, settings_from_json

_FILE_OF: Final = MappingProxyType(
    {"glb": "model.glb", "urdf": "model.urdf", "mjcf": "model.xml", "usd": "model.usdc", "usdz": "model.usdz"}
    | {"blend": "model.blend"}
)
_INSTEAD = "choose another --out, or give --overwrite"


def earlier_report(folder: Path, settings: Settings | None, formats: tuple[str, ...]) -> Report | None:
    """Returns the report of an earlier run with these settings and formats, or None where there is none.

    Raises:
        ExportError: if what is there is not whole, or was made with other settings.
    """
    if not (folder / "report.json").is_file():
        return None
    try:
        report = Report.model_validate_json((folder / "report.json").read_bytes())
    except ValidationError:
        raise ExportError(f"`{folder}` holds a report of another form: {_INSTEAD}") from None
    if _for_any_model(_settings_in(folder)) != _for_any_model(settings):
        raise ExportError(f"`{folder}` was made with other options: {_INSTEAD}")
    absent = [name for name in formats if name in _FILE_OF and not (folder / _FILE_OF[name]).exists()]
    if absent:
        raise ExportError(f"`{folder}` was made without {', '.join(absent)}: {_INSTEAD}")
    return report


def _settings_in(folder: Path) -> Settings | None:
    path = folder / "settings.json"
    return settings_from_json(json.loads(path.read_bytes())) if path.is_file() else None


def _for_any_model(settings: Settings | None) -> dict[str, Any]:
    """Returns the settings without what is decided of single parts: one model that was mended is done, too."""
    if settings is None:
        return {}
    additions = replace(settings.additions, fronts={}, compartments={}, rejected=frozenset())
    return replace(settings, labels={}, motions={}, joints={}, additions=additions).to_json()
