"""Templates as articulated objects, so that every exporter and every picture can show them. It writes nothing."""

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, JointLimits, Link, Visual, VisualRole
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.transform import rotation_about, translation
from grafu.templates.template import (
    Gallery,
    HingeModel,
    HingeSize,
    HingeTemplate,
    RailModel,
    RailSize,
    RailTemplate,
)
from grafu.vocabulary import JointType

Template = HingeTemplate | RailTemplate
Model = HingeModel | RailModel

_SHOWN_LENGTH = 0.12  # metres; long templates are shown shorter, or nothing but their length could be seen
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
        joint_type, axis = JointType.REVOLUTE, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0))
    else:
        joint_type, axis = JointType.PRISMATIC, Axis(vec3(0.0, 0.0, 0.0), vec3(0.0, -1.0, 0.0))
    prefix = "hinge" if joint_type is JointType.REVOLUTE else "rail"
    links = []
    for name, end in (("static", template.static), ("dynamic", template.dynamic)):
        surfaces = end.transformed(T).surfaces
        links.append(Link(name, (Visual(f"{prefix}_{template.id}_{name}", surfaces, VisualRole.HARDWARE),)))
    joint = Joint(f"{template.id}_joint", joint_type, "static", "dynamic", axis, JointLimits(0.0, template.range))
    return ArticulatedObject(template.id, "static", tuple(links), (joint,))


def models_of(gallery: Gallery) -> tuple[Model, ...]:
    """Returns all models of a gallery, hinges first."""
    return (*gallery.hinges, *gallery.rails)


def natural_template(model: Model) -> Template:
    """Returns the template at its natural size."""
    if isinstance(model, HingeModel):
        return model.build(model.natural)
    return model.build(model.natural)


def shown_template(model: Model) -> Template:
    """Returns the template for a picture: at its natural size, but long ones cut short so that details show."""
    if isinstance(model, HingeModel):
        n = model.natural
        return model.build(HingeSize(min(n.length, _SHOWN_LENGTH), n.leaf, n.thickness, n.radius))
    r = model.natural
    return model.build(RailSize(min(r.length, _SHOWN_RAIL), r.height, r.thickness))
