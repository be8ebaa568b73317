"""Cuts the moving part's way out of static parts, where little of them goes."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import manifold3d
import numpy as np

from grafu.asset.part import Part
from grafu.geometry.arrays import Mat3, Mat4, Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.components import connected_parts
from grafu.geometry.solids import ConvexSolid, enclosed_area, subtract
from grafu.geometry.transform import transform_points
from grafu.realization.clearance.path import Path
from grafu.realization.config import RealizationConfig
from grafu.realization.report import Clearance
from grafu.realization.scene import Scene

_TURN_STEP = np.radians(5.0)
_MOST_TRIANGLES = 400  # a piece with more triangles near the blockers is covered by its convex hull


def carve(scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with the path cut out of those blockers that lose less than the limit."""
    play = 1.5 * config.depth * scene.unit
    solids = list(_swept_solids(scene, path, [scene.parts[name].mesh for name in ids], play))
    carved: list[Part] = []
    done: list[Clearance] = []
    for name in ids:
        part = scene.parts[name]
        near = [solid for solid in solids if solid.box.overlaps(part.box)]
        share = _lost_share(part, near, config.max_carve)
        if not 0 < share < config.max_carve:
            continue
        surfaces = tuple(cut for s in part.surfaces if not (cut := subtract(s, near)).is_empty)
        carved.append(replace(part, surfaces=surfaces))
        depth = max((float(solid.box.size.min()) for solid in near), default=0.0)
        done.append(Clearance(name, "carved", depth, share, f"stood in the way of {path.mover}"))
    return scene.replaced(carved), done


def _lost_share(part: Part, solids: Sequence[ConvexSolid], limit: float) -> float:
    """Returns the share of the part's surface that lies in the solids, or of its volume where that is less.

    Volumes are those of the convex hulls of its connected pieces: real parts are rarely closed.
    """
    if not solids or part.mesh.area == 0:
        return 0.0
    by_area = sum(enclosed_area(s.mesh, solids) for s in part.surfaces) / part.mesh.area
    if by_area < limit:
        return by_area
    whole = left = 0.0
    cutters = [_manifold(solid) for solid in solids]
    for piece in connected_parts(part.mesh):
        hull = ConvexSolid.around(piece.vertices)
        if hull is None:
            continue
        body = _manifold(hull)
        whole += body.volume()
        for cutter in cutters:
            body = body - cutter
        left += body.volume()
    return min(by_area, 1.0 - left / whole) if whole > 0 else by_area


def _manifold(solid: ConvexSolid) -> manifold3d.Manifold:
    return manifold3d.Manifold(manifold3d.Mesh(solid.vertices.astype(np.float32), solid.faces.astype(np.uint32)))


def _swept_solids(
    scene: Scene, path: Path, targets: Sequence[TriangleMesh], play: float
) -> Iterator[ConvexSolid]:
    """Yields convex solids that cover the way of those pieces of the mover that meet a target, with some play."""
    steps = max(2, int(np.ceil(path.reach / _TURN_STEP)) + 1) if path.is_turn else 2
    poses = [path.motion(v) for v in np.linspace(0.0, path.reach, steps)]
    boxes = [target.box for target in targets]
    for member in scene.movers[path.mover].members:
        for piece in connected_parts(scene.parts[member].mesh):
            for before, after in zip(poses[:-1], poses[1:], strict=True):
                if any(_way_of(piece.vertices, before, after).overlaps(box, play) for box in boxes):
                    yield from _covered(piece, (before, after), boxes, play, path.axes)


def _covered(
    piece: TriangleMesh, step: tuple[Mat4, Mat4], boxes: Sequence[Box], play: float, axes: Mat3
) -> Iterator[ConvexSolid]:
    """Yields the way of a piece over one step: its convex hull's where it is convex, else triangle by triangle."""
    hull = ConvexSolid.around(piece.vertices)
    triangles = piece.triangles
    near = [t for t in triangles if any(_way_of(t, *step).overlaps(box, play) for box in boxes)]
    if (hull is not None and _is_convex(piece, hull, play)) or len(near) > _MOST_TRIANGLES:
        near = [np.asarray(piece.vertices)]
    for points in near:
        solid = ConvexSolid.around(_grown(np.vstack([transform_points(T, points) for T in step]), play, axes))
        if solid is not None:
            yield solid


def _is_convex(piece: TriangleMesh, hull: ConvexSolid, play: float) -> bool:
    """Whether no vertex lies deeper than `play` inside the piece's own hull."""
    depth = hull.planes[:, 3] - piece.vertices @ hull.planes[:, :3].T
    return bool(depth.min(axis=1).max() <= play)


def _way_of(points: Points, before: Mat4, after: Mat4) -> Box:
    return Box.around(np.vstack([transform_points(before, points), transform_points(after, points)]))


def _grown(points: Points, play: float, axes: Mat3) -> Points:
    cube = Box(np.full(3, -play), np.full(3, play)).corners() @ axes.T
    return (points[:, None, :] + cube[None]).reshape(-1, 3)

