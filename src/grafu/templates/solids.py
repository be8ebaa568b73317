"""Closed solids that mechanisms are made of: plates, profiles, turned pieces; and their metal and plastic finishes.

Every solid is closed and faces outward, with smooth curved sides and sharp edges. Plates are drawn in two coordinates
(s, t) and grow along a third, d; `placed` maps (s, t, d) to the template's axes.
"""

from collections.abc import Sequence

import mapbox_earcut
import numpy as np
from shapely.geometry import MultiPolygon, Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.geometry.polygon import orient

from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import Mat3, Mat4, Vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.transform import from_rotation
from grafu.shapes import Float

STEEL = Material("brushed steel", (0.56, 0.57, 0.58, 1.0), metallic=1.0, roughness=0.38)
NICKEL = Material("satin nickel", (0.66, 0.61, 0.53, 1.0), metallic=1.0, roughness=0.3)
BRASS = Material("brass", (0.78, 0.57, 0.25, 1.0), metallic=1.0, roughness=0.28)
BRONZE = Material("antique bronze", (0.20, 0.12, 0.07, 1.0), metallic=1.0, roughness=0.5)
BLACK = Material("blackened iron", (0.03, 0.03, 0.032, 1.0), metallic=0.7, roughness=0.6)
SCREW = Material("screw steel", (0.40, 0.41, 0.42, 1.0), metallic=1.0, roughness=0.3)
ZINC = Material("zinc plate", (0.62, 0.64, 0.67, 1.0), metallic=1.0, roughness=0.45)
COATED = Material("epoxy-coated steel", (0.80, 0.79, 0.75, 1.0), metallic=0.0, roughness=0.5)
NYLON = Material("nylon", (0.86, 0.86, 0.84, 1.0), metallic=0.0, roughness=0.6)

_CREASE = np.cos(np.radians(40.0))  # sides of a 12-gon turn by 30 degrees and look round; a chamfer turns by 45


def finished(mesh: TriangleMesh, material: Material) -> Surface:
    """Returns the mesh in a material, with normals that are smooth across edges flatter than 40 degrees."""
    if not len(mesh.faces):
        return Surface(mesh, material)
    corners = mesh.faces.reshape(-1)
    normals = _corner_normals(mesh, corners)
    rows = np.c_[corners, np.round(normals * 1e6)].astype(np.int64)
    order = np.lexsort(rows.T[::-1])
    is_new = np.append(True, (rows[order[1:]] != rows[order[:-1]]).any(axis=1))
    first, index = order[is_new], np.empty(len(rows), np.int64)
    index[order] = np.cumsum(is_new) - 1
    split = TriangleMesh(mesh.vertices[corners[first]], index.reshape(-1, 3))
    return Surface(split, material, normals=normals[first])


def _corner_normals(mesh: TriangleMesh, corners: np.ndarray) -> np.ndarray:
    """Returns for each face corner the mean, weighted by corner angles, over nearly coplanar faces at its vertex."""
    one, other = _corner_pairs(corners)
    unit = mesh.face_normals
    weighted = np.repeat(unit, 3, axis=0) * _corner_angles(mesh)[:, None]  # so a quad counts alike however it is split
    smooth = np.einsum("ij,ij->i", unit[one // 3], unit[other // 3]) > _CREASE
    one, other = one[smooth], other[smooth]
    total = np.stack([np.bincount(one, weighted[other, k], len(corners)) for k in range(3)], axis=1)
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-300)


def _corner_angles(mesh: TriangleMesh) -> np.ndarray:
    """Returns the angle of each face at each of its corners, radians."""
    ahead = np.roll(mesh.triangles, -1, axis=1) - mesh.triangles
    ahead = ahead / np.maximum(np.linalg.norm(ahead, axis=2, keepdims=True), 1e-300)
    back = -np.roll(ahead, 1, axis=1)
    return np.arccos(np.clip(np.einsum("fck,fck->fc", ahead, back), -1.0, 1.0)).reshape(-1)


def _corner_pairs(corners: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns all ordered pairs of corners at the same vertex, each corner with itself too."""
    order = np.argsort(corners, kind="stable")
    counts = np.bincount(corners)
    starts = np.cumsum(counts) - counts
    repeats = counts[corners]
    one = np.repeat(np.arange(len(corners)), repeats)
    within = np.arange(len(one)) - np.repeat(np.cumsum(repeats) - repeats, repeats)
    return one, order[np.repeat(starts[corners], repeats) + within]


Outline = Polygon
Rows = Float[np.ndarray, "n 2"]


def extrude(shape: BaseGeometry, near: float, far: float) -> TriangleMesh:
    """Returns the prism over a plane shape, coordinates (s, t, d) with d from `near` to `far`, near < far."""
    return merge_meshes([_extrude_polygon(polygon, near, far) for polygon in polygons_of(shape)])


def polygons_of(shape: BaseGeometry) -> list[Polygon]:
    """Returns the polygons of a plane shape, without slivers."""
    if isinstance(shape, Polygon):
        parts = [shape]
    elif isinstance(shape, MultiPolygon):
        parts = list(shape.geoms)
    else:
        parts = [g for g in getattr(shape, "geoms", []) if isinstance(g, Polygon)]
    # A triangulation skips points on straight lines, and the walls would then not match the caps.
    clean = [p.simplify(1e-9) for p in parts if p.area > 1e-12]
    return [orient(p) for p in clean]


def _extrude_polygon(polygon: Polygon, near: float, far: float) -> TriangleMesh:
    rings = [np.asarray(ring.coords)[:-1, :2] for ring in (polygon.exterior, *polygon.interiors)]
    flat = np.vstack(rings)
    count = len(flat)
    ends = np.cumsum([len(ring) for ring in rings])
    cap = _facing_up(flat, mapbox_earcut.triangulate_float64(flat, ends.astype(np.uint32)).reshape(-1, 3))
    index = np.arange(count)
    follow = index + 1
    follow[ends - 1] = np.concatenate([[0], ends[:-1]])
    walls = np.vstack([np.c_[index, follow, follow + count], np.c_[index, follow + count, index + count]])
    vertices = np.vstack([np.c_[flat, np.full(count, near)], np.c_[flat, np.full(count, far)]])
    return TriangleMesh(vertices, np.vstack([cap[:, ::-1], cap + count, walls]).astype(np.int64))


def _facing_up(flat: Rows, faces: np.ndarray) -> np.ndarray:
    faces = faces.astype(np.int64)
    a, b, c = flat[faces[:, 0]], flat[faces[:, 1]], flat[faces[:, 2]]
    cross = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    return np.where((cross < 0)[:, None], faces[:, ::-1], faces)


def turned(profile: Sequence[tuple[float, float]], segments: int = 16) -> TriangleMesh:
    """Returns the solid of revolution about Z of a closed profile of (radius, z) points, in either order.

    Points at radius 0 become one vertex each, so a profile may start and end on the axis.
    """
    rows = np.array(profile, dtype=np.float64)
    if _signed_area(rows) < 0:
        rows = rows[::-1]
    angles = np.arange(segments) * (2 * np.pi / segments)
    ring = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    on_axis = rows[:, 0] < 1e-12
    sizes = np.where(on_axis, 1, segments)
    starts = (np.cumsum(sizes) - sizes).tolist()
    vertices = [
        np.array([[0.0, 0.0, z]]) if r < 1e-12 else np.c_[ring * r, np.full(segments, z)] for r, z in rows.tolist()
    ]
    faces = [_band(starts[k], starts[(k + 1) % len(rows)], on_axis, k, segments) for k in range(len(rows))]
    return TriangleMesh(np.vstack(vertices), np.vstack(faces).astype(np.int64))


def _band(start: int, end: int, on_axis: np.ndarray, k: int, segments: int) -> np.ndarray:
    """Returns the faces between profile point k and the next one (none where both lie on the axis)."""
    index = np.arange(segments)
    follow = (index + 1) % segments
    first, last = bool(on_axis[k]), bool(on_axis[(k + 1) % len(on_axis)])
    a = np.full(segments, start) if first else start + index
    b = np.full(segments, start) if first else start + follow
    c = np.full(segments, end) if last else end + index
    d = np.full(segments, end) if last else end + follow
    faces = np.zeros((0, 3), np.int64)
    if not first:
        faces = np.vstack([faces, np.c_[a, b, d]])
    if not last:
        faces = np.vstack([faces, np.c_[a, d, c]])
    return faces


def _signed_area(rows: Rows) -> float:
    x, y = rows[:, 0], rows[:, 1]
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y) / 2)


def tube(
    inner: float, outer: float, span: tuple[float, float], segments: int = 12, chamfer: float = 0.0
) -> TriangleMesh:
    """Returns a tube over `span` of Z between two radii (`inner` 0: a full cylinder); `chamfer` cuts outer edges."""
    low, high = span
    edge = min(chamfer, 0.4 * (outer - inner), 0.2 * (high - low))
    if edge <= 0:
        return turned([(inner, low), (outer, low), (outer, high), (inner, high)], segments)
    profile = [(inner, low), (outer - edge, low), (outer, low + edge)]
    profile += [(outer, high - edge), (outer - edge, high), (inner, high)]
    return turned(profile, segments)


def ball(radius: float) -> TriangleMesh:
    """Returns a ball of 80 faces around the origin: an icosahedron, each face in four, its corners on the sphere."""
    long = (1.0 + np.sqrt(5.0)) / 2.0
    pairs = [(x, y) for y in (long, -long) for x in (-1.0, 1.0)]
    corners = [(x, y, 0.0) for x, y in pairs] + [(0.0, x, y) for x, y in pairs] + [(y, 0.0, x) for x, y in pairs]
    points, faces = np.array(corners) / np.linalg.norm(corners[0]), np.array(_ICOSAHEDRON)
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=2)
    edges, number = np.unique(np.sort(sides.reshape(-1, 2))[:, ::-1], axis=0, return_inverse=True)
    (a, b, c), (ab, bc, ca) = faces.T, number.reshape(-1, 3).T + len(corners)
    vertices = np.concatenate([points, points[edges].mean(axis=1)])
    around = np.stack([a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca], axis=1).reshape(-1, 3)
    length = np.sqrt((vertices**2).sum(axis=1, keepdims=True))
    return TriangleMesh(vertices + vertices / length * (radius - length), around)


# Corners as `ball` makes them: four in the XY plane, four in YZ, four in ZX.
_ICOSAHEDRON = [
    [0, 11, 5], [0, 5, 1], [0, 1, 7], [0, 7, 10], [0, 10, 11], [1, 5, 9], [5, 11, 4], [11, 10, 2], [10, 7, 6],
    [7, 1, 8], [3, 9, 4], [3, 4, 2], [3, 2, 6], [3, 6, 8], [3, 8, 9], [4, 9, 5], [2, 4, 11], [6, 2, 10], [8, 6, 7],
    [9, 8, 1],
]  # fmt: skip


def disc(center: tuple[float, float], radius: float, segments: int = 10) -> Polygon:
    """Returns a regular polygon around a centre as a plane shape."""
    angles = np.arange(segments) * (2 * np.pi / segments)
    return Polygon(np.c_[center[0] + radius * np.cos(angles), center[1] + radius * np.sin(angles)])


def rectangle(s: tuple[float, float], t: tuple[float, float], chamfer: float = 0.0) -> Polygon:
    """Returns a rectangle over two intervals; `chamfer` cuts its corners."""
    (s0, s1), (t0, t1) = s, t
    c = min(chamfer, 0.45 * (s1 - s0), 0.45 * (t1 - t0))
    if c <= 0:
        return box(s0, t0, s1, t1)
    corners = [(s0 + c, t0), (s1 - c, t0), (s1, t0 + c), (s1, t1 - c)]
    return Polygon([*corners, (s1 - c, t1), (s0 + c, t1), (s0, t1 - c), (s0, t0 + c)])


def placed(mesh: TriangleMesh, s: Vec3, t: Vec3, d: Vec3) -> TriangleMesh:
    """Returns a solid drawn in (s, t, d) with these coordinates laid along three given directions."""
    R: Mat3 = np.stack([s, t, d], axis=1)
    T: Mat4 = from_rotation(R)
    return mesh.transformed(T)
