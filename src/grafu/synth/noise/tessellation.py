"""How finely furniture is drawn, and from how many sides: broken edges, finer faces, every face turned over again.

What these edits do is what exporters and tidy modellers do: the furniture stays in its place to within the width of a
broken edge, boxes to the bit, so that contacts and motions are those of the plain boards and need not be worked out on
many times their faces. It draws nothing at random.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Final, Literal

import numpy as np
from scipy.spatial import ConvexHull

from grafu.asset.part import Asset, Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Faces, Points
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Float

Density = Literal["plain", "broken edges", "rounded edges", "finely rounded", "split", "split twice"]

# Faces of a plain board: 12 as made; 44, 236 and 1052 with edges broken in 1, 4 and 10 steps; 48 and 192 split.
STEPS: Final[dict[Density, int]] = {"broken edges": 1, "rounded edges": 4, "finely rounded": 10}
SPLITS: Final[dict[Density, int]] = {"split": 1, "split twice": 2}
WIDEST = 0.3  # fraction of a board's thickness that one broken edge takes at most
THINNEST = 0.002  # metres: thinner boards keep their edges
CUT: Final = 1.16  # widths of a broken edge by which a board's corner lies deeper: 2 / sqrt(3), and a little
MANY = 600  # faces of a surface beyond which it is not split: turned knobs, curved fronts
_SAME = 1e-6  # metres within which a vertex is a corner of its box


def tessellated(asset: Asset, density: Density = "plain", edge: float = 0.0015, both_sides: bool = False) -> Asset:
    """Returns the asset with its boards drawn this finely, edges broken by `edge` metres, faces from both sides."""
    if density == "plain" and not both_sides:
        return asset
    parts = tuple(_mapped(part, lambda s: _redrawn(s, density, edge, both_sides)) for part in asset.parts)
    return replace(asset, parts=parts)


def is_two_sided(faces: Faces) -> bool:
    """Whether the second half of the faces are the first half turned over."""
    half = len(faces) // 2
    return len(faces) > 0 and len(faces) % 2 == 0 and bool(np.array_equal(faces[:half], faces[half:, ::-1]))


def rounded_board(low: Points, high: Points, radius: float, steps: int) -> tuple[Float[np.ndarray, "n v 3"], Faces]:
    """Returns the vertices of boards between these corners, edges rounded in `steps` (1: a chamfer), and their faces.

    The radius is smaller on boards that are too thin for it.
    """
    signs, directions, faces = _corner_lattice(steps)
    middle, half = (low + high)[:, None] / 2, (high - low)[:, None] / 2
    radii = np.minimum(radius, 2 * WIDEST * half.min(axis=2, keepdims=True))
    return middle + signs * (half - radii) + directions * radii, faces


def _redrawn(surface: Surface, density: Density, edge: float, both_sides: bool) -> Surface:
    mesh = surface.mesh
    one_sided = not is_two_sided(mesh.faces)
    if surface.uv is None and one_sided and density in STEPS and _is_plain_board(mesh):
        vertices, faces = rounded_board(mesh.box.low[None], mesh.box.high[None], edge, STEPS[density])
        mesh = TriangleMesh(vertices[0], faces)
    for _ in range(SPLITS.get(density, 0)):
        if surface.uv is None and len(mesh.faces) <= MANY:
            mesh = _split(mesh)
    if both_sides and one_sided:
        mesh = TriangleMesh(mesh.vertices, np.vstack([mesh.faces, mesh.faces[:, ::-1]]))
    return surface if mesh is surface.mesh else replace(surface, mesh=mesh)


def _is_plain_board(mesh: TriangleMesh) -> bool:
    if mesh.faces.shape != (12, 3) or len(mesh.vertices) != 8 or mesh.box.size.min() < THINNEST:
        return False
    away = np.minimum(np.abs(mesh.vertices - mesh.box.low), np.abs(mesh.vertices - mesh.box.high))
    return bool(away.max() < _SAME)


def _split(mesh: TriangleMesh) -> TriangleMesh:
    """Returns each face as four, vertices shared as before."""
    f, count = mesh.faces, len(mesh.vertices)
    sides = np.sort(np.concatenate([f[:, [0, 1]], f[:, [1, 2]], f[:, [2, 0]]]), axis=1)
    keys, index = np.unique(sides[:, 0] * count + sides[:, 1], return_inverse=True)
    middles = (mesh.vertices[keys // count] + mesh.vertices[keys % count]) / 2
    ab, bc, ca = (count + index).reshape(3, -1)
    a, b, c = f.T
    faces = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return TriangleMesh(np.vstack([mesh.vertices, middles]), faces)


@cache
def _corner_lattice(steps: int) -> tuple[Points, Points, Faces]:
    """Returns for each vertex of a rounded board its corner (signs) and its direction from there, and the faces.

    The faces are those of the convex hull, which are the same for boards of all sizes.
    """
    octant = np.array([(a, b, steps - a - b) for a in range(steps + 1) for b in range(steps + 1 - a)], dtype=float)
    octant /= np.linalg.norm(octant, axis=1, keepdims=True)
    corners = np.array(list(product((-1.0, 1.0), repeat=3)))
    signs = np.repeat(corners, len(octant), axis=0)
    directions = signs * np.tile(octant, (8, 1))
    points = 2.0 * signs + directions
    hull = ConvexHull(points)
    a, b, c = (points[hull.simplices[:, k]] for k in range(3))
    inward = np.einsum("ij,ij->i", np.cross(b - a, c - a), hull.equations[:, :3]) < 0
    faces = hull.simplices.astype(np.int64)
    faces[inward] = faces[inward][:, ::-1]
    return signs, directions, faces


def _mapped(part: Part, edit: Callable[[Surface], Surface]) -> Part:
    return replace(part, surfaces=tuple(edit(surface) for surface in part.surfaces))
