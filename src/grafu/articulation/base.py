"""How a piece stands: on its own feet, fixed to the world, or hung on a wall."""

from enum import StrEnum


class BaseKind(StrEnum):
    """What holds the static root link."""

    FREE = "free"
    """Nothing: it stands on the floor by its weight, and can be pushed and tipped."""
    FIXED = "fixed"
    """It is fixed to the world where it stands."""
    WALL = "wall"
    """It hangs on a wall or leans on one, to which it is fixed."""
