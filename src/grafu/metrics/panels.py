"""Whether shelves and dividers that were added stand, and leave all motions free, measured on an articulated object.

It shares nothing with what makes them: trimesh's collision manager looks for panels that float (an end does not rest on
anything that stands still), pierce (cut into anything at rest) or block (stand in the way of what moves). It knows no
scene and no compartments.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, Literal

import numpy as np
import trimesh

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Visual
from grafu.geometry.arrays import Mat4, Points, vec3
from grafu.geometry.heading import heading_of
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.vocabulary import JointType, PartLabel

PanelFault = tuple[str, Literal["floats", "pierces", "blocks"], str]
_MANAGER: Any = trimesh.collision.CollisionManager  # untyped
POSES = 60  # of each joint, from closed to wide open


def panel_faults(articulated: ArticulatedObject, panels: Collection[str], skin: float) -> list[PanelFault]:
    """Returns (panel, fault, the end or the other part) for all that is wrong with panels of the static link.

    `panels` are names of visuals; a cut of less than `skin` metres is a touch, a gap of twice as much none. Ends and
    halves are those along the panels' own level axes.
    """
    angle = heading_of(v.mesh for v in articulated.link(articulated.root).visuals if v.name in panels)
    if angle:
        articulated = _turned(articulated, from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), -angle)))
    root = [v for v in articulated.link(articulated.root).visuals if len(v.mesh.faces)]
    standing = {v.name: v.mesh for v in root}
    moving = {link.id: link.mesh for link in articulated.links if link.id != articulated.root}
    joints = [joint for joint in articulated.joints if joint.type is not JointType.FIXED]
    found: list[PanelFault] = []
    for panel in (v for v in root if v.name in panels):
        others = {name: mesh for name, mesh in standing.items() if name != panel.name}
        found += [(panel.name, "floats", end) for end in _loose_ends(panel, others, 2 * skin)]
        found += [(panel.name, "pierces", other) for other in _pierced(panel.mesh, {**others, **moving}, skin)]
        blocked = (joint for joint in joints if _is_blocked(panel.mesh, joint, moving[joint.child], skin))
        found += [(panel.name, "blocks", joint.child) for joint in blocked]
    return found


def _turned(articulated: ArticulatedObject, T: Mat4) -> ArticulatedObject:
    """Returns the object, hardware and joints, as it stands after T."""

    def moved(visual: Visual) -> Visual:
        return replace(visual, surfaces=tuple(surface.transformed(T) for surface in visual.surfaces))

    links = tuple(replace(link, visuals=tuple(map(moved, link.visuals))) for link in articulated.links)
    joints = tuple(
        replace(joint, axis=joint.axis.transformed(T, joint.type is JointType.REVOLUTE)) for joint in articulated.joints
    )
    return replace(articulated, links=links, joints=joints)


def _loose_ends(panel: Visual, others: Mapping[str, TriangleMesh], reach: float) -> Sequence[str]:
    """A panel rests with the front and the back half of both its ends: of one pair of opposite sides at least."""
    mesh = panel.mesh
    thin = 2 if panel.label is PartLabel.SHELF else int(np.argmin(mesh.box.size))
    manager = _manager(others, mesh, reach)
    loose: dict[int, list[str]] = {}
    for axis in (k for k in range(3) if k != thin):
        other = 3 - thin - axis
        loose[axis] = [
            f"{'xyz'[axis]}{'-+'[side]} {('front', 'back')[half]}"
            for side in (0, 1)
            for half in (0, 1)
            if manager.min_distance_single(_cap(mesh, axis, side, other, half)) > reach
        ]
    return min(loose.values(), key=len)


def _cap(mesh: TriangleMesh, axis: int, side: int, other: int, half: int) -> trimesh.Trimesh:
    """Returns the outer hundredth of a half of one end of a prism with eight corners, in the prism's own shape."""
    corner = {tuple(key): v for key, v in zip(mesh.vertices > mesh.box.center, mesh.vertices, strict=True)}

    def at(u: float, v: float, top: bool) -> Points:
        """Returns the point at shares along the end's axis and along the other one."""
        point = np.zeros(3)
        for far, farther in product((False, True), repeat=2):
            key = [top] * 3
            key[axis], key[other] = far, farther
            point += (u if far else 1 - u) * (v if farther else 1 - v) * corner[tuple(key)]
        return point[None]

    us, vs = ((0.0, 0.01) if side == 0 else (0.99, 1.0)), ((0.0, 0.5) if half == 0 else (0.5, 1.0))
    corners = np.concatenate([at(u, v, top) for u in us for v in vs for top in (False, True)])
    return trimesh.convex.convex_hull(corners)


def _pierced(panel: TriangleMesh, others: Mapping[str, TriangleMesh], skin: float) -> list[str]:
    hit, names = _manager(others, panel, 0.0).in_collision_single(_shrunk(panel, skin), return_names=True)
    return sorted(names) if hit else []


def _is_blocked(panel: TriangleMesh, joint: Joint, body: TriangleMesh, skin: float) -> bool:
    if not len(body.faces):
        return False
    shrunk = _shrunk(panel, skin)
    manager = _MANAGER()
    manager.add_object("moving body", body.to_trimesh())
    for value in np.linspace(joint.limits.lower, joint.limits.upper, POSES):
        manager.set_transform("moving body", joint.motion(float(value)))
        if manager.in_collision_single(shrunk):
            return True
    return False


def _manager(others: Mapping[str, TriangleMesh], near: TriangleMesh, reach: float) -> Any:
    manager = _MANAGER()
    for name, mesh in others.items():
        if len(mesh.faces) and mesh.box.overlaps(near.box, reach + 0.01 * float(near.box.size.max())):
            manager.add_object(name, mesh.to_trimesh())
    return manager


def _shrunk(mesh: TriangleMesh, skin: float) -> trimesh.Trimesh:
    size = mesh.box.size
    factor = np.maximum(size - 2 * skin, 0.1 * size) / size
    return trimesh.Trimesh(mesh.box.center + (mesh.vertices - mesh.box.center) * factor, mesh.faces, process=False)
