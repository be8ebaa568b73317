"""Moving bodies on moving bodies: which carries which, and the scene as the body that carries a joint sees it.

Joints are built in the closed pose of what carries them. Seen from the carrier, it is static itself, what is built on
it moves with all that this carries in turn, and everything else is static.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.arrays import Mat4
from grafu.joints.plan import JointRequest
from grafu.scene.scene import MovingBody, Scene

ParentOf = Mapping[str, str]
"""By moving body the one that carries it; "": the static body."""


def bodies_of(requests: Sequence[JointRequest]) -> dict[str, MovingBody]:
    """Returns the moving body of each request: its part and what is attached, without the moving bodies on it."""
    parent_of = {request.moving: request.parent for request in requests}
    attached = {request.moving: (request.moving, *request.attached) for request in requests}
    found = {}
    for moving, members in attached.items():
        others = {member for other in bodies_on(moving, parent_of) for member in attached[other]}
        found[moving] = MovingBody(moving, tuple(m for m in members if m not in others))
    return found


def above(moving: str, parent_of: ParentOf) -> Iterator[str]:
    """Yields the moving bodies that carry a moving body, the nearest first."""
    seen = {moving}
    while (moving := parent_of.get(moving, "")) and moving not in seen:
        seen.add(moving)
        yield moving


def bodies_on(moving: str, parent_of: ParentOf) -> tuple[str, ...]:
    """Returns the moving bodies that a moving body carries, and those that these carry."""
    return tuple(other for other in parent_of if moving in above(other, parent_of))


def seen_from(
    carrier: str,
    bodies: Collection[str],
    scene: Scene,
    parent_of: ParentOf,
    T_carrier_others: Mat4 | None = None,
    is_alone: bool = False,
) -> Scene:
    """Returns the scene in which the `bodies` move, each with all that it carries, and everything else is static.

    Args:
        carrier: the moving body that carries them; "": the static body.
        bodies: the moving bodies that joints are built for.
        scene: all parts at rest.
        parent_of: which moving body carries which.
        T_carrier_others: where everything but the carrier and what it carries stands (None: at rest).
        is_alone: whether there is nothing but the carrier and the bodies.
    """
    owner = {own: body for body in bodies for own in (body, *bodies_on(body, parent_of))}
    members = {body: tuple(m for own in owner if owner[own] == body for m in _members(own, scene)) for body in bodies}
    near = {*_members(carrier, scene), *(m for ids in members.values() for m in ids)}
    parts, hardware = dict(scene.parts), list(scene.hardware)
    if is_alone:
        parts = {name: part for name, part in parts.items() if name in near}
        hardware = [(name, visual) for name, visual in hardware if name == carrier or name in owner]
    elif T_carrier_others is not None:
        T = T_carrier_others
        parts = {name: part if name in near else posed(part, T) for name, part in parts.items()}
        hardware = [
            (name, visual)
            if name == carrier or name in owner
            else (name, replace(visual, surfaces=tuple(s.transformed(T) for s in visual.surfaces)))
            for name, visual in hardware
        ]
    return replace(
        scene,
        parts=parts,
        moving_bodies={body: MovingBody(body, ids) for body, ids in members.items()},
        hardware=tuple((owner.get(name, ""), visual) for name, visual in hardware),
        joint_motions={body: motion for body, motion in scene.joint_motions.items() if body in members},
    )


def brought_back(built: Scene, view: Scene, carrier: str, scene: Scene, T_others_carrier: Mat4 | None = None) -> Scene:
    """Returns the whole scene with what was built in a view of it: hardware, motions, clearance, parts that joined.

    Args:
        built: the view with what was built.
        view: the view as `seen_from` returned it.
        carrier: whose view it is; static hardware is fixed to it.
        scene: the whole scene that the view is of.
        T_others_carrier: maps what is not on the carrier back to where it stands at rest (None: it stands there).
    """
    near = {*_members(carrier, scene), *view.moving_ids}
    changed = [part for name, part in built.parts.items() if part is not view.parts[name] and part != view.parts[name]]
    if T_others_carrier is not None:
        changed = [part if part.id in near else posed(part, T_others_carrier) for part in changed]
    joined = {
        body: [m for m in built.moving_bodies[body].members if m not in view.moving_ids] for body in built.moving_bodies
    }
    gone = {member for members in joined.values() for member in members}
    known = {visual.name for _, visual in view.hardware}
    hardware = [(owner or carrier, visual) for owner, visual in built.hardware if visual.name not in known]
    bodies = {
        name: MovingBody(name, (*(m for m in body.members if m not in gone), *joined.get(name, ())))
        for name, body in scene.moving_bodies.items()
    }
    return replace(
        scene.replaced(changed),
        moving_bodies=bodies,
        hardware=(*scene.hardware, *hardware),
        joint_motions={**scene.joint_motions, **built.joint_motions},
    )


def riding(moving: str, carrier: str, scene: Scene) -> Scene:
    """Returns the scene in which a moving body without a joint is part of another; of "": of the static body."""
    bodies = {name: body for name, body in scene.moving_bodies.items() if name != moving}
    if carrier:
        bodies[carrier] = MovingBody(carrier, (*bodies[carrier].members, *_members(moving, scene)))
    return replace(scene, moving_bodies=bodies)


def posed(part: Part, T: np.ndarray) -> Part:
    """Returns a part moved by T."""
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))


def _members(moving: str, scene: Scene) -> tuple[str, ...]:
    return scene.moving_bodies[moving].members if moving else ()
