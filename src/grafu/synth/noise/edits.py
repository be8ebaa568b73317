"""The defects of real models, as edits of an asset: each edit makes one, and they can be combined.

Ground-truth joints stay as they are unless a part is shifted: then its joint goes with it. `where` names the labels or
part ids that an edit applies to (none: every part). Nothing is drawn at random.

Boards drawn as single sheets do not come loose: a sheet has its place on the board's outer face; where that would tear
the furniture apart, on the inner one. Whether parts touch is judged by their boxes.
"""

from collections.abc import Callable, Collection
from dataclasses import replace
from itertools import pairwise
from typing import Final

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, translation
from grafu.synth.pieces.riding import busy_in, moving_with
from grafu.vocabulary import PartLabel


def with_sheets(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns boards as single sheets: of each part only the faces of its outer side are left.

    The outer side is that of the thin axis which looks away from the object's middle.
    """
    middle = asset.box.center
    parts = ((as_sheet(p, middle) or p) if _selected(p, where) else p for p in asset.parts)
    return replace(asset, parts=tuple(parts))


def as_sheet(part: Part, middle: Vec3, inner: bool = False) -> Part | None:
    """Returns a board's face that looks away from the middle (`inner`: to it) as a part; None where it has none."""
    thin = part.box.thin_axis
    sign = 1.0 if (part.box.center[thin] >= middle[thin]) != inner else -1.0
    surfaces = (_kept(s, s.mesh.face_normals[:, thin] * sign > 0.5) for s in part.surfaces)
    left = tuple(s for s in surfaces if not s.is_empty)
    return replace(part, surfaces=left) if left else None


def with_open_backs(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns parts as open shells: faces that look to the back (+Y) are gone, as on sides that are not seen."""
    return _edited(asset, where, lambda _, s: _kept(s, s.mesh.face_normals[:, 1] < 0.5))


def with_doubled_faces(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns every face twice, the second time turned over, as two-sided exports have it."""
    return _edited(asset, where, lambda _, s: _with_mesh(s, np.vstack([s.mesh.faces, s.mesh.faces[:, ::-1]])))


def with_inverted_normals(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns every face turned over: solids look inwards."""
    return _edited(asset, where, lambda _, s: _with_mesh(s, s.mesh.faces[:, ::-1]))


def with_degenerate_faces(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns surfaces with faces without area added: two corners alike, and three corners in a line."""

    def degenerate(_: Part, surface: Surface) -> Surface:
        first = surface.mesh.faces[:4]
        return _with_mesh(surface, np.vstack([surface.mesh.faces, first[:, [0, 1, 1]], first[:, [2, 2, 2]]]))

    return _edited(asset, where, degenerate)


def with_loose_faces(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns every face as a shell of its own: no two share a vertex."""

    def loose(_: Part, surface: Surface) -> Surface:
        index = surface.mesh.faces.ravel()
        mesh = TriangleMesh(surface.mesh.vertices[index], np.arange(len(index)).reshape(-1, 3))
        return replace(surface, mesh=mesh, uv=None if surface.uv is None else surface.uv[index])

    return _edited(asset, where, loose)


def with_many_shells(asset: Asset, boards: int, where: Collection[str] = ()) -> Asset:
    """Returns parts whose every board became `boards` boxes side by side along its longest side.

    Raises:
        ValueError: if `boards` is less than 1.
    """
    if boards < 1:
        raise ValueError(f"`boards` must be at least 1: got {boards}")

    def split(part: Part) -> Part:
        surfaces = [replace(s, mesh=mesh, uv=None) for s in part.surfaces for mesh in _slices(s.mesh.box, boards)]
        return replace(part, surfaces=tuple(surfaces))

    return replace(asset, parts=tuple(split(p) if _selected(p, where) else p for p in asset.parts))


def with_merged(asset: Asset, where: Collection[str], name: str = "body") -> Asset:
    """Returns the selected parts as one part without a label, as where an artist joined a whole case.

    Raises:
        ValueError: if fewer than two parts, or one that moves or carries others, are selected.
    """
    merged = [p for p in asset.parts if _selected(p, where)]
    moving = busy_in(asset)
    if len(merged) < 2 or any(p.id in moving or p.carried_by for p in merged):
        raise ValueError(f"`where` must select two or more still parts: got {[p.id for p in merged]}")
    body = Part(name, PartLabel.UNKNOWN, tuple(s for p in merged for s in p.surfaces), PartSource(name))
    return replace(asset, parts=(body, *(p for p in asset.parts if p not in merged)))


def with_shifted(asset: Asset, part_id: str, offset: Vec3) -> Asset:
    """Returns the asset with one part, its joint and its attached parts shifted: floating, or sunk into a neighbour."""
    T, moving = translation(offset), moving_with(asset, part_id)

    def shifted(joints: tuple[AnnotatedJoint, ...]) -> tuple[AnnotatedJoint, ...]:
        return tuple(
            replace(j, axis=motion_kind(j.type).mapped_axis(j.axis, T)) if j.part in moving else j for j in joints
        )

    parts = (
        replace(p, surfaces=tuple(s.transformed(T) for s in p.surfaces)) if p.id in moving else p for p in asset.parts
    )
    joints, small = shifted(asset.joints), shifted(asset.small_joints)
    return replace(asset, parts=tuple(parts), joints=joints, small_joints=small)


def with_swollen(asset: Asset, part_id: str, margin: Vec3) -> Asset:
    """Returns the asset with one part grown by `margin` metres to both sides of each axis: it interpenetrates."""
    box = asset.part(part_id).box
    factors = 1.0 + np.asarray(margin) / np.maximum(box.half, 1e-9)
    T = from_rotation(np.diag(factors), box.center * (1.0 - factors))

    def stretched(surface: Surface) -> Surface:
        return Surface(surface.mesh.transformed(T), surface.material, surface.uv)

    return _edited(asset, (part_id,), lambda _, s: stretched(s))


def with_labels_lost(asset: Asset, where: Collection[str] = ()) -> Asset:
    """Returns the selected parts without their labels, and named as modelling programs name things."""
    parts = (
        replace(p, label=PartLabel.UNKNOWN, labelled_by="none", source=replace(p.source, name=f"Cube.{k:03d}"))
        if _selected(p, where)
        else p
        for k, p in enumerate(asset.parts)
    )
    return replace(asset, parts=tuple(parts))


def without_parts(asset: Asset, where: Collection[str]) -> Asset:
    """Returns the asset without the selected parts, what rides on them, and the joints of all these."""
    gone = {i for p in asset.parts if _selected(p, where) for i in moving_with(asset, p.id)}

    def left(joints: tuple[AnnotatedJoint, ...]) -> tuple[AnnotatedJoint, ...]:
        kept = (joint for joint in joints if joint.part not in gone)
        return tuple(replace(j, coupling=None) if j.coupling and j.coupling.leader in gone else j for j in kept)

    kept = tuple(p for p in asset.parts if p.id not in gone)
    return replace(asset, parts=kept, joints=left(asset.joints), small_joints=left(asset.small_joints))


def _selected(part: Part, where: Collection[str]) -> bool:
    return not where or part.id in where or part.label in where


def _edited(asset: Asset, where: Collection[str], edit: Callable[[Part, Surface], Surface]) -> Asset:
    """Returns the asset with the selected parts' surfaces edited; a part that would lose all its faces is kept."""
    parts = []
    for part in asset.parts:
        surfaces = tuple(edit(part, s) for s in part.surfaces) if _selected(part, where) else part.surfaces
        left = tuple(s for s in surfaces if not s.is_empty)
        parts.append(replace(part, surfaces=left) if left else part)
    return replace(asset, parts=tuple(parts))


def _kept(surface: Surface, keep: np.ndarray) -> Surface:
    """Returns the surface with the selected faces, and the vertices and UVs that they use."""
    used, index = np.unique(surface.mesh.faces[keep], return_inverse=True)
    mesh = TriangleMesh(surface.mesh.vertices[used], index.reshape(-1, 3))
    return Surface(mesh, surface.material, None if surface.uv is None else surface.uv[used])


def _with_mesh(surface: Surface, faces: np.ndarray) -> Surface:
    return replace(surface, mesh=TriangleMesh(surface.mesh.vertices, faces))


def _slices(box: Box, count: int) -> list[TriangleMesh]:
    axis = int(np.argmax(box.size))
    cuts = np.linspace(box.low[axis], box.high[axis], count + 1)
    boxes = []
    for start, end in pairwise(cuts.tolist()):
        low, high = vec3(*box.low), vec3(*box.high)
        low[axis], high[axis] = start, end
        boxes.append(TriangleMesh.box_mesh(Box(low, high)))
    return boxes


REACH: Final = 0.0045  # fraction of the object's largest side within which boxes touch: a little less than in graphs


def with_anchored_sheets(asset: Asset, where: Collection[str]) -> Asset:
    """Returns the named boards as sheets of their outer or inner face; where neither holds, they stay boards."""
    parts, middle, reach = list(asset.parts), asset.box.center, REACH * asset.extent
    low, high = np.array([p.box.low for p in parts]), np.array([p.box.high for p in parts])
    touching = np.array([_touched(Box(a, b), low, high, reach) for a, b in zip(low, high, strict=True)])
    groups = _groups(touching)
    for k, part in enumerate(asset.parts):
        if part.id not in where:
            continue
        for inner in (False, True):
            sheet = as_sheet(part, middle, inner)
            if sheet is None:
                continue
            tried = touching.copy()
            tried[k] = tried[:, k] = _touched(sheet.box, low, high, reach)
            tried[k, k] = True
            if _groups(tried) <= groups:
                parts[k], touching = sheet, tried
                low[k], high[k] = sheet.box.low, sheet.box.high
                break
    return replace(asset, parts=tuple(parts))


def _touched(box: Box, low: np.ndarray, high: np.ndarray, reach: float) -> np.ndarray:
    return np.asarray((np.maximum(box.low - high, low - box.high) <= reach).all(axis=1))


def _groups(touching: np.ndarray) -> int:
    """Returns how many groups of parts hang together."""
    left, found = np.ones(len(touching), dtype=bool), 0
    while left.any():
        group = np.zeros(len(touching), dtype=bool)
        edge = np.zeros(len(touching), dtype=bool)
        edge[int(left.argmax())] = True
        while edge.any():
            group |= edge
            edge = touching[edge].any(axis=0) & ~group
        left &= ~group
        found += 1
    return found
