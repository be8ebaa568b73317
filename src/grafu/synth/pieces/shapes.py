"""The solids of synthetic furniture: boards, chamfered and rounded boards, turned rods. No materials here.

Every mesh is closed with its faces outward. Boards that stand in a front face -Y. Lengths are metres.
"""

from collections.abc import Sequence

import numpy as np

from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import loft
from grafu.shapes import Float


def board(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    """Returns the box between two corners."""
    return TriangleMesh.box_mesh(Box(vec3(*low), vec3(*high)))


def sheet(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    """Returns the rectangle between two corners that agree along one axis, with faces on both sides."""
    corners = Box(vec3(*low), vec3(*high)).corners()
    flat = int(np.argmin(np.abs(np.subtract(high, low))))
    a, b = (1 << k for k in range(3) if k != flat)
    return TriangleMesh(corners[[0, a, a + b, b]], np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]]))


def arched_rail(box: Box, rise: float, steps: int = 10) -> TriangleMesh:
    """Returns an upright board along x whose lower edge is an arch, `rise` higher in the middle than at its ends."""
    (x0, y0, z0), (x1, y1, z1) = box.low.tolist(), box.high.tolist()
    ratios = np.linspace(0.0, 1.0, steps + 1)
    low = z0 + rise * (1 - (2 * ratios - 1) ** 2)
    rings = [
        [(x, y0, z), (x, y1, z), (x, y1, z1), (x, y0, z1)]
        for x, z in zip((x0 + ratios * (x1 - x0)).tolist(), low.tolist(), strict=True)
    ]
    return loft(np.array(rings))


def table_board(box: Box, edge: float, rounded: bool, steps: int = 4) -> TriangleMesh:
    """Returns a level board whose upper edges are chamfered or rounded by `edge`."""
    angles = np.linspace(0.0, np.pi / 2, (steps if rounded else 1) + 1)
    rings = [_level_ring(box, float(box.low[2]), 0.0)]
    for angle in angles.tolist():
        z, inset = box.high[2] - edge * (1 - np.sin(angle)), edge * (1 - np.cos(angle))
        rings.append(_level_ring(box, float(z), float(inset)))
    return loft(np.stack(rings))


def bow_fronted_board(box: Box, belly: float, steps: int = 12) -> TriangleMesh:
    """Returns a level board whose front edge bulges by `belly` before the box, in the middle."""
    (x0, y0, z0), (x1, y1, z1) = box.low.tolist(), box.high.tolist()
    ratios = np.linspace(0.0, 1.0, steps + 1)
    front = zip((x0 + ratios * (x1 - x0)).tolist(), (y0 - 4 * belly * ratios * (1 - ratios)).tolist(), strict=True)
    return prism([*front, (x1, y1), (x0, y1)], z0, z1)


def domed_board(box: Box, rise: float, steps: int = 12) -> TriangleMesh:
    """Returns a level board whose upper face is an arch from front to back, `rise` above the box in the middle."""
    (x0, y0, z0), (x1, y1, z1) = box.low.tolist(), box.high.tolist()
    ratios = np.linspace(1.0, 0.0, steps + 1)
    y, z = y0 + ratios * (y1 - y0), z1 + 4 * rise * ratios * (1 - ratios)
    return prism_along_x([(y0, z0), (y1, z0), *zip(y.tolist(), z.tolist(), strict=True)], x0, x1)


def turned(start: Vec3, end: Vec3, profile: Sequence[tuple[float, float]], sides: int = 12) -> TriangleMesh:
    """Returns a turned solid from `start` to `end`; `profile` lists (fraction of the length, radius), radii above 0."""
    direction = (end - start) / np.linalg.norm(end - start)
    across = np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))])
    across /= np.linalg.norm(across)
    angles = 2 * np.pi * (np.arange(sides) + 0.5) / sides
    circle = np.outer(np.cos(angles), across) + np.outer(np.sin(angles), np.cross(direction, across))
    return loft(np.stack([start + ratio * (end - start) + radius * circle for ratio, radius in profile]))


def rod(start: Vec3, end: Vec3, radius: float, sides: int = 12) -> TriangleMesh:
    """Returns a round rod."""
    return turned(start, end, ((0.0, radius), (1.0, radius)), sides)


def chamfered_board(box: Box, chamfer: float) -> TriangleMesh:
    """Returns a board that faces -Y, its four front edges cut at 45 degrees."""
    rings = [_front_ring(box, box.high[1], 0.0), _front_ring(box, box.low[1] + chamfer, 0.0)]
    return loft(np.stack([*rings, _front_ring(box, box.low[1], chamfer)]))


def rounded_board(box: Box, radius: float, steps: int = 4) -> TriangleMesh:
    """Returns a board that faces -Y, its four front edges rounded."""
    angles = np.linspace(0.0, np.pi / 2, steps + 1)
    rings = [_front_ring(box, box.high[1], 0.0)]
    for angle in angles:
        y, inset = box.low[1] + radius * (1 - np.sin(angle)), radius * (1 - np.cos(angle))
        rings.append(_front_ring(box, float(y), float(inset)))
    return loft(np.stack(rings))


def prism(outline: Sequence[tuple[float, float]], low: float, high: float) -> TriangleMesh:
    """Returns the upright prism over a convex outline in XY, given counter-clockwise."""
    flat = np.array(outline, dtype=np.float64)
    return loft(np.stack([np.column_stack([flat, np.full(len(flat), z)]) for z in (low, high)]))


def prism_along_x(outline: Sequence[tuple[float, float]], x0: float, x1: float) -> TriangleMesh:
    """Returns the prism along x over a convex outline in (y, z), given counter-clockwise about +X."""
    flat = np.array(outline, dtype=np.float64)
    return loft(np.stack([np.column_stack([np.full(len(flat), x), flat]) for x in (x0, x1)]))


def framed_opening(box: Box, width: float) -> tuple[TriangleMesh, ...]:
    """Returns four boards, two stiles and two rails between them, around a board that faces -Y."""
    (x0, y0, z0), (x1, y1, z1) = box.low.tolist(), box.high.tolist()
    return (
        board((x0, y0, z0), (x0 + width, y1, z1)),
        board((x1 - width, y0, z0), (x1, y1, z1)),
        board((x0 + width, y0, z0), (x1 - width, y1, z0 + width)),
        board((x0 + width, y0, z1 - width), (x1 - width, y1, z1)),
    )


def _front_ring(box: Box, y: float, inset: float) -> Float[np.ndarray, "4 3"]:
    x0, z0 = box.low[0] + inset, box.low[2] + inset
    x1, z1 = box.high[0] - inset, box.high[2] - inset
    return np.array([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)])


def _level_ring(box: Box, z: float, inset: float) -> Float[np.ndarray, "4 3"]:
    x0, y0 = box.low[0] + inset, box.low[1] + inset
    x1, y1 = box.high[0] - inset, box.high[1] - inset
    return np.array([(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)])
