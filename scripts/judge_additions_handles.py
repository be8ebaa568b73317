"""Faults of how moving bodies can be grasped: sweeps of handles with fcl over an object, for `judge_additions.py`."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import trimesh

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual, VisualRole
from grafu.articulation.sweep import values_before
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.metrics.bodies import largest_side
from grafu.pipeline.functionalize import Functionalized
from grafu.pipeline.report import report_of
from grafu.scene.scale import metre_on
from grafu.vocabulary import PartLabel

POSES = 40  # of each joint in which handles are looked at
WIDE = 0.9  # metres: from here on two handles are no waste
SKIN = 0.001  # of the largest side: deeper cuts are cuts
MANAGER: Any = trimesh.collision.CollisionManager  # untyped


def grasp_faults(result: Functionalized) -> Iterator[str]:
    """Yields moving bodies that nothing can be grasped of, and those with more handles than they need."""
    grasps = {joint.part: joint.grasp for joint in report_of(result).joints}
    factor = metre_on(largest_side(result.object))
    for joint in result.object.joints:
        visuals, added = result.object.link(joint.child).visuals, new_handles(result.object, joint)
        carved = [c for c in result.fittings.changes.carved if c.part.id in {v.name for v in visuals}]
        before = result.fittings.grasps[joint.child]
        if grasps[joint.child] == "none":
            yield f"`{joint.child}` cannot be grasped"
        width = float(np.max(merge_meshes([v.mesh for v in visuals]).box.size[:2])) / factor
        if len(added) + len(carved) > (2 if width >= WIDE else 1):
            yield f"`{joint.child}` has {len(added)} handles and {len(carved)} grips"
        if (added or carved) and before.kind in ("handle", "recess"):
            yield f"`{joint.child}` had a {before.kind} and got another"


def handle_faults(result: Functionalized) -> Iterator[str]:
    """Yields added handles that cut into anything along their path, or that other moving bodies run into on theirs.

    What a joint waits for is open as far as it goes; all else rests.
    """
    articulated = result.object
    skin = SKIN * largest_side(articulated)
    for joint in articulated.joints:
        for handle in new_handles(articulated, joint):
            hit = _met(handle.mesh, joint, _around(articulated, joint), skin)
            yield from (f"`{handle.name}` meets `{name}`" for name in hit)
            struck = (other for other in articulated.joints if other.child != joint.child)
            yield from (
                f"`{other.child}` strikes `{handle.name}`" for other in struck if _strikes(other, handle, result)
            )


def new_handles(articulated: ArticulatedObject, joint: Joint) -> list[Visual]:
    """Returns the handles that the moving part of a joint was given."""
    visuals = articulated.link(joint.child).visuals
    return [v for v in visuals if v.role is VisualRole.ADDED and v.label is PartLabel.HANDLE]


def _around(articulated: ArticulatedObject, joint: Joint) -> Any:
    """Returns all other links at rest, those that a joint waits for wide open."""
    manager = MANAGER()
    for visual in articulated.link(articulated.root).visuals:
        if len(visual.mesh.faces):
            manager.add_object(visual.name, visual.mesh.to_trimesh())
    values = values_before(articulated, joint.id)
    for other in articulated.joints:
        if other.child != joint.child:
            mesh = articulated.link(other.child).mesh
            manager.add_object(other.child, mesh.to_trimesh(), transform=other.motion(values[other.id]))
    return manager


def _met(handle: TriangleMesh, joint: Joint, around: Any, skin: float) -> list[str]:
    found: set[str] = set()
    body = handle.to_trimesh()
    for value in np.linspace(joint.limits.lower, joint.limits.upper, POSES):
        hit, names, contacts = around.in_collision_single(
            body, transform=joint.motion(float(value)), return_names=True, return_data=True
        )
        if hit:
            found |= {n for c in contacts if c.depth > skin for n in c.names if n in names}
    return sorted(found)


def _strikes(moving: Joint, handle: Visual, result: Functionalized) -> bool:
    """Whether a moving body hits a handle at rest; in the frame of the body, the handle moves backwards."""
    articulated = result.object
    own = next(joint for joint in articulated.joints if handle in articulated.link(joint.child).visuals)
    values = values_before(articulated, moving.id)
    if values[own.id] != own.limits.lower or not len(articulated.link(moving.child).mesh.faces):
        return False  # the handle is out of the way by then
    manager = MANAGER()
    manager.add_object(moving.child, articulated.link(moving.child).mesh.to_trimesh())
    body, skin = handle.mesh.to_trimesh(), SKIN * largest_side(articulated)
    for value in np.linspace(moving.limits.lower, moving.limits.upper, POSES):
        T = np.linalg.inv(moving.motion(float(value)))
        hit, contacts = manager.in_collision_single(body, transform=T, return_data=True)
        if hit and any(contact.depth > skin for contact in contacts):
            return True
    return False
