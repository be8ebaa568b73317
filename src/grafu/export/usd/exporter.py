"""`model.usdc` with its textures, and `model.usdz`, one file with all in it. It imports `pxr` only when it writes."""

from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import Final
from zipfile import ZIP_STORED, ZipFile, ZipInfo

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.physics import physics_of
from grafu.errors import ExportError
from grafu.export.files import ExportFiles
from grafu.export.usd.config import UsdConfig
from grafu.processes.lifetime import scratch_folder

DEFAULT_USD_CONFIG: Final = UsdConfig()
_ALIGNMENT = 64  # bytes: where the data of every file in a USDZ begins
_HEADER = 30  # bytes of a zip entry before its name
_PADDING = b"\x86\x19\0\0"  # the kind of an extra field that OpenUSD pads with, and its length


def export_usd(articulated: ArticulatedObject, config: UsdConfig = DEFAULT_USD_CONFIG) -> ExportFiles:
    """Returns `model.usdc`, binary, and the images that it names under `textures/`.

    Raises:
        ExportError: if `usd-core` is not installed.
    """
    require_pxr()
    from grafu.export.usd.stage import build_stage

    stage, images = build_stage(articulated, config)
    with scratch_folder() as folder:
        path = Path(folder) / "model.usdc"
        if not stage.GetRootLayer().Export(str(path)):
            raise ExportError("OpenUSD could not write model.usdc")
        notes = physics_of(articulated, config.physics).notes
        return ExportFiles({"model.usdc": path.read_bytes(), **images}, notes=notes)


def export_usdz(articulated: ArticulatedObject, config: UsdConfig = DEFAULT_USD_CONFIG) -> ExportFiles:
    """Returns `model.usdz`: the same scene and its images, packed without compression as the format demands.

    Raises:
        ExportError: if `usd-core` is not installed.
    """
    files = export_usd(articulated, config)
    return ExportFiles({"model.usdz": _packed(files)}, notes=files.notes)


def _packed(files: ExportFiles) -> bytes:
    """Returns the files as a USDZ archive, the scene first; no times, so that one scene is always the same bytes."""
    stream = BytesIO()
    with ZipFile(stream, "w", ZIP_STORED) as archive:
        for name, data in files.contents.items():
            entry = ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            start = stream.tell() + _HEADER + len(name.encode()) + len(_PADDING)
            pad = -start % _ALIGNMENT
            entry.extra = _PADDING[:2] + pad.to_bytes(2, "little") + b"\0" * pad
            archive.writestr(entry, data)
    return stream.getvalue()


def require_pxr() -> None:
    """Refuses where OpenUSD is missing.

    Raises:
        ExportError: if it is.
    """
    if find_spec("pxr") is None:
        raise ExportError("the formats `usd` and `usdz` need OpenUSD's Python package: pip install 'grafu[usd]'")
