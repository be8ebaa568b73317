"""The track above a pair of leaves that fold, and the guide on the inner leaf that runs in it.

The guide stands where the inner leaf mirrors the outer one's pivot across the seam: that point stays in one plane. The
track is a strip under what stands right above the leaves; else it lies on them and is fixed to the front of the case,
or lies on the top of the case behind them.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Scalars, median, vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.joints.build import Built
from grafu.joints.config import RealizationConfig
from grafu.joints.fold_config import FoldConfig
from grafu.joints.hinge.pivot import upright_disc
from grafu.joints.support_block import METAL, Footing, block
from grafu.scene.border import BorderFrame, border_frame
from grafu.scene.scene import Scene
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

_POSES = 9  # of the leaves, in which nothing of them may cut into the track
_RAYS = 7  # along the track
_ACROSS = tuple((k + 0.5) / 12 for k in range(12))  # where rays start across it, from the front (fractions of it)

NO_TRACK = "its free edge is guided by no track: there is no room for one above it"


@final
@dataclass(frozen=True, eq=False)
class _Line:
    """Where the guide runs, in the outer leaf's border frame: from `low` to `high` along X, at `y`, above `top`.

    The leaves' fronts lie at y = 0. Heights count from the frame's middle towards the leaves' upper ends, which is
    `sign` along Z. The guide stands at `rest` while the leaves are closed.
    """

    frame: BorderFrame
    sign: float
    rest: float
    low: float
    high: float
    y: float
    top: float

    def heights(self, target: RayCaster, rays: list[tuple[float, float]], start: float, sense: float) -> Scalars:
        """Returns where rays from a height, at each (x, y), up or down (`sense`), meet a target; infinite: nowhere."""
        starts = np.array([(x, y, self.sign * start) for x, y in rays])
        direction = self.frame.direction(0.0, 0.0, self.sign * sense)
        return start + sense * target.along(self.frame.to_object(starts), direction)

    def strip(self, front: float, back: float, low: float, high: float) -> TriangleMesh:
        """Returns the strip along the line between two heights, from one y to another."""
        corners = np.array([(self.low, back, self.sign * low), (self.high, front, self.sign * high)])
        mesh = TriangleMesh.box_mesh(Box(corners.min(axis=0), corners.max(axis=0)))
        return mesh.transformed(self.frame.T_object_border)


def with_track(scene: Scene, outer: Built, inner: Built, upper: float, config: RealizationConfig) -> Scene | None:
    """Returns the scene with a track and a guide for a pair that opens to `upper`, radians; None where none fits."""
    config = at_scale(config, scene.metre)
    line = _line(scene, outer, inner, upper, config)
    if line is None:
        return None
    for track, under in _tracks(line, scene, config):
        if not _is_in_the_way(track, scene, outer, inner, upper, config.depth * scene.extent):
            name, disc = inner.request.moving, config.hinge.pivot
            ends = (line.sign * (line.top - disc.disc_inset), line.sign * under)
            guide = upright_disc(line.frame, (line.rest, line.y), config.fold.bearing, ends, disc.sides)
            named = [replace(visual, name=f"{kind}_{name}_track_static") for kind, visual in track]
            moving = _visual(f"rail_{name}_track_dynamic", guide)
            return replace(scene, hardware=(*scene.hardware, *(("", visual) for visual in named), (name, moving)))
    return None


def _line(scene: Scene, outer: Built, inner: Built, upper: float, config: RealizationConfig) -> _Line | None:
    """Returns where the guide runs; None where it would not stand on the inner leaf."""
    frame = border_frame(scene.parts[outer.request.moving].mesh, outer.placement.axis)
    (px, py), (hx, hy) = (_at(frame, built) for built in (outer, inner))
    turns = np.linspace(0.0, upper, config.fine_poses)
    along = px + 2 * ((hx - px) * np.cos(turns) - (hy - py) * np.sin(turns))
    sign = 1.0 if frame.rotation[2, 2] > 0 else -1.0
    fold, start = config.fold, frame.length / 2 + config.hinge.pivot.start
    leaf = scene.parts[inner.request.moving].mesh
    end = float(frame.to_border(leaf.vertices)[:, 0].max())
    margin = 2 * fold.bearing
    low, high = float(along.min()) - margin, min(float(along.max()) + margin, max(end, float(along[0])))
    line = _Line(frame, sign, float(along[0]), low, high, py, start)
    rim = config.hinge.pivot.ring * fold.bearing
    ring = [(line.rest + dx * rim, py + dy * rim) for dx, dy in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))]
    tops = line.heights(RayCaster(leaf), ring, start, -1.0)
    on_leaf = np.abs(tops - frame.length / 2) <= config.hinge.pivot.start
    return replace(line, top=median(tops[on_leaf])) if on_leaf.mean() >= config.hinge.pivot.met else None


def _at(frame: BorderFrame, built: Built) -> tuple[float, float]:
    x, y, _ = frame.to_border(built.placement.axis.closest_point(frame.origin)[None])[0]
    return float(x), float(y)


_Track = tuple[list[tuple[str, Visual]], float]
"""What a track is made of, each with the kind of hardware that it is, and the height of its lower side."""


def _tracks(line: _Line, scene: Scene, config: RealizationConfig) -> Iterator[_Track]:
    """Yields the tracks that something holds, the best first."""
    fold = config.fold
    back = -line.frame.thickness
    box = line.strip(0.0, back - fold.widest_gap, line.top - fold.room, line.top + fold.room).box
    static = RayCaster(scene.static_mesh_near(box, fold.room))
    xs = [float(x) for x in np.linspace(line.low, line.high, _RAYS)]
    above = line.heights(static, [(x, -k * fold.track) for x in xs for k in _ACROSS], line.top, 1.0)
    gap, front_at = float(above.min()) - line.top, _covered(above.reshape(len(xs), -1), fold)
    if front_at >= line.y and fold.least < gap <= fold.room:
        under = line.top + gap - min(fold.strip, gap / 2)
        yield [("rail", _visual("", line.strip(front_at, -fold.track, under, line.top + gap)))], under
    under = line.top + fold.play
    front = _on_front(line, static, under, config)
    if front is not None and above.min() >= under + fold.strip:
        strip = line.strip(0.0, back, under, under + fold.strip)
        yield [("rail", _visual("", strip)), ("support", front)], under
    behind = line.heights(static, [(x, back - fold.widest_gap / 2) for x in xs], line.top + fold.room, -1.0)
    if _is_level(behind, fold.flush) and abs(float(behind.max()) - line.top) <= fold.room:
        under = max(under, float(behind.max()))
        if above.min() < under + fold.strip:
            return
        strip = line.strip(0.0, back - fold.widest_gap, under, under + fold.strip)
        yield [("rail", _visual("", strip))], under


def _covered(above: Float[np.ndarray, "n k"], fold: FoldConfig) -> float:
    """Returns the y from which on something level stands above a line, to the track's rear; minus infinity: none.

    `above` holds the heights along the line, and across it from the front.
    """
    level = [k for k in range(len(_ACROSS)) if _is_level(above[:, k:].ravel(), fold.flush)]
    return -(_ACROSS[level[0]] - _ACROSS[0]) * fold.track if level else -np.inf


def _is_level(heights: Scalars, within: float) -> bool:
    return bool(np.isfinite(heights).all() and np.ptp(heights) <= within)


def _on_front(line: _Line, static: RayCaster, under: float, config: RealizationConfig) -> Visual | None:
    """Returns the block that joins a track to the front of the case behind the leaves; None where it is too far."""
    fold, frame = config.fold, line.frame
    middle = vec3((line.low + line.high) / 2, -frame.thickness, line.sign * (under + fold.strip / 2))
    foot = Footing(
        frame.to_object(middle[None])[0],
        frame.direction(0.0, -1.0, 0.0),
        frame.direction((line.high - line.low) / 2, 0.0, 0.0),
        frame.direction(0.0, 0.0, fold.strip / 2),
    )
    gap = foot.gap(static, fold.widest_gap, config.block)
    return block("", foot, gap, config.block, METAL) if np.isfinite(gap) else None


def _is_in_the_way(
    track: list[tuple[str, Visual]], scene: Scene, outer: Built, inner: Built, upper: float, depth: float
) -> bool:
    """Whether moving bodies at rest, or the leaves as they fold, cut into a track by more than `depth` metres."""
    strip = MeshCollider(merge_meshes([visual.mesh for _, visual in track]))
    for name in scene.moving_bodies:
        body = SweptBody(scene.moving_mesh(name), depth)
        body.place(np.eye(4))
        if body.penetrates(strip):
            return True
    bodies = [SweptBody(scene.moving_mesh(one.request.moving), depth) for one in (outer, inner)]
    for value in np.linspace(0.0, upper, _POSES):
        T = outer.placement.axis.rotation(float(value))
        poses = T, T @ inner.placement.axis.rotation(2 * float(value))
        for body, pose in zip(bodies, poses, strict=True):
            body.place(pose)
            if body.penetrates(strip):
                return True
    return False


def _visual(name: str, mesh: TriangleMesh) -> Visual:
    return Visual(name, (Surface(mesh, METAL),), VisualRole.HARDWARE, PartLabel.MISC)
