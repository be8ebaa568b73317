"""What sits on a front, and the handle among pieces of one door that no name tells apart: shapes of a robot's body.

It reads no names and no files: the bar stands before the leaf, on posts or by itself.
"""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh


@final
@dataclass(frozen=True, slots=True)
class DrawnGripConfig:
    """What counts as the handle of a door that is drawn in several pieces.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or `deep` not above 0.
    """

    thin: float = 0.35
    """Greatest thickness of the leaf (fraction of its next side)."""
    small: float = 0.12
    """Greatest face of a piece of the handle (fraction of the leaf's)."""
    touch: float = 0.01
    """How far these pieces may lie from the leaf and from each other, and stand out of its outline (fraction of the
    leaf's largest side)."""
    out: float = 0.04
    """How far the handle stands out of the leaf at least (fraction of its largest side): mouldings are flatter."""
    deep: float = 4.0
    """The furniture reaches this many times as far to the leaf's inner side as to the other."""
    shared: float = 0.3
    """Greatest face of all pieces of the handle together (fraction of the leaf's): more are a frame."""

    def __post_init__(self) -> None:
        require_ratios(self, *(name for name in self.__dataclass_fields__ if name != "deep"))
        require_positive(self, "deep")


DEFAULT_DRAWN_GRIP_CONFIG: Final = DrawnGripConfig()


def grip_among(
    boxes: Sequence[Box], whole: Box | None = None, config: DrawnGripConfig = DEFAULT_DRAWN_GRIP_CONFIG
) -> tuple[int, ...]:
    """Returns the numbers of the pieces of a door that are its handle; none where no leaf or no handle is plain.

    `whole` is the box around all that is furniture: what sits on the leaf's side to the inside is a liner or a bin.
    """
    leaf = max(range(len(boxes)), key=lambda k: face_area(boxes[k]), default=None)
    if leaf is None or boxes[leaf].size.min() > config.thin * np.sort(boxes[leaf].size)[1]:
        return ()
    plate = boxes[leaf]
    largest = float(plate.size.max())
    sitting = pieces_before(plate, boxes, config.small, config.touch * largest)
    found = tuple(k for k in sitting if whole is None or not is_inside(boxes[k], plate, whole, config.deep))
    faces = sum(face_area(boxes[k]) for k in found)
    stands_out = found and _reach([boxes[k] for k in found], plate) >= config.out * largest
    return found if stands_out and faces <= config.shared * face_area(plate) else ()


def pieces_before(plate: Box, boxes: Sequence[Box], small: float, slack: float) -> tuple[int, ...]:
    """Returns the numbers of the boxes that sit on a plate: they touch it or each other, and lie out of its plane.

    Args:
        plate: a front.
        boxes: what may sit on it.
        small: their largest face (fraction of the plate's).
        slack: how far they may lie apart and stand out of the plate's outline, metres.
    """
    most, around = small * face_area(plate), plate.grown(slack)
    left = [k for k, box in enumerate(boxes) if face_area(box) <= most and _is_before(box, plate, around)]
    found: list[int] = []
    queue = [plate]
    while queue:
        near = queue.pop()
        new = [k for k in left if k not in found and near.overlaps(boxes[k], slack)]
        found += new
        queue += [boxes[k] for k in new]
    return tuple(sorted(found))


def face_area(box: Box) -> float:
    """Returns the area of the largest face of a box."""
    first, second = np.sort(box.size)[1:]
    return float(first * second)


def is_plate(box: Box, most: float) -> bool:
    """Whether a box is thin: its shortest side is no longer than `most` of its next one (fraction)."""
    sides = np.sort(box.size)
    return bool(sides[0] <= most * sides[1])


def facing_axis(front: TriangleMesh, plate: float) -> int:
    """Returns the axis that a front faces: across a plate (`is_plate`), else that which most of its surface faces.

    A knob on a low front makes its box deep, but not this; of a frame without a panel most surface may face up.
    """
    if is_plate(front.box, plate):
        return front.box.thin_axis
    corners = front.triangles
    doubled = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return int(np.argmax(np.abs(doubled).sum(axis=0)))


def _is_before(box: Box, plate: Box, around: Box) -> bool:
    """Whether a box lies in the outline of a plate, and with its middle out of the plate's plane."""
    thin = plate.thin_axis
    across = [axis for axis in range(3) if axis != thin]
    within = np.all(box.low[across] >= around.low[across]) and np.all(box.high[across] <= around.high[across])
    return bool(within and not plate.low[thin] < box.center[thin] < plate.high[thin])


def is_inside(box: Box, plate: Box, whole: Box, deep: float) -> bool:
    """Whether a box lies on the inner side of a front, to which the furniture reaches `deep` times as far.

    `whole` is the box around the furniture. A leaf in a wall has no inner side.
    """
    axis = plate.thin_axis
    low, high = float(plate.low[axis] - whole.low[axis]), float(whole.high[axis] - plate.high[axis])
    own, other = (low, high) if box.center[axis] < plate.center[axis] else (high, low)
    return own >= deep * max(other, 0.0) and own > 0.0


def _reach(boxes: Sequence[Box], plate: Box) -> float:
    """Returns how far pieces stand out of a leaf to the farther side."""
    thin, all_of_them = plate.thin_axis, Box.enclosing(boxes)
    return float(max(plate.low[thin] - all_of_them.low[thin], all_of_them.high[thin] - plate.high[thin]))
