"""The marks of a joint that stands in Blender, read off its empty and what hangs on it. It draws nothing."""

from typing import Any

import numpy as np

from grafu.articulation.articulated_object import JointLimits
from grafu.export.blend.layout import KIND, LOWER, OPEN, TYPE, UPPER, Kind
from grafu.export.blend.marks import MotionMarks, motion_marks
from grafu.geometry.box import Box
from grafu.vocabulary import JointType


def marks_of(empty: Any) -> MotionMarks | None:
    """Returns the marks of a joint's empty, in its own frame; None where it does not move or nothing hangs on it."""
    if empty.get(KIND) != Kind.JOINT or OPEN not in empty or empty[UPPER] <= empty[LOWER]:
        return None
    link = next((child for child in empty.children if child.get(KIND) == Kind.LINK), None)
    meshes = [child for child in link.children if child.data is not None] if link is not None else []
    if not meshes:
        return None
    R = np.array(empty.rotation_quaternion.to_matrix(), dtype=np.float64)
    corners = np.concatenate([np.array(mesh.bound_box, dtype=np.float64) for mesh in meshes]) @ R
    limits = JointLimits(float(empty[LOWER]), float(empty[UPPER]))
    value = limits.lower + limits.range * min(max(float(empty[OPEN]), 0.0), 1.0)
    return motion_marks(JointType(empty[TYPE]), limits, value, Box(corners.min(axis=0), corners.max(axis=0)))
