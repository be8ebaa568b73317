"""Leaves of doors and windows that are drawn open across their frame: about which of their corners they close into it.

A closed leaf lies within the width of its frame and, but for its thickness, within its depth.
"""

from collections.abc import Iterator
from math import atan2, radians
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.transform import transform_points
from grafu.scene.border import part_axes

_WIDTH, _DEPTH, _UP = 0, 1, 2


@final
@dataclass(frozen=True)
class DrawnAcrossConfig:
    """When a leaf that is drawn across its frame fits into it.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    along: float = 0.8
    """What is less deep than this over its width stands along its frame: closed, or drawn ajar (ratio)."""
    least: float = radians(20)
    """How far such a leaf stands open at least (radians) ..."""
    widest: float = radians(135)
    """... and at most (radians)."""
    beyond: float = 0.02
    """How far a closed leaf reaches beyond the width of its frame at most (fraction of the leaf's width)."""
    proud: float = 1.2
    """How far it stands out of the depth of the frame at most (in thicknesses of the leaf): it may lie on its face."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)
        require_ratios(self, "along", "beyond")


@final
@dataclass(frozen=True)
class ClosesAbout:
    """The axis about which a leaf is closed, positive opening, and the angle at which it is drawn (radians)."""

    axis: Axis
    angle: float


def is_along(leaf: Part, config: DrawnAcrossConfig = DrawnAcrossConfig()) -> bool:
    """Whether a leaf stands along its frame: closed, or drawn ajar."""
    size = leaf.box.size
    return leaf.box.thin_axis == _DEPTH and bool(size[_DEPTH] <= config.along * size[_WIDTH])


def closes_about(leaf: Part, frame: Box, config: DrawnAcrossConfig = DrawnAcrossConfig()) -> ClosesAbout | None:
    """Returns how a leaf that stands open closes into its frame; None where it fits about none of its upright edges."""
    axes = part_axes(leaf.mesh)
    local = Box.around(leaf.mesh.vertices @ axes)
    if local.thin_axis == _UP:
        return None
    fits: list[tuple[float, float, ClosesAbout]] = []
    for turn in _turns(axes, local, config):
        closed = Box.around(transform_points(turn.axis.rotation(-turn.angle), leaf.mesh.vertices))
        beyond = np.maximum(frame.low - closed.low, closed.high - frame.high)
        if beyond[_WIDTH] > config.beyond * closed.size[_WIDTH]:
            continue
        if beyond[_DEPTH] > config.proud * local.size[local.thin_axis]:
            continue
        at = float(turn.axis.point[_WIDTH])
        jamb = min(abs(at - float(frame.low[_WIDTH])), abs(at - float(frame.high[_WIDTH])))
        fits.append((max(float(beyond[_DEPTH]), 0.0) + jamb, turn.angle, turn))
    return _centred(min(fits, key=lambda fit: fit[:2])[2], leaf, frame, config) if fits else None


def _centred(turn: ClosesAbout, leaf: Part, frame: Box, config: DrawnAcrossConfig) -> ClosesAbout:
    """Returns the turn about a pin beside the corner after which a leaf that fills its frame stands in its middle."""
    T = turn.axis.rotation(-turn.angle)
    closed = Box.around(transform_points(T, leaf.mesh.vertices))
    shift = float(frame.center[_WIDTH] - closed.center[_WIDTH])
    if abs(shift) > config.beyond * closed.size[_WIDTH]:
        return turn  # one of two leaves
    off = np.linalg.solve(np.eye(2) - T[:2, :2], np.array([shift, 0.0]))
    return ClosesAbout(Axis(turn.axis.point + vec3(float(off[0]), float(off[1]), 0.0), turn.axis.direction), turn.angle)


def _turns(axes: np.ndarray, local: Box, config: DrawnAcrossConfig) -> Iterator[ClosesAbout]:
    """Yields the turns about each upright edge by which a leaf comes to stand along the frame."""
    wide = 1 - local.thin_axis
    for end in (-1.0, 1.0):
        for face in (-1.0, 1.0):
            corner = local.center.copy()
            corner[wide] += end * local.half[wide]
            corner[local.thin_axis] += face * local.half[local.thin_axis]
            free = -end * axes[:, wide]
            for along in (-1.0, 1.0):
                angle = atan2(along * float(free[_DEPTH]), along * float(free[_WIDTH]))  # from closed to as drawn
                if config.least <= abs(angle) <= config.widest:
                    up = vec3(0.0, 0.0, float(np.sign(angle)))
                    yield ClosesAbout(Axis(axes @ corner, up), abs(angle))
