"""Furniture from above: how high it stands, covers and encloses, on one grid.

What one sees of furniture from in front and from both sides: the faces whose look its top takes on.

A drawer's inside and runners do not show when one chooses a top; a table's legs, apron and fronts are what one sees. A
face is seen as far as three of its four points are (its middle and half way to its corners), so this is no rendering.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.additions.top.config import TopConfig
from grafu.additions.top.height_map import CellMask, Grid, Heights, grown, heights_of
from grafu.additions.top.roles import Roles, triangles_of
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.box import Box
from grafu.shapes import Bool, Float
from grafu.vocabulary import PartLabel

VIEW_CELLS = 96
"""Cells along the longer side of each view from in front or from a side."""
PLAN_CELLS = 160
"""Cells along the longer side of the view from above: a panel of 18 mm is two cells of a sideboard wide."""
SEEN_POINTS = 3
"""Points of a triangle, of four, that must lie foremost for it to be seen."""
VIEWING_DIRECTIONS = ((0, 1.0), (0, -1.0), (1, -1.0))  # along X to the right and to the left, and along Y in front
SPARE_LABELS = (PartLabel.HANDLE, PartLabel.LEG)  # their look is the body's only where there is no other

Triangles = Float[np.ndarray, "n 3 3"]
FaceMask = Bool[np.ndarray, " n"]


def outer_body(parts: Sequence[Part], roles: Roles, config: TopConfig) -> tuple[Part, ...]:
    """Returns the parts whose look a top takes on.

    They are what is static but legs, as it is. Where this shows little, legs are what tops are painted with, unless
    they are metal or thin; else they are all parts but handles, and of them those faces alone that one sees.
    """
    body = tuple(p for p in roles.still if p.label not in SPARE_LABELS)
    others = tuple(p for p in parts if p.label is not PartLabel.HANDLE and len(p.mesh.faces))
    seen = _seen(others, config)
    shown = {part.id: sum(s.mesh.area for s in part.surfaces) for part in seen}
    if sum(shown[p.id] for p in body) > config.seen_body * sum(shown.values()):
        return body
    legs = tuple(p for p in seen if p.label is PartLabel.LEG and not _is_metal(p, config.metal))
    if sum(shown[p.id] for p in legs) > config.seen_legs * sum(shown.values()):
        return (*legs, *(p for p in seen if p in body))
    return seen if sum(shown.values()) > 0 else others


def _seen(parts: tuple[Part, ...], config: TopConfig) -> tuple[Part, ...]:
    """Returns parts with those faces alone that one sees from in front or from a side."""
    box = Box.enclosing(p.box for p in parts)
    deep = config.seen_depth * float(box.size.max())
    turned = [_View(axis, sign, parts, box, config.seen_facing) for axis, sign in VIEWING_DIRECTIONS]
    return tuple(
        replace(part, surfaces=tuple(_with_faces(s, _any_sees(turned, s.mesh.triangles, deep)) for s in part.surfaces))
        for part in parts
    )


class _View:
    """The foremost surface in each cell, as one sees parts along an axis from its end with this sign."""

    def __init__(self, axis: int, sign: float, parts: tuple[Part, ...], box: Box, facing: float) -> None:
        self.facing = facing
        self.axes, self.sign = [a for a in range(3) if a != axis] + [axis], sign
        corners = self.turned(box.corners())
        self.grid = Grid.over(Box(corners.min(axis=0), corners.max(axis=0)), VIEW_CELLS)
        self.front: Heights = heights_of(self.turned(triangles_of(p.mesh for p in parts)), self.grid)

    def turned(self, points: Float[np.ndarray, "... 3"]) -> Float[np.ndarray, "... 3"]:
        """Returns points with the eye above them."""
        return points[..., self.axes] * np.array([1.0, 1.0, self.sign])

    def sees(self, triangles: Triangles, deep: float) -> FaceMask:
        """Whether triangles face the eye and most of their points lie foremost."""
        flat = self.turned(triangles)
        normals = np.cross(flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0])
        length = np.maximum(np.linalg.norm(normals, axis=1), 1e-12)
        facing = np.abs(normals[:, 2]) >= self.facing * length
        middle = flat.mean(axis=1, keepdims=True)
        points = np.concatenate([middle, 0.5 * (middle + flat)], axis=1)
        at = np.floor((points[..., :2] - self.grid.low) / self.grid.cell).astype(np.int64)
        at = np.clip(at, 0, np.array(self.grid.shape) - 1)
        foremost = points[..., 2] >= self.front[at[..., 0], at[..., 1]] - deep
        return facing & (foremost.sum(axis=1) >= SEEN_POINTS)


def _any_sees(views: list[_View], triangles: Triangles, deep: float) -> FaceMask:
    return np.logical_or.reduce([view.sees(triangles, deep) for view in views])


def _is_metal(part: Part, metal: float) -> bool:
    """Whether most of a part is metal, as materials of at least this metallic fraction are."""
    area = sum(s.mesh.area for s in part.surfaces)
    return sum(s.mesh.area for s in part.surfaces if s.material.metallic >= metal) > 0.5 * area


def _with_faces(surface: Surface, seen: FaceMask) -> Surface:
    """Returns a surface with some faces alone; its vertices stay, as what is laid on them does."""
    return replace(surface, mesh=replace(surface.mesh, faces=surface.mesh.faces[seen]))


@final
@dataclass(frozen=True, eq=False)
class Views:
    """Heights from above: of what stands, of what covers (still or turning) and of all, drawers included."""

    grid: Grid
    still: Heights
    cover: Heights
    wall: Heights
    region: CellMask
    floor: float


def views_of(roles: Roles, front: float) -> Views:
    """Returns the heights of furniture from above, and the region that it stands on, kneeholes counted in.

    Closed fronts up to `front` metres before the still parts belong to it.
    """
    grid = Grid.over(roles.box.grown(front), PLAN_CELLS)
    still = heights_of(triangles_of(p.mesh for p in roles.still), grid)
    turning = heights_of(triangles_of(m.mesh for m in roles.turning), grid)
    sliding = heights_of(triangles_of(m.mesh for m in roles.sliding), grid)
    cover = np.maximum(still, turning)
    wall = np.maximum(cover, sliding)
    stands = np.isfinite(still if roles.still else wall)
    near = grown(_between(stands), grid.cells(front))
    return Views(grid, still, cover, wall, _between(stands) | (near & np.isfinite(wall)), roles.floor)


def _between(stands: CellMask) -> CellMask:
    """Returns the cells with something on both sides along X or along Y, or on themselves."""
    found = stands.copy()
    for axis in (0, 1):
        before = np.logical_or.accumulate(stands, axis=axis)
        found |= before & np.flip(np.logical_or.accumulate(np.flip(stands, axis), axis=axis), axis)
    return found
