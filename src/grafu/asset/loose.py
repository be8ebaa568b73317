"""A welded model taken apart: each connected shell of a mesh becomes a part. It reads no files and settles no frame."""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.names import unique_ids
from grafu.asset.part import Part
from grafu.geometry.appearance import Surface, selected
from grafu.geometry.arrays import Indices
from grafu.geometry.box import Box
from grafu.geometry.components import shell_numbers
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.point_distance import point_triangle_distances
from grafu.vocabulary import PartLabel

_TINY = 0.01  # of the whole's largest side: a screw, no part
_TOUCH = 0.002  # of it: this near, a screw lies on a board
_SEEN = 16  # corners of a screw that are measured
_WHOLE = 0.5  # of the whole's box: what fills more names the piece and not a part of it


def shell_count(surfaces: Sequence[Surface]) -> int:
    """Returns how many connected shells some surfaces hold together."""
    numbers = shell_numbers(merge_meshes([surface.mesh for surface in surfaces]))
    return int(numbers.max()) + 1 if len(numbers) else 0


def loose_parts(parts: Sequence[Part], held: Collection[str] = ()) -> tuple[Part, ...]:
    """Returns the parts taken apart into their connected shells, those that are `held` (ids) as they are.

    Tiny shells, under 1 % of the largest side of all, stay with the shell of their part on which or in which they lie.
    Shells keep the name of their part, and its label unless it filled most of the whole: that names the piece.
    """
    if not parts:
        return ()
    whole = Box.enclosing([part.box for part in parts])
    found = [(part, [part.surfaces] if part.id in held else _shells(part, whole)) for part in parts]
    ids = iter(unique_ids((part.id, part.label is PartLabel.HANDLE) for part, shells in found for _ in shells))
    return tuple(
        _renamed(part, next(ids), shells_of, whole) if len(shells) > 1 else replace(part, id=next(ids))
        for part, shells in found
        for shells_of in shells
    )


def _renamed(part: Part, name: str, surfaces: tuple[Surface, ...], whole: Box) -> Part:
    label, by = part.label, part.labelled_by
    if part.box.volume > _WHOLE * whole.volume:
        label, by = PartLabel.UNKNOWN, "none"
    return replace(part, id=name, surfaces=surfaces, label=label, labelled_by=by)


def _shells(part: Part, whole: Box) -> list[tuple[Surface, ...]]:
    """Returns the surfaces of each shell of a part, tiny ones with those that they touch."""
    numbers = shell_numbers(part.mesh)
    count = int(numbers.max()) + 1
    if count == 1:
        return [part.surfaces]
    numbers = _with_hosts(part.mesh, numbers, float(whole.size.max()))
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


def _with_hosts(mesh: TriangleMesh, numbers: Indices, size: float) -> Indices:
    """Returns for each face the number of its shell, or of the shell that its own, a tiny one, touches."""
    triangles = [mesh.triangles[faces] for faces in _by_number(numbers)]
    boxes = [Box.around(corners.reshape(-1, 3)) for corners in triangles]
    large = [k for k, box in enumerate(boxes) if box.size.max() >= _TINY * size]
    host = np.arange(len(boxes))
    for k in set(range(len(boxes))) - set(large):
        near = [other for other in large if boxes[other].overlaps(boxes[k], _TOUCH * size)]
        corners = triangles[k].reshape(-1, 3)
        seen = corners[:: -(-len(corners) // _SEEN)]
        gaps = {n: 0.0 if boxes[n].contains(seen).all() else _gap(seen, triangles[n]) for n in near}
        touched = [n for n in near if gaps[n] <= _TOUCH * size]
        host[k] = min(touched, key=lambda n: (_gap(seen, triangles[n]), n), default=k)
    return host[numbers].astype(np.int64)


def _gap(points: np.ndarray, triangles: np.ndarray) -> float:
    return float(point_triangle_distances(points, triangles).min())
