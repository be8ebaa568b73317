"""What the user decides about one joint instead of the search: class, template, size, number, side, opening, mount.

A choice narrows the search; what it leaves must still hold and be free, or the joint is not built. It searches nothing.
"""

from collections.abc import Collection, Mapping
from dataclasses import replace
from math import degrees

from grafu.asset.part import Asset, Part
from grafu.errors import OptionError
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.joints.plan import AUTOMATIC, CUP, PIVOT, JointChoice, JointRequest, PlanConfig, RealizationPlan, Supports
from grafu.scene.border import BorderFrame, border_frame
from grafu.templates.template import Gallery
from grafu.vocabulary import RAIL_CLASSES, MechanismClass


def with_choices(
    plan: RealizationPlan,
    choices: Mapping[str, JointChoice],
    asset: Asset,
    gallery: Gallery,
    config: PlanConfig = PlanConfig(),
) -> RealizationPlan:
    """Returns the plan whose joints are to be built as chosen; `choices` go by the id of the moving part.

    A choice for a part without a joint in the plan waits for one: it changes nothing.

    Raises:
        OptionError: if a template is not in the gallery or of another class, a mount is no still part of the asset, or
            what is chosen for a slide is for hinges alone, or the other way about.
    """
    parts = {part.id: part for part in asset.parts}
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    for request in plan.joints:
        _require_still(request.moving, choices.get(request.moving, AUTOMATIC).mount, parts, moving)
    joints = tuple(
        _chosen(request, choices.get(request.moving, AUTOMATIC), parts, gallery, config) for request in plan.joints
    )
    return replace(plan, joints=joints)


def _require_still(part: str, mount: str, parts: Collection[str], moving: Collection[str]) -> None:
    if mount and (mount not in parts or mount in moving):
        why = "moves itself" if mount in moving else "is no part"
        raise OptionError(f"the mount of `{part}` must be a static part: {mount!r} {why}")


def _chosen(
    request: JointRequest, choice: JointChoice, parts: Mapping[str, Part], gallery: Gallery, config: PlanConfig
) -> JointRequest:
    if choice == AUTOMATIC:
        return request
    choice = replace(choice, mechanism=_mechanism(request, choice, gallery))
    axis = _chosen_axis(request, choice, parts, config)
    mounts = (choice.mount, *(m for m in request.mounts if m != choice.mount)) if choice.mount else request.mounts
    reference = request.reference if choice.opening is None else choice.opening
    return replace(request, axis=axis, mounts=mounts, reference=reference, choice=choice)


def _chosen_axis(request: JointRequest, choice: JointChoice, parts: Mapping[str, Part], config: PlanConfig) -> Axis:
    """Returns the axis at the border that is chosen: the opposite one, or that by which the chosen mount stands."""
    door = parts[request.moving]
    if choice.flipped:
        return flipped_axis(door, request.axis)
    if choice.mount and request.kind.turns and _is_beyond(door, request.axis, parts[choice.mount], config):
        return flipped_axis(door, request.axis)
    return request.axis


def _is_beyond(door: Part, axis: Axis, mount: Part, config: PlanConfig) -> bool:
    """Whether a mount stands by the door's opposite border, and clearly not by that of the axis."""
    frame = border_frame(door.mesh, axis)
    box = Box.around(frame.to_border(mount.mesh.vertices))
    near, far = (_border_box(frame, x).gap(box) for x in (0.0, frame.width))
    return far + config.nearer_border * frame.width < near


def _border_box(frame: BorderFrame, x: float) -> Box:
    half = frame.length / 2
    return Box(vec3(x, -frame.thickness, -half), vec3(x, 0.0, half))


def _mechanism(request: JointRequest, choice: JointChoice, gallery: Gallery) -> MechanismClass | None:
    """Returns the class that is chosen, by name or by the template."""
    slides = request.kind.slides
    if slides and (choice.flipped or choice.count or choice.scale != 1.0):
        raise OptionError(f"side, count and scale are chosen for hinges: `{request.moving}` slides on two rails")
    if not slides and choice.supports is not Supports.AUTO:
        raise OptionError(f"supports are chosen for rails: `{request.moving}` turns on hinges")
    if choice.mechanism is not None and slides is not (choice.mechanism in RAIL_CLASSES):
        raise OptionError(f"`{request.moving}` is {request.type}: got the class {choice.mechanism}")
    if choice.template in ("", PIVOT) or (choice.template == CUP and not slides):
        return choice.mechanism
    models = {m.id: m.mechanism for m in (gallery.rails if slides else gallery.hinges)}
    if choice.template not in models:
        known = ", ".join([*models, *([] if slides else [CUP])])
        raise OptionError(f"the template of `{request.moving}` must be one of {known}: got {choice.template!r}")
    if choice.mechanism not in (None, models[choice.template]):
        raise OptionError(f"`{choice.template}` is of class {models[choice.template]}: got {choice.mechanism}")
    return models[choice.template]


def flipped_axis(part: Part, axis: Axis) -> Axis:
    """Returns the axis at the part's opposite border, such that the part still opens to the same side."""
    frame = border_frame(part.mesh, axis)
    x, y, _ = frame.to_border(axis.closest_point(frame.origin)[None])[0]
    return Axis(frame.to_object(vec3(frame.width - float(x), float(y), 0.0)[None])[0], -frame.rotation[:, 2])


def short_of_chosen(request: JointRequest, template: str, upper: float, config: PlanConfig) -> tuple[str, ...]:
    """Returns a note where a joint opens clearly less than the user chose.

    `upper` is how far it opens, radians or metres.
    """
    chosen, turns = request.choice.opening, request.kind.turns
    if chosen is None or upper > chosen - (config.short_turn if turns else config.short_slide):
        return ()
    opens = f"{degrees(upper):.0f} of {degrees(chosen):.0f} degrees" if turns else f"{upper:.3f} of {chosen:.3f} m"
    return (f"opens by {opens} that were chosen: `{template}` or what stands around it allows no more",)
