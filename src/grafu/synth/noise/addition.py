"""A part that is to be added to furniture, and plain shapes for it. It knows no furniture."""

from dataclasses import dataclass
from typing import final

import numpy as np

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class Addition:
    """A part to be: `fits` says that it must keep out of still parts, too; `rides_on` names what carries it."""

    label: PartLabel
    stem: str
    mesh: TriangleMesh
    fits: bool = False
    rides_on: str | None = None


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> TriangleMesh:
    """Returns the closed box between two opposite corners."""
    return TriangleMesh.box_mesh(Box(np.minimum(low, high), np.maximum(low, high)))


def sheet_of(box: Box) -> TriangleMesh:
    """Returns a box without depth along y as two triangles."""
    (x0, y, z0), (x1, _, z1) = box.low.tolist(), box.high.tolist()
    corners = np.array([(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)])
    return TriangleMesh(corners, np.array([[0, 1, 2], [0, 2, 3]]))
