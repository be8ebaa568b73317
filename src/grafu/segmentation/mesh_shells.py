"""The faces of an input's objects sorted into shells, and how these are seen from four sides."""

from collections.abc import Sequence
from functools import cached_property
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Mat3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.shells import shell_numbers
from grafu.segmentation.view import OfShells, RaysFromSides, ShellBounds, ShellsView

_Z = np.array([0.0, 0.0, 1.0])


@final
@dataclass(frozen=True, eq=False)
class MeshShells:
    """All faces of several meshes, the shell of each face, and for each shell the mesh that holds it."""

    mesh: TriangleMesh
    shell: Indices
    owner: OfShells
    rays: RaysFromSides

    @classmethod
    def of(cls, meshes: Sequence[TriangleMesh]) -> "MeshShells":
        """Returns the shells of some meshes."""
        shell = shell_numbers(*meshes)
        of = np.repeat(np.arange(len(meshes)), [len(mesh.faces) for mesh in meshes])
        mesh = merge_meshes(meshes)
        return cls(mesh, shell, of[np.unique(shell, return_index=True)[1]], RaysFromSides.towards(mesh))

    def sorted(self, shell: Indices, owner: OfShells) -> "MeshShells":
        """Returns the same faces sorted otherwise: the number of each face's shell, and the mesh that holds each."""
        return MeshShells(self.mesh, shell, owner, self.rays)

    def parted(self, numbers: Sequence[Indices]) -> "MeshShells":
        """Returns the shells parted by a number of each face, mesh after mesh: that of its material, or of its patch.

        No number is negative.
        """
        number = np.concatenate(numbers)
        pair = self.shell * (int(number.max(initial=0)) + 1) + number
        _, first, shell = np.unique(pair, return_index=True, return_inverse=True)
        if len(first) == len(self.owner):
            return self  # each shell has one number
        return self.sorted(shell.reshape(-1).astype(np.int64), self.owner[self.shell[first]])

    @cached_property
    def _bounds(self) -> ShellBounds:
        return ShellBounds.of(self.mesh, self.shell, len(self.owner))

    def seen(self, axes: Mat3) -> ShellsView:
        """Returns the shells as they are seen against the third row of `axes` (`axes_from`)."""
        key = axes.tobytes()
        if key not in self._views:
            bounds, rays = self._bounds.seen(axes), self.rays.along(axes)
            self._views[key] = ShellsView(self.owner, bounds.low, bounds.high, bounds.faced, self.shell, rays)
        return self._views[key]

    @cached_property
    def _views(self) -> dict[bytes, ShellsView]:
        """The views that were asked for, by their axes."""
        return {}


def axes_from(turn: int) -> Mat3:
    """Returns a viewer's axes: from -Y, +X, +Y or -X."""
    toward = np.round([np.sin(turn * np.pi / 2), -np.cos(turn * np.pi / 2), 0.0])
    return np.stack([np.cross(_Z, toward), _Z, toward])
