"""A planar four-bar linkage: how its coupler moves, and how far that is from a turn about one axis.

Lengths are metres. The plane's coordinates are those of whoever uses it; the coupler turns counterclockwise. It builds
no solids.
"""

from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.errors import TemplateError
from grafu.geometry.arrays import Scalars
from grafu.shapes import Float

Point = tuple[float, float]
Plane = Float[np.ndarray, "n 2"]


@final
@dataclass(frozen=True, slots=True)
class FourBar:
    """Two links join `fixed` pivots to `moving` pivots of the coupler; all at rest.

    Raises:
        TemplateError: if a link has no length, or two pivots of one body coincide.
    """

    fixed: tuple[Point, Point]
    moving: tuple[Point, Point]

    def __post_init__(self) -> None:
        pairs = (*zip(self.fixed, self.moving, strict=True), self.fixed, self.moving)
        if min(float(np.hypot(a[0] - b[0], a[1] - b[1])) for a, b in pairs) <= 0:
            raise TemplateError(f"a four-bar linkage needs four pivots apart: got {self.fixed}, {self.moving}")

    @property
    def lengths(self) -> tuple[float, float]:
        """The lengths of the two links."""
        first, second = np.linalg.norm(np.array(self.fixed) - np.array(self.moving), axis=1)
        return float(first), float(second)

    def scaled(self, factor: float) -> "FourBar":
        """Returns the linkage with all lengths times `factor`."""
        (a, b), (c, d) = (((factor * x, factor * y) for x, y in pair) for pair in (self.fixed, self.moving))
        return FourBar((a, b), (c, d))

    def shifts(self, angles: Scalars) -> Plane:
        """Returns by how much the coupler shifts after it has turned about the origin by angles that begin at 0.

        Neighbouring angles must lie near each other: of two assemblies it is the one that the linkage is in.

        Raises:
            TemplateError: if the linkage does not reach an angle.
        """
        shift, found = np.zeros(2), list[np.ndarray]()
        for angle in angles:
            shift = min(self._assemblies(float(angle)), key=lambda s, last=shift: float(np.hypot(*(s - last))))  # type: ignore[misc]
            found.append(shift)
        return np.array(found)

    def _assemblies(self, angle: float) -> tuple[np.ndarray, np.ndarray]:
        """Returns the two shifts at which both links have their lengths: where two circles meet."""
        first, second = np.array(self.fixed) - np.array(self.moving) @ _turned(angle).T
        (one, other), apart = self.lengths, second - first
        distance = float(np.hypot(*apart))
        along = (one**2 - other**2 + distance**2) / (2.0 * distance) if distance > 0 else np.inf
        if not abs(along) <= one:
            raise TemplateError(f"the linkage does not reach {np.degrees(angle):.1f} degrees: its links are too short")
        across = float(np.sqrt(one**2 - along**2))
        middle, side = first + along * apart / distance, np.array([-apart[1], apart[0]]) / distance
        return middle + across * side, middle - across * side

    def moved(self, angles: Scalars) -> Float[np.ndarray, "n 2 2"]:
        """Returns where the two moving pivots are at angles of the coupler."""
        turned = np.array([np.array(self.moving) @ _turned(float(angle)).T for angle in angles])
        return turned + self.shifts(angles)[:, None, :]

    def link_turns(self, angles: Scalars) -> Plane:
        """Returns by how much either link has turned from rest at angles of the coupler, radians."""
        arms = self.moved(angles) - np.array(self.fixed)
        directions = np.unwrap(np.arctan2(arms[..., 1], arms[..., 0]), axis=0)
        return np.asarray(directions - directions[0])

    def slips(self, angles: Scalars, axis: Point) -> Plane:
        """Returns what must be added to a turn about an axis, so that the coupler stands where the linkage holds it."""
        about = np.array([np.array(axis) - _turned(float(angle)) @ np.array(axis) for angle in angles])
        found = self.shifts(angles) - about
        return np.asarray(found - found[0])  # at rest there is none, but for rounding

    def best_axis(self, angles: Scalars) -> tuple[Point, float]:
        """Returns the axis a turn about which is nearest to the coupler's motion, and the largest slip beside it."""
        rows = np.vstack([np.eye(2) - _turned(float(angle)) for angle in angles])
        found = np.linalg.lstsq(rows, self.shifts(angles).ravel(), rcond=None)[0]
        axis = float(found[0]), float(found[1])
        return axis, float(np.hypot(*self.slips(angles, axis).T).max())


def _turned(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s], [s, c]])
