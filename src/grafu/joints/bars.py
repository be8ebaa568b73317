"""Slim straight bars among the shells of a mesh: their ends and widths. They are any bars: arms, stays, rods, rails."""

from collections.abc import Iterator
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Vec3, distinct, freeze_arrays
from grafu.geometry.components import connected_parts
from grafu.geometry.mesh import TriangleMesh


@final
@dataclass(frozen=True, eq=False, slots=True)
class Bar(ArrayValue):
    """A slim shell: the middles of its two ends (object frame) and its width there, metres."""

    start: Vec3
    end: Vec3
    width: float

    def __post_init__(self) -> None:
        freeze_arrays(self, "start", "end")

    @property
    def length(self) -> float:
        """How long it is."""
        return float(np.linalg.norm(self.end - self.start))

    @property
    def direction(self) -> Vec3:
        """The unit direction from its start to its end."""
        return np.asarray((self.end - self.start) / max(self.length, 1e-12))

    @property
    def center(self) -> Vec3:
        """Its middle."""
        return np.asarray((self.start + self.end) / 2)

    def pivots(self) -> tuple[Vec3, Vec3]:
        """Returns where pins through its ends are: half its width before either."""
        inset = self.direction * (self.width / 2)
        return np.asarray(self.start + inset), np.asarray(self.end - inset)


def bars_of(mesh: TriangleMesh, slim: float) -> Iterator[Bar]:
    """Yields the shells of a mesh that are at least `slim` times as long as wide, from their lower end up."""
    for shell in connected_parts(mesh):
        points = shell.vertices[distinct(shell.faces)]
        if len(points) <= points.shape[1]:
            continue
        middle = points.mean(axis=0)
        along = np.linalg.svd(points - middle, full_matrices=False)[2]
        local = (points - middle) @ along.T
        low, high = local.min(axis=0), local.max(axis=0)
        size = high - low
        if size[0] < slim * max(size[1], 1e-9):
            continue
        center = middle + (low + high) / 2 @ along
        half = along[0] * (size[0] / 2)
        half = half if half[2] >= 0 else -half
        yield Bar(center - half, center + half, float(size[1]))
