"""What carries a table's drop leaf once it is raised: gate legs and brackets swing out below it, lopers slide out.

They are found beside leaves that hang (`drop_leaves`), by name, or by shape: a plank under the top along the frame, an
open frame that stands on the floor, a bar that passes the frame and ends behind the leaf. They move on what the
table has, without hardware. Until the leaf is up it is in their way, so they wait for it; it comes to lie on them.
"""

from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from math import pi

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import merge_meshes
from grafu.graph.edges import Hinge, Slide
from grafu.graph.functional_graph import joined_groups
from grafu.joints.beside_leaf import BesideLeaf, is_shown, looks_like_support, path_of_swing, pin_of
from grafu.joints.drop_leaves import (
    SOURCE,
    HangingLeaf,
    hanging_leaves,
    is_called_support,
    moving_parts,
    with_drop_leaves,
)
from grafu.joints.drop_support_config import DropSupportConfig
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

_UP = 2
_QUARTER = pi / 2


def with_drop_supports(
    plan: RealizationPlan, asset: Asset, config: DropSupportConfig = DropSupportConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which what carries the raised leaves that it has swings or slides out.

    What is called a support and was predicted to move in another way is one; other joints stay as they are.
    """
    scaled = at_scale(config, metre_on(asset.extent))
    besides = [BesideLeaf(leaf, scaled) for leaf in hanging_leaves(plan, asset)]
    found = _found(besides, plan, asset) if besides else {}
    taken = {name for request in found.values() for name in (request.moving, *request.attached)}
    others = [_without(request, taken) for request in plan.joints if request.moving not in taken]
    kept = _resting(others, found.values(), besides, asset)
    refused = tuple(refusal for refusal in plan.refused if refusal.part not in taken)
    return replace(plan, joints=(*kept, *found.values()), refused=refused) if found else plan


def _without(request: JointRequest, taken: set[str]) -> JointRequest:
    """Returns a request whose part carries nothing of what moves by itself."""
    return replace(request, attached=tuple(part for part in request.attached if part not in taken))


def with_supported_leaves(
    plan: RealizationPlan, asset: Asset, config: DropSupportConfig = DropSupportConfig()
) -> RealizationPlan:
    """Returns a predicted plan in which leaves that hang from a top swing up, and what carries them comes out."""
    scaled = at_scale(config, metre_on(asset.extent))

    def supports(leaf: HangingLeaf) -> frozenset[str]:
        found = _found([BesideLeaf(leaf, scaled)], plan, asset)
        return frozenset(name for request in found.values() for name in (request.moving, *request.attached))

    return with_drop_supports(with_drop_leaves(plan, asset, supports=supports), asset, config)


def _found(besides: Sequence[BesideLeaf], plan: RealizationPlan, asset: Asset) -> dict[str, JointRequest]:
    """Returns what carries leaves that hang, by the part that moves."""
    hung, moving = {one.leaf.part.id for one in besides}, moving_parts(plan)
    free = [part for part in asset.parts if part.id not in hung and _may_carry(part, moving)]
    still = [part for part in asset.parts if part.id not in moving and part.id not in hung]
    found: dict[str, JointRequest] = {}
    for group in _groups(free, besides[0].config.touching):
        request = _request(group, _nearest(Box.enclosing(part.box for part in group), besides), still)
        found |= {} if request is None else {request.moving: request}
    return found


def with_stated_supports(
    plan: RealizationPlan, asset: Asset, config: DropSupportConfig = DropSupportConfig()
) -> RealizationPlan:
    """Returns the plan in which what swings or slides out behind a leaf, wherever that is stated, is its support."""
    leaves = hanging_leaves(plan, asset)
    if not leaves:
        return plan
    config = at_scale(config, metre_on(asset.extent))
    hung = {leaf.part.id for leaf in leaves}
    besides = [BesideLeaf(leaf, config) for leaf in leaves]
    stated = [replace(r, role=MotionRole.SUPPORT) for r in plan.joints if _is_stated(r, asset, besides)]
    carrying = {request.moving: request for request in stated if request.moving not in hung}
    joints = [carrying.get(request.moving, request) for request in plan.joints]
    return replace(plan, joints=_resting(joints, carrying.values(), besides, asset)) if carrying else plan


def _nearest(box: Box, besides: Sequence[BesideLeaf]) -> BesideLeaf:
    """Returns the leaf that a box ends next to."""
    return min(besides, key=lambda one: abs(one.behind(box)))


def _resting(
    joints: Sequence[JointRequest], supports: Collection[JointRequest], besides: Sequence[BesideLeaf], asset: Asset
) -> tuple[JointRequest, ...]:
    """Returns joints in which the leaves that have supports come to lie on these; a leaf that was found turns so."""
    upper: dict[str, float] = {}
    for support in supports:
        box = asset.part(support.moving).box
        leaf = _nearest(box, besides).leaf.part.id
        upper[leaf] = max(upper.get(leaf, -np.inf), float(box.high[_UP]))
    by_leaf = {one.leaf.part.id: one for one in besides}
    return tuple(by_leaf[r.moving].resting(r, upper[r.moving]) if r.moving in upper else r for r in joints)


def _may_carry(part: Part, moving: frozenset[str]) -> bool:
    named = is_called_support(part) and part.carried_by is None
    return named or (part.id not in moving and part.label not in (PartLabel.DRAWER, PartLabel.HANDLE, PartLabel.DOOR))


def _groups(free: Sequence[Part], touching: float) -> Iterator[tuple[Part, ...]]:
    """Yields the parts that may carry a leaf: what is called so and touches as one, everything else by itself."""
    named = {part.id: part for part in free if is_called_support(part)}
    near = {a: [b for b in named if b != a and named[a].box.overlaps(named[b].box, touching)] for a in named}
    yield from (tuple(named[name] for name in sorted(group)) for group in joined_groups(near))
    yield from ((part,) for part in free if part.id not in named)


def _request(group: tuple[Part, ...], beside: BesideLeaf, still: Sequence[Part]) -> JointRequest | None:
    """Returns how parts that hang together carry a leaf; None where they do not."""
    box, named = Box.enclosing(part.box for part in group), is_called_support(group[0])
    if not beside.is_below_and_behind(box):
        return None
    own = {beside.leaf.top.id, *(part.id for part in group)}
    others = [part.box for part in still if part.id not in own]
    mesh = merge_meshes([part.mesh for part in group])
    largest = max(group, key=lambda part: float(np.prod(np.sort(part.box.size)[1:])))
    attached = tuple(part.id for part in group if part is not largest)
    made = JointRequest(
        largest.id, Slide.joint_type, Axis(box.center, beside.out), SOURCE, attached=attached, role=MotionRole.SUPPORT
    )
    if beside.slides(box) and named:
        return replace(made, reference=beside.travel(box))
    if not beside.swings(box) or not (named or is_shown(mesh, beside, others)):
        return None
    if any(other.overlaps(path_of_swing(box, beside)) for other in others):
        return None
    return replace(made, type=Hinge.joint_type, axis=pin_of(mesh, beside), reference=_QUARTER)


def _is_stated(request: JointRequest, asset: Asset, besides: Sequence[BesideLeaf]) -> bool:
    """Whether a request is of a support: beside a leaf, towards it or about an upright axis, and no door or drawer."""
    part, direction = asset.part(request.moving), request.axis.direction
    if request.role is not MotionRole.NONE or request.parent or request.coupling is not None:
        return False
    bodies = [asset.part(name).mesh for name in (request.moving, *request.attached)]
    mesh = merge_meshes(bodies)
    for beside in besides:
        aligned = beside.config.aligned
        turns = request.kind.turns and abs(float(direction[_UP])) >= aligned and beside.swings(mesh.box)
        slides = request.kind.slides and float(direction @ beside.out) >= aligned and beside.slides(mesh.box)
        shown = is_called_support(part) or slides or looks_like_support(mesh, beside.leaf.axis, beside.config)
        if (turns or slides) and shown and beside.is_below_and_behind(mesh.box):
            return True
    return False
