"""How modellers cut furniture into parts: panels joined, panels in several parts, handles within doors. Pure edits.

Each returns a new asset with the same surfaces in the same places; joints stay with the part that keeps the name.
"""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.components import connected_parts
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.riding import busy_in
from grafu.vocabulary import PartLabel

_FRONT_ZONE = 0.03  # metres behind a drawer's front within which its boards belong to the front itself


def with_joined(asset: Asset, ids: Collection[str], label: PartLabel, name: str) -> Asset:
    """Returns still parts joined to one with this label, at the place of the first of them.

    Raises:
        ValueError: if fewer than two parts, or one that moves or carries others, are named.
    """
    joined = [p for p in asset.parts if p.id in ids]
    busy = busy_in(asset)
    if len(joined) < 2 or any(p.id in busy or p.carried_by for p in joined):
        raise ValueError(f"`ids` must name two or more still parts: got {[p.id for p in joined]}")
    body = Part(name, label, tuple(s for p in joined for s in p.surfaces), PartSource(name), "annotation")
    parts = tuple(body if p is joined[0] else p for p in asset.parts if p is joined[0] or p not in joined)
    return replace(asset, parts=parts)


def with_attached_joined(asset: Asset, ids: Collection[str]) -> Asset:
    """Returns the named attached parts as geometry of what carries them: a handle in its door is no part any more.

    Nor does a lever turn by itself there.
    """
    attached = [p for p in asset.parts if p.id in ids and p.carried_by]
    gone = {p.id for p in attached}
    parts = []
    for part in asset.parts:
        own = [s for other in attached if other.carried_by == part.id for s in other.surfaces]
        if part.id not in gone:
            parts.append(replace(part, surfaces=(*part.surfaces, *own)) if own else part)
    small = tuple(joint for joint in asset.small_joints if joint.part not in gone)
    return replace(asset, parts=tuple(parts), small_joints=small)


MOST_PIECES = 4  # of a handle that is drawn in pieces: a bar and its posts, a knob and its plate


def with_handles_in_pieces(asset: Asset, kept: Collection[str] = ()) -> Asset:
    """Returns the asset with each connected piece of a handle as a part of its own, those `kept` as they are.

    The first piece keeps the handle's id; a lever that turns by itself stays whole.
    """
    whole = busy_in(asset) | set(kept)
    parts: list[Part] = []
    for part in asset.parts:
        pieces = _handle_pieces(part) if part.id not in whole else [part.surfaces]
        ids = [part.id, *(f"{part.id}_piece_{k}" for k in range(1, len(pieces)))]
        parts += [replace(part, id=i, source=PartSource(i), surfaces=s) for i, s in zip(ids, pieces, strict=True)]
    return replace(asset, parts=tuple(parts))


def _handle_pieces(part: Part) -> list[tuple[Surface, ...]]:
    if part.label is not PartLabel.HANDLE or part.carried_by is None:
        return [part.surfaces]
    pieces = [replace(s, mesh=mesh) for s in part.surfaces if s.uv is None for mesh in connected_parts(s.mesh)]
    fits = 1 < len(pieces) <= MOST_PIECES and all(s.uv is None for s in part.surfaces)
    return [(piece,) for piece in pieces] if fits else [part.surfaces]


def in_pieces(asset: Asset, part_id: str, label: PartLabel | None = None) -> Asset:
    """Returns the asset with each surface of a still part as a part of its own (a face frame as bars)."""
    return _replaced(asset, part_id, lambda part: [(label or part.label, (s,)) for s in part.surfaces])


def in_planks(asset: Asset, part_id: str, count: int, axis: int) -> Asset:
    """Returns the asset with a plain board cut square to an axis into `count` boards, each a part.

    A part that is no plain board stays as it is.
    """

    def cut(part: Part) -> list[tuple[PartLabel, tuple[Surface, ...]]]:
        if not is_board(part):
            return []
        edges = np.linspace(part.box.low[axis], part.box.high[axis], count + 1)
        material = part.surfaces[0].material
        slices = [_slice(part.box, axis, float(a), float(b)) for a, b in pairwise(edges)]
        return [(part.label, (surface_of(TriangleMesh.box_mesh(box), material),)) for box in slices]

    return _replaced(asset, part_id, cut)


def with_edge_strip(asset: Asset, part_id: str, width: float) -> Asset:
    """Returns the asset with the front `width` metres of a plain board as a strip of its own (misc)."""

    def cut(part: Part) -> list[tuple[PartLabel, tuple[Surface, ...]]]:
        box = part.box
        if not is_board(part) or box.size[1] < 3 * width:
            return []
        seam = float(box.low[1] + width)
        halves = (_slice(box, 1, seam, float(box.high[1])), _slice(box, 1, float(box.low[1]), seam))
        material = part.surfaces[0].material
        made = [(surface_of(TriangleMesh.box_mesh(half), material),) for half in halves]
        return [(part.label, made[0]), (PartLabel.MISC, made[1])]

    return _replaced(asset, part_id, cut)


def with_box_apart(asset: Asset, drawer_id: str) -> Asset:
    """Returns the asset with a drawer's boards behind its front as parts of their own that ride on the front.

    They are labelled misc: none of them is a panel of the case. Boards that do not reach the front stay with one that
    does. A drawer that is a front alone stays as it is.
    """
    drawer, behind = asset.part(drawer_id), _behind_front(asset, drawer_id)
    loose = [s for s, gap in behind if gap > _FRONT_ZONE]
    held = [s for s, gap in behind if gap <= _FRONT_ZONE]
    if not held:
        return asset
    kept = tuple(s for s in drawer.surfaces if not any(s is board for board, _ in behind))
    ids = fresh_ids(asset, f"{drawer_id}_board", len(held))
    boards = [
        Part(i, PartLabel.MISC, (s, *(loose if s is held[-1] else ())), PartSource(i), "annotation", drawer_id)
        for i, s in zip(ids, held, strict=True)
    ]
    parts: list[Part] = []
    for part in asset.parts:
        parts += [replace(part, surfaces=kept), *boards] if part is drawer else [part]
    return replace(asset, parts=tuple(parts))


def with_front_alone(asset: Asset, drawer_id: str) -> Asset:
    """Returns the asset with nothing left of a drawer but its front: what was drawn of it where only the outside is."""
    drawer, behind = asset.part(drawer_id), _behind_front(asset, drawer_id)
    kept = tuple(s for s in drawer.surfaces if not any(s is board for board, _ in behind))
    return replace(asset, parts=tuple(replace(p, surfaces=kept) if p is drawer else p for p in asset.parts))


def _behind_front(asset: Asset, drawer_id: str) -> list[tuple[Surface, float]]:
    """Returns a drawer's surfaces behind its front, with how far each begins behind it, metres; none of a front alone.

    A part that does not slide, and one all of whose surfaces lie behind, has none.
    """
    slides = [j.axis.direction for j in asset.joints if j.part == drawer_id and motion_kind(j.type).slides]
    if not slides:
        return []
    drawer, slide = asset.part(drawer_id), slides[0]
    front = float((drawer.mesh.vertices @ slide).max())
    behind = [s for s in drawer.surfaces if front - float(s.mesh.box.center @ slide) > _FRONT_ZONE]
    if len(behind) == len(drawer.surfaces):
        return []
    return [(s, front - float((s.mesh.vertices @ slide).max())) for s in behind]


def is_board(part: Part) -> bool:
    """Whether a part is one plain box: one surface of twelve faces whose vertices are its box's corners."""
    if len(part.surfaces) != 1 or len(part.surfaces[0].mesh.faces) != 12:
        return False
    box, vertices = part.box, part.surfaces[0].mesh.vertices
    return bool(np.all(np.minimum(np.abs(vertices - box.low), np.abs(vertices - box.high)) < 1e-6))


def fresh_ids(asset: Asset, stem: str, count: int) -> list[str]:
    """Returns ids that no part of the asset has: the stem, numbered."""
    taken = {part.id for part in asset.parts}
    start = 1
    while any(f"{stem}_{k}" in taken for k in range(start, start + count)):
        start += count
    return [f"{stem}_{k}" for k in range(start, start + count)]


def _replaced(
    asset: Asset, part_id: str, cut: Callable[[Part], Sequence[tuple[PartLabel, tuple[Surface, ...]]]]
) -> Asset:
    """Returns the asset with a still part in pieces; where there are fewer than two, or the part moves, as it was."""
    busy = busy_in(asset)
    part = asset.part(part_id)
    pieces = [] if part_id in busy or part.carried_by else list(cut(part))
    if len(pieces) < 2:
        return asset
    ids = fresh_ids(asset, f"{part_id}_piece", len(pieces))
    made = [Part(i, label, s, PartSource(i), "annotation") for i, (label, s) in zip(ids, pieces, strict=True)]
    parts: list[Part] = []
    for other in asset.parts:
        parts += made if other is part else [other]
    return replace(asset, parts=tuple(parts))


def _slice(box: Box, axis: int, start: float, end: float) -> Box:
    low, high = vec3(*box.low.tolist()), vec3(*box.high.tolist())
    low[axis], high[axis] = start, end
    return Box(low, high)
