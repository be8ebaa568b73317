"""What placing hinges or rails returns, and which part they came to sit on. It searches nothing."""

from dataclasses import dataclass
from typing import final

from grafu.articulation.articulated_object import Visual
from grafu.geometry.axis import Axis
from grafu.geometry.intersection import MeshCollider
from grafu.scene.scene import Scene
from grafu.vocabulary import MechanismClass

CHOSEN_REACH = 0.1
"""Longest block (extent) that bridges the way to a mount that was chosen: what stands farther off does not carry it."""


@final
@dataclass(frozen=True)
class Placement:
    """The hardware of one joint in the object frame at rest: rectified axis, opening (radians or metres), both ends.

    `in_way` names the moving bodies that the part meets at rest along its path, `struck_by` those that run into the
    hardware on theirs; `notes` say what was left out for their sake.
    """

    axis: Axis
    upper: float
    mechanism: MechanismClass
    template: str
    mount: str
    count: int
    dynamic: tuple[Visual, ...]
    static: tuple[Visual, ...]
    in_way: tuple[str, ...]
    struck_by: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def nearest_part(hardware: Visual, scene: Scene, mounts: tuple[str, ...]) -> str:
    """Returns the id of the static part that hardware sits on, "" where none is near; a wanted mount wins a draw."""
    collider = MeshCollider(hardware.mesh)
    near = [o for o in scene.static_obstacles if o.collider.box.overlaps(collider.box, 0.1 * scene.extent)]
    ranked = sorted((round(collider.distance(o.collider), 4), o.id not in mounts, o.id) for o in near)
    return ranked[0][2] if ranked else ""
