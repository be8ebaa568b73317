"""The front frame: a door or drawer front seen from before it, with the edge at which it is gripped on top.

X runs along the gripped edge, Y across the front towards it, Z outwards, right-handed; the frame shares its origin with
the object frame. A door is gripped opposite its hinge, a drawer at its upper edge, a sliding door at the edge that
trails when it opens.
"""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.arrays import ArrayValue, Mat3, Points, Vec3, freeze_arrays, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.grip.config import GripConfig
from grafu.realization.hinge.border import border_frame, part_axes
from grafu.realization.rail.search import slides_in_its_plane
from grafu.realization.scene import JointMotion
from grafu.vocabulary import JointType

_HAND = 0.1  # metres: on a front with a shorter side, all that fingers need shrinks with it


@final
@dataclass(frozen=True, eq=False)
class Front(ArrayValue):
    """See the module's docstring; `rotation` has X, Y, Z as columns in the object frame, `box` is in the frame."""

    rotation: Mat3
    box: Box

    def __post_init__(self) -> None:
        freeze_arrays(self, "rotation")

    @property
    def length(self) -> float:
        """The gripped edge's length."""
        return float(self.box.size[0])

    @property
    def breadth(self) -> float:
        """The front's side across the gripped edge."""
        return float(self.box.size[1])

    @property
    def scale(self) -> float:
        """What lengths that are made for hands are multiplied with: 1, less on fronts that are smaller than a hand."""
        return min(1.0, min(self.length, self.breadth) / _HAND)

    def local(self, points: Points) -> Points:
        """Returns points of the object frame in the front frame."""
        return points @ self.rotation

    def in_object(self, points: Points) -> Points:
        """Returns points of the front frame in the object frame."""
        return points @ self.rotation.T


def front_of(mesh: TriangleMesh, joint_motion: JointMotion, config: GripConfig) -> Front:
    """Returns the front frame of a part that moves in a way."""
    direction = np.asarray(joint_motion.axis.direction)
    if joint_motion.type is JointType.REVOLUTE:
        border = border_frame(mesh, joint_motion.axis)
        along, towards, out = border.rotation[:, 2], border.rotation[:, 0], border.rotation[:, 1]
    elif slides_in_its_plane(mesh, direction):
        axes = part_axes(mesh)
        out = axes[:, int(np.argmin(np.ptp(mesh.vertices @ axes, axis=0)))]
        out = out * (-1.0 if _looks_back(out) else 1.0)
        towards = -_across(direction, out)
        along = np.cross(towards, out)
    else:
        axes = part_axes(mesh)
        nearest = int(np.argmax(np.abs(axes.T @ direction)))
        out = axes[:, nearest] * np.sign(float(axes[:, nearest] @ direction))
        up = vec3(0.0, 0.0, 1.0) if abs(float(out[2])) < 0.5 else vec3(0.0, -1.0, 0.0)
        towards = _across(up, out) * (1.0 if config.drawer_side == "top" else -1.0)
        along = np.cross(towards, out)
    rotation = np.column_stack([along, towards, out])
    return Front(rotation, Box.around(mesh.vertices[np.unique(mesh.faces)] @ rotation))


def _looks_back(out: Vec3) -> bool:
    """Whether a sliding door's normal points to the object's back: its front is -Y, or else +X."""
    return bool(out[1] > 0) if abs(float(out[1])) > 0.5 else bool(out[0] < 0)


def _across(direction: Vec3, out: Vec3) -> Vec3:
    """Returns the unit vector of a direction's part across another."""
    flat = direction - out * float(direction @ out)
    return np.asarray(flat / np.linalg.norm(flat))
