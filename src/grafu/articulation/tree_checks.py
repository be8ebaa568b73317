"""What every articulated object is checked for, besides being a tree: unique ids, and that what swings is driven."""

from collections.abc import Collection, Iterable

from grafu.articulation.swing import Swing
from grafu.errors import ArticulationError


def require_unique(what: str, ids: list[str]) -> None:
    """Raises ArticulationError if an id stands there more than once."""
    repeated = sorted({i for i in ids if ids.count(i) > 1}) if len(set(ids)) < len(ids) else []
    if repeated:
        raise ArticulationError(f"{what} ids must be unique: got {repeated} more than once")


def require_driven(swings: Iterable[Swing | None], moving: Collection[str]) -> None:
    """Raises ArticulationError if a piece swings with a link that is not among those that move."""
    still = sorted({swing.moving for swing in swings if swing is not None and swing.moving not in moving})
    if still:
        raise ArticulationError(f"hardware must swing with a link that moves: {still} do not move")
