"""Which side of a piece without labels and handles is its front: the broad one that its compartments open to.

An open bookcase has a board at each end, which looks like a door where the piece is taken to face there. Coordinates
are the input's; directions are spelled like `-Y`.
"""

from collections.abc import Sequence
from typing import final

from grafu.asset.closed_side import rays_into
from grafu.asset.part import Part
from grafu.asset.standing import spelled
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster


@final
@dataclass(frozen=True, slots=True)
class OpenSideConfig:
    """When a side is open, and when it is closed.

    Raises:
        ValueError: if a fraction is not between 0 and 1.
    """

    deep: float = 0.3
    """What a ray passes before it meets anything where a side is open there (fraction of the depth of the whole)."""
    open: float = 0.5
    """Rays into an open side that do so at least (fraction): boards and their edges stop the others ..."""
    closed: float = 0.1
    """... and into each of two closed ends at most: a table's or a chair's sides are open between legs."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


def open_side(
    parts: Sequence[Part], whole: Box, up: str, usual: str, config: OpenSideConfig = OpenSideConfig()
) -> str | None:
    """Returns the broad side that is open, where the `usual` front is one of two closed ends; else None.

    Of two broad sides it is the more open one: behind a bookcase is its back. Where both are as open it is the positive
    one.

    Args:
        parts: the parts, in the input's coordinates.
        whole: the box around them.
        up: the direction that is up.
        usual: the front by the format or by habit.
        config: when a side is open.
    """
    end, upright = "XYZ".index(usual[1]), "XYZ".index(up[1])
    broad = 3 - end - upright
    if whole.size[end] <= whole.size[broad] or min(whole.size) <= 0:
        return None
    caster = RayCaster(merge_meshes([part.mesh for part in parts]))
    if max(_open_ratio(caster, whole, end, positive, config) for positive in (False, True)) > config.closed:
        return None
    back, front = (_open_ratio(caster, whole, broad, positive, config) for positive in (False, True))
    return spelled(broad, front >= back) if max(back, front) >= config.open else None


def _open_ratio(caster: RayCaster, whole: Box, axis: int, positive: bool, config: OpenSideConfig) -> float:
    """Returns the fraction of rays into a side that meet nothing near it."""
    deep = float(whole.size[axis])
    starts, towards = rays_into(whole, axis, positive, deep)
    return float((caster.along(starts, towards) > (1.0 + config.deep) * deep).mean())
