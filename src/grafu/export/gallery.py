"""A gallery of templates as files: an animated GLB each, and one picture of them all. It writes nothing itself."""

from math import radians

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.export.camera import three_quarter_view
from grafu.export.files import ExportFiles
from grafu.export.glb import export_glb
from grafu.export.picture import (
    Picture,
    box_of,
    contact_sheet,
    encode_png,
    opened_values,
    posed_visuals,
    render,
)
from grafu.templates.sheet import Model, as_articulated, models_of, natural_template, shown_template
from grafu.templates.template import Gallery, HingeModel

SHEET_NAME = "templates.png"
_SHOWN_OPENING = 0.55  # share of the range: wide open, leaves hide one another again


def gallery_files(gallery: Gallery) -> ExportFiles:
    """Returns `<id>.glb` for each template at its natural size, opening and closing, and the sheet `templates.png`."""
    contents: dict[str, bytes] = {}
    for model in models_of(gallery):
        exported = export_glb(as_articulated(natural_template(model)))
        contents[f"{model.id}.glb"] = next(data for name, data in exported.contents.items() if name.endswith(".glb"))
    contents[SHEET_NAME] = encode_png(gallery_sheet(gallery))
    return ExportFiles(contents)


def gallery_sheet(gallery: Gallery, size: tuple[int, int] = (300, 260), columns: int = 3) -> Picture:
    """Returns one picture of all templates, closed beside opened, with title, id and class below each."""
    models = models_of(gallery)
    pictures = [_closed_and_opened(as_articulated(shown_template(m)), isinstance(m, HingeModel), size) for m in models]
    return contact_sheet(pictures, [_caption(model) for model in models], columns)


def _caption(model: Model) -> str:
    return f"{model.title}  ·  {model.id}  ·  {model.mechanism.value}"


def _closed_and_opened(shown: ArticulatedObject, is_hinge: bool, size: tuple[int, int]) -> Picture:
    azimuth = radians(-32 if is_hinge else 62)  # rails are seen from the drawer's side
    poses = [posed_visuals(shown), posed_visuals(shown, opened_values(shown, _SHOWN_OPENING if is_hinge else 1.0))]
    camera = three_quarter_view(box_of([v for pose in poses for v in pose]), size[0] / size[1], azimuth)
    return np.concatenate([render(pose, camera, size) for pose in poses], axis=1)
