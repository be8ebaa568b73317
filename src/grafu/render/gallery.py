"""A gallery of templates as files: hinges, rails and handles, a GLB each, and one picture of them all.

Templates become articulated objects first, so that every exporter and every picture can show them. It writes nothing
itself.
"""

from collections.abc import Sequence
from math import radians

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.articulation.motion_kind import motion_kind
from grafu.articulation.slip import Slip
from grafu.articulation.swing import Swing
from grafu.export.files import ExportFiles
from grafu.export.glb import export_glb
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import rotation_about, translation
from grafu.render.camera import three_quarter_view
from grafu.render.picture import (
    Picture,
    box_of,
    contact_sheet,
    encode_png,
    opened_values,
    posed_visuals,
    render,
)
from grafu.templates.concealed import ConcealedModel, axis_at
from grafu.templates.solids import STEEL, finished
from grafu.templates.template import (
    Gallery,
    HandleTemplate,
    HingeModel,
    HingeSize,
    HingeTemplate,
    RailModel,
    RailSize,
    RailTemplate,
)
from grafu.vocabulary import PartLabel

Template = HingeTemplate | RailTemplate
Model = HingeModel | RailModel | ConcealedModel

_SHOWN_HINGE = 0.12  # metres; long templates are shown shorter, or nothing but their length could be seen
_SHOWN_RAIL = 0.2


def as_articulated(template: Template) -> ArticulatedObject:
    """Returns a template as an object with a static link, a dynamic link and one joint, standing on z = 0.

    The joint is `<id>_joint`; its limits are the template's whole range. A hinge is turned so that its leaves face
    the front (-Y).
    """
    low = min(float(end.mesh.box.low[2]) for end in (template.static, template.dynamic))
    T = translation(vec3(0.0, 0.0, -low))
    if isinstance(template, HingeTemplate):
        T = T @ rotation_about(np.zeros(3), vec3(0.0, 0.0, 1.0), np.pi)
        axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    else:
        axis = Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))
    prefix = motion_kind(template.joint_type).hardware
    links = []
    for name, end in (("static", template.static), ("dynamic", template.dynamic)):
        surfaces = end.transformed(T).surfaces
        links.append(Link(name, (Visual(f"{prefix}_{template.id}_{name}", surfaces, VisualRole.HARDWARE),)))
    joint = Joint(
        f"{template.id}_joint", template.joint_type, "static", "dynamic", axis, JointLimits(0.0, template.range)
    )
    return ArticulatedObject(template.id, "static", tuple(links), (joint,))


def concealed_as_articulated(model: ConcealedModel) -> ArticulatedObject:
    """Returns a concealed hinge as such an object: its door's link turns about the axis that fits best, and slips."""
    hinge = model.natural
    point, _ = hinge.linkage.best_axis(hinge.angles)
    low = min(float(surface.mesh.box.low[2]) for surface in (*hinge.static, *hinge.dynamic))
    T = translation(vec3(0.0, 0.0, -low)) @ rotation_about(np.zeros(3), vec3(0.0, 0.0, 1.0), np.pi)
    axis, name = axis_at(point).transformed(T), f"hinge_{model.id}"
    slips = np.column_stack([hinge.slips(point), np.zeros(len(hinge.angles))]) @ T[:3, :3].T
    visuals = [
        Visual(f"{name}_{end}", tuple(s.transformed(T) for s in surfaces), VisualRole.HARDWARE)
        for end, surfaces in (("static", hinge.static), ("dynamic", hinge.dynamic))
    ]
    arms = tuple(
        Visual(
            f"{name}_{arm.name}",
            tuple(s.transformed(T) for s in arm.surfaces),
            VisualRole.HARDWARE,
            swing=Swing("dynamic", axis_at(arm.pivot).transformed(T), hinge.angles, arm.turns),
        )
        for arm in hinge.arms
    )
    links = (Link("static", (visuals[0], *arms)), Link("dynamic", (visuals[1],)))
    limits, slip = JointLimits(0.0, model.range), Slip(hinge.angles, slips)
    joint = Joint(f"{model.id}_joint", HingeTemplate.joint_type, "static", "dynamic", axis, limits, slip=slip)
    return ArticulatedObject(model.id, "static", links, (joint,))


def models_of(gallery: Gallery) -> tuple[Model, ...]:
    """Returns all models of a gallery, hinges first."""
    return (*gallery.hinges, *gallery.concealed, *gallery.rails)


def natural_object(model: Model) -> ArticulatedObject:
    """Returns the template at its natural size as an object that moves."""
    if isinstance(model, ConcealedModel):
        return concealed_as_articulated(model)
    return as_articulated(natural_template(model))


def natural_template(model: HingeModel | RailModel) -> Template:
    """Returns the template at its natural size."""
    if isinstance(model, HingeModel):
        return model.build(model.natural)
    return model.build(model.natural)


def shown_template(model: HingeModel | RailModel) -> Template:
    """Returns the template for a picture: at its natural size, but long ones cut short so that details show."""
    if isinstance(model, HingeModel):
        n = model.natural
        return model.build(HingeSize(min(n.length, _SHOWN_HINGE), n.leaf, n.thickness, n.radius))
    r = model.natural
    return model.build(RailSize(min(r.length, _SHOWN_RAIL), r.height, r.thickness))


HANDLE_SHEET_NAME = "handles.png"
_SHOWN_LENGTH = 0.2  # metres: longer ones are shown shorter, or nothing but their length could be seen


def handle_files(handles: Sequence[HandleTemplate], finish: Material = STEEL) -> ExportFiles:
    """Returns `handle_<id>.glb` for each handle at its natural size, and the sheet `handles.png`."""
    contents: dict[str, bytes] = {}
    for template in handles:
        exported = export_glb(handle_object(template, finish))
        contents[f"handle_{template.id}.glb"] = next(
            d for name, d in exported.contents.items() if name.endswith(".glb")
        )
    contents[HANDLE_SHEET_NAME] = encode_png(handle_sheet(handles, finish))
    return ExportFiles(contents)


def handle_sheet(
    handles: Sequence[HandleTemplate], finish: Material = STEEL, size: tuple[int, int] = (300, 220), columns: int = 6
) -> Picture:
    """Returns one picture of all handles, seen from the front, with title and id below each."""
    pictures = [handle_picture(template, finish, size) for template in handles]
    return contact_sheet(pictures, [f"{t.title}  ·  {t.id}" for t in handles], columns)


def handle_picture(template: HandleTemplate, finish: Material = STEEL, size: tuple[int, int] = (300, 220)) -> Picture:
    """Returns a picture of a handle, seen from the front; `size` is width and height in pixels."""
    visuals = posed_visuals(_shown(template, min(template.natural.length, _SHOWN_LENGTH), finish))
    camera = three_quarter_view(box_of(visuals), size[0] / size[1], radians(-35), radians(25))
    return render(visuals, camera, size)


def handle_object(template: HandleTemplate, finish: Material = STEEL) -> ArticulatedObject:
    """Returns a handle at its natural size as an object of one link."""
    return _shown(template, template.natural.length, finish)


def _shown(template: HandleTemplate, length: float, finish: Material) -> ArticulatedObject:
    surfaces = tuple(finished(mesh, finish) for mesh in template.build(length))
    visual = Visual(f"handle_{template.id}", surfaces, VisualRole.ADDED, PartLabel.HANDLE)
    return ArticulatedObject(template.id, "handle", (Link("handle", (visual,)),))


SHEET_NAME = "templates.png"
_SHOWN_OPENING = 0.55  # fraction of the range: wide open, leaves hide one another again


def gallery_files(gallery: Gallery) -> ExportFiles:
    """Returns `<id>.glb` for each template at its natural size, opening and closing, and the sheet `templates.png`."""
    contents: dict[str, bytes] = {}
    for model in models_of(gallery):
        exported = export_glb(natural_object(model))
        contents[f"{model.id}.glb"] = next(data for name, data in exported.contents.items() if name.endswith(".glb"))
    contents[SHEET_NAME] = encode_png(gallery_sheet(gallery))
    return ExportFiles(contents)


def gallery_sheet(gallery: Gallery, size: tuple[int, int] = (300, 260), columns: int = 3) -> Picture:
    """Returns one picture of all templates, closed beside opened, with title, id and class below each."""
    models = models_of(gallery)
    pictures = [_closed_and_opened(model, size) for model in models]
    return contact_sheet(pictures, [_caption(model) for model in models], columns)


def _caption(model: Model) -> str:
    return f"{model.title}  ·  {model.id}  ·  {_class_words(model)}"


def _class_words(model: Model) -> str:
    """Returns what people read as the class of a template."""
    return "concealed" if isinstance(model, ConcealedModel) else model.mechanism.in_words


def template_picture(model: Model, size: tuple[int, int] = (300, 260)) -> Picture:
    """Returns a picture of a hinge or rail, opened; `size` is width and height in pixels."""
    shown, azimuth, ratio = _as_shown(model)
    visuals = posed_visuals(shown, opened_values(shown, ratio))
    return render(visuals, three_quarter_view(box_of(visuals), size[0] / size[1], azimuth), size)


def _closed_and_opened(model: Model, size: tuple[int, int]) -> Picture:
    shown, azimuth, ratio = _as_shown(model)
    poses = [posed_visuals(shown), posed_visuals(shown, opened_values(shown, ratio))]
    camera = three_quarter_view(box_of([v for pose in poses for v in pose]), size[0] / size[1], azimuth)
    return np.concatenate([render(pose, camera, size) for pose in poses], axis=1)


def _as_shown(model: Model) -> tuple[ArticulatedObject, float, float]:
    """Returns a template, from where it is seen (azimuth, radians) and how far it is opened (0..1).

    Rails are seen from the drawer's side, concealed hinges from within.
    """
    if isinstance(model, ConcealedModel):
        return concealed_as_articulated(model), radians(-140), 0.8
    is_hinge = isinstance(model, HingeModel)
    azimuth, ratio = radians(-32 if is_hinge else 62), _SHOWN_OPENING if is_hinge else 1.0
    return as_articulated(shown_template(model)), azimuth, ratio
