"""Meshes that were merged, and bodies that were prepared for sweeps: worked out once for all scenes that share them."""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.geometry.arrays import Mat3
from grafu.geometry.blocks import LARGE
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.swept_body import SweptBody

MOST_SHAPES: Final = 400
"""Merged meshes, or bodies, that are kept: those of some changes of a model with twenty joints."""
MOST_USES: Final = 50
"""Uses after which all is forgotten: each leaves some thousand outcomes of single tests in its bodies."""


@final
class Shapes:
    """What is known of meshes, by which ones they are; not a value. A scene that changes gives its own on."""

    def __init__(self) -> None:
        self._merged: dict[tuple[int, ...], tuple[tuple[TriangleMesh, ...], TriangleMesh]] = {}
        self._boxes: dict[tuple[int, ...], tuple[tuple[TriangleMesh, ...], Box]] = {}
        self._bodies: dict[tuple[int, bytes], tuple[TriangleMesh, SweptBody]] = {}
        self._uses = 0

    def as_one(self, meshes: Sequence[TriangleMesh]) -> TriangleMesh:
        """Returns meshes merged into one: the same one whenever it is asked for."""
        key = tuple(id(mesh) for mesh in meshes)
        if key not in self._merged:
            self._merged[key] = (tuple(meshes), merge_meshes(meshes))
        return self._merged[key][1]

    def box_around(self, meshes: Sequence[TriangleMesh]) -> Box:
        """Returns the box around meshes, which change in few of the scenes that ask."""
        key = tuple(id(mesh) for mesh in meshes)
        if key not in self._boxes:
            self._boxes[key] = (tuple(meshes), Box.enclosing(mesh.box for mesh in meshes))
        return self._boxes[key][1]

    def body(self, mesh: TriangleMesh, depth: float, axes: Mat3) -> SweptBody:
        """Returns a mesh as a body that tells a touch from a penetration deeper than `depth` metres."""
        key = (id(mesh), np.append(axes, depth).tobytes())
        if key not in self._bodies:
            self._bodies[key] = (mesh, SweptBody(mesh, depth, axes))
        return self._bodies[key][1]

    def tidy(self) -> None:
        """Forgets what takes up much room, at the end of a use: large bodies, and all where it is too much."""
        self._uses += 1
        is_much = max(len(self._merged), len(self._bodies)) > MOST_SHAPES or self._uses >= MOST_USES
        self._uses = 0 if is_much else self._uses
        self._merged = {} if is_much else self._merged
        self._boxes = {} if is_much else self._boxes
        small = {} if is_much else self._bodies
        self._bodies = {key: kept for key, kept in small.items() if len(kept[0].faces) <= LARGE}
