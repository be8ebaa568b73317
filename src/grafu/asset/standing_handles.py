"""Handles that are one piece with their front, on a surface that was parted into pieces: what stands out of a board.

Where a handle is tells how a front opens. In a scan it is no shell of its own.
"""

from collections.abc import Collection
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.loose import faces_of_part
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, distinct
from grafu.geometry.components import linked, welded
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.shapes import Int
from grafu.vocabulary import PartLabel

_Numbers = Int[np.ndarray, "_"]


@final
@dataclass(frozen=True, slots=True)
class StandingHandleConfig:
    """What of a front is a handle; `out` and `deep` are fractions of the largest side of the piece.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    out: float = 0.01
    """A handle begins so far before the plane of its front: mouldings and raised panels end below ..."""
    deep: float = 0.014
    """... and it reaches so far out at least."""
    slim: float = 0.35
    """Its shorter side, seen from in front, is at most this of the front's shorter side (fraction) ..."""
    large: float = 0.2
    """... and the rectangle around it at most this of the front's (fraction): what is larger is a board in front."""
    most: int = 2
    """A front has as many handles at most: more are decoration, or several fronts are one piece."""

    def __post_init__(self) -> None:
        require_positive(self, "out", "deep", "most")
        require_ratios(self, "slim", "large")


def without_handles(
    part: Part,
    towards: Vec3,
    plane: float,
    extent: float,
    taken: Collection[str],
    config: StandingHandleConfig = StandingHandleConfig(),
) -> tuple[Part, ...]:
    """Returns the front without its handles, and these; the part alone where it has none, or more than a front has.

    Args:
        part: a sheet of a parted surface.
        towards: the direction along an axis that it faces.
        plane: how far in that direction most of it lies, in the unit of its mesh.
        extent: the largest side of the whole piece.
        taken: ids that parts have.
        config: what is a handle.
    """
    mesh = part.mesh
    of_handle = _handles(mesh, towards, plane, extent, config)
    if not 0 < len(of_handle) <= config.most:
        return (part,)
    kept = np.ones(len(mesh.faces), dtype=bool)
    kept[np.concatenate(of_handle)] = False
    names = (name for k in range(1, 10_000) if (name := f"{part.id}_handle" + (f"_{k}" if k > 1 else "")) not in taken)
    front = replace(part, surfaces=faces_of_part(part, np.flatnonzero(kept)))
    handle = replace(part, label=PartLabel.HANDLE, labelled_by="shape", carried_by=part.id)
    made = [
        replace(handle, id=name, surfaces=faces_of_part(part, faces))
        for name, faces in zip(names, of_handle, strict=False)
    ]
    return (front, *made)


def _handles(
    mesh: TriangleMesh, towards: Vec3, plane: float, extent: float, config: StandingHandleConfig
) -> list[_Numbers]:
    """Returns the faces of each handle that stands out of a board."""
    depth = mesh.triangles @ towards - plane
    out = np.flatnonzero(depth.max(axis=1) > config.out * extent)
    if not len(out):
        return []
    corners = welded(mesh.vertices, 1e-6 * extent)[mesh.faces[out]]
    edges = corners.ravel()
    group = linked(int(edges.max()) + 1, edges, np.roll(corners, -1, axis=1).ravel())[corners[:, 0]]
    across = np.flatnonzero(towards == 0)
    board = np.ptp(mesh.vertices[distinct(mesh.faces)][:, across], axis=0)
    found: list[_Numbers] = []
    for k in distinct(group):
        faces = out[group == k]
        points = mesh.triangles[faces].reshape(-1, 3)
        size = np.ptp(points[:, across], axis=0)
        if float((points @ towards).max()) - plane < config.deep * extent:
            continue
        if size.min() > config.slim * board.min() or np.prod(size) > config.large * np.prod(board):
            return []
        found.append(faces)
    return found
