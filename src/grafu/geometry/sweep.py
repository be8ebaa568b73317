"""Solids along a path: lofts through rings, sections swept along a line, sheets between two grids. Lengths in metres.

Every mesh is closed, its faces outward, as long as it does not cross itself.
"""

import numpy as np

from grafu.geometry.arrays import Faces, Points, Vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float

Rings = Float[np.ndarray, "k n 3"]
Section = Float[np.ndarray, "m 2"]


def loft(rings: Rings, closed: bool = False) -> TriangleMesh:
    """Returns the solid through rings of equally many points; both ends are capped unless the rings form a circle.

    Each ring runs counter-clockwise about the direction in which the rings follow each other. The first and the last
    must be convex, or at least seen whole from their first point.
    """
    count, n = rings.shape[:2]
    faces = [_walls(count, n, closed)]
    if not closed:
        fan = np.arange(1, n - 1)
        hub = np.zeros_like(fan)
        last = (count - 1) * n
        faces += [np.column_stack([hub, fan + 1, fan]), np.column_stack([hub, fan, fan + 1]) + last]
    return TriangleMesh(rings.reshape(-1, 3), np.vstack(faces))


def swept(
    path: Points,
    section: Section,
    normal: Vec3,
    ends: tuple[Vec3, Vec3] | None = None,
    closed: bool = False,
) -> TriangleMesh:
    """Returns a convex section swept along a plane path and mitred at its corners.

    `normal` is the unit normal of the path's plane. The section is counter-clockwise in two coordinates: across the
    path (normal x direction) and along the normal. `ends` gives the directions that the path starts and ends with
    (none: those of its first and last stretch), so that its ends can lie flat on a face.
    """
    ahead = _unit(np.roll(path, -1, axis=0) - path)
    behind = np.roll(ahead, 1, axis=0)
    if not closed:
        first, last = ends or (ahead[0], ahead[-2])
        behind[0] = ahead[0] = first
        ahead[-1] = behind[-1] = last
    direction = _unit(ahead + behind)
    mitre = np.maximum(np.einsum("ij,ij->i", direction, ahead), 0.2)  # a sharp corner may not shoot away
    across = np.cross(normal, direction) / mitre[:, None]
    rings = path[:, None] + section[None, :, :1] * across[:, None] + section[None, :, 1:] * normal
    return loft(rings, closed)


def sheet(outer: Rings, inner: Rings) -> TriangleMesh:
    """Returns the solid between two grids of points, rows by columns, closed along their four rims.

    Seen from outside, the outer grid's columns run to the left of its rows' direction (rows x columns is outward).
    """
    rows, columns = outer.shape[:2]
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b, c, d = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    quads = np.stack([a, b, c, d], axis=-1).reshape(-1, 4)
    far = rows * columns
    rim = np.concatenate([index[:-1, 0], index[-1, :-1], index[:0:-1, -1], index[0, :0:-1]])
    follow = np.roll(rim, -1)
    rims = np.column_stack([follow, rim, rim + far, follow + far])
    every = np.vstack([quads, quads[:, ::-1] + far, rims])
    return TriangleMesh(np.vstack([outer.reshape(-1, 3), inner.reshape(-1, 3)]), _triangles(every))


def circle(radius: float, sides: int, flat: float = 1.0) -> Section:
    """Returns a regular polygon with a corner on each half axis (4, 8, 12, ... sides); `flat` scales its height."""
    angles = 2 * np.pi * np.arange(sides) / sides
    return radius * np.column_stack([np.cos(angles), flat * np.sin(angles)])


def chamfered_rectangle(half: tuple[float, float], chamfer: float) -> Section:
    """Returns a rectangle with its corners cut, eight points, as a section; `half` are its half sizes."""
    a, b = half
    c = min(chamfer, 0.8 * a, 0.8 * b)
    upper = [(a, -b + c), (a, b - c), (a - c, b), (-a + c, b)]
    return np.array([*upper, *((-s, -t) for s, t in upper)])


def _walls(count: int, n: int, closed: bool) -> Faces:
    steps = np.arange(count if closed else count - 1)
    i, j = (index.ravel() for index in np.meshgrid(steps, np.arange(n), indexing="ij"))
    after, beside = (i + 1) % count * n, (j + 1) % n
    return _triangles(np.column_stack([i * n + j, i * n + beside, after + beside, after + j]))


def _triangles(quads: np.ndarray) -> Faces:
    return np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype(np.int64)


def _unit(rows: np.ndarray) -> np.ndarray:
    return rows / np.maximum(np.linalg.norm(rows, axis=1, keepdims=True), 1e-300)
