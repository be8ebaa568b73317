"""A welded model taken apart: each connected shell of a mesh becomes a part. It reads no files and settles no frame.

A mesh that holds the handles of several doors and drawers becomes a part for each.
"""

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.names import unique_ids
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface, selected
from grafu.geometry.arrays import Indices, distinct
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh, merge_meshes, triangle_bounds
from grafu.geometry.sampling import point_triangle_distances
from grafu.geometry.shells import shell_numbers
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class LooseConfig:
    """Which shells of a part become parts of their own, and which serve a door or drawer.

    Raises:
        ValueError: if a fraction is not between 0 and 1, or no corner is measured.
    """

    tiny: float = 0.01
    """A shell smaller than this is a screw, no part (fraction of the largest side of all)."""
    touch: float = 0.002
    """This near, a screw lies on a board (fraction of the largest side of all)."""
    seen: int = 16
    """How many corners of a screw are measured."""
    whole: float = 0.5
    """What fills more than this of the box around all names the piece, and not a part of it (fraction)."""
    handle_reach: float = 0.01
    """How far a handle may stand off its front (fraction of the largest side of all)."""

    def __post_init__(self) -> None:
        require_positive(self, "seen")
        require_ratios(self, "tiny", "touch", "whole", "handle_reach")


_DEFAULT = LooseConfig()


def shell_count(surfaces: Sequence[Surface]) -> int:
    """Returns how many connected shells some surfaces hold together."""
    numbers = shell_numbers(merge_meshes([surface.mesh for surface in surfaces]))
    return int(numbers.max()) + 1 if len(numbers) else 0


def _allow(_: int) -> None:
    """Allows any number of parts."""


def loose_parts(
    parts: Sequence[Part],
    held: Collection[str] = (),
    allow: Callable[[int], None] = _allow,
    config: LooseConfig = _DEFAULT,
) -> tuple[Part, ...]:
    """Returns the parts taken apart into their connected shells, those that are `held` (ids) as they are.

    `allow` receives the least number of parts before they are made, and raises where that is too many.
    Tiny shells, under 1 % of the largest side of all, stay with the shell of their part on which or in which they lie.
    Shells keep the name of their part, and its label unless it filled most of the whole: that names the piece.
    """
    if not parts:
        return ()
    whole = Box.enclosing([part.box for part in parts])
    found: list[tuple[Part, list[tuple[Surface, ...]]]] = []
    made = 0
    for part in parts:
        found.append((part, [part.surfaces] if part.id in held else _shells(part, whole, _more(allow, made), config)))
        made += len(found[-1][1])
    ids = iter(unique_ids((part.id, part.label is PartLabel.HANDLE) for part, shells in found for _ in shells))
    return tuple(
        _renamed(part, next(ids), shells_of, config.whole * whole.volume)
        if len(shells) > 1
        else replace(part, id=next(ids))
        for part, shells in found
        for shells_of in shells
    )


def shells_of(part: Part, whole: Box, config: LooseConfig = _DEFAULT) -> list[tuple[Surface, ...]]:
    """Returns the surfaces of each connected shell of a part, tiny ones with those that they touch; see `loose_parts`.

    `whole` is the box around all parts.
    """
    return _shells(part, whole, _allow, config)


def _renamed(part: Part, name: str, surfaces: tuple[Surface, ...], largest: float) -> Part:
    label, by = part.label, part.labelled_by
    if part.box.volume > largest:
        label, by = PartLabel.UNKNOWN, "none"
    return replace(part, id=name, surfaces=surfaces, label=label, labelled_by=by)


def _more(allow: Callable[[int], None], made: int) -> Callable[[int], None]:
    return lambda count: allow(made + count)


def _shells(part: Part, whole: Box, allow: Callable[[int], None], config: LooseConfig) -> list[tuple[Surface, ...]]:
    """Returns the surfaces of each shell of a part, tiny ones with those that they touch."""
    numbers = shell_numbers(part.mesh)
    count = int(numbers.max()) + 1
    if count == 1:
        return [part.surfaces]
    numbers = _with_hosts(part.mesh, numbers, float(whole.size.max()), allow, config)
    allow(len(distinct(numbers)))
    return [faces_of_part(part, faces) for faces in _by_number(numbers) if len(faces)]


def _by_number(numbers: Indices) -> list[np.ndarray]:
    """Returns the faces of each number, in order."""
    order = np.argsort(numbers, kind="stable")
    return np.split(order, np.cumsum(np.bincount(numbers))[:-1])


def faces_of_part(part: Part, faces: Indices) -> tuple[Surface, ...]:
    """Returns some faces, in order and numbered through all surfaces, as surfaces; those without any are left out."""
    bounds = np.cumsum([0, *(len(surface.mesh.faces) for surface in part.surfaces)])
    cuts = np.searchsorted(faces, bounds)
    spans = zip(part.surfaces, bounds[:-1], cuts[:-1], cuts[1:], strict=True)
    return tuple(selected(surface, faces[a:b] - start) for surface, start, a, b in spans if b > a)


def _with_hosts(
    mesh: TriangleMesh, numbers: Indices, size: float, allow: Callable[[int], None], config: LooseConfig
) -> Indices:
    """Returns for each face the number of its shell, or of the shell that its own, a tiny one, touches."""
    corners_of, faces_of = mesh.triangles, _by_number(numbers)
    low, high = _bounds(corners_of, faces_of)
    is_large = (high - low).max(axis=1) >= config.tiny * size
    large = np.flatnonzero(is_large)
    allow(len(large))
    host = np.arange(len(faces_of))
    for k in np.flatnonzero(~is_large):
        apart = np.maximum(low[large] - high[k], low[k] - high[large])
        near = large[(apart <= config.touch * size).all(axis=1)]
        corners = corners_of[faces_of[k]].reshape(-1, 3)
        seen = corners[:: -(-len(corners) // config.seen)]
        triangles = {n: corners_of[faces_of[n]] for n in near}
        inside = {n: bool(np.all((seen >= low[n]) & (seen <= high[n]))) for n in near}
        gaps = {n: 0.0 if inside[n] else _gap(seen, triangles[n]) for n in near}
        touched = [n for n in near if gaps[n] <= config.touch * size]
        host[k] = min(touched, key=lambda n: (_gap(seen, triangles[n]), n), default=k)
    return host[numbers].astype(np.int64)


def _bounds(triangles: np.ndarray, faces_of: Sequence[Indices]) -> tuple[np.ndarray, np.ndarray]:
    """Returns the lowest and the highest corner of each group of faces."""
    low, high = triangle_bounds(triangles)
    order, starts = np.concatenate(faces_of), np.cumsum([0, *(len(faces) for faces in faces_of[:-1])])
    return np.minimum.reduceat(low[order], starts), np.maximum.reduceat(high[order], starts)


def _gap(points: np.ndarray, triangles: np.ndarray) -> float:
    return float(point_triangle_distances(points, triangles).min())


def with_split_handles(parts: tuple[Part, ...], config: LooseConfig = _DEFAULT) -> tuple[tuple[Part, ...], list[str]]:
    """Returns the parts, each handle whose shells lie on several doors and drawers split between them, and notes.

    Every shell goes to the door or drawer that is nearest to its middle. A handle in one piece stays whole.
    """
    fronts = [part for part in parts if part.label.is_movable]
    if len(fronts) < 2:
        return parts, []
    reach = config.handle_reach * float(Box.enclosing(part.box for part in parts).size.max())
    taken = {part.id for part in parts}
    found: list[Part] = []
    notes: list[str] = []
    for part in parts:
        pieces = (
            _split_handle(part, fronts, reach, taken)
            if part.label is PartLabel.HANDLE and part.carried_by is None
            else []
        )
        found += pieces or [part]
        taken |= {piece.id for piece in pieces}
        if pieces:
            notes.append(f"{part.source.name} serves {len(pieces)} doors and drawers: split between them")
    return tuple(found), notes


def _split_handle(handle: Part, fronts: list[Part], reach: float, taken: Collection[str]) -> list[Part]:
    """Returns the handle in a piece for each front that it serves, empty where it serves one or is one piece."""
    near = [front for front in fronts if front.box.overlaps(handle.box, reach)]
    shells = loose_parts([handle]) if len(near) > 1 else ()
    if len(shells) < 2:
        return []
    ratios: dict[str, list[Part]] = {}
    for shell in shells:
        ratios.setdefault(min(near, key=lambda front: _box_distance(shell.box, front.box)).id, []).append(shell)
    if len(ratios) < 2:
        return []
    names = (name for k in range(1, 10_000) if (name := f"{handle.id}_{k}") not in taken)
    return [
        replace(handle, id=name, surfaces=tuple(s for shell in of for s in shell.surfaces), carried_by=front)
        for name, (front, of) in zip(names, ratios.items(), strict=False)
    ]


def _box_distance(shell: Box, front: Box) -> float:
    """Returns how far the middle of a box lies from another box."""
    return float(np.linalg.norm(np.maximum(np.maximum(front.low - shell.center, shell.center - front.high), 0.0)))
