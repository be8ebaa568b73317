"""Rays against a mesh (Embree): first hits, robust distances, which faces are seen from outside.

Embree works in single precision: distances hold to about a micrometre on furniture. Where parallel lines cross
triangles is found exactly, every crossing: the lines run along the third coordinate through the points of a grid in the
first two.
"""

from collections.abc import Callable
from itertools import product
from typing import final

import numpy as np
from embreex import rtcore_scene
from embreex.mesh_construction import TriangleMesh as EmbreeMesh
from embreex.rtcore import EmbreeDevice

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Indices, Points, Scalars, Vec3, distinct, freeze_arrays, median
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.components import repeated_faces
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.geometry.remembered import RememberedByContent
from grafu.shapes import Bool, Float, Float32, Int, Int32

_REMEMBERED = 150_000  # faces of Embree's scenes kept by content: 30 MB
_LARGE = 50_000  # faces: scenes of larger meshes are not kept
_DEVICE = EmbreeDevice()  # one for all: each takes as long as the scene of a small mesh
_by_content: RememberedByContent[rtcore_scene.EmbreeScene] = RememberedByContent(_REMEMBERED)


@final
@dataclass(frozen=True, eq=False, slots=True)
class Crossings(ArrayValue):
    """Each crossing's line, face, height (the third coordinate), and whether the face looks along the lines.

    Lines are numbered as the grid's points, the second coordinate running fastest. Crossings come line by line, from
    high to low.
    """

    line: Int[np.ndarray, " n"]
    face: Int[np.ndarray, " n"]
    height: Float[np.ndarray, " n"]
    looks_up: Bool[np.ndarray, " n"]

    def __post_init__(self) -> None:
        freeze_arrays(self)


def line_crossings(
    triangles: Float[np.ndarray, "m 3 3"], first: Float[np.ndarray, " a"], second: Float[np.ndarray, " b"]
) -> Crossings:
    """Returns where the lines through the grid of `first` x `second` (both rising) cross the triangles.

    Triangles that stand along the lines are never crossed.
    """
    low, high = triangle_bounds(triangles)
    columns = np.stack([np.searchsorted(first, low[:, 0]), np.searchsorted(first, high[:, 0], "right")])
    rows = np.stack([np.searchsorted(second, low[:, 1]), np.searchsorted(second, high[:, 1], "right")])
    wide, tall = columns[1] - columns[0], rows[1] - rows[0]
    count = wide * tall
    face = np.repeat(np.arange(len(triangles)), count)
    within = np.arange(len(face)) - np.repeat(np.cumsum(count) - count, count)
    i = columns[0, face] + within // np.maximum(tall[face], 1)
    j = rows[0, face] + within % np.maximum(tall[face], 1)
    a, b, c = (triangles[face, k] for k in range(3))
    point = np.stack([first[i], second[j]], axis=1)
    area = _twice_area(a[:, :2], b[:, :2], c[:, :2])
    weights = np.stack(
        [_twice_area(b[:, :2], c[:, :2], point), _twice_area(c[:, :2], a[:, :2], point), np.zeros(len(face))], axis=1
    )
    weights[:, 2] = area - weights[:, 0] - weights[:, 1]
    hit = (area != 0) & np.all(weights * np.sign(area)[:, None] >= 0, axis=1)
    ratio = weights[hit] / area[hit, None]
    height = ratio[:, 0] * a[hit, 2] + ratio[:, 1] * b[hit, 2] + ratio[:, 2] * c[hit, 2]
    line = i[hit] * len(second) + j[hit]
    order = np.lexsort((-height, line))
    return Crossings(line[order], face[hit][order], height[order], (area[hit] > 0)[order])


def _twice_area(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> np.ndarray:
    """Returns twice the signed area of flat triangles, positive where they run counter-clockwise."""
    ab, ac = b - a, c - a
    return np.asarray(ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0])


@final
class RayCaster:
    """A mesh prepared for many rays; not a value. An empty mesh is never hit."""

    def __init__(self, mesh: TriangleMesh) -> None:
        self._scene: rtcore_scene.EmbreeScene | None = None
        if len(mesh.faces):
            vertices, faces = mesh.vertices.astype(np.float32, order="C"), mesh.faces.astype(np.int32, order="C")
            if len(faces) > _LARGE:
                self._scene = embree_scene(vertices, faces)
            else:
                self._scene = _by_content.of(lambda: embree_scene(vertices, faces), len(faces), vertices, faces)

    def distances(self, origins: Points, directions: Points) -> Scalars:
        """Returns the distance in metres along each unit direction to the first face hit; infinity where none is."""
        if self._scene is None or not len(origins):
            return np.full(len(origins), np.inf)
        require_time()
        found = self._scene.run(
            np.ascontiguousarray(origins, dtype=np.float32),
            np.ascontiguousarray(directions, dtype=np.float32),
            query="DISTANCE",
        )
        return _without_misses(found)

    def along(self, origins: Points, direction: Vec3) -> Scalars:
        """Returns the distances of many origins along one unit direction."""
        return self.distances(origins, _each_along(direction, len(origins)))

    def is_clear(self, origins: Points, direction: Vec3) -> Bool[np.ndarray, " n"]:
        """Returns for each origin whether no face lies along a unit direction, however far."""
        if self._scene is None or not len(origins):
            return np.ones(len(origins), dtype=np.bool_)
        require_time()
        found = self._scene.run(
            np.ascontiguousarray(origins, dtype=np.float32),
            _each_along(direction, len(origins)),
            query="OCCLUDED",
        )
        return np.asarray(found != 0)

    def first_faces(self, origins: Points, direction: Vec3) -> tuple[Indices, Scalars]:
        """Returns for each origin the number of the face first hit along a unit direction (-1: none), and how far."""
        if self._scene is None or not len(origins):
            return np.full(len(origins), -1, np.int64), np.full(len(origins), np.inf)
        require_time()
        found = self._scene.run(
            np.ascontiguousarray(origins, dtype=np.float32),
            _each_along(direction, len(origins)),
            query="INTERSECT",
            output=True,
        )
        distances = _without_misses(found["tfar"])
        return np.where(np.isfinite(distances), found["primID"].astype(np.int64), -1), distances


def embree_scene(vertices: Float32[np.ndarray, "n 3"], faces: Int32[np.ndarray, "m 3"]) -> rtcore_scene.EmbreeScene:
    """Returns Embree's scene of the triangles of a mesh, at least one."""
    scene = rtcore_scene.EmbreeScene(_DEVICE)
    # it copies number by number: more numbers take longer than to sort them, and numpy's longer than plain ones
    if len(vertices) >= 2 * len(faces):
        EmbreeMesh(scene, vertices[faces])
    elif len(faces) > _LARGE:
        EmbreeMesh(scene, vertices, faces)
    else:
        EmbreeMesh(scene, vertices.astype(object), faces.astype(object))
    return scene


def _each_along(direction: Vec3, count: int) -> Float32[np.ndarray, "n 3"]:
    """Returns one direction for each of many rays; `numpy.broadcast_to` takes longer than the rays of a small mesh."""
    directions = np.empty((count, 3), np.float32)
    directions[:] = direction
    return directions


def _without_misses(found: np.ndarray) -> Scalars:
    """Returns Embree's distances, infinity where a ray meets nothing."""
    distances = np.asarray(found, dtype=np.float64)
    return np.where(distances > 1e30, np.inf, distances)


def depths_below(rays: RayCaster, face: Box, along: int, count: int, above: float) -> Scalars:
    """Returns how far below the upper face of a box, along an axis, a grid of rays first meets a mesh, metres.

    The count x count rays begin `above` metres above the face; the mesh ends below that. Infinity where one meets none.
    """
    steps = (np.arange(count) + 0.5) / count
    across = [k for k in range(3) if k != along]
    grid = np.stack(np.meshgrid(*(face.low[k] + steps * face.size[k] for k in across)), -1).reshape(-1, 2)
    origins, direction = np.zeros((len(grid), 3)), np.zeros(3)
    origins[:, across] = grid
    origins[:, along], direction[along] = face.high[along] + above, -1.0
    return rays.along(origins, direction) - above


def covered_ratio(rays: RayCaster, face: Box, along: int, count: int, above: float) -> float:
    """Returns which fraction of the rays of `depths_below` meets the mesh."""
    return float(np.isfinite(depths_below(rays, face, along, count, above)).mean())


def robust_median(distances: Scalars, reach: float, ratio: float = 0.3) -> float:
    """Returns the median of the distances within `reach`; infinity where less than `ratio` of the rays hit."""
    hits = distances[distances <= reach]
    return median(hits) if len(hits) >= max(1.0, ratio * len(distances)) else float("inf")


_OFF = 1e-4  # of the largest side: how far before a face a ray begins
_DIRECTIONS = np.array([d for d in product((-1.0, 0.0, 1.0), repeat=3) if any(d)])
_DIRECTIONS /= np.linalg.norm(_DIRECTIONS, axis=1)[:, None]
_OBLIQUE = _DIRECTIONS @ np.linalg.qr([[9.0, 1.0, -2.0], [-1.0, 8.0, 2.0], [3.0, -1.0, 9.0]])[0]  # any turn
_PLACES = np.array([[1, 1, 1], [8, 1, 1], [1, 8, 1], [1, 1, 8]])  # weights of the corners: the middle, near each corner


def outer_faces(mesh: TriangleMesh) -> Bool[np.ndarray, " n"]:
    """Returns for each face whether it can be seen from far away: from either side of it, past all other faces.

    Four points of a face are looked from, along the 26 directions to the faces, edges and corners of a cube. The walls
    of a cavity without an opening are not seen, nor are faces where two boards touch.
    """
    if not len(mesh.faces):
        return np.zeros(0, dtype=np.bool_)
    first = repeated_faces(mesh)  # front and back of one sheet, as most are drawn, are seen alike
    left = distinct(first)
    seen = np.ones(len(first), dtype=np.bool_)
    seen[left] = False
    caster, off = RayCaster(mesh), _OFF * float(mesh.box.size.max())
    triangles, normals = mesh.triangles[left], mesh.face_normals[left]
    for direction, weights in product(_DIRECTIONS, _PLACES):
        points = np.einsum("k,nkd->nd", weights / weights.sum(), triangles)
        side = np.sign(normals @ direction)
        origins = points + off * side[:, None] * normals
        hidden = (side == 0) | ~caster.is_clear(origins, direction)
        seen[left[~hidden]] = True
        left, triangles, normals = left[hidden], triangles[hidden], normals[hidden]
    return seen[first]


def outer_points(points: Points, caster: RayCaster, size: float) -> Bool[np.ndarray, " n"]:
    """Returns for each of some points on a mesh whether it can be seen from far away, along one of 26 directions.

    They are those of `outer_faces`, turned: furniture has no faces along them. `caster` is of the mesh, whose largest
    side is `size` (metres).
    """
    seen, off = np.zeros(len(points), dtype=np.bool_), _OFF * size
    for direction in _OBLIQUE:
        left = np.flatnonzero(~seen)
        seen[left] = caster.is_clear(points[left] + off * direction, direction)
    return seen


_RAYS = 5  # in each direction of a face


def open_ratios(caster: RayCaster, box: Box, axis: int, reach: float = np.inf) -> tuple[float, float]:
    """Returns the fraction of rays that meet nothing, from just before the lower and the upper face across an axis.

    What is farther from the face than `reach` metres counts as nothing.
    """
    across = [k for k in range(3) if k != axis]
    steps = (np.arange(_RAYS) + 0.5) / _RAYS
    places = np.stack(np.meshgrid(steps, steps, indexing="ij"), axis=-1).reshape(-1, 2)
    origins = np.empty((len(places), 3))
    origins[:, across] = box.low[across] + places * box.size[across]
    off, direction = _OFF * float(box.size.max()), np.zeros(3)
    found = []
    for sign, face in ((-1.0, box.low), (1.0, box.high)):
        origins[:, axis], direction[axis] = face[axis] + sign * off, sign
        free = caster.along(origins, direction) > reach if np.isfinite(reach) else caster.is_clear(origins, direction)
        found.append(float(free.mean()))
    return found[0], found[1]


Cast = Callable[[Points, Vec3], Scalars]
"""What gives the distances of many origins along one unit direction, as `RayCaster.along` does."""


def wall_distances(
    cast: Cast,
    spot: Vec3,
    along: tuple[int, Float[np.ndarray, " a"]],
    up: tuple[int, Float[np.ndarray, " b"]],
    sign: float,
) -> Float[np.ndarray, "a b"]:
    """Returns how far to one side of a grid of places something is met; infinity where nothing is.

    The grid runs through `spot` along two axes, each given by its number and its coordinates; rays run along the third.
    """
    side = 3 - along[0] - up[0]
    places = np.stack(np.meshgrid(along[1], up[1], indexing="ij"), axis=-1).reshape(-1, 2)
    origins = np.tile(np.asarray(spot, dtype=np.float64), (len(places), 1))
    origins[:, along[0]], origins[:, up[0]] = places[:, 0], places[:, 1]
    direction = np.zeros(3)
    direction[side] = sign
    return cast(origins, direction).reshape(len(along[1]), len(up[1]))


def stands_between_walls(
    cast: Cast,
    spot: Vec3,
    along: tuple[int, Float[np.ndarray, " a"]],
    up: tuple[int, Float[np.ndarray, " b"]],
    reach: float = np.inf,
) -> Bool[np.ndarray, " a"]:
    """Whether walls stand on both sides of each place `along`, within `reach` metres, at half of those `up` at least.

    The grid is as in `wall_distances`.
    """
    sides = [wall_distances(cast, spot, along, up, sign) for sign in (-1.0, 1.0)]
    met = [np.isfinite(distances) & (distances <= reach) for distances in sides]
    return np.asarray((met[0] & met[1]).mean(axis=1) >= 0.5)
