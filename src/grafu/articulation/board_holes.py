"""Holes through a board: cable outlets in backs, vents. One hull over the board would close them."""

from collections.abc import Iterator
from typing import final

import numpy as np
import shapely

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Vec3, freeze_arrays
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import line_crossings
from grafu.geometry.unions import united

MOST_FACES = 4000
"""Faces of a board that is looked at: finer ones take long."""
SMALL = 0.33
"""Fraction of a board's shorter side below which a hole is one in it: wider cells are those of a rack."""
MOST_HOLES = 12
"""Holes of a board that are kept open; what has more is a grating."""
SLIM = 0.5
"""Fraction of its shorter side up to which a board is thick."""
FREE = 0.6
"""Fraction of a hole's radius that stays free: cuts along the axes leave the corners around a round hole."""
_FEW = 24  # faces: of no more the union takes no longer than the quick answer
_NEAR = 0.99 / 2**0.5  # of a circle's diameter: a square grid of this step has a point well within the circle


@final
@dataclass(frozen=True, eq=False)
class BoardHole(ArrayValue):
    """A hole through a board: the middle, in the board, and the radius of the largest circle in it, and its box."""

    middle: Vec3
    radius: float
    extents: Box

    def __post_init__(self) -> None:
        freeze_arrays(self, "middle", dtype=np.float64)

    def is_closed_by(self, mesh: TriangleMesh, boxed: float) -> bool:
        """Whether the convex outline of a mesh, seen across its thin side, reaches into the hole.

        An outline that fills its rectangle to the fraction `boxed` counts as that.
        """
        across = _across(mesh)
        outline = shapely.convex_hull(shapely.multipoints(mesh.vertices[:, across]))
        if outline.area >= boxed * outline.envelope.area:
            outline = outline.envelope
        return bool(outline.distance(shapely.Point(*self.middle[across])) < FREE * self.radius)

    def edges(self, box: Box) -> Iterator[tuple[int, float, float]]:
        """Yields axis, sense and position of the four planes around the hole that cross a box."""
        for axis in np.argsort(-box.size)[:2].tolist():
            for sign in (-1.0, 1.0):
                at = float((self.extents.high if sign > 0 else self.extents.low)[axis])
                if box.low[axis] < at < box.high[axis]:
                    yield axis, sign, at


def is_board(mesh: TriangleMesh, thickest: float) -> bool:
    """Whether a mesh is as thin as a board: at most `thickest` metres, and half as thick as wide."""
    size = mesh.box.size
    return float(size.min()) <= min(thickest, SLIM * float(size[_across(mesh)].min()))


def holes_through(mesh: TriangleMesh, least: float, widest: float, thickest: float) -> tuple[BoardHole, ...]:
    """Returns the holes through a board into which a circle of diameter `least` fits, but none of `widest`, metres.

    A mesh that is no board (see `is_board`) has none, nor has a grating.
    """
    across = _across(mesh)
    widest = min(widest, SMALL * float(mesh.box.size[across].min()))
    if widest <= least or len(mesh.faces) > MOST_FACES or not is_board(mesh, thickest):
        return ()
    if len(mesh.faces) > _FEW and _is_covered(mesh, across, least):
        return ()
    flat = shapely.polygons(mesh.triangles[:, :, across])
    covered = united(flat[shapely.area(flat) > 0])
    rings = [ring for part in shapely.get_parts(covered) for ring in shapely.Polygon(part).interiors]
    found = []
    for ring in rings:
        circle = shapely.maximum_inscribed_circle(shapely.Polygon(ring))
        if least <= 2 * circle.length < widest:
            middle = mesh.box.center.copy()
            middle[across] = shapely.get_coordinates(circle)[0]
            low, high = middle.copy(), middle.copy()
            low[across], high[across] = np.reshape(ring.bounds, (2, 2))
            found.append(BoardHole(middle, float(circle.length), Box(low, high)))
    return tuple(found) if len(found) <= MOST_HOLES else ()


def _is_covered(mesh: TriangleMesh, across: list[int], least: float) -> bool:
    """Whether the faces of one side lie below every point of a grid that has one in each circle of diameter `least`.

    Then there is no hole: a quick answer, that of most boards.
    """
    box = mesh.box
    seen = mesh.triangles[:, :, [*across, box.thin_axis]]
    side = np.take(mesh.face_normals, box.thin_axis, axis=1) > 0
    counts = np.ceil(box.size[across] / (_NEAR * least)).astype(int)
    first, second = (box.low[k] + (np.arange(n) + 0.5) / n * box.size[k] for k, n in zip(across, counts, strict=True))
    is_met = np.zeros(len(first) * len(second), dtype=bool)
    is_met[line_crossings(seen[side], first, second).line] = True
    return bool(is_met.all())


def _across(mesh: TriangleMesh) -> list[int]:
    return [axis for axis in range(3) if axis != mesh.box.thin_axis]
