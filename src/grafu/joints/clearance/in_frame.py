"""Cuts off the edges of a leaf that are drawn in the frame around it; what is cut off stays with the frame.

Many doors are drawn as panels that end somewhere in the hollow of their frame, or with pieces of the frame's faces.
What lies beyond the opening of the frame looks like a part of it, so it stays there, and only a seam goes.
"""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import Box
from grafu.geometry.halves import half_of
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip, subtract
from grafu.joints.clearance.carve import box_in
from grafu.joints.config import RealizationConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene

GAPS = (2.5, 4.0, 6.0)
"""On each side, in tolerated penetrations: what a leaf that fills its opening is made smaller by."""
WIDE_GAPS = (8.0, 10.0, 14.0)
"""The same of a leaf that is not narrowed along a cut, and is free in none of these."""


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Edges:
    """How far a leaf reaches into its frame at the low and at the high end of each axis of its box, metres."""

    low: Vec3
    high: Vec3

    @property
    def deepest(self) -> float:
        """The most of them, metres."""
        return float(max(self.low.max(), self.high.max()))

    @property
    def sides(self) -> int:
        """On how many sides it reaches into the frame: one leaf of a pair does so at one side and above."""
        return int(np.count_nonzero(self.low > 0) + np.count_nonzero(self.high > 0))

    def inside(self, box: Box, gap: float) -> Box:
        """Returns what of the leaf's box lies in the opening, with a gap, metres, at the edges that are cut."""
        low = np.where(self.low > 0, box.low + self.low + gap, box.low - box.diagonal)
        high = np.where(self.high > 0, box.high - self.high - gap, box.high + box.diagonal)
        return Box(low, high)


def leaf_in_frame(
    scene: Scene, moving: str, axes: Mat3, ids: Sequence[str], config: RealizationConfig, sides: int = 2
) -> Iterator[tuple[Scene, tuple[Clearance, ...]]]:
    """Yields the scene with a leaf cut to the opening of the frame that it is drawn in, with ever wider gaps.

    Nothing is yielded unless the leaf reaches into one of the static parts `ids` on so many `sides` at least, through
    much of its thickness, deeper than narrowing it would free it, and by at most `config.clearance.lapped`.
    """
    leaf, unit = scene.parts[moving], config.depth * scene.extent
    box = box_in(axes, leaf.mesh)
    found = (pair for pair in _frames(scene, box, axes, ids, config) if pair[1].sides >= sides)
    frame, edges = next(found, (None, None))
    if frame is None or edges is None or edges.deepest <= GAPS[-1] * unit:
        return
    opening = _solid(edges.inside(box, 0.0), axes)
    rim = tuple(left for s in leaf.surfaces if not (left := clip(s, [opening])).is_empty)
    holder = replace(frame, surfaces=(*frame.surfaces, *rim))
    for gap in (plays * unit for plays in GAPS):
        beyond = _beyond(edges.inside(box, gap), box, axes)
        cut = tuple(left for s in leaf.surfaces if not (left := subtract(s, beyond)).is_empty)
        if not cut:
            return
        amount = edges.deepest + gap
        why = f"its edges lay in {frame.id}, which keeps them"
        note = Clearance(moving, "trimmed", amount, amount / float(box.size.max()), why)
        yield scene.replaced([replace(leaf, surfaces=cut), holder]), (note,)


def _frames(
    scene: Scene, box: Box, axes: Mat3, ids: Sequence[str], config: RealizationConfig
) -> Iterator[tuple[Part, _Edges]]:
    """Yields static parts with how far a leaf's edges reach into each, largest first; hardware is no frame."""
    for part in sorted((scene.parts[name] for name in ids if name in scene.parts), key=lambda part: -part.box.diagonal):
        mesh = TriangleMesh(part.mesh.vertices @ axes, part.mesh.faces)
        edges = _edges(box, mesh, config.depth * scene.extent, config)
        if edges is not None:
            yield part, edges


def _edges(box: Box, frame: TriangleMesh, unit: float, config: RealizationConfig) -> _Edges | None:
    """Returns how far a leaf reaches into a frame; None where it does so too far, or lies on it rather than in it."""
    thin, lapped = box.thin_axis, config.clearance.lapped
    found = np.zeros((2, 3))
    for axis in (k for k in range(3) if k != thin):
        for side in (0, 1):
            points = _within(frame, _edge_region(box, axis, side, unit, lapped))
            if not len(points):
                continue
            ends = points[:, axis]
            found[side, axis] = depth = float(ends.max() - box.low[axis] if side == 0 else box.high[axis] - ends.min())
            if depth >= lapped - unit or float(np.ptp(points[:, thin])) < config.clearance.through * box.size[thin]:
                return None
    return _Edges(*found)


def _edge_region(box: Box, axis: int, side: int, unit: float, lapped: float) -> Box:
    """Returns the strip of a leaf's box along one edge, without its ends and its faces."""
    shrink = np.full(3, lapped)
    shrink[box.thin_axis], shrink[axis] = unit, 0.0
    low, high = box.low + shrink, np.maximum(box.high - shrink, box.low + shrink)
    if side == 0:
        high[axis] = box.low[axis] + lapped
    else:
        low[axis] = box.high[axis] - lapped
    return Box(low, high)


def _within(mesh: TriangleMesh, box: Box) -> np.ndarray:
    """Returns the corners of what of a mesh lies in a box."""
    for k in range(3):
        for sign, end in ((1.0, box.low), (-1.0, box.high)):
            if not len(mesh.faces):
                return np.zeros((0, 3))
            mesh = half_of(mesh, sign * np.eye(3)[k], end)
    return np.asarray(mesh.vertices)


def _beyond(opening: Box, box: Box, axes: Mat3) -> list[ConvexSolid]:
    """Returns solids around all of a leaf's box that lies beyond an opening."""
    around, solids = box.grown(box.diagonal), []
    for k in range(3):
        if opening.low[k] > box.low[k]:
            solids.append(_solid(Box(around.low, np.where(np.arange(3) == k, opening.low, around.high)), axes))
        if opening.high[k] < box.high[k]:
            solids.append(_solid(Box(np.where(np.arange(3) == k, opening.high, around.low), around.high), axes))
    return solids


def _solid(box: Box, axes: Mat3) -> ConvexSolid:
    solid = ConvexSolid.around(box.corners() @ axes.T)
    assert solid is not None, "a box of a leaf's size has a hull"
    return solid
