"""Convex solids, and cutting them out of surfaces, attributes kept.

Watertight surfaces are cut by manifold3d and stay so. Open ones, which real furniture is full of, are clipped
triangle by triangle: what lies inside goes, the rest stays as it was, and the cut is left open as the surface was
before. What several solids take of one triangle goes at once: one after another they would shred it.
"""

from collections.abc import Sequence
from functools import cached_property, lru_cache
from typing import final

import manifold3d
import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface, attribute_rows, from_attributes
from grafu.geometry.arrays import ArrayValue, Faces, Indices, Points, Scalars, cross, distinct, frozen_array
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.directions import directions_around
from grafu.geometry.face_cuts import NOTHING, left_over
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.shapes import Bool, Float

_REMEMBERED = 8192  # hulls, of at most ...
_REMEMBERED_POINTS = 64  # ... so many points: a swept triangle with play has 48


@final
@dataclass(frozen=True, eq=False)
class ConvexSolid(ArrayValue):
    """A convex polyhedron: corners, faces, and the half-spaces `normal . x <= offset` as rows (normal, offset)."""

    vertices: Points
    faces: Faces
    planes: Float[np.ndarray, "k 4"]

    @classmethod
    def around(cls, points: Points) -> "ConvexSolid | None":
        """Returns the convex hull of the points; None where they are flat beyond repair.

        Small hulls are remembered: one path is cut out of one part after another.
        """
        points = np.ascontiguousarray(points, dtype=np.float64)
        return _known_hull(points.tobytes()) if len(points) <= _REMEMBERED_POINTS else _hull(points)

    @cached_property
    def box(self) -> Box:
        """The axis-aligned box around the solid."""
        return Box.around(self.vertices)

    def contains(self, points: Points) -> Bool[np.ndarray, " n"]:
        """Returns whether points lie in the solid or on its surface."""
        return (points @ self.planes[:, :3].T <= self.planes[:, 3]).all(axis=1)

    @property
    def mesh(self) -> TriangleMesh:
        """The watertight surface of the solid."""
        return TriangleMesh(self.vertices, self.faces)


def _hull(points: Points) -> ConvexSolid | None:
    from scipy.spatial import ConvexHull, QhullError  # local: it takes 0.3 s to import, and not all need a hull

    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return None
    planes = _merged_planes(hull.equations)
    index = np.full(len(points), -1)
    index[hull.vertices] = np.arange(len(hull.vertices))
    corners = points[hull.simplices]
    turned = np.einsum("ij,ij->i", _cross(corners), hull.equations[:, :3]) < 0
    faces = index[hull.simplices]
    faces[turned] = faces[turned][:, ::-1]
    flipped = np.column_stack([planes[:, :3], -planes[:, 3]])
    return ConvexSolid(frozen_array(points[hull.vertices]), frozen_array(faces, np.int64), frozen_array(flipped))


@lru_cache(maxsize=_REMEMBERED)
def _known_hull(points: bytes) -> ConvexSolid | None:
    return _hull(np.frombuffer(points).reshape(-1, 3))


def in_any(solids: Sequence[ConvexSolid], points: Points) -> Bool[np.ndarray, " n"]:
    """Returns whether points lie in one of the solids or on its surface."""
    inside = np.zeros(len(points), dtype=bool)
    for solid in solids:
        left = np.flatnonzero(~inside)
        left = left[solid.box.contains(points[left])]
        inside[left] = solid.contains(points[left])
    return inside


def subtract(surface: Surface, solids: Sequence[ConvexSolid], clipped: Surface | None = None) -> Surface:
    """Returns the surface without what lies inside the solids; the very same surface where nothing does.

    `clipped` is what `clip` gave of the same, where that is known.
    """
    near = _near(surface, solids)
    if near and surface.mesh.is_watertight:
        cut = _subtract_closed(surface, near)
        if cut is not None:
            return cut
    return clip(surface, near) if clipped is None else clipped


def clip(surface: Surface, solids: Sequence[ConvexSolid]) -> Surface:
    """Returns the surface, taken for an open one, without the parts of its triangles inside the solids.

    What is less of its area is what lies inside the solids, also where the surface is closed.
    """
    return clip_by_faces(surface, solids)[0]


def clip_by_faces(surface: Surface, solids: Sequence[ConvexSolid]) -> tuple[Surface, Scalars]:
    """Returns what `clip` does, and what goes of the area of each face of the surface."""
    near = _near(surface, solids)
    return _clip(surface, near) if near else (surface, np.zeros(len(surface.mesh.faces)))


def _near(surface: Surface, solids: Sequence[ConvexSolid]) -> list[ConvexSolid]:
    return [solid for solid in solids if solid.box.overlaps(surface.mesh.box)]


def _merged_planes(equations: np.ndarray) -> np.ndarray:
    """Returns the hull's planes, those of one flat face (triangulated, with rounding errors) as one, the outermost."""
    x, y, z = np.round(equations[:, :3], 4).T
    order = np.lexsort((equations[:, 3], z, y, x))
    normals = np.stack([x, y, z], axis=1)[order]
    is_first = np.append(True, (normals[1:] != normals[:-1]).any(axis=1))
    return equations[order[is_first]]


def _cross(triangles: np.ndarray) -> Points:
    return cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])


def _subtract_closed(surface: Surface, solids: Sequence[ConvexSolid]) -> Surface | None:
    """Returns the boolean difference, None where manifold3d does not accept the surface."""
    rows = attribute_rows(surface)
    body_mesh = manifold3d.Mesh(rows.astype(np.float32), surface.mesh.faces.astype(np.uint32))
    body_mesh.merge()
    body = manifold3d.Manifold(body_mesh)
    if body.status() != manifold3d.Error.NoError or body.is_empty() or body.volume() <= 0:
        return None
    for solid in solids:
        require_time()
        body = body - manifold3d.Manifold(
            manifold3d.Mesh(solid.vertices.astype(np.float32), solid.faces.astype(np.uint32))
        )
    cut = body.to_mesh()
    if not len(cut.tri_verts):
        return from_attributes(surface, rows, np.zeros((0, 3), np.int64))
    return from_attributes(surface, _padded(cut.vert_properties, rows.shape[1]), np.asarray(cut.tri_verts, np.int64))


def _padded(rows: np.ndarray, width: int) -> np.ndarray:
    """Returns rows of at least `width` columns (faces of the cut carry no attributes of their own: zeros)."""
    rows = np.asarray(rows, dtype=np.float64)
    return rows if rows.shape[1] >= width else np.pad(rows, ((0, 0), (0, width - rows.shape[1])))


def _clip(surface: Surface, solids: Sequence[ConvexSolid]) -> tuple[Surface, Scalars]:
    """Returns an open surface without the parts of its triangles inside the solids, and the area of these."""
    mesh, lost = surface.mesh, np.zeros(len(surface.mesh.faces))
    triangles = mesh.triangles
    near = _meet(triangle_bounds(triangles), Box.around(np.vstack([solid.vertices for solid in solids])))
    if not near.any():
        return surface, lost
    rows = attribute_rows(surface)
    # Faces without area go too: they would stay behind as needles in the cut.
    owner = np.flatnonzero(near)
    owner = owner[~_is_sliver(triangles[owner])]
    corners = triangles[owner]
    bounds = triangle_bounds(corners)
    near_each = [_touched(corners, bounds, solid) for solid in solids]
    pieces, whose, gone = left_over(rows[mesh.faces[owner]], near_each, [solid.planes for solid in solids])
    cut = np.zeros(len(mesh.faces), dtype=bool)
    cut[owner[gone]] = True
    if not cut.any():
        return surface, lost
    flat = near & _is_sliver(triangles)
    is_whole = ~_is_sliver(pieces)
    pieces, whose = pieces[is_whole], whose[is_whole]
    left = np.bincount(owner[whose], _areas(pieces), len(lost))
    lost = np.where(cut | flat, mesh.face_areas - left, 0.0)
    new_faces = len(rows) + np.arange(3 * len(pieces)).reshape(-1, 3)
    faces = np.vstack([mesh.faces[~cut & ~flat], new_faces])
    return from_attributes(surface, np.vstack([rows, pieces.reshape(-1, rows.shape[1])]), faces), lost


def _touched(triangles: np.ndarray, bounds: tuple[np.ndarray, np.ndarray], solid: ConvexSolid) -> Indices:
    """Returns the numbers of the triangles, in these bounds, that a solid may take something of."""
    require_time()
    number = np.flatnonzero(_meet(bounds, solid.box))
    return number[~_beyond_a_plane(triangles[number], solid.planes)]


def _beyond_a_plane(triangles: np.ndarray, planes: np.ndarray) -> np.ndarray:
    """Returns which triangles lie wholly outside one of the planes: the solid cannot touch them."""
    side = triangles @ planes[:, :3].T - planes[:, 3]
    return np.all(side >= -NOTHING, axis=1).any(axis=1)


def _meet(bounds: tuple[np.ndarray, np.ndarray], box: Box) -> np.ndarray:
    """Returns which of some boxes, given by their lowest and highest corners, share a point with a box."""
    low, high = bounds
    return np.all((low <= box.high) & (high >= box.low), axis=1)


def _is_sliver(triangles: np.ndarray) -> np.ndarray:
    """Returns which triangles are flatter than nothing: no higher over their longest side than a sliver."""
    corners = triangles[:, :, :3]
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    return 2 * _areas(triangles) <= 2 * NOTHING * longest


def _areas(triangles: np.ndarray) -> np.ndarray:
    return np.linalg.norm(_cross(triangles[:, :, :3]), axis=1) / 2


def few_corners(points: Points, most: int) -> Float[np.ndarray, "k 3"]:
    """Returns at most `most` of the points: those that lie farthest out along directions spread evenly."""
    if len(points) <= most:
        return points
    size = np.maximum(np.ptp(points, axis=0), 1e-9)
    return points[distinct(np.argmax((directions_around(most) / size) @ points.T, axis=1))]
