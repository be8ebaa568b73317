"""Does a moving body stay connected: the largest gap between it and the static body over its whole motion.

The paper counts a part as connected while its distance to the static parts never exceeds 5 mm in a unit cube. Hardware
belongs to the body that it is anchored to; a hinge that floats beside its door connects nothing (docs/metrics.md).
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.articulation.kinematics import link_poses
from grafu.articulation.sweep import rest_to_full
from grafu.geometry.intersection import MeshCollider
from grafu.metrics.bodies import anchored_mesh, largest_side, rigid_body


@final
@dataclass(frozen=True, slots=True)
class ConnectivityConfig:
    """How connection is measured; `tolerance` is a share of the object's largest side.

    `unit` is the side in metres to use instead of the object's own: that of the input, where parts were added to it.

    Raises:
        ValueError: if there is no pose, the tolerance is negative or the unit is not positive.
    """

    poses: int = 50  # as for collisions
    tolerance: float = 0.005  # the paper's 5 mm in a unit cube
    unit: float | None = None

    def __post_init__(self) -> None:
        if self.poses < 1 or self.tolerance < 0:
            raise ValueError(f"connectivity needs poses and a tolerance >= 0: got {self.poses}, {self.tolerance}")
        if self.unit is not None and not self.unit > 0:
            raise ValueError(f"`ConnectivityConfig.unit` must be above 0: got {self.unit}")

    def allowed(self, articulated: ArticulatedObject) -> float:
        """Returns the widest gap in metres that still counts as connected."""
        return self.tolerance * (self.unit or largest_side(articulated))


DEFAULT = ConnectivityConfig()


def largest_gaps(articulated: ArticulatedObject, config: ConnectivityConfig = DEFAULT) -> dict[str, float]:
    """Returns for each moving joint the largest distance, metres, of its body from the static body over its motion.

    Where one of the two has no faces the gap is infinite.
    """
    tolerance = config.allowed(articulated)
    static = anchored_mesh(rigid_body(articulated, articulated.root), tolerance)
    if not len(static.faces):
        return {joint.id: float("inf") for joint in articulated.moving_joints}
    held = MeshCollider(static)
    return {j.id: _largest_gap(articulated, j, held, (tolerance, config.poses)) for j in articulated.moving_joints}


def connected_joints(articulated: ArticulatedObject, config: ConnectivityConfig = DEFAULT) -> dict[str, bool]:
    """Returns for each moving joint whether its body stays within the tolerance of the static body."""
    allowed = config.allowed(articulated)
    return {joint: gap <= allowed for joint, gap in largest_gaps(articulated, config).items()}


def connectivity(articulated: ArticulatedObject, config: ConnectivityConfig = DEFAULT) -> float:
    """Returns the share of moving joints that stay connected (the paper's figure per object), 1 without joints."""
    found = connected_joints(articulated, config)
    return float(np.mean(list(found.values()))) if found else 1.0


def _largest_gap(
    articulated: ArticulatedObject, joint: Joint, static: MeshCollider, settings: tuple[float, int]
) -> float:
    tolerance, poses = settings
    mesh = anchored_mesh(rigid_body(articulated, joint.child), tolerance)
    if not len(mesh.faces):
        return float("inf")
    body, largest = MeshCollider(mesh), 0.0
    for frame in rest_to_full(articulated, joint.id, poses):
        body.place(link_poses(articulated, frame)[joint.child])
        largest = max(largest, body.distance(static))
    return largest
