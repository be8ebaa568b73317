"""One table from format names to exporters, each imported when it is used."""

from collections.abc import Callable, Sequence
from importlib import import_module
from types import MappingProxyType

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.errors import ExportError
from grafu.export.files import ExportFiles

Exporter = Callable[[ArticulatedObject], ExportFiles]

FORMATS = MappingProxyType(
    {
        "glb": ("grafu.export.glb", "export_glb"),
        "urdf": ("grafu.export.urdf", "export_urdf"),
        "particulate": ("grafu.export.particulate", "export_particulate"),
        "singapo": ("grafu.export.singapo", "export_singapo"),
    }
)


def exporter_for(name: str) -> Exporter:
    """Returns the exporter of a format, with its default configuration.

    Raises:
        ExportError: if the format is not in the table.
    """
    if name.lower() not in FORMATS:
        raise ExportError(f"unknown format `{name}`: known formats are {', '.join(FORMATS)}")
    module, function = FORMATS[name.lower()]
    exporter: Exporter = getattr(import_module(module), function)
    return exporter


def export(articulated: ArticulatedObject, formats: Sequence[str]) -> ExportFiles:
    """Returns the files of all the formats named, together.

    Raises:
        ExportError: if a format is unknown or cannot say what the object holds.
    """
    exporters = [exporter_for(name) for name in formats]
    files = ExportFiles({})
    for exporter in exporters:
        files = files.joined(exporter(articulated))
    return files
