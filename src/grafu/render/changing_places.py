"""Sliding leaves that only change places when all of them are open: a picture of both open shows the piece closed."""

from typing import Final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint
from grafu.geometry.box import Box

_PARALLEL: Final = 0.99  # least cosine between directions along one line
_COVERED: Final = 0.5  # least fraction of a leaf's place, as it is seen from the front, that another takes up


def left_closed(articulated: ArticulatedObject) -> frozenset[str]:
    """Returns the ids of joints that a picture of an open piece leaves closed, so that it shows what is behind.

    They are those of leaves which slide to where a leaf before them in the order of joints stood, while that one slides
    the other way. Of two sliding doors the second stays closed.
    """
    opened: list[tuple[Joint, Box]] = []
    closed: set[str] = set()
    for joint in articulated.free_joints:
        if not joint.kind.slides or not len(articulated.link(joint.child).body_mesh.faces):
            continue
        box = articulated.link(joint.child).body_mesh.box
        if any(_covers(joint, box, other, place) for other, place in opened):
            closed.add(joint.id)
        else:
            opened.append((joint, box))
    return frozenset(closed)


def _covers(joint: Joint, box: Box, other: Joint, place: Box) -> bool:
    """Whether a leaf slides against another's direction, level with it and as wide, to where that one stood at rest."""
    along = joint.axis.direction
    if float(along @ other.axis.direction) > -_PARALLEL:
        return False
    moved = Box(box.low + joint.limits.upper * along, box.high + joint.limits.upper * along)
    seen = np.argsort(place.size)[1:]  # the two long sides of the leaf
    lap = np.minimum(moved.high, place.high) - np.maximum(moved.low, place.low)
    return bool(np.all(lap[seen] >= _COVERED * place.size[seen]))
