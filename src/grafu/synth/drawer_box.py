"""The boxes behind drawer fronts: whole, without a bottom, a bare shell, or none. It knows no cabinet."""

import numpy as np

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.layout import DrawerBox, Rect
from grafu.synth.shapes import board

_SHELL_FACES = np.array([0, 1, 6, 7, 8, 9, 10, 11])  # of a box mesh: bottom, back, left and right


def drawer_box(kind: DrawerBox, inner: Rect, depth: tuple[float, float]) -> tuple[TriangleMesh, ...]:
    """Returns the boards of a drawer box between two values of y; its front is the drawer's own front."""
    if kind == "front only":
        return ()
    if kind == "shell":
        return (_shell(inner, depth),)
    wall = min(0.012, inner.width / 8, inner.height / 4)
    boards = _walls(inner, depth, wall)
    return boards if kind == "no bottom" else (*boards, _bottom(inner, depth, wall))


def _walls(r: Rect, depth: tuple[float, float], wall: float) -> tuple[TriangleMesh, ...]:
    y0, y1 = depth
    return (
        board((r.x0, y0, r.z0), (r.x0 + wall, y1, r.z1)),
        board((r.x1 - wall, y0, r.z0), (r.x1, y1, r.z1)),
        board((r.x0 + wall, y1 - wall, r.z0), (r.x1 - wall, y1, r.z1)),
    )


def _bottom(r: Rect, depth: tuple[float, float], wall: float) -> TriangleMesh:
    return board((r.x0 + wall, depth[0], r.z0), (r.x1 - wall, depth[1] - wall, r.z0 + wall / 2))


def _shell(r: Rect, depth: tuple[float, float]) -> TriangleMesh:
    """Returns a sheet without thickness, open on top and in front, as many real models have."""
    whole = TriangleMesh.box_mesh(Box(vec3(r.x0, depth[0], r.z0), vec3(r.x1, depth[1], r.z1)))
    return whole.with_faces(_SHELL_FACES)
