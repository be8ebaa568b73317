"""What an earlier run wrote for an input, for one that goes on from there. It changes nothing."""

from pathlib import Path
from types import MappingProxyType
from typing import Final

from pydantic import ValidationError

from grafu.errors import ExportError
from grafu.graph.serialize import dump_json
from grafu.pipeline.report_schema import Report
from grafu.pipeline.settings import Settings

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
        raise ExportError(
            f"`{folder / 'report.json'}` is of another form: choose another --out, or --overwrite"
        ) from None
    if _settings_in(folder) != (dump_json(settings.to_json()) if settings else ""):
        raise ExportError(f"`{folder}` was made with other options: {_INSTEAD}")
    absent = [name for name in formats if name in _FILE_OF and not (folder / _FILE_OF[name]).exists()]
    if absent:
        raise ExportError(f"`{folder}` was made without {', '.join(absent)}: {_INSTEAD}")
    return report


def _settings_in(folder: Path) -> str:
    path = folder / "settings.json"
    return path.read_text("utf-8") if path.is_file() else ""
