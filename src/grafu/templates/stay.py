"""A gas stay: a tube on the case and a rod on the lid, which slide in one another, and the brackets that hold them.

Frames: tube and rod run along +X from their pivots at the origin, which turn about Z. Brackets: see each function. It
chooses no place.
"""

from typing import Final

import numpy as np

from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.solids import BLACK, STEEL, ZINC, disc, extrude, finished, placed, rectangle, tube

_X, _Y, _Z = vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)
TUBE: Final = 0.009
"""Radius of a stay's tube (metres)."""
ROD: Final = 0.004
EYE: Final = 0.0065
"""Radius of the eyes in which tube and rod end (metres)."""
STUD: Final = 0.004
LUG: Final = 0.003
"""Thickness of brackets (metres)."""
PLATE: Final = (0.014, 0.011)
"""Half the sides of a bracket's plate (metres)."""
_SIDES = 20


def tube_surfaces(length: float, metre: float) -> tuple[Surface, ...]:
    """Returns the tube with its eye, of a length from the pivot to the tube's open end."""
    barrel = _along(TUBE, EYE * 0.7, length / metre)
    return _scaled([finished(_eye(), STEEL), finished(barrel, BLACK)], metre)


def rod_surfaces(length: float, metre: float) -> tuple[Surface, ...]:
    """Returns the rod with its eye, of a length from the pivot to the end that is in the tube."""
    return _scaled([finished(merge_meshes([_eye(), _along(ROD, EYE * 0.7, length / metre)]), STEEL)], metre)


def wall_bracket(gap: float, metre: float) -> tuple[Surface, ...]:
    """Returns the bracket on a wall: its plate lies on the plane z = 0, its stud ends on the pivot at z = `gap`."""
    plate = extrude(rectangle((-PLATE[0], PLATE[0]), (-PLATE[1], PLATE[1]), 0.004), 0.0, LUG)
    stud = extrude(disc((0.0, 0.0), STUD, _SIDES), 0.0, gap / metre + 0.5 * EYE)
    return _scaled([finished(plate, ZINC), finished(stud, STEEL)], metre)


def leaf_bracket(height: float, metre: float) -> tuple[Surface, ...]:
    """Returns the bracket on a lid: its plate lies on the plane y = 0 below the lid, its pivot is at y = -`height`.

    The lug is beside the rod, towards +Z.
    """
    drop, side = height / metre, EYE * 0.6
    plate = placed(extrude(rectangle((-PLATE[0], PLATE[0]), (-PLATE[1], PLATE[1]), 0.004), 0.0, LUG), _X, -_Z, _Y)
    shift = np.eye(4)
    shift[1, 3] = -LUG
    lug = extrude(rectangle((-EYE, EYE), (-drop - EYE, -0.5 * LUG)), side, side + LUG)
    stud = extrude(disc((0.0, -drop), STUD, _SIDES), -side, side + 0.5 * LUG)
    return _scaled([finished(merge_meshes([plate.transformed(shift), lug]), ZINC), finished(stud, STEEL)], metre)


def _eye() -> TriangleMesh:
    return extrude(disc((0.0, 0.0), EYE, _SIDES), -0.5 * EYE, 0.5 * EYE)


def _along(radius: float, start: float, end: float) -> TriangleMesh:
    return placed(tube(0.0, radius, (start, end), _SIDES), _Y, _Z, _X)


def _scaled(surfaces: list[Surface], metre: float) -> tuple[Surface, ...]:
    S: Mat4 = np.diag([metre, metre, metre, 1.0])
    return tuple(surface.transformed(S) for surface in surfaces)
