"""What a front is made of at a spot, by lines straight into it: how thick, how even, and what stands around it."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property
from typing import final

import numpy as np

from grafu.additions.grip.config import GroundConfig
from grafu.additions.grip.shape import GripFrame
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import OPAQUE_ALPHA
from grafu.geometry.arrays import ArrayValue, Mask, Scalars, freeze_arrays
from grafu.geometry.bodywork import Bodywork
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, mesh_near, triangle_bounds
from grafu.geometry.raycast import Crossings, line_crossings
from grafu.scene.scene import Scene
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

ASIDE = 1e-4 * np.sqrt(2.0)
"""Fraction of a grid's step by which lines are moved aside: they do not run along the edges between faces."""
OUTERMOST_LINES = 24
"""Lines each way that look for the front's outermost part."""


Triangles = Float[np.ndarray, "_ 3 3"]
Grid = Float[np.ndarray, " _"]  # rising coordinates


@final
@dataclass(frozen=True, eq=False)
class FrontLayers(ArrayValue):
    """What lines into the front meet first, one row per line; heights are Z of the grip frame.

    `face` is where a line enters (-inf: it meets nothing), `back` where the first layer ends, `solid` how much of that
    layer is solid (0: mere sheets), `beneath` where the part's next layer begins (-inf: there is none). Sheets that
    follow one another closely are a hollow board, and count as one layer.
    """

    face: Scalars
    back: Scalars
    solid: Scalars
    beneath: Scalars
    is_opaque: Mask

    def __post_init__(self) -> None:
        freeze_arrays(self)

    def lowered(self, by: Scalars) -> "FrontLayers":
        """Returns the ground with each line's heights less by some metres: what is tilted comes to lie level."""
        return replace(self, face=self.face - by, back=self.back - by, beneath=self.beneath - by)

    @property
    def is_covered(self) -> bool:
        """Whether every line meets something."""
        return bool(np.isfinite(self.face).all())

    @property
    def thickness(self) -> Scalars:
        """How far the back of the first layer lies behind its face."""
        return self.face - self.back

    @property
    def is_hollow(self) -> bool:
        """Whether the first layer is nowhere solid: a sheet, or a board of sheets with nothing in between."""
        return not np.any(self._is_solid)

    @property
    def is_mixed(self) -> bool:
        """Whether the first layer is solid in some places only."""
        return bool(np.any(self._is_solid) and not np.all(self._is_solid))

    @property
    def _is_solid(self) -> Mask:
        return (self.solid > 0) & (self.solid >= 0.5 * self.thickness)


@final
@dataclass(frozen=True, eq=False)
class GripSite:
    """A front to carve: its part, its frame, and everything around it as triangles in the grip frame.

    `attached` moves with the front (handles, hardware); `still` and `others` do not.
    """

    part: Part
    frame: GripFrame
    attached: Triangles
    still: Triangles
    others: Triangles
    scale: float
    config: GroundConfig

    @cached_property
    def body(self) -> Bodywork:
        """The part's faces, sorted."""
        return Bodywork.of(self.part.surfaces)

    @cached_property
    def _triangles(self) -> Triangles:
        local = self.frame.local(np.asarray(self.body.mesh.vertices))
        return np.asarray(local[self.body.faces])

    @cached_property
    def _extent(self) -> tuple[np.ndarray, np.ndarray]:
        return triangle_bounds(self._triangles)

    @cached_property
    def _is_opaque(self) -> Mask:
        clear = [
            s.material.base_color[3] < OPAQUE_ALPHA or s.material.alpha_mode == "BLEND" for s in self.body.surfaces
        ]
        return ~np.array(clear)[self.body.owner[self.body.source]]

    def ground(self, xs: Grid, ys: Grid) -> FrontLayers:
        """Returns what the lines through a grid meet, the second coordinate running fastest."""
        low, high = self._extent
        near = np.flatnonzero(
            (low[:, 0] <= xs[-1]) & (high[:, 0] >= xs[0]) & (low[:, 1] <= ys[-1]) & (high[:, 1] >= ys[0])
        )
        found = line_crossings(self._triangles[near], aside(xs), aside(ys))
        face = near[found.face]
        return _layered(
            found,
            self.body.is_solid[face],
            self._is_opaque[face],
            len(xs) * len(ys),
            (self.seam, self.config.board * self.scale),
        )

    @property
    def seam(self) -> float:
        """Layers no farther apart than this count as one, metres."""
        return self.config.seam * self.scale


def aside(grid: Grid) -> Grid:
    """Returns a grid's coordinates moved aside by a trace."""
    return grid + ASIDE * (grid[-1] - grid[0]) / max(len(grid) - 1, 1)


def _layered(found: Crossings, is_solid: Mask, is_opaque: Mask, lines: int, limits: tuple[float, float]) -> FrontLayers:
    """Returns what each line meets first; `limits` are the widest seam and the thickest hollow board, metres."""
    rows = [(-np.inf, -np.inf, 0.0, -np.inf, True)] * lines
    starts = np.searchsorted(found.line, np.arange(lines + 1)).tolist()
    steps = np.where(is_solid, np.where(found.looks_up, 1, -1), 0).tolist()
    heights, opaque = found.height.tolist(), is_opaque.tolist()
    for line in range(lines):
        span = slice(starts[line], starts[line + 1])
        if span.start < span.stop:
            rows[line] = _first_layer(heights[span], steps[span], opaque[span], *limits)
    face, back, solid, beneath, clear = zip(*rows, strict=True)
    return FrontLayers(np.array(face), np.array(back), np.array(solid), np.array(beneath), np.array(clear))


def _first_layer(
    heights: list[float], steps: list[int], opaque: list[bool], seam: float, board: float
) -> tuple[float, float, float, float, bool]:
    """Returns a row of `FrontLayers` from crossings; a step is +1 into a solid, -1 out of one, 0 at a sheet."""
    face = back = heights[0]
    solid, inside, is_opaque = 0.0, 0, True
    for height, step, is_dull in zip(heights, steps, opaque, strict=True):
        if inside > 0:
            solid += back - height
        elif back - height > seam and not (solid == 0.0 and face - height <= board):
            return face, back, solid, height, is_opaque
        back, inside, is_opaque = height, inside + step, is_opaque and is_dull
    return face, back, solid, -np.inf, is_opaque


def site_of(scene: Scene, moving_id: str, frame: GripFrame, part: Part, config: GroundConfig) -> GripSite:
    """Returns the site on one of the moving body's parts."""
    around = Box.around(frame.in_object(frame.box.corners())).grown(config.around * scene.metre)
    own = [scene.parts[m].mesh for m in scene.moving_bodies[moving_id].members if m != part.id]
    own += [v.mesh for v in scene.hardware_of(moving_id)]
    still = [scene.static_mesh_near(around, 0.0)]
    still += [v.mesh for owner, v in scene.hardware if not owner]
    others = [scene.equipped_mesh(other) for other in scene.moving_bodies if other != moving_id]
    attached, fixed, moving = (_near(frame, meshes, around) for meshes in (own, still, others))
    return GripSite(part, frame, attached, fixed, moving, scene.metre, config)


def _near(frame: GripFrame, meshes: Sequence[TriangleMesh], around: Box) -> Triangles:
    """Returns the triangles, in the grip frame, whose boxes meet a box of the object frame."""
    corners = mesh_near(meshes, around).triangles
    return np.asarray(frame.local(corners.reshape(-1, 3)).reshape(-1, 3, 3))


def front_part(scene: Scene, moving_id: str, frame: GripFrame) -> Part:
    """Returns the moving body's part that lies outermost over most of its front; handles do not count."""
    ids = scene.moving_bodies[moving_id].members
    parts = [scene.parts[m] for m in ids if m == moving_id or scene.parts[m].label is not PartLabel.HANDLE]
    if len(parts) == 1:
        return parts[0]
    owner = np.repeat(np.arange(len(parts)), [len(p.mesh.faces) for p in parts])
    triangles = np.concatenate([frame.local(p.mesh.vertices)[p.mesh.faces] for p in parts])
    x, y = (np.linspace(frame.box.low[k], frame.box.high[k], OUTERMOST_LINES + 2)[1:-1] for k in (0, 1))
    found = line_crossings(triangles, aside(x), aside(y))
    first = np.unique(found.line, return_index=True)[1]
    counts = np.bincount(owner[found.face[first]], minlength=len(parts))
    return parts[int(counts.argmax())]
