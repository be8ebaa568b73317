"""Cuts the moving part's path out of static parts, where little of them goes.

How much of a part goes when solids are cut out of it: of what is seen of it, and of its volume.

The path that must become free, and what stands in it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TypeAlias, final

import manifold3d
import numpy as np
from jaxtyping import Float

from grafu.asset.labels import sense_of
from grafu.asset.part import Part
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat3, Points
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.components import connected_parts, part_numbers
from grafu.geometry.intersection import MeshCollider, SweptBody
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import outer_faces, outer_points
from grafu.geometry.sampling import sample_surface
from grafu.geometry.solids import ConvexSolid, clip, subtract
from grafu.geometry.transform import transform_points
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import PoseFunction, SweepVerdict, in_the_way, opening_values, sweep, swept_box
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene


@final
@dataclass(frozen=True, eq=False)
class Path:
    """A motion from 0 to `reach` (radians if `is_turn`, else metres); the columns of `axes` are those of its box."""

    moving: str
    motion: PoseFunction
    reach: float
    axes: Mat3
    is_turn: bool


ClearanceStep: TypeAlias = Callable[[Scene, Path, Sequence[str], RealizationConfig], tuple[Scene, list[Clearance]]]


def obstruction(
    scene: Scene, path: Path, config: RealizationConfig, ignored: frozenset[str] = frozenset()
) -> SweepVerdict:
    """Returns how far the static parts block the path of the moving body, and which of them do, `ignored` left out."""
    mesh = scene.moving_mesh(path.moving)
    body = scene.swept_body(path.moving, config.depth * scene.extent, path.axes)
    obstacles = [obstacle for obstacle in scene.static_obstacles if obstacle.id not in ignored]
    near = in_the_way(obstacles, swept_box(mesh.box, path.motion, path.reach))
    return sweep(body, path.motion, path.reach, near, config.fine_poses)


def box_in(axes: Mat3, mesh: TriangleMesh) -> Box:
    """Returns the box around a mesh in the coordinates of `axes`."""
    return Box.around(mesh.vertices @ axes)


@final
@dataclass(frozen=True, slots=True)
class Loss:
    """What goes of a part: fractions of its outer surface, and of the volume of its pieces' convex hulls."""

    surface: float
    volume: float

    @property
    def ratio(self) -> float:
        """The larger of the two: a hollow part loses much of its surface with little of the volume around it."""
        return max(self.surface, self.volume)


def measured_loss(part: Part, solids: Sequence[ConvexSolid]) -> Loss:
    """Returns what of a part lies in the solids."""
    return Loss(lost_surface(part, solids), lost_volume(part, solids))


def lost_surface(part: Part, solids: Sequence[ConvexSolid]) -> float:
    """Returns the fraction of the part's outer surface that lies in the solids, 0..1.

    Outer is what can be seen from outside the part, so cut faces and hidden walls do not count.
    """
    seen = outer_faces(part.mesh)
    whole = float(part.mesh.face_areas[seen].sum())
    if whole == 0 or not solids:
        return 0.0
    ends = np.cumsum([len(surface.mesh.faces) for surface in part.surfaces])
    shown = [s.mesh.with_faces(keep) for s, keep in zip(part.surfaces, np.split(seen, ends[:-1]), strict=True)]
    left = sum(clip(Surface(mesh), solids).mesh.area for mesh in shown if len(mesh.faces))
    return min(max(1.0 - left / whole, 0.0), 1.0)


def lost_volume(part: Part, solids: Sequence[ConvexSolid]) -> float:
    """Returns the fraction of the volume of the part's pieces' convex hulls that lies in the solids, 0..1.

    Volumes are those of hulls because real parts are rarely closed; 1 where all pieces are flat.
    """
    if not solids:
        return 0.0
    whole = lost = 0.0
    cutter = manifold3d.Manifold.batch_boolean([_manifold(solid) for solid in solids], manifold3d.OpType.Add)
    for piece in connected_parts(part.mesh):
        require_time()
        hull = ConvexSolid.around(piece.vertices)
        if hull is None:
            continue
        body = _manifold(hull)
        whole += body.volume()
        if any(hull.box.overlaps(solid.box) for solid in solids):
            lost += (body ^ cutter).volume()
    return min(lost / whole, 1.0) if whole > 0 else 1.0


def _manifold(solid: ConvexSolid) -> manifold3d.Manifold:
    return manifold3d.Manifold(manifold3d.Mesh(solid.vertices.astype(np.float32), solid.faces.astype(np.uint32)))


_TURN_STEP = np.radians(5.0)
_MOST_PLANES = 26  # of a box with its edges and corners bevelled
_SAMPLES = 2000  # points on a part where it is looked at
MOST_SOLIDS = 400  # a piece whose cutting triangles would sweep out more is covered by its convex hull


def carve(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig, most: int = MOST_SOLIDS
) -> tuple[Scene, list[Clearance]]:
    """Returns the scene with the path cut out of those blockers that lose less than the limit.

    A piece whose cutting triangles would sweep out more than `most` solids is covered by its convex hull: that is
    faster, and cuts more.
    """
    ids = [name for name in ids if len(scene.parts[name].mesh.faces) <= config.carved_faces]
    play = config.clearance.play * config.depth * scene.extent
    solids = list(_swept_solids(scene, path, ids, play, config, most))
    carved: list[Part] = []
    done: list[Clearance] = []
    for name in ids:
        part = scene.parts[name]
        near = [solid for solid in solids if solid.box.overlaps(part.box)]
        clipped = [clip(surface, near) for surface in part.surfaces]
        area = sum(surface.mesh.area - left.mesh.area for surface, left in zip(part.surfaces, clipped, strict=True))
        lost = _lost_ratio(part, near, area, config.max_carve)
        may_lose = 0 < lost < config.max_carve
        if not may_lose and not (0 < lost < config.max_carve_hidden and _is_hidden(scene, part, near, config)):
            continue
        surfaces = (subtract(surface, near, left) for surface, left in zip(part.surfaces, clipped, strict=True))
        carved.append(replace(part, surfaces=tuple(s for s in surfaces if not s.is_empty)))
        done.append(_carved(name, area, measured_loss(part, near), path))
    return scene.replaced(carved), done


def _carved(name: str, area: float, loss: Loss, path: Path) -> Clearance:
    why = f"stood in the way of {path.moving}"
    return Clearance(name, "carved", float(np.sqrt(area)), loss.ratio, why, loss.surface, loss.volume)


def _lost_ratio(part: Part, solids: Sequence[ConvexSolid], area: float, limit: float) -> float:
    """Returns the fraction of the part's surface that is cut, or of its volume if smaller; `area` is what is cut."""
    if part.mesh.area == 0 or not solids:
        return 0.0
    by_area = area / part.mesh.area
    return by_area if by_area < limit else min(by_area, lost_volume(part, solids))


def _is_hidden(scene: Scene, part: Part, solids: Sequence[ConvexSolid], config: RealizationConfig) -> bool:
    """Whether hardly any of what the solids cut off is seen from outside, all closed; rails and hinges are not seen."""
    if sense_of(part.source.name).is_fitting:
        return True
    points = sample_surface(part.mesh, _SAMPLES).points
    inside = points[np.any([solid.contains(points) for solid in solids], axis=0)]
    whole = merge_meshes(tuple(other.mesh for other in scene.parts.values()))
    return bool(np.count_nonzero(outer_points(inside, whole)) <= config.max_carve_seen * _SAMPLES)


def _swept_solids(
    scene: Scene, path: Path, ids: Sequence[str], play: float, config: RealizationConfig, most: int
) -> Iterator[ConvexSolid]:
    """Yields convex solids that cover the path of whatever of the moving body cuts into a blocker, with some play."""
    poses = [path.motion(v) for v in np.linspace(0.0, path.reach, _steps(path) + 1)]
    boxes = [scene.parts[name].box for name in ids]
    for points in _cutting_pieces(scene, path, ids, play, config, most):
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
    scene: Scene, path: Path, ids: Sequence[str], play: float, config: RealizationConfig, most: int
) -> Iterator[Points]:
    """Yields the corners, with play, of what cuts in: a convex piece's hull, or the triangles of other pieces."""
    mesh = scene.moving_mesh(path.moving)
    body = scene.swept_body(path.moving, config.depth * scene.extent, path.axes)
    colliders = [MeshCollider(scene.parts[name].mesh) for name in ids]
    cutting = _cutting_faces(body, path, colliders, config.fine_poses)
    numbers = part_numbers(mesh)
    for number in np.unique(numbers[cutting]):
        piece = mesh.with_faces(numbers == number)
        faces = cutting[numbers[cutting] == number]
        hull = ConvexSolid.around(piece.vertices)
        if hull is not None and (len(faces) * _steps(path) > most or _is_convex(piece, hull, play)):
            yield _grown(np.asarray(hull.vertices), play, path.axes)
        else:
            yield from (_grown(triangle, play, path.axes) for triangle in mesh.triangles[faces])


def _cutting_faces(body: SweptBody, path: Path, obstacles: Sequence[MeshCollider], poses: int) -> np.ndarray:
    """Returns the numbers of the moving faces that cut into an obstacle somewhere along the path."""
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
