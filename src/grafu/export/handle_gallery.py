"""Handle templates as files: a GLB each, and one picture of them all. It writes nothing itself."""

from collections.abc import Sequence
from math import radians

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual, VisualRole
from grafu.export.camera import three_quarter_view
from grafu.export.files import ExportFiles
from grafu.export.glb import export_glb
from grafu.export.picture import Picture, box_of, contact_sheet, encode_png, posed_visuals, render
from grafu.geometry.appearance import Material
from grafu.templates.finish import STEEL, finished
from grafu.templates.handle import HandleTemplate
from grafu.vocabulary import PartLabel

HANDLE_SHEET_NAME = "handles.png"
_SHOWN_LENGTH = 0.2  # metres: longer ones are shown shorter, or nothing but their length could be seen


def handle_files(handles: Sequence[HandleTemplate], finish: Material = STEEL) -> ExportFiles:
    """Returns `handle_<id>.glb` for each handle at its natural size, and the sheet `handles.png`."""
    contents: dict[str, bytes] = {}
    for template in handles:
        exported = export_glb(_shown(template, template.natural.length, finish))
        contents[f"handle_{template.id}.glb"] = next(
            d for name, d in exported.contents.items() if name.endswith(".glb")
        )
    contents[HANDLE_SHEET_NAME] = encode_png(handle_sheet(handles, finish))
    return ExportFiles(contents)


def handle_sheet(
    handles: Sequence[HandleTemplate], finish: Material = STEEL, size: tuple[int, int] = (300, 220), columns: int = 6
) -> Picture:
    """Returns one picture of all handles, seen from the front, with title and id below each."""
    pictures = []
    for template in handles:
        visuals = posed_visuals(_shown(template, min(template.natural.length, _SHOWN_LENGTH), finish))
        camera = three_quarter_view(box_of(visuals), size[0] / size[1], radians(-35), radians(25))
        pictures.append(render(visuals, camera, size))
    return contact_sheet(pictures, [f"{t.title}  ·  {t.id}" for t in handles], columns)


def _shown(template: HandleTemplate, length: float, finish: Material) -> ArticulatedObject:
    surfaces = tuple(finished(mesh, finish) for mesh in template.build(length))
    visual = Visual(f"handle_{template.id}", surfaces, VisualRole.ADDED, PartLabel.HANDLE)
    return ArticulatedObject(template.id, "handle", (Link("handle", (visual,)),))
