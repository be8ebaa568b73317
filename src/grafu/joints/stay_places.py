"""Where a stay may be held, in the plane across a lid's hinges: lengths, levers and turns. It reads no meshes.

The plane is that of the border frame: the leaf fills x from 0 and y up to its inner face, and opens counterclockwise.
"""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Scalars, Vec2, freeze_arrays
from grafu.joints.stay_config import StayConfig


@final
@dataclass(frozen=True, eq=False, slots=True)
class StayPlace(ArrayValue):
    """One stay: its pivot on the case and, closed, on the leaf; `axis` is the hinges', all in the plane (metres)."""

    case: Vec2
    leaf: Vec2
    axis: Vec2

    def __post_init__(self) -> None:
        freeze_arrays(self)

    def spans(self, angles: Scalars) -> np.ndarray:
        """Returns the vectors (n, 2) from the case's pivot to the leaf's, at angles of the leaf."""
        arm, c, s = self.leaf - self.axis, np.cos(angles), np.sin(angles)
        moved = np.column_stack([c * arm[0] - s * arm[1], s * arm[0] + c * arm[1]]) + self.axis
        return np.asarray(moved - self.case)

    def lengths(self, angles: Scalars) -> Scalars:
        """Returns how long the stay is at angles of the leaf."""
        return np.asarray(np.linalg.norm(self.spans(angles), axis=1))

    def turns(self, angles: Scalars) -> Scalars:
        """Returns by how much the stay has turned from rest in the plane, radians."""
        spans = self.spans(angles)
        directions = np.unwrap(np.arctan2(spans[:, 1], spans[:, 0]))
        return np.asarray(directions - directions[0])

    def levers(self, angles: Scalars) -> Scalars:
        """Returns the distance of the stay's line from the hinges; positive where pushing opens."""
        spans, arm = self.spans(angles), self.case - self.axis
        return np.asarray((arm[0] * spans[:, 1] - arm[1] * spans[:, 0]) / np.linalg.norm(spans, axis=1))

    def parts(self, angles: Scalars, config: StayConfig) -> tuple[float, float] | None:
        """Returns the lengths of tube and rod; None where no two slide in one another from closed to open."""
        lengths = self.lengths(angles)
        shortest, longest = float(lengths.min()), float(lengths.max())
        piece = shortest - config.room
        if piece <= config.room or 2 * piece < (1.0 + config.lap) * longest:
            return None
        return piece, piece


def places(
    axis: Vec2, face: float, width: float, angles: Scalars, config: StayConfig
) -> Iterator[tuple[StayPlace, tuple[float, float]]]:
    """Yields the places at which a stay pushes the leaf open throughout, with the lengths of its tube and rod.

    `face` is the y of the leaf's inner face, `width` the leaf's.
    """
    for on_leaf in config.on_leaf:
        for behind in config.behind:
            for across in config.across:
                place = StayPlace(
                    np.array([across * width, face - behind * width]),
                    np.array([on_leaf * width, face - config.off_leaf]),
                    axis,
                )
                parts = place.parts(angles, config)
                if parts is not None and float(place.levers(angles).min()) >= config.lever * width:
                    yield place, parts
