"""Where the front of a robot description is that has no telling names and looks alike all around.

A rigid body of its own that closes one side of a piece, whose opposite side is closed by the rest, is its door. A flat
piece, such as a gate or a screen, faces across its broad side.
"""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.asset.part import Part
from grafu.asset.standing import spelled
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster

_STEPS: Final = (np.arange(16) + 0.5) / 16  # where rays go into a side


@final
@dataclass(frozen=True, slots=True)
class ClosedSideConfig:
    """What closes a side of a piece, and which piece is flat.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    thick: float = 0.2
    """Greatest thickness of what closes a side, with what stands out of it (fraction of the piece's depth there)."""
    end: float = 0.02
    """How far inside the end of the piece it begins at most (the same)."""
    covers: float = 0.7
    """What of that side it takes at least (fraction of the area)."""
    closed: float = 0.8
    """What of the opposite side the rest closes at least (fraction of rays): a bookcase is open before its back ..."""
    near: float = 0.15
    """... within this of its end (fraction of the depth)."""
    deep: float = 3.0
    """A piece that would be deeper than this, in widths, is flat, and faces the other way."""

    def __post_init__(self) -> None:
        require_positive(self, "deep")
        require_ratios(self, "thick", "end", "covers", "closed", "near")


def side_of_door(
    parts: Sequence[Part], whole: Box, up: str, config: ClosedSideConfig = ClosedSideConfig()
) -> str | None:
    """Returns the side, like `-Y`, that one rigid body alone closes; None where there is none or several."""
    links: dict[str, list[TriangleMesh]] = {}
    for part in parts:
        links.setdefault(part.source.link, []).append(part.mesh)
    if len(links) < 2 or "" in links:
        return None
    bodies = [merge_meshes(meshes) for meshes in links.values()]
    upright = "XYZ".index(up[1])
    sides = [(axis, positive) for axis in range(3) if axis != upright for positive in (False, True)]
    found = [
        spelled(axis, positive)
        for k, body in enumerate(bodies)
        for axis, positive in sides
        if _closes(body.box, whole, axis, positive, config)
        and _is_closed(merge_meshes([b for i, b in enumerate(bodies) if i != k]), whole, axis, not positive, config)
    ]
    return found[0] if len(found) == 1 else None


def faces_across(front: str, whole: Box, up: str, config: ClosedSideConfig = ClosedSideConfig()) -> bool:
    """Whether a piece is so flat that it cannot face this way: it would be much deeper than wide."""
    axis = "XYZ".index(front[1])
    other = 3 - axis - "XYZ".index(up[1])
    return bool(whole.size[axis] > config.deep * whole.size[other])


def _closes(box: Box, whole: Box, axis: int, positive: bool, config: ClosedSideConfig) -> bool:
    deep = float(whole.size[axis])
    inset = float(whole.high[axis] - box.high[axis] if positive else box.low[axis] - whole.low[axis])
    across = np.delete(np.arange(3), axis)
    covers = float(np.prod(box.size[across])) >= config.covers * float(np.prod(whole.size[across]))
    return covers and inset <= config.end * deep and float(box.size[axis]) <= config.thick * deep


def _is_closed(mesh: TriangleMesh, whole: Box, axis: int, positive: bool, config: ClosedSideConfig) -> bool:
    """Whether rays into a side meet a mesh close to the end of the whole there."""
    near = config.near * float(whole.size[axis])
    starts, towards = rays_into(whole, axis, positive, near)
    return float((RayCaster(mesh).along(starts, towards) <= 2 * near).mean()) >= config.closed


def rays_into(whole: Box, axis: int, positive: bool, off: float) -> tuple[Points, Vec3]:
    """Returns the starts of rays into a side of a box, metres, `off` before it, and their direction.

    They are spread over the side; `positive` is the side at the high end of the axis.
    """
    across = np.delete(np.arange(3), axis)
    places = np.meshgrid(*(whole.low[k] + _STEPS * whole.size[k] for k in across), indexing="ij")
    starts, towards = np.empty((len(_STEPS) ** 2, 3)), np.zeros(3)
    starts[:, across] = np.stack(places, axis=-1).reshape(-1, 2)
    towards[axis] = -1.0 if positive else 1.0
    starts[:, axis] = (whole.high if positive else whole.low)[axis] - towards[axis] * off
    return starts, towards
