"""What somebody decides about one joint instead of the search: class, template, size, number, side, opening, mount.

A choice narrows the search; what it leaves must still hold and be free, or the joint is not built. It searches nothing.
"""

from collections.abc import Mapping
from dataclasses import replace

from grafu.asset.part import Asset, Part
from grafu.errors import OptionError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.realization.hinge.border import border_frame
from grafu.realization.plan import AUTOMATIC, PIVOT, JointChoice, JointRequest, RealizationPlan
from grafu.templates.template import Gallery
from grafu.vocabulary import JointType, MechanismClass

_RAILS = (MechanismClass.CENTRE, MechanismClass.CORNER)


def with_choices(
    plan: RealizationPlan, choices: Mapping[str, JointChoice], asset: Asset, gallery: Gallery
) -> RealizationPlan:
    """Returns the plan whose joints are to be built as chosen; `choices` go by the id of the moving part.

    A choice for a part without a joint in the plan waits for one: it changes nothing.

    Raises:
        OptionError: if a template is not in the gallery or of another class, a mount is no part of the asset, or what
            is chosen for a slide is for hinges alone.
    """
    parts = {part.id: part for part in asset.parts}
    joints = tuple(_chosen(request, choices.get(request.moving, AUTOMATIC), parts, gallery) for request in plan.joints)
    return replace(plan, joints=joints)


def _chosen(request: JointRequest, choice: JointChoice, parts: Mapping[str, Part], gallery: Gallery) -> JointRequest:
    if choice == AUTOMATIC:
        return request
    choice = replace(choice, mechanism=_mechanism(request, choice, gallery))
    if choice.mount and (choice.mount not in parts or choice.mount == request.moving):
        raise OptionError(f"the mount of `{request.moving}` must be another part: got {choice.mount!r}")
    axis = flipped_axis(parts[request.moving], request.axis) if choice.flipped else request.axis
    mounts = (choice.mount, *(m for m in request.mounts if m != choice.mount)) if choice.mount else request.mounts
    reference = request.reference if choice.opening is None else choice.opening
    return replace(request, axis=axis, mounts=mounts, reference=reference, choice=choice)


def _mechanism(request: JointRequest, choice: JointChoice, gallery: Gallery) -> MechanismClass | None:
    """Returns the class that is chosen, by name or by the template."""
    slides = request.type is JointType.PRISMATIC
    if slides and (choice.flipped or choice.count or choice.scale != 1.0):
        raise OptionError(f"side, count and scale are chosen for hinges: `{request.moving}` slides on two rails")
    if choice.mechanism is not None and slides is not (choice.mechanism in _RAILS):
        raise OptionError(f"`{request.moving}` is {request.type}: got the class {choice.mechanism}")
    if choice.template in ("", PIVOT):
        return choice.mechanism
    models = {m.id: m.mechanism for m in (gallery.rails if slides else gallery.hinges)}
    if choice.template not in models:
        known = ", ".join(models)
        raise OptionError(f"the template of `{request.moving}` must be one of {known}: got {choice.template!r}")
    if choice.mechanism not in (None, models[choice.template]):
        raise OptionError(f"`{choice.template}` is of class {models[choice.template]}: got {choice.mechanism}")
    return models[choice.template]


def flipped_axis(part: Part, axis: Axis) -> Axis:
    """Returns the axis at the part's opposite border, such that the part still opens to the same side."""
    frame = border_frame(part.mesh, axis)
    x, y, _ = frame.to_border(axis.closest_point(frame.origin)[None])[0]
    return Axis(frame.to_object(vec3(frame.width - float(x), float(y), 0.0)[None])[0], -frame.rotation[:, 2])
