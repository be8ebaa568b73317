"""Cuts the moving part's path out of static parts, where little of them goes.

The path that must become free, and what stands in it.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from typing import TypeAlias, final

import numpy as np

from grafu.asset.labels import sense_of
from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat3, Points, Scalars, Vec3, distinct
from grafu.geometry.box import Box
from grafu.geometry.components import part_numbers
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster, outer_points
from grafu.geometry.sampling import sample_surface
from grafu.geometry.solids import ConvexSolid, clip_by_faces, in_any, subtract
from grafu.geometry.transform import transform_points
from grafu.joints.clearance.loss import lost_volume, measured_loss
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import PoseFunction, SweepVerdict, in_the_way, opening_values, sweep, swept_box
from grafu.joints.report import Clearance
from grafu.scene.scene import Scene
from grafu.shapes import Float


@final
@dataclass(frozen=True, eq=False)
class Path:
    """A motion from 0 to `reach` (radians if `is_turn`, else metres); the columns of `axes` are those of its box."""

    moving: str
    motion: PoseFunction
    reach: float
    axes: Mat3
    is_turn: bool

    @property
    def shift(self) -> Vec3:
        """How far what slides is moved at the end, along each of `axes`, metres."""
        return np.asarray(self.motion(self.reach)[:3, 3] @ self.axes)

    @property
    def slide_axis(self) -> int:
        """Along which of `axes` it slides."""
        return int(np.argmax(np.abs(self.shift)))


@final
@dataclass(frozen=True, eq=False)
class Carving:
    """Solids cut out of a static part, by `area` square metres of its surface; the loss is yet to be measured.

    `lost` is the area that goes of each face of the part.
    """

    part: Part
    solids: tuple[ConvexSolid, ...]
    area: float
    lost: Scalars
    moving: str

    def recorded(self) -> Clearance:
        """Returns what goes of the part; measuring it takes longer than cutting."""
        loss = measured_loss(self.part, self.solids, self.lost)
        why, amount = f"stood in the way of {self.moving}", float(np.sqrt(self.area))
        return Clearance(self.part.id, "carved", amount, loss.ratio, why, loss.surface, loss.volume)


Change: TypeAlias = Clearance | Carving
ClearanceStep: TypeAlias = Callable[[Scene, Path, Sequence[str], RealizationConfig], tuple[Scene, Sequence[Change]]]


def obstruction(
    scene: Scene, path: Path, config: RealizationConfig, ignored: frozenset[str] = frozenset()
) -> SweepVerdict:
    """Returns how far the static parts block the path of the moving body, and which of them do, `ignored` left out."""
    mesh = scene.moving_mesh(path.moving)
    body = scene.swept_body(path.moving, config.depth * scene.extent, path.axes)
    near = in_the_way(scene.static_obstacles.without(ignored), swept_box(mesh.box, path.motion, path.reach))
    return sweep(body, path.motion, path.reach, near, config.fine_poses)


def box_in(axes: Mat3, mesh: TriangleMesh) -> Box:
    """Returns the box around a mesh in the coordinates of `axes`."""
    return Box.around(mesh.vertices @ axes)


_TURN_STEP = np.radians(5.0)
_MOST_PLANES = 26  # of a box with its edges and corners bevelled
_SAMPLES = 2000  # points on a part where it is looked at
_FEW_SOLIDS = (24, 96, 192, 384)  # with which it is seen which parts would lose too much, before all are made
_SURE = 0.02  # of a part: how far beyond its limit a few solids must take it; volumes are counted to about half of that
MOST_SOLIDS = 400  # a piece whose cutting triangles would sweep out more is covered by its convex hull


def carve(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig, most: int = MOST_SOLIDS
) -> tuple[Scene, list[Change]]:
    """Returns the scene with the path cut out of those blockers that lose less than the limit.

    A piece whose cutting triangles would sweep out more than `most` solids is covered by its convex hull: that is
    faster, and cuts more.
    """
    ids = [name for name in ids if len(scene.parts[name].mesh.faces) <= config.carved_faces]
    play = config.clearance.play * config.depth * scene.extent
    swept = _swept(scene, path, ids, play, config, most)
    for count in _FEW_SOLIDS:
        if len(swept := swept.near([scene.parts[name].box for name in ids])) >= 2 * count:
            few = swept.solids(len(swept) // count)
            ids = [name for name in ids if not _loses_too_much(cut_by(scene.parts[name], few, config), scene, config)]
    solids = swept.near([scene.parts[name].box for name in ids]).solids()
    carved: list[Part] = []
    done: list[Change] = []
    for name in ids:
        cut = cut_by(scene.parts[name], solids, config)
        if cut.ratio == 0 or _loses_too_much(cut, scene, config, sure=0.0):
            continue
        surfaces = (subtract(s, cut.solids, left) for s, left in zip(cut.part.surfaces, cut.clipped, strict=True))
        carved.append(replace(cut.part, surfaces=tuple(s for s in surfaces if not s.is_empty)))
        done.append(Carving(cut.part, cut.solids, cut.area, cut.lost, path.moving))
    return scene.replaced(carved), done


@final
@dataclass(frozen=True, eq=False)
class Cut:
    """What solids would take of a part: its surfaces without that, square metres in all and of each face, the ratio."""

    part: Part
    solids: tuple[ConvexSolid, ...]
    clipped: tuple[Surface, ...]
    area: float
    lost: Scalars
    ratio: float


def cut_by(part: Part, solids: Sequence[ConvexSolid], config: RealizationConfig) -> Cut:
    """Returns what solids would take of a part."""
    near = tuple(solid for solid in solids if solid.box.overlaps(part.box))
    clipped, lost = zip(*(clip_by_faces(surface, near) for surface in part.surfaces), strict=True)
    area = sum(surface.mesh.area - left.mesh.area for surface, left in zip(part.surfaces, clipped, strict=True))
    return Cut(part, near, clipped, area, np.concatenate(lost), _lost_ratio(part, near, area, config))


def _loses_too_much(cut: Cut, scene: Scene, config: RealizationConfig, sure: float = _SURE) -> bool:
    """Whether a part loses more than it may, by more than `sure`: what a few solids take, more of them take as well."""
    if cut.ratio < config.max_carve + sure:
        return False
    is_much = cut.ratio >= config.max_carve_hidden + sure
    return is_much or not is_hidden(scene, cut.part, cut.solids, config.max_carve_seen)


def _lost_ratio(part: Part, solids: Sequence[ConvexSolid], area: float, config: RealizationConfig) -> float:
    """Returns the fraction of the part's surface that is cut, or of its volume if smaller; `area` is what is cut.

    It is exact enough to tell on which side of the limits it lies.
    """
    if part.mesh.area == 0 or not solids:
        return 0.0
    by_area = area / part.mesh.area
    if by_area < config.max_carve:
        return by_area
    return min(by_area, lost_volume(part, solids, (config.max_carve, config.max_carve_hidden)))


def is_hidden(scene: Scene, part: Part, solids: Sequence[ConvexSolid], most: float) -> bool:
    """Whether hardly any of what the solids cut off is seen from outside, all closed; rails and hinges are not seen.

    `most` is the fraction of the part's surface that counts as hardly any.
    """
    if sense_of(part.source.name).is_fitting:
        return True
    points = sample_surface(part.mesh, _SAMPLES).points
    inside = points[in_any(solids, points)]
    drawn = (other.box for other in scene.parts.values() if len(other.mesh.faces))  # all parts are read, each time
    seen = outer_points(inside, scene.once(_caster), float(Box.enclosing(drawn).size.max()))
    return bool(np.count_nonzero(seen) <= most * _SAMPLES)


def _caster(scene: Scene) -> RayCaster:
    return RayCaster(merge_meshes(tuple(part.mesh for part in scene.parts.values())))


@final
@dataclass(frozen=True, eq=False)
class _Swept:
    """Corners whose hulls cover a path, in order, and the boxes around them grown by `play` metres."""

    corners: Sequence[Points]
    play: float

    def __len__(self) -> int:
        return len(self.corners)

    def near(self, boxes: Sequence[Box]) -> "_Swept":
        """Returns those that come within the play of one of some boxes."""
        if not boxes or not self.corners:
            return _Swept((), self.play)
        lows, highs = np.array([box.low for box in boxes]), np.array([box.high for box in boxes])
        low = np.array([corners.min(axis=0) for corners in self.corners])[:, None]
        high = np.array([corners.max(axis=0) for corners in self.corners])[:, None]
        is_near = np.all(np.maximum(low - highs, lows - high) <= self.play, axis=2).any(axis=1)
        return _Swept([self.corners[k] for k in np.flatnonzero(is_near).tolist()], self.play)

    def solids(self, each: int = 1) -> list[ConvexSolid]:
        """Returns the hulls, or each so-manieth of them; none of what is flat."""
        found = (ConvexSolid.around(corners) for corners in self.corners[::each])
        return [solid for solid in found if solid is not None]


def _swept(scene: Scene, path: Path, ids: Sequence[str], play: float, config: RealizationConfig, most: int) -> _Swept:
    """Returns what covers the path of whatever of the moving body cuts into a blocker, with some play."""
    poses = [path.motion(v) for v in np.linspace(0.0, path.reach, steps_of(path) + 1)]
    corners: list[Points] = []
    for points in _cutting_pieces(scene, path, ids, play, config, most):
        posed = np.stack([transform_points(T, points) for T in poses])
        corners += [posed[k : k + 2].reshape(-1, 3) for k in range(len(poses) - 1)]
    return _Swept(corners, play)


def steps_of(path: Path) -> int:
    """Returns in how many convex steps a path is covered."""
    return max(1, int(np.ceil(path.reach / _TURN_STEP))) if path.is_turn else 1


def _cutting_pieces(
    scene: Scene, path: Path, ids: Sequence[str], play: float, config: RealizationConfig, most: int
) -> Iterator[Points]:
    """Yields the corners, with play, of what cuts in: a convex piece's hull, or the triangles of other pieces."""
    mesh = scene.moving_mesh(path.moving)
    cutting = scene.once(_cutting_faces, path, tuple(ids), config)
    numbers = part_numbers(mesh)
    for number in distinct(numbers[cutting]):
        piece = mesh.with_faces(numbers == number)
        faces = cutting[numbers[cutting] == number]
        hull = ConvexSolid.around(piece.vertices)
        if hull is not None and (len(faces) * steps_of(path) > most or _is_convex(piece, hull, play)):
            yield _grown(np.asarray(hull.vertices), play, path.axes)
        else:
            yield from (_grown(triangle, play, path.axes) for triangle in mesh.triangles[faces])


def _cutting_faces(scene: Scene, path: Path, ids: tuple[str, ...], config: RealizationConfig) -> np.ndarray:
    """Returns the numbers of the moving faces that cut into a blocker somewhere along the path."""
    body = scene.swept_body(path.moving, config.depth * scene.extent, path.axes)
    swept = swept_box(scene.moving_mesh(path.moving).box, path.motion, path.reach)
    near = in_the_way(scene.static_obstacles, swept)
    obstacles, counted = [o.collider for o in near], [o.id in ids for o in near]
    found: set[int] = set()
    for value in opening_values(path.reach, config.fine_poses):
        body.place(path.motion(value))
        found |= body.cutting_faces(obstacles, counted)
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
