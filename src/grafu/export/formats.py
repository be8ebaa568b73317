"""One table from format names to exporters, each imported when it is used."""

from collections.abc import Callable, Sequence
from importlib import import_module
from types import MappingProxyType
from typing import Any

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.errors import ExportError
from grafu.export.files import ExportFiles

Exporter = Callable[[ArticulatedObject], ExportFiles]

FORMATS = MappingProxyType(
    {
        "glb": ("grafu.export.glb", "export_glb"),
        "urdf": ("grafu.export.urdf", "export_urdf"),
        "mjcf": ("grafu.export.mjcf", "export_mjcf"),
        "usd": ("grafu.export.usd.exporter", "export_usd"),
        "usdz": ("grafu.export.usd.exporter", "export_usdz"),
        "particulate": ("grafu.export.particulate", "export_particulate"),
        "singapo": ("grafu.export.singapo", "export_singapo"),
        "blend": ("grafu.export.blend.exporter", "export_blend"),
    }
)
_NEEDS = MappingProxyType(
    {
        "blend": ("grafu.export.blend.exporter", "find_interpreter"),
        "usd": ("grafu.export.usd.exporter", "require_pxr"),
        "usdz": ("grafu.export.usd.exporter", "require_pxr"),
    }
)
"""What finds, or else refuses, what an optional format cannot do without."""


def exporter_for(name: str) -> Exporter:
    """Returns the exporter of a format, with its default configuration.

    Raises:
        ExportError: if the format is not in the table, or what it needs is not installed.
    """
    if name.lower() not in FORMATS:
        raise ExportError(f"unknown format `{name}`: known formats are {', '.join(FORMATS)}")
    if name.lower() in _NEEDS:
        _found(*_NEEDS[name.lower()])()
    exporter: Exporter = _found(*FORMATS[name.lower()])
    return exporter


def export(articulated: ArticulatedObject, formats: Sequence[str]) -> ExportFiles:
    """Returns the files of all the formats named, together; their `formats` say which are whose.

    Raises:
        ExportError: if a format is unknown or cannot say what the object holds.
    """
    exporters = [exporter_for(name) for name in formats]
    files = ExportFiles({})
    for name, exporter in zip(formats, exporters, strict=True):
        made = exporter(articulated)
        files = files.joined(ExportFiles(made.contents, {name.lower(): made.names}))
    return files


def _found(module: str, function: str) -> Callable[..., Any]:
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found
