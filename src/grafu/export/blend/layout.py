"""What things are called in a Blender scene of ours: properties, collections, frames; and the keys of its animation.

It does not know Blender.
"""

from enum import StrEnum

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, VisualRole
from grafu.articulation.sweep import opening_stages

KIND = "grafu"
"""The custom property that states what something of ours is: a `Kind`, or a visual's role."""
ID = "id"
LABEL = "label"
OPEN = "open"
"""The property of a joint's empty that moves the joint: 0 is closed, 1 open by its limit."""
LOWER, UPPER = "lower", "upper"
TYPE, PARENT, CHILD, AFTER = "type", "parent", "child", "after"
LEADER, MULTIPLIER, OFFSET = "leader", "multiplier", "offset"
"""Of a coupled joint: the id of the joint that it follows, and how."""

FIRST_FRAME, WIDEST_FRAME, LAST_FRAME = 0, 50, 100  # closed, open, closed: the authors' cycle (paper, Blender Add-on)
FRAME_RATE = 24  # Blender's own default; the cycle takes about four seconds

UV_LAYER = "UVMap"  # the names that Blender itself gives first
COLOR_LAYER = "Color"
RIG = "rig"
COLLECTION_OF_ROLE = {VisualRole.PART: "parts", VisualRole.ADDED: "added", VisualRole.HARDWARE: "hardware"}

LONGEST_NAME = 63  # bytes in UTF-8 that a name may have before Blender 5.0


class Kind(StrEnum):
    """What an empty or a collection stands for."""

    OBJECT = "object"
    LINK = "link"
    JOINT = "joint"


def fitted_name(name: str, room: int = 0) -> str:
    """Returns the name cut to what Blender keeps, less `room` bytes; no character is cut in two or unprintable."""
    printable = "".join(c if c.isprintable() else "_" for c in name) or "unnamed"
    return printable.encode("utf-8", "replace")[: LONGEST_NAME - room].decode("utf-8", "ignore")


Key = tuple[float, float]


def cycle_keys(articulated: ArticulatedObject) -> dict[str, tuple[Key, ...]]:
    """Returns for each joint that moves by itself its keys: frames and fractions of its opening, closed 0, open 1.

    Joints of one stage open together, each stage while all before it are wide open; closing is the mirror image.

    Raises:
        ArticulationError: if joints wait for one another.
    """
    stages, free = opening_stages(articulated), {joint.id for joint in articulated.free_joints}
    bounds = np.linspace(FIRST_FRAME, WIDEST_FRAME, len(stages) + 1)
    if len(stages) <= WIDEST_FRAME - FIRST_FRAME:  # else whole frames are too few
        bounds = np.round(bounds)
    keys: dict[str, tuple[Key, ...]] = {}
    for stage, start, end in zip(stages, bounds[:-1], bounds[1:], strict=True):
        keys |= dict.fromkeys([name for name in stage if name in free], _there_and_back(float(start), float(end)))
    return keys


def _there_and_back(start: float, end: float) -> tuple[Key, ...]:
    """Returns the keys of a joint that starts to open at one frame and is open at another, without repeated frames."""
    last = FIRST_FRAME + LAST_FRAME
    keys = [(FIRST_FRAME, 0.0), (start, 0.0), (end, 1.0), (last - end, 1.0), (last - start, 0.0), (LAST_FRAME, 0.0)]
    return tuple(sorted({float(frame): ratio for frame, ratio in keys}.items()))
