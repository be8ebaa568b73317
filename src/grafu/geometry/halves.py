"""A mesh cut in two by a plane: open surfaces stay open, and attributes are not kept."""

import numpy as np

from grafu.geometry.arrays import Vec3, renumbered
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Int

_ON_PLANE = 1e-8  # metres


def half_of(mesh: TriangleMesh, normal: Vec3, origin: Vec3) -> TriangleMesh:
    """Returns what lies beyond a plane, on the side of its `normal`; of faces on it, those that look back across it."""
    return _half(mesh, _sides(mesh, normal, origin), normal, origin)


def halves_of(mesh: TriangleMesh, normal: Vec3, origin: Vec3) -> tuple[TriangleMesh, TriangleMesh]:
    """Returns what `half_of` does, and the rest: the same of the opposite normal."""
    side = _sides(mesh, normal, origin)
    return _half(mesh, side, normal, origin), _half(mesh, -side, -normal, origin)


def _sides(mesh: TriangleMesh, normal: Vec3, origin: Vec3) -> Int[np.ndarray, "m 3"]:
    """Returns for each face's corners whether they lie beyond a plane (1), before it (-1) or on it (0)."""
    height = (mesh.vertices - origin) @ normal
    return ((height > _ON_PLANE).astype(np.int8) - (height < -_ON_PLANE).astype(np.int8))[mesh.faces]


def _half(mesh: TriangleMesh, side: Int[np.ndarray, "m 3"], normal: Vec3, origin: Vec3) -> TriangleMesh:
    is_beyond, is_before = side > 0, side < 0
    beyond, before = (each[:, 0].astype(np.int8) + each[:, 1] + each[:, 2] for each in (is_beyond, is_before))
    whole = (before == 0) & ((beyond > 0) | (mesh.face_normals @ normal < 0))
    lone_before, lone_beyond = (before == 1) & (beyond == 2), (beyond == 1) & (before > 0)
    quads, quad_ends = _cut_around(mesh, lone_before, is_before, normal, origin)
    tips, tip_ends = _cut_around(mesh, lone_beyond, is_beyond, normal, origin)
    ends = len(mesh.vertices) + np.arange(2 * (len(quads) + len(tips))).reshape(-1, 2)
    (into, out), (a, b) = ends[: len(quads)].T, ends[len(quads) :].T
    corners = ((quads[:, 1], quads[:, 2], into), (into, out, quads[:, 1]), (tips[:, 0], a, b))
    faces = np.concatenate([mesh.faces[whole], *(np.stack(three, axis=1) for three in corners)])
    points = np.concatenate([mesh.vertices, quad_ends[:, ::-1].reshape(-1, 3), tip_ends.reshape(-1, 3)])
    used, index = renumbered(faces, len(points))
    return TriangleMesh(points[used], index)


def _cut_around(
    mesh: TriangleMesh, cut: np.ndarray, is_lone: np.ndarray, normal: Vec3, origin: Vec3
) -> tuple[np.ndarray, np.ndarray]:
    """Returns the corners of the cut faces, the lone one first, and where a plane cuts the edges from and to it."""
    order = (np.argmax(is_lone[cut], axis=1)[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(mesh.faces[cut], order, axis=1)
    start, end = mesh.vertices[corners[:, [0, 2]]], mesh.vertices[corners[:, [1, 0]]]
    along = end - start
    ratio = ((origin - start) @ normal) / (along @ normal)
    return corners, ratio[..., None] * along + start
