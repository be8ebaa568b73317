"""Whether a piece is a window, or a glazed door, that lies on its face in a file without a stated direction that is up.

Coordinates are the input's; directions are spelled like `-Y`. No label and no joint is asked.
"""

from collections.abc import Iterator, Sequence
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import distinct
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_ratios
from grafu.geometry.mesh import merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.shells import shell_numbers
from grafu.shapes import Bool, Float, Int

_RAYS = 48  # along each side of the outline
_Mask = Bool[np.ndarray, "n n"]


@final
@dataclass(frozen=True, slots=True)
class LyingWindowConfig:
    """What is a window that lies on its face: a shallow frame around panes in the middle of its depth.

    Raises:
        ValueError: if a number is not between 0 and 1.
    """

    shallow: float = 0.22
    """Greatest height of what lies so, with sill and handle (fraction of the shorter of its other sides)."""
    inside: float = 0.1
    """How far a pane is from both ends at least (fraction of the height): the bottom of a tray is at its end."""
    pane: float = 0.04
    """What each pane covers at least (fraction of the outline): the slats of a bed cover less ..."""
    glazed: float = 0.25
    """... and what all panes cover together at least (fraction of the outline)."""
    thinner: float = 0.8
    """Greatest thickness of a pane (fraction of that of the frame around it)."""

    def __post_init__(self) -> None:
        require_ratios(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Outline:
    """What vertical lines meet.

    The first shell from above (-1: none), whether it is the first from below, too, the thickness between both (0 where
    nothing is met), and whether they are far from both ends.
    """

    shell: Int[np.ndarray, "n n"]
    is_alone: _Mask
    thickness: Float[np.ndarray, "n n"]
    is_inside: _Mask


def lies_as_a_window(
    parts: Sequence[Part], whole: Box, up: str, config: LyingWindowConfig = LyingWindowConfig()
) -> bool:
    """Whether panes that are seen from above and from below lie within a shallow frame: windows stand.

    A tray and a table top are closed by one board at one end, a picture and a mirror have a back, and the slats of a
    bed are narrow.

    Args:
        parts: the parts, in the input's coordinates.
        whole: the box around them.
        up: the direction that is up by habit.
        config: what is a window.
    """
    axis = "XYZ".index(up[1])
    if whole.size[axis] > config.shallow * float(np.delete(whole.size, axis).min()):
        return False
    outline = _outline(parts, whole, axis, config)
    panes = (pane for pane in _panes(outline, config) if _is_framed(pane, outline, config))
    return sum(float(pane.mean()) for pane in panes) >= config.glazed


def _outline(parts: Sequence[Part], whole: Box, axis: int, config: LyingWindowConfig) -> _Outline:
    meshes = [part.mesh for part in parts]
    shells, caster = shell_numbers(*meshes), RayCaster(merge_meshes(meshes))
    across = [k for k in range(3) if k != axis]
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = np.stack(np.meshgrid(*(whole.low[k] + steps * whole.size[k] for k in across), indexing="ij"), axis=-1)
    off = 0.1 * float(whole.size.max())
    found = []
    for sign, end in ((1.0, whole.high), (-1.0, whole.low)):
        origins = np.empty((_RAYS * _RAYS, 3))
        origins[:, across], origins[:, axis] = places.reshape(-1, 2), end[axis] + sign * off
        faces, distances = caster.first_faces(origins, -sign * np.eye(3)[axis])
        shell = np.where(faces >= 0, shells[faces], -1)
        found.append((shell.reshape(_RAYS, _RAYS), distances.reshape(_RAYS, _RAYS) - off))
    (above, over), (below, under) = found
    height, least = float(whole.size[axis]), config.inside * float(whole.size[axis])
    thickness = np.where(above >= 0, height - over - under, 0.0)
    return _Outline(above, (above >= 0) & (above == below), thickness, np.minimum(over, under) >= least)


def _panes(outline: _Outline, config: LyingWindowConfig) -> Iterator[_Mask]:
    """Yields where each shell is seen from above and below, off both ends, that covers enough of the outline."""
    seen = outline.is_alone & outline.is_inside
    for number in distinct(outline.shell[seen]):
        pane = seen & (outline.shell == number)
        if pane.mean() >= config.pane:
            yield pane


def _is_framed(pane: _Mask, outline: _Outline, config: LyingWindowConfig) -> bool:
    """Whether what is thicker lies on all four sides of a pane, along the lines through its middle."""
    thick = outline.thickness * config.thinner >= float(np.median(outline.thickness[pane]))
    frame = thick & (outline.thickness > 0.0) & ~pane
    row, column = (int(np.median(places)) for places in np.nonzero(pane))
    for line, filled in ((frame[row], pane[row]), (frame[:, column], pane[:, column])):
        within = np.flatnonzero(filled)
        if not len(within) or not line[: within[0]].any() or not line[within[-1] + 1 :].any():
            return False
    return True
