"""The closed word lists: part labels, edge kinds, joint types.

The labels are the paper's thirteen categories and `unknown` (paper, section Functional Graph Parsing).
"""

from enum import StrEnum


class PartLabel(StrEnum):
    """The category of a part, spelled as in the authors' files."""

    TOP_PANEL = "top panel"
    SIDE_PANEL = "side panel"
    BACK_PANEL = "back panel"
    BOTTOM_PANEL = "bottom panel"
    FACE_FRAME = "face frame"
    SHELF = "shelf"
    DIVIDER = "divider"
    BAR = "bar"
    LEG = "leg"
    DOOR = "door"
    DRAWER = "drawer"
    HANDLE = "handle"
    MISC = "misc"
    UNKNOWN = "unknown"

    @property
    def is_movable(self) -> bool:
        """Whether parts of this label move on a hinge or on rails."""
        return self in (PartLabel.DOOR, PartLabel.DRAWER)

    @property
    def is_support(self) -> bool:
        """Whether parts of this label may carry a hinge or a rail (official rule 8)."""
        return self not in (PartLabel.DOOR, PartLabel.DRAWER, PartLabel.HANDLE)


MOVABLE_VALUES = frozenset(label.value for label in PartLabel if label.is_movable)
"""The values of the labels of what moves on a hinge or on rails, as decisions spell them."""


class PieceKind(StrEnum):
    """What a whole piece of furniture, appliance or opening of a building is."""

    CABINET = "cabinet"
    WALL_CABINET = "wall cabinet"
    WARDROBE = "wardrobe"
    SINK_UNIT = "sink unit"
    CHEST_OF_DRAWERS = "chest of drawers"
    CHEST = "chest"
    SHELF = "shelf"
    KITCHEN = "kitchen"
    TABLE = "table"
    DESK = "desk"
    BED = "bed"
    OVEN = "oven"
    DISHWASHER = "dishwasher"
    MICROWAVE = "microwave"
    REFRIGERATOR = "refrigerator"
    WASHING_MACHINE = "washing machine"
    BUILDING_DOOR = "building door"
    WINDOW = "window"


class EdgeKind(StrEnum):
    """The paper's four kinds of functional edges, and two of ours, which the authors' files do not have.

    `slide` is a part that slides and is no drawer, `turn` one that turns about no border of its box.
    """

    CONTACT = "contact"
    HINGE = "hinge"
    RAIL = "rail"
    ATTACHED = "attached"
    SLIDE = "slide"
    TURN = "turn"


class JointType(StrEnum):
    """How a child link moves against its parent."""

    FIXED = "fixed"
    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"
    CONTINUOUS = "continuous"  # revolute without limits: a knob, a wheel


class MechanismClass(StrEnum):
    """How a mechanism meets its two parts (paper, figure Hinge Configurations).

    C (contact) joins two faces that touch, F (flush) two faces in one plane, P (perpendicular) two faces at a right
    angle; rails are named by their mount. NONE is a joint without hardware: it moves, and nothing is shown to carry it.
    """

    C = "C"
    F = "F"
    P = "P"
    CENTRE = "centre-mount"
    CORNER = "corner-mount"
    NONE = "none"

    @classmethod
    def _missing_(cls, value: object) -> "MechanismClass | None":
        """Takes the name for people as well: `MechanismClass("contact")` is C."""
        return next((member for member in cls if member.in_words == value), None)

    @property
    def in_words(self) -> str:
        """The name for people: `contact`, `flush` and `perpendicular` for the paper's C, F and P."""
        return _HINGE_WORDS.get(self.value, self.value)


_HINGE_WORDS = {"C": "contact", "F": "flush", "P": "perpendicular"}
MECHANISM_MENU: dict[MechanismClass, str] = {
    MechanismClass.C: "Leaves between two faces that touch",
    MechanismClass.F: "Leaves on two flush faces",
    MechanismClass.P: "Leaves in an inner corner",
    MechanismClass.CENTRE: "Rails at half the height of the drawer's sides",
    MechanismClass.CORNER: "Rails that carry the drawer from below",
}
"""The classes that can be chosen, hinges before rails, each with a line for menus."""
RAIL_CLASSES = (MechanismClass.CENTRE, MechanismClass.CORNER)


MOTION_WORDS = (
    *("left", "right", "top", "bottom", "front", "back", "lift", "drop", "tilt", "lift-parallel"),
    *("slides", "pull", "slide-left", "slide-right", "slide-up", "fold-left", "fold-right", "fold-up", "fixed"),
)
"""How a user states a motion: the border that a part turns about (`lift`: the top, `drop`: the bottom; `tilt`: the
bottom, with the bin behind it, and not far); `lift-parallel`: arms lift it, and it stays upright; `slides` or `pull`:
out of the front; `slide-left` and the like: along itself; `fold-left`, `fold-right` and `fold-up`: as one of two leaves
that fold to that side; `fixed`: it does not move."""
