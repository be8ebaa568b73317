"""Cuts the moving part's way out of static parts, where little of them goes."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
from jaxtyping import Float

from grafu.asset.labels import sense_of
from grafu.asset.part import Part
from grafu.geometry.arrays import Mat3, Points
from grafu.geometry.box import Box
from grafu.geometry.components import part_numbers
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid, clip, subtract
from grafu.geometry.transform import transform_points
from grafu.realization.clearance.loss import Loss, lost_volume, measured_loss
from grafu.realization.clearance.path import Path
from grafu.realization.config import RealizationConfig
from grafu.realization.limits import opening_values
from grafu.realization.report import Clearance
from grafu.realization.scene import Scene

_TURN_STEP = np.radians(5.0)
_MOST_PLANES = 26  # of a box with its edges and corners bevelled
_MOST_SOLIDS = 400  # a piece whose cutting triangles would sweep out more is covered by its convex hull


def carve(scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with the path cut out of those blockers that lose less than the limit."""
    play = 2.5 * config.depth * scene.unit
    solids = list(_swept_solids(scene, path, ids, play, config))
    carved: list[Part] = []
    done: list[Clearance] = []
    for name in ids:
        part = scene.parts[name]
        near = [solid for solid in solids if solid.box.overlaps(part.box)]
        clipped = [clip(surface, near) for surface in part.surfaces]
        area = sum(surface.mesh.area - left.mesh.area for surface, left in zip(part.surfaces, clipped, strict=True))
        most = config.max_carve_fitting if sense_of(part.source.name).is_fitting else config.max_carve
        if not 0 < _lost_share(part, near, area, most) < most:
            continue
        surfaces = (subtract(surface, near, left) for surface, left in zip(part.surfaces, clipped, strict=True))
        carved.append(replace(part, surfaces=tuple(s for s in surfaces if not s.is_empty)))
        done.append(_carved(name, area, measured_loss(part, near), path))
    return scene.replaced(carved), done


def _carved(name: str, area: float, loss: Loss, path: Path) -> Clearance:
    why = f"stood in the way of {path.moving}"
    return Clearance(name, "carved", float(np.sqrt(area)), loss.share, why, loss.surface, loss.volume)


def _lost_share(part: Part, solids: Sequence[ConvexSolid], area: float, limit: float) -> float:
    """Returns the share of the part's surface that goes, or of its volume where that is less; `area` is what goes."""
    if part.mesh.area == 0 or not solids:
        return 0.0
    by_area = area / part.mesh.area
    return by_area if by_area < limit else min(by_area, lost_volume(part, solids))


def _swept_solids(
    scene: Scene, path: Path, ids: Sequence[str], play: float, config: RealizationConfig
) -> Iterator[ConvexSolid]:
    """Yields convex solids that cover the way of whatever of the moving body cuts into a blocker, with some play."""
    poses = [path.motion(v) for v in np.linspace(0.0, path.reach, _steps(path) + 1)]
    boxes = [scene.parts[name].box for name in ids]
    for points in _cutting_pieces(scene, path, ids, play, config):
        for step in pairwise(poses):
            swept = np.vstack([transform_points(T, points) for T in step])
            if not any(Box.around(swept).overlaps(box, play) for box in boxes):
                continue
            solid = ConvexSolid.around(swept)
            if solid is not None:
                yield solid


def _steps(path: Path) -> int:
    """Returns in how many convex steps a path is covered."""
    return max(1, int(np.ceil(path.reach / _TURN_STEP))) if path.is_turn else 1


def _cutting_pieces(
    scene: Scene, path: Path, ids: Sequence[str], play: float, config: RealizationConfig
) -> Iterator[Points]:
    """Yields the corners, with play, of what cuts in: a convex piece's hull, or the triangles of other pieces."""
    mesh = scene.moving_mesh(path.moving)
    body = scene.swept_body(path.moving, config.depth * scene.unit, path.axes)
    colliders = [MeshCollider(scene.parts[name].mesh) for name in ids]
    cutting = _cutting_faces(body, path, colliders, config.fine_poses)
    numbers = part_numbers(mesh)
    for number in np.unique(numbers[cutting]):
        piece = mesh.with_faces(numbers == number)
        faces = cutting[numbers[cutting] == number]
        hull = ConvexSolid.around(piece.vertices)
        if hull is not None and (len(faces) * _steps(path) > _MOST_SOLIDS or _is_convex(piece, hull, play)):
            yield _grown(np.asarray(hull.vertices), play, path.axes)
        else:
            yield from (_grown(triangle, play, path.axes) for triangle in mesh.triangles[faces])


def _cutting_faces(body: SweptBody, path: Path, obstacles: Sequence[MeshCollider], poses: int) -> np.ndarray:
    """Returns the numbers of the moving faces that cut into an obstacle somewhere on the way."""
    found: set[int] = set()
    for value in opening_values(path.reach, poses):
        body.place(path.motion(value))
        found |= body.cutting_faces(obstacles)
    return np.array(sorted(found), dtype=np.int64)


def _is_convex(piece: TriangleMesh, hull: ConvexSolid, play: float) -> bool:
    """Whether no vertex lies deeper than `play` inside the piece's own hull."""
    depth = hull.planes[:, 3] - piece.vertices @ hull.planes[:, :3].T
    return bool(depth.min(axis=1).max() <= play)


def _grown(points: Points, play: float, axes: Mat3) -> Float[np.ndarray, "m 3"]:
    """Returns the corners of the points' hull grown by `play` along the axes; a box's where the hull is rounded.

    Cutting along a rounded hull's many planes would shred what is cut.
    """
    cube = Box(np.full(3, -play), np.full(3, play)).corners() @ axes.T
    hull = ConvexSolid.around((points[:, None, :] + cube[None]).reshape(-1, 3))
    if hull is not None and len(hull.planes) <= _MOST_PLANES:
        return np.asarray(hull.vertices)
    return Box.around(points @ axes).grown(play).corners() @ axes.T
