"""Surfaces of several materials taken as one body: which faces bound solids, which are mere sheets, and cutting it.

Closed patches are cut by manifold3d in double precision and stay closed; every face that is left keeps the texture
coordinates, normals and colours of the face that it comes from. Sheets are clipped.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import manifold3d
import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface, joined, selected
from grafu.geometry.arrays import ArrayValue, Faces, Indices, Mask, Points, distinct, freeze_arrays
from grafu.geometry.box import Box
from grafu.geometry.components import patches_of, welded
from grafu.geometry.mesh import TriangleMesh, merge_meshes, triangle_bounds
from grafu.geometry.solids import ConvexSolid, subtract
from grafu.shapes import Bool, Int

_NOTHING = 1e-12  # of a patch's volume: what the boolean takes away by rounding


@final
@dataclass(frozen=True, eq=False)
class Bodywork(ArrayValue):
    """The distinct faces of some surfaces.

    `faces` index `mesh`, all surfaces as one, and are turned as `patches_of` states; `source` is the face of `mesh`
    that each looks like, `is_turned` whether that one is drawn the other way round; `owner` is the surface of each face
    of `mesh`, and `group` numbers the faces of `mesh` that lie on the same three corners as one of `faces` (-1: none).
    """

    surfaces: tuple[Surface, ...]
    mesh: TriangleMesh
    owner: Int[np.ndarray, " drawn"]
    group: Int[np.ndarray, " drawn"]
    faces: Int[np.ndarray, "kept 3"]
    patch: Int[np.ndarray, " kept"]
    closed: Bool[np.ndarray, " patches"]
    source: Int[np.ndarray, " kept"]
    is_turned: Bool[np.ndarray, " kept"]

    def __post_init__(self) -> None:
        freeze_arrays(self)

    @property
    def is_solid(self) -> Mask:
        """Whether each of `faces` bounds a solid."""
        return self.closed[self.patch]

    @classmethod
    def of(cls, surfaces: Sequence[Surface]) -> "Bodywork":
        """Returns the bodywork of some surfaces."""
        mesh = merge_meshes([s.mesh for s in surfaces])
        owner = np.repeat(np.arange(len(surfaces)), [len(s.mesh.faces) for s in surfaces])
        patches = patches_of(mesh)
        place = welded(mesh.vertices) if len(mesh.vertices) else np.zeros(0, np.int64)
        drawn, kept = place[mesh.faces], place[patches.faces]
        group = _groups(drawn, kept)
        source, is_turned = _sources(drawn, kept, group)
        faces, patch, closed = np.array(patches.faces), np.array(patches.patch), np.array(patches.closed)
        return cls(tuple(surfaces), mesh, owner, group, faces, patch, closed, source, is_turned)


@final
@dataclass(frozen=True)
class CutOut:
    """What cutting left.

    `surfaces` are the given ones in their order, less what went; `wall` the faces of the cut, which look into the
    hollow. `skin` is the surface that lost most, `area` how much of all surfaces went (square metres), `volume` what
    the solids lost (cubic metres), `is_whole` whether no solid fell apart.
    """

    surfaces: tuple[Surface, ...]
    wall: TriangleMesh
    skin: int
    area: float
    volume: float
    is_whole: bool


@final
@dataclass(frozen=True, eq=False)
class _CutPatch:
    """One patch after the cut: faces that are left, each one's place in `Bodywork.faces`, and those of the cut."""

    vertices: Points
    faces: Int[np.ndarray, "m 3"]
    origin: Int[np.ndarray, " m"]
    wall: Int[np.ndarray, "w 3"]
    volume: float
    is_whole: bool


def cut_out(body: Bodywork, solids: Sequence[ConvexSolid], union: TriangleMesh | None = None) -> CutOut:
    """Returns the body without what lies inside the solids.

    `union` is the watertight surface around all solids, where it is known: worked out, that of solids which touch in
    many corners has slivers.
    """
    closed = [(union.vertices, union.faces)] if union is not None else [(s.vertices, s.faces) for s in solids]
    cutter = manifold3d.Manifold.batch_boolean([_manifold(*one) for one in closed], manifold3d.OpType.Add)
    box = Box.around(np.vstack([s.vertices for s in solids]))
    cuts: list[_CutPatch] = []
    is_cut, is_sheet = np.zeros(len(body.closed), dtype=bool), ~body.closed
    for number in np.flatnonzero(body.closed & _meet(body, box)):
        solid = _solid(body, int(number))
        cut = _cut_patch(body, int(number), solid, cutter) if solid else None
        is_sheet[number] = solid is None
        if cut is not None:
            is_cut[number] = True
            cuts.append(cut)
    patch = np.where(body.group >= 0, body.patch[body.group], -1)  # faces without area are sheets
    is_cut, is_sheet = np.append(is_cut, False)[patch], np.append(is_sheet, True)[patch]
    left = [_left(body, k, is_cut, is_sheet, cuts, solids) for k in range(len(body.surfaces))]
    surfaces, lost = tuple(surface for surface, _ in left), np.array([area for _, area in left])
    wall = merge_meshes([TriangleMesh(cut.vertices, cut.wall) for cut in cuts])
    wall = wall.with_faces(np.arange(len(wall.faces)))
    volume = sum((cut.volume for cut in cuts), 0.0)
    return CutOut(surfaces, wall, int(lost.argmax()), float(lost.sum()), volume, all(cut.is_whole for cut in cuts))


def _meet(body: Bodywork, box: Box) -> Mask:
    """Returns which patches' boxes share a point with a box."""
    low, high = np.full((len(body.closed), 3), np.inf), np.full((len(body.closed), 3), -np.inf)
    lows, highs = triangle_bounds(body.mesh.vertices[body.faces])
    np.minimum.at(low, body.patch, lows)
    np.maximum.at(high, body.patch, highs)
    return np.asarray(np.all((low <= box.high) & (high >= box.low), axis=1))


def _groups(drawn: Int[np.ndarray, "d 3"], kept: Int[np.ndarray, "k 3"]) -> Indices:
    """Returns for each drawn face the kept face on the same three positions, -1 where there is none."""
    count = int(drawn.max()) + 1 if len(drawn) else 1
    weight = np.array([count * count, count, 1])
    keys, kept_keys = np.sort(drawn, axis=1) @ weight, np.sort(kept, axis=1) @ weight
    order = np.argsort(kept_keys)
    at = np.searchsorted(kept_keys[order], keys)
    at = np.minimum(at, max(len(kept) - 1, 0))
    found = order[at] if len(kept) else np.zeros(len(keys), np.int64)
    return np.where(kept_keys[found] == keys, found, -1) if len(kept) else np.full(len(keys), -1)


def _sources(
    drawn: Int[np.ndarray, "d 3"], kept: Int[np.ndarray, "k 3"], group: Int[np.ndarray, " d"]
) -> tuple[Int[np.ndarray, " k"], Bool[np.ndarray, " k"]]:
    """Returns for each kept face the first drawn face in its place, the same way round if there is one; is it not?"""
    sense, kept_sense = _sense(drawn), _sense(kept)
    known = np.flatnonzero(group >= 0)[::-1]
    first = np.full((len(kept), 2), -1)
    first[group[known], sense[known]] = known
    rows = np.arange(len(kept))
    alike, other = first[rows, kept_sense], first[rows, 1 - kept_sense]
    return np.where(alike >= 0, alike, other), alike < 0


def _sense(corners: Faces) -> Indices:
    """Returns 0 or 1: which of the two ways round each face names its three corners."""
    ascents = (corners < np.roll(corners, -1, axis=1)).sum(axis=1)
    return np.asarray(ascents == 2, dtype=np.int64)


def _manifold(vertices: Points, faces: Faces) -> manifold3d.Manifold:
    return manifold3d.Manifold(
        manifold3d.Mesh64(
            np.array(vertices, dtype=np.float64, order="C"),  # a copy: manifold3d takes no read-only arrays
            np.array(faces, dtype=np.uint64, order="C"),
            run_index=np.array([0, 3 * len(faces)], dtype=np.uint64),
            run_original_id=np.array([manifold3d.Manifold.reserve_ids(1)], dtype=np.uint32),
            face_id=np.arange(len(faces), dtype=np.uint64),
        )
    )


def _solid(body: Bodywork, number: int) -> manifold3d.Manifold | None:
    """Returns a closed patch, its faces in order; None where manifold3d does not accept it."""
    faces = body.faces[body.patch == number]
    used = distinct(faces)
    place = welded(body.mesh.vertices[used])
    first = np.unique(place, return_index=True)[1]
    spot = np.zeros(len(body.mesh.vertices), np.int64)
    spot[used] = place
    solid = _manifold(body.mesh.vertices[used[first]], spot[faces])
    return solid if solid.status() == manifold3d.Error.NoError and solid.volume() > 0 else None


def _cut_patch(
    body: Bodywork, number: int, solid: manifold3d.Manifold, cutter: manifold3d.Manifold
) -> _CutPatch | None:
    """Returns a patch after the cut, None where nothing of it goes."""
    left = solid - cutter
    lost = float(solid.volume() - left.volume())
    if lost <= _NOTHING * solid.volume():
        return None
    mesh = left.to_mesh64()
    triangles = np.asarray(mesh.tri_verts, np.int64)
    runs = np.asarray(mesh.run_index, np.int64)
    ids = np.repeat(np.asarray(mesh.run_original_id), (runs[1:] - runs[:-1]) // 3)
    own = np.isin(ids, np.asarray(solid.to_mesh64().run_original_id))
    origin = np.flatnonzero(body.patch == number)[np.asarray(mesh.face_id, np.int64)[own]]
    vertices = np.asarray(mesh.vert_properties, np.float64)[:, :3]
    is_whole = len(left.decompose()) == len(solid.decompose())
    return _CutPatch(vertices, triangles[own], origin, triangles[~own], lost, is_whole)


def _left(
    body: Bodywork, number: int, is_cut: Mask, is_sheet: Mask, cuts: Sequence[_CutPatch], solids: Sequence[ConvexSolid]
) -> tuple[Surface, float]:
    """Returns one surface after the cut (the very same one where nothing of it went), and the area that went."""
    surface, mine = body.surfaces[number], body.owner == number
    gone, sheet = is_cut[mine], is_sheet[mine]
    sheets = selected(surface, np.flatnonzero(sheet & ~gone))
    clipped = subtract(sheets, solids) if not sheets.is_empty else sheets
    if not gone.any() and clipped is sheets:
        return surface, 0.0
    kept = selected(surface, np.flatnonzero(~sheet & ~gone))
    pieces = [_redrawn(body, number, cut) for cut in cuts]
    once = is_cut[body.source] & (body.owner[body.source] == number)  # faces drawn twice count once
    before = float(body.mesh.face_areas[body.source[once]].sum()) + sheets.mesh.area
    after = sum((piece.mesh.area for piece in pieces), clipped.mesh.area)
    return joined(surface, [kept, clipped, *pieces]), before - after


def _redrawn(body: Bodywork, number: int, cut: _CutPatch) -> Surface:
    """Returns the faces of a cut patch that come from one surface, with attributes as they were there."""
    surface = body.surfaces[number]
    rows = np.flatnonzero(body.owner[body.source[cut.origin]] == number)
    origin, faces = cut.origin[rows], cut.faces[rows]
    start = int(sum(len(s.mesh.vertices) for s in body.surfaces[:number]))
    first_face = int(sum(len(s.mesh.faces) for s in body.surfaces[:number]))
    theirs = surface.mesh.faces[body.source[origin] - first_face]
    points = cut.vertices[faces]
    ratio = _barycentric(points, body.mesh.vertices[start:][theirs])
    uv = normals = colors = None
    if surface.uv is not None:
        uv = _mixed(ratio, surface.uv[theirs])
    if surface.normals is not None:
        normals = _mixed(ratio, surface.normals[theirs])
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        normals[np.repeat(body.is_turned[origin], 3)] *= -1
    if surface.colors is not None:
        colors = np.clip(np.round(_mixed(ratio, surface.colors[theirs])), 0, 255).astype(np.uint8)
    mesh = TriangleMesh(points.reshape(-1, 3), np.arange(3 * len(rows)).reshape(-1, 3))
    return replace(surface, mesh=mesh, uv=uv, normals=normals, colors=colors)


def _mixed(ratio: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Returns the corners' values, each mixed from three, (3 m, k)."""
    return np.asarray(np.einsum("mck,mkd->mcd", ratio, values.astype(np.float64)).reshape(-1, values.shape[-1]))


def _barycentric(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Returns the weights with which three corners make up points of their triangle, (m, points, 3)."""
    a, b, c = (triangles[:, None, k] for k in range(3))
    cross = np.cross(b - a, c - a)
    area = np.maximum((cross * cross).sum(axis=2), 1e-300)
    weights = np.stack(
        [
            (np.cross(c - b, points - b) * cross).sum(axis=2) / area,
            (np.cross(a - c, points - c) * cross).sum(axis=2) / area,
            (np.cross(b - a, points - a) * cross).sum(axis=2) / area,
        ],
        axis=2,
    )
    weights = np.clip(weights, 0.0, 1.0)
    return np.asarray(weights / np.maximum(weights.sum(axis=2, keepdims=True), 1e-300))
