"""Handles that were added: which bodies have any, and what their handles hit along the path. Sweeps with fcl.

A handle is a part of that category which stands out: a carved grip is none, as in the paper's count.
"""

from collections.abc import Mapping
from typing import Any, Literal

import numpy as np
import trimesh

from grafu.geometry.mesh import TriangleMesh
from grafu.judging.piece import JudgedBody, JudgedMotion, JudgedPart, JudgedPiece

_MANAGER: Any = trimesh.collision.CollisionManager  # untyped
POSES = 40  # of each body, from closed to wide open

HandleFault = tuple[str, Literal["meets", "is struck by"], str]


def with_handles(piece: JudgedPiece) -> Mapping[str, bool]:
    """Returns for each moving body whether it has a handle."""
    return {body.id: bool(body.handles) for body in piece.moving}


def handle_faults(piece: JudgedPiece, skin: float) -> list[HandleFault]:
    """Returns (handle, fault, the other part or body) for added handles in the way of something, or it in theirs.

    A cut of less than `skin` metres is a touch. What a body waits for is open as far as it goes; all else rests.
    """
    found: list[HandleFault] = []
    for body in piece.moving:
        new = [handle for handle in body.handles if handle.origin == "added"]
        around = _around(piece, body) if new else None
        for handle in new:
            found += [(handle.name, "meets", name) for name in _met(handle.mesh, body, around, skin)]
            others = (other for other in piece.moving if other is not body)
            found += [(handle.name, "is struck by", o.id) for o in others if _strikes(o, handle, body, skin)]
    return found


def _around(piece: JudgedPiece, body: JudgedBody) -> Any:
    """Returns all that is not of a body, what it waits for wide open."""
    manager = _MANAGER()
    for part in piece.still:
        if len(part.mesh.faces):
            manager.add_object(part.name, part.mesh.to_trimesh())
    for other in piece.bodies:
        if other is not body and len(other.mesh.faces):
            value = body.starts.get(other.id, 0.0)
            T = np.eye(4) if other.motion is None else other.motion.at(value)
            manager.add_object(other.id, other.mesh.to_trimesh(), transform=T)
    return manager


def _values(motion: JudgedMotion) -> list[float]:
    return [float(value) for value in np.linspace(motion.lower, motion.upper, POSES)]


def _met(handle: TriangleMesh, body: JudgedBody, around: Any, skin: float) -> list[str]:
    found: set[str] = set()
    shape = handle.to_trimesh()
    for value in _values(body.motion) if body.motion else ():
        T = body.motion.at(value) if body.motion else np.eye(4)
        hit, names, contacts = around.in_collision_single(shape, transform=T, return_names=True, return_data=True)
        if hit:
            found |= {name for contact in contacts if contact.depth > skin for name in contact.names if name in names}
    return sorted(found)


def _strikes(moving: JudgedBody, handle: JudgedPart, own: JudgedBody, skin: float) -> bool:
    """Whether a moving body hits a handle at rest; in the frame of the body, the handle moves backwards."""
    if moving.motion is None or own.motion is None or not len(moving.mesh.faces):
        return False
    if moving.starts.get(own.id, own.motion.lower) != own.motion.lower:
        return False  # the handle is out of the way by then
    manager = _MANAGER()
    manager.add_object(moving.id, moving.mesh.to_trimesh())
    shape = handle.mesh.to_trimesh()
    for value in _values(moving.motion):
        T = np.linalg.inv(moving.motion.at(value))
        hit, contacts = manager.in_collision_single(shape, transform=T, return_data=True)
        if hit and any(contact.depth > skin for contact in contacts):
            return True
    return False
