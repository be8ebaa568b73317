"""The boxes behind drawer fronts: whole, of four walls, bottomless, shells, floating, trays, none. No cabinets here.

The tray behind a tilting front, as in shoe cabinets, is lifted as the front tilts about its lower front edge. Whatever
stays within a circle about that pin that reaches the opening's top clears it at every angle.
"""

from dataclasses import replace
from math import sqrt

import numpy as np

from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.fronts.layout import DrawerBox, Rect
from grafu.synth.pieces.shapes import board, prism_along_x

WALL = 0.006  # metres
REACH = 0.28  # metres: as deep as a shoe needs
CLEARANCE = 0.008  # metres below the opening's top


def tray_meshes(inner: Rect, pin: tuple[float, float], behind: float, back: float) -> tuple[TriangleMesh, ...]:
    """Returns two cheeks and an inclined floor between them.

    `inner` is the clear opening in x and z; `pin` the (y, z) that the front turns about; the tray begins at the y
    `behind` the front and stays before `back`.
    """
    low = inner.z0 + 0.01
    radius = inner.z1 - CLEARANCE - pin[1]
    high = low + 0.7 * (inner.z1 - low)
    rise = 0.3 * (high - low)
    reach = min(sqrt(max(radius**2 - (low + rise + WALL - pin[1]) ** 2, 0.0)), REACH)
    end = min(pin[0] + reach, back - 0.01)
    high = min(high, pin[1] + sqrt(max(radius**2 - (behind - pin[0]) ** 2, 0.0)))
    cheek = ((behind, low), (end, low + rise), (end, low + rise + WALL), (behind, high))
    floor = ((behind, low), (end, low + rise), (end, low + rise + WALL), (behind, low + WALL))
    return (
        prism_along_x(cheek, inner.x0, inner.x0 + WALL),
        prism_along_x(cheek, inner.x1 - WALL, inner.x1),
        prism_along_x(floor, inner.x0 + WALL, inner.x1 - WALL),
    )


_SHELL_FACES = np.array([0, 1, 6, 7, 8, 9, 10, 11])  # of a box mesh: bottom, back, left and right
TRAY_RIM = 0.02  # metres that a tray's rim stands above its board
FLOATING = 0.03  # metres that a floating box keeps from its opening's sides


def drawer_box(kind: DrawerBox, inner: Rect, depth: tuple[float, float]) -> tuple[TriangleMesh, ...]:
    """Returns the boards of a drawer box between two values of y; its front is the drawer's own front."""
    if kind == "front only":
        return ()
    if kind == "shell":
        return (_shell(inner, depth),)
    if kind == "tray":
        return _tray(inner, depth)
    if kind == "floating":
        inner = _shrunk(inner, min(FLOATING, inner.width / 5, inner.height / 5))
    wall = min(0.012, inner.width / 8, inner.height / 4)
    if kind == "four walls":
        inner_front = board((inner.x0 + wall, depth[0], inner.z0), (inner.x1 - wall, depth[0] + wall, inner.z1))
        return (inner_front, *_walls(inner, depth, wall), _bottom(inner, (depth[0] + wall, depth[1]), wall))
    boards = _walls(inner, depth, wall)
    return boards if kind == "no bottom" else (*boards, _bottom(inner, depth, wall))


def tray_level(inner: Rect) -> float:
    """Returns the height of a tray's underside: at half height, in low openings at the bottom."""
    return inner.z0 if inner.height < 0.15 else (inner.z0 + inner.z1) / 2


def _walls(r: Rect, depth: tuple[float, float], wall: float) -> tuple[TriangleMesh, ...]:
    y0, y1 = depth
    return (
        board((r.x0, y0, r.z0), (r.x0 + wall, y1, r.z1)),
        board((r.x1 - wall, y0, r.z0), (r.x1, y1, r.z1)),
        board((r.x0 + wall, y1 - wall, r.z0), (r.x1 - wall, y1, r.z1)),
    )


def _bottom(r: Rect, depth: tuple[float, float], wall: float) -> TriangleMesh:
    return board((r.x0 + wall, depth[0], r.z0), (r.x1 - wall, depth[1] - wall, r.z0 + wall / 2))


def _tray(r: Rect, depth: tuple[float, float]) -> tuple[TriangleMesh, ...]:
    """Returns a board with a low rim at its sides and back, at half height where there is room: of keyboard trays."""
    thick = min(0.016, r.height / 3)
    low = tray_level(r)
    rim = replace(r, z0=low, z1=min(low + thick + TRAY_RIM, r.z1))
    floor = board((r.x0 + 0.006, depth[0], low), (r.x1 - 0.006, depth[1] - 0.006, low + thick))
    return (floor, *_walls(rim, depth, 0.006))


def _shell(r: Rect, depth: tuple[float, float]) -> TriangleMesh:
    """Returns a sheet without thickness, open on top and in front, as many real models have."""
    whole = TriangleMesh.box_mesh(Box(vec3(r.x0, depth[0], r.z0), vec3(r.x1, depth[1], r.z1)))
    return whole.with_faces(_SHELL_FACES)


def _shrunk(r: Rect, by: float) -> Rect:
    return Rect(r.x0 + by, r.x1 - by, r.z0 + by, r.z1 - by)
