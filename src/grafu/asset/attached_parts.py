"""Which door or drawer carries a handle, by contact, where the input does not say."""

from dataclasses import replace

import numpy as np
import trimesh

from grafu.asset.part import Part
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, triangle_bounds
from grafu.vocabulary import PartLabel

# How far a handle may stand off what carries it, in metres: modelling gaps, not real ones.
REACH = 0.01
_MOST_POINTS, _MOST_FACES = 300, 3000


def with_attached(parts: tuple[Part, ...], reach: float = REACH) -> tuple[Part, ...]:
    """Returns the parts, each handle that rides on nothing yet set to ride on the nearest door or drawer in reach.

    A handle that lies nearer to a static part than to any door or drawer rides on nothing.

    Args:
        parts: labelled parts in the object frame.
        reach: the largest gap in metres that counts as contact.
    """
    loose = [p for p in parts if p.label is PartLabel.HANDLE and p.rides_on is None]
    others = [p for p in parts if p.label is not PartLabel.HANDLE]
    if not loose or not any(p.label.is_movable for p in others):
        return parts
    carriers = {p.id: _carrier(p, others, reach) for p in loose}
    return tuple(replace(p, rides_on=carriers[p.id]) if p.id in carriers else p for p in parts)


def _carrier(handle: Part, others: list[Part], reach: float) -> str | None:
    near = [p for p in others if handle.box.overlaps(p.box, reach)]
    movable = [p for p in near if p.label.is_movable]
    if len(near) <= 1 or not movable:
        return movable[0].id if movable else None
    points = _points(handle.mesh)
    region = handle.box.grown(reach)
    gaps = {p.id: surface_gap(points, p.mesh, region) for p in near}
    # Rounding decides nothing: a door wins over a frame that touches the handle as closely.
    best = min(movable, key=lambda p: gaps[p.id])
    nearest = min(gaps.values())
    return best.id if gaps[best.id] <= min(reach, nearest + 0.1 * reach) else None


def _points(mesh: TriangleMesh) -> np.ndarray:
    points = np.vstack([mesh.vertices[np.unique(mesh.faces)], mesh.triangles.mean(axis=1)])
    return points[:: max(1, len(points) // _MOST_POINTS)]


def surface_gap(points: np.ndarray, mesh: TriangleMesh, region: Box) -> float:
    """Returns the least distance of the points from those faces of the mesh whose boxes reach into `region`."""
    low, high = triangle_bounds(mesh.triangles)
    faces = mesh.triangles[np.all((low <= region.high) & (high >= region.low), axis=1)]
    faces = faces[:: max(1, len(faces) // _MOST_FACES)]
    if not len(faces):
        return float("inf")
    least = np.inf
    for chunk in np.array_split(points, max(1, len(points) * len(faces) // 200_000)):
        pairs = np.repeat(faces, len(chunk), axis=0), np.tile(chunk, (len(faces), 1))
        found = trimesh.triangles.closest_point(*pairs)  # type: ignore[no-untyped-call]
        least = min(least, float(np.linalg.norm(found - pairs[1], axis=1).min()))
    return least
