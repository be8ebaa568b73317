"""What things are called in a Blender scene of ours: properties, collections, frames. It does not know Blender."""

from enum import StrEnum

from grafu.articulation.articulated_object import VisualRole

KIND = "grafu"
"""The custom property that says what something of ours is: a `Kind`, or a visual's role."""
ID = "id"
LABEL = "label"
OPEN = "open"
"""The property of a joint's empty that moves the joint: 0 is closed, 1 open by its limit."""
LOWER, UPPER = "lower", "upper"
TYPE, PARENT, CHILD, AFTER = "type", "parent", "child", "after"

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
