"""The kinds of catches that keep doors and drawers closed."""

from enum import StrEnum


class CatchKind(StrEnum):
    """What keeps a joint closed besides friction."""

    NONE = "none"
    """Nothing."""
    DETENT = "detent"
    """It is held where it is closed, as by a hold-in detent, a ball catch or a magnet."""
    SELF_CLOSING = "self-closing"
    """It is pulled shut over the last centimetres and held there, as by self-closing runners and spring hinges."""
