"""The one table of the formats that are written: command, `--resume`, library, pages and Blender extension read it.

It imports nothing heavy: an exporter is imported when it is used. It writes no file: exporters return names and bytes.
"""

from collections.abc import Callable, Sequence
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, TypeAlias, final

from grafu.dataclass import dataclass
from grafu.errors import ExportError, did_you_mean
from grafu.geometry.budget import has_time
from grafu.processes.limits import give_back_unused

if TYPE_CHECKING:
    from grafu.articulation.articulated_object import ArticulatedObject
    from grafu.export.files import ExportFiles
    from grafu.graph.completion import GraphCompletion

Exporter: TypeAlias = "Callable[..., ExportFiles]"
"""Takes an articulated object and, of a format with `graph`, the completed graph that it was built from."""


@final
@dataclass(frozen=True, slots=True)
class Format:
    """A format that is written.

    `name` is what `--formats` takes, `title` what people call it, `about` what is in it and for whom. `files` are the
    names that it writes; a folder ends with `/`. `exporter` and `requirement` are `module:function`; `requirement`
    raises `ExportError` where what the format needs besides is not installed, and `extra` is the extra of the package
    that brings it (`pip install 'grafu[EXTRA]'`); both are empty where nothing more is needed. A format with `graph`
    holds the completed graph, which not every object has.
    """

    name: str
    title: str
    about: str
    files: tuple[str, ...]
    exporter: str
    extra: str = ""
    requirement: str = ""
    graph: bool = False


_ALL = (
    Format(
        "glb",
        "GLB",
        "Animated, with its materials: any glTF viewer",
        ("model.glb",),
        "grafu.export.glb:export_glb",
    ),
    Format(
        "glb-merged",
        "GLB, merged",
        "The same with one mesh per link and material: fewer draw calls on web pages",
        ("model_merged.glb",),
        "grafu.export.glb:export_merged_glb",
    ),
    Format(
        "glb-draco",
        "GLB, Draco",
        "The GLB with meshes compressed by Draco: smaller downloads",
        ("model_draco.glb",),
        "grafu.export.glb_draco:export_draco_glb",
        "formats",
        "grafu.export.gltf_packing:require_draco",
    ),
    Format(
        "glb-merged-draco",
        "GLB, merged, Draco",
        "The merged GLB with meshes compressed by Draco",
        ("model_merged_draco.glb",),
        "grafu.export.glb_draco:export_merged_draco_glb",
        "formats",
        "grafu.export.gltf_packing:require_draco",
    ),
    Format(
        "urdf",
        "URDF",
        "Joints, masses and collision shapes: any robot simulator",
        ("model.urdf", "meshes/"),
        "grafu.export.urdf:export_urdf",
    ),
    Format(
        "mjcf",
        "MJCF",
        "Joints, masses, contacts and keyframes: MuJoCo",
        ("model.xml", "meshes/"),
        "grafu.export.mjcf:export_mjcf",
    ),
    Format(
        "sdf",
        "SDF",
        "Joints, masses, springs and frames of grasps: Gazebo",
        ("model.sdf", "meshes/"),
        "grafu.export.sdf:export_sdf",
    ),
    Format(
        "usd",
        "USD",
        "OpenUSD with physics and materials: Isaac Sim, Omniverse",
        ("model.usdc", "textures/"),
        "grafu.export.usd.exporter:export_usd",
        "usd",
        "grafu.export.usd.exporter:require_pxr",
    ),
    Format(
        "usdz",
        "USDZ",
        "The USD scene in one file: viewers",
        ("model.usdz",),
        "grafu.export.usd.exporter:export_usdz",
        "usd",
        "grafu.export.usd.exporter:require_pxr",
    ),
    Format(
        "particulate",
        "Particulate",
        "Prediction files in the form of Particulate",
        ("eval/",),
        "grafu.export.particulate:export_particulate",
    ),
    Format(
        "singapo",
        "SINGAPO",
        "Object folder in the form of SINGAPO",
        ("object.json", "objs/"),
        "grafu.export.singapo:export_singapo",
    ),
    Format(
        "grafu-pred",
        "GraFu prediction",
        "The completed graph as the paper's authors write predictions: their Blender add-on",
        ("prediction/",),
        "grafu.export.prediction:export_prediction",
        graph=True,
    ),
    Format(
        "blend",
        "Blend",
        "A Blender file with every joint on one property",
        ("model.blend",),
        "grafu.export.blend.exporter:export_blend",
        "blender",
        "grafu.export.blend.exporter:find_interpreter",
    ),
)
FORMATS = MappingProxyType({one.name: one for one in _ALL})
DEFAULT_FORMATS = ("glb", "urdf")
"""The formats that are written by default."""


def known_formats() -> str:
    """Returns the names of all formats, for people: `glb, urdf, ...`."""
    return ", ".join(FORMATS)


def exporter_for(name: str) -> Exporter:
    """Returns the exporter of a format, with its default configuration.

    Raises:
        ExportError: if the format is not in the table, or what it needs is not installed.
    """
    if name.lower() not in FORMATS:
        raise ExportError(f"unknown format `{name}`: known formats are {known_formats()}{did_you_mean(name, FORMATS)}")
    found = FORMATS[name.lower()]
    if found.requirement:
        _found(found.requirement)()
    exporter: Exporter = _found(found.exporter)
    return exporter


def export(
    articulated: "ArticulatedObject", formats: Sequence[str], completion: "GraphCompletion | None" = None
) -> "ExportFiles":
    """Returns the files of all the formats named, together; their `formats` say which are whose.

    `completion` is the graph that the object was built from, for the formats that hold it.

    Where the budget in force holds no more, the first is written all the same, and the others are left out: the files'
    `notes` state which.

    Raises:
        ExportError: if a format is unknown, cannot say what the object holds, or holds a graph and there is none.
    """
    from grafu.export.files import ExportFiles

    exporters = [exporter_for(name) for name in formats]
    files = ExportFiles({})
    for place, (name, exporter) in enumerate(zip(formats, exporters, strict=True)):
        if place and not has_time():
            left_out = ", ".join(dict.fromkeys(name.lower() for name in formats[place:]))
            return files.joined(ExportFiles({}, notes=(f"left out for lack of time: {left_out}; allow more time",)))
        if not FORMATS[name.lower()].graph:
            made = exporter(articulated)
        elif completion is None:
            raise ExportError(f"`{name}` holds a completed graph: the object alone has none")
        else:
            made = exporter(articulated, completion)
        give_back_unused()
        files = files.joined(ExportFiles(made.contents, {name.lower(): made.names}, made.notes))
    return files


def _found(place: str) -> Callable[..., Any]:
    module, function = place.split(":")
    found: Callable[..., Any] = getattr(import_module(module), function)
    return found
