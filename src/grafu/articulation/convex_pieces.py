"""A mesh taken apart into nearly convex pieces: boards are cut off around its deepest pit until no pit is left.

Works on surfaces as they are, open or closed: a pit is empty space inside the convex hull from which one can look out
along an axis and which is far from every face.
Coordinates are the caller's; the pieces fit best in a frame along the boards.
"""

from collections.abc import Iterator
from functools import cached_property
from itertools import islice
from typing import Any, final

import numpy as np

from grafu.articulation.board_holes import BoardHole, holes_through, is_board
from grafu.articulation.plain_boxes import has_all_corners, is_plain_box
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Scalars, Vec3
from grafu.geometry.box import Box
from grafu.geometry.budget import require_time
from grafu.geometry.components import tidy_parts
from grafu.geometry.config_checks import require_positive
from grafu.geometry.halves import halves_of
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.simplify import mesh_of, solid_of
from grafu.geometry.solids import ConvexSolid, few_corners
from grafu.shapes import Bool

_DIRECTIONS = np.array([[-1.0, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]])
_HULL_CORNERS = 32
_GRID = 10  # points per side at most: pits narrower than a tenth of the part are filled
_TRIES = 8  # walls of one pit, and cuts through it, that are tried for a clean cut


@final
@dataclass(frozen=True, slots=True)
class ConvexPieceConfig:
    """How finely a mesh is taken apart.

    Raises:
        ValueError: if a number is not above 0.
    """

    tolerance: float = 0.02
    """Pits less deep than this are filled (metres)."""
    hole: float = 0.04
    """Holes through a board are left open where a circle of this diameter fits into them (metres) ..."""
    window: float = 0.12
    """... and none of this diameter: wider ones are pits as any other (metres)."""
    board: float = 0.05
    """What is thicker is no board (metres)."""
    boxed: float = 0.85
    """Fraction of its box from which on a piece of a board may be taken as that box (see `CollisionShapeConfig`)."""
    most_cuts: int = 40
    """How often one mesh is cut at most; connected parts come apart without a cut."""
    rim: float = 0.02
    """A cut that takes off less than this part of the surface shaves a rim: others are tried first."""
    past_wall: float = 0.0005
    """How far behind the wall of a pit a cut lies: faces on it belong to the board that is cut off (metres)."""
    speck: float = 0.004
    """Pieces with a shorter diagonal carry no load and stop no hand (metres)."""

    def __post_init__(self) -> None:
        require_positive(
            self, "tolerance", "hole", "window", "board", "boxed", "most_cuts", "rim", "past_wall", "speck"
        )


DEFAULT_PIECE_CONFIG = ConvexPieceConfig()


def convex_pieces(mesh: TriangleMesh, config: ConvexPieceConfig = DEFAULT_PIECE_CONFIG) -> list[TriangleMesh]:
    """Returns nearly convex pieces of a mesh: one where it has no pits, else its parts, cut along axis planes.

    Specks of a few millimetres are left out, except where there is nothing else.
    """
    pieces = [piece.mesh for piece in _taken_apart(_Piece(mesh, config, is_whole=True))]
    return [piece for piece in pieces if piece.box.diagonal > config.speck] or pieces[:1]


def hull_of(points: Points, least_thickness: float) -> ConvexSolid | None:
    """Returns the convex hull of points; flat ones are thickened to `least_thickness` metres. None for fewer than 3."""
    return ConvexSolid.around(_thickened(points, least_thickness))


@final
@dataclass(frozen=True)
class _Piece:
    """A mesh and, where it bounds a solid, that solid: what is cut from a solid stays one."""

    mesh: TriangleMesh
    config: ConvexPieceConfig
    solid: Any = None  # a manifold3d.Manifold
    known: tuple[BoardHole, ...] | None = None  # through the board that it was cut from
    is_whole: bool = False

    @cached_property
    def pit(self) -> Vec3 | None:
        """The point of the deepest pit, else of a hole, None where every pit is within the tolerance."""
        if is_plain_box(self.mesh):
            return None
        closed = (hole.middle for hole in self.holes if hole.is_closed_by(self.mesh, self.config.boxed))
        deepest = self._deepest
        return next(closed, None) if deepest is None else deepest

    @property
    def _deepest(self) -> Vec3 | None:
        mesh, side, tolerance = self.mesh, float(self.mesh.box.size.max()), self.config.tolerance
        if side < 2 * tolerance:
            return None
        points = _grid(mesh.box, tolerance)
        depth = _depths(self.caster, points, mesh.box, tolerance)
        left = np.flatnonzero(depth)
        left = left[_is_inside_hull(mesh, points[left], self.config.speck)] if len(left) else left
        return points[left[int(np.argmax(depth[left]))]] if len(left) else None

    @cached_property
    def holes(self) -> tuple[BoardHole, ...]:
        """The holes through the board that it is, or that it was cut from.

        What was cut from a surface, or is one shell of several, may be open where the whole is not: it is not asked.
        """
        if self.known is not None:
            return self.known
        is_closed = self.is_whole or self.solid is not None
        return holes_through(self.mesh, self.config.hole, self.config.window, self.config.board) if is_closed else ()

    @property
    def passed_on(self) -> tuple[BoardHole, ...] | None:
        """The holes that what is cut from it has; None: each solid is asked for its own."""
        if self.known is not None:
            return self.known
        is_known = (self.is_whole or self.solid is not None) and is_board(self.mesh, self.config.board)
        return self.holes if is_known else None

    @cached_property
    def area(self) -> float:
        """The area of all its faces."""
        return self.mesh.area

    @cached_property
    def caster(self) -> RayCaster:
        """Rays against the piece."""
        return RayCaster(self.mesh)

    def parts(self) -> list["_Piece"]:
        """Returns the connected parts, each as a solid where it bounds one."""
        if self.solid is not None:
            return [self._of_solid(part) for part in self.solid.decompose()]
        parts = ((part, solid_of(part) if closed else None) for part, closed in tidy_parts(self.mesh))
        return [
            _Piece(part, self.config, known=self.passed_on) if solid is None else self._of_solid(solid)
            for part, solid in parts
        ]

    def halves(self, axis: int, sign: float, position: float) -> tuple["_Piece", "_Piece"]:
        """Returns what lies beyond a plane across `axis` (on the side of `sign`), and the rest."""
        normal = np.zeros(3)
        normal[axis] = sign
        if self.solid is not None:
            beyond, rest = self.solid.split_by_plane(tuple(normal), sign * position)
            return self._of_solid(beyond), self._of_solid(rest)
        origin = np.abs(normal) * position
        beyond, rest = halves_of(self.mesh, normal, origin)
        known = self.passed_on
        return _Piece(beyond, self.config, known=known), _Piece(rest, self.config, known=known)

    def _of_solid(self, solid: Any) -> "_Piece":
        return _Piece(mesh_of(solid), self.config, solid, self.passed_on)


def _taken_apart(whole: _Piece) -> list[_Piece]:
    waiting, done, cuts = [whole], list[_Piece](), whole.config.most_cuts
    while waiting:
        require_time()
        piece = waiting.pop(int(np.argmax([w.area for w in waiting])))  # large ones first: cuts are scarce
        if piece.pit is None:
            done.append(piece)
            continue
        parts = piece.parts()
        if len(parts) == 1 and cuts:
            parts = _cut(parts[0], piece.pit)
            cuts -= 1
        if len(parts) > 1:
            waiting += parts
        else:
            done.append(piece)
    return done


def _grid(box: Box, spacing: float) -> Points:
    counts = np.clip(np.ceil(box.size / max(spacing, 1e-6)), 2, _GRID).astype(int)
    axes = [low + (np.arange(n) + 0.5) / n * size for low, n, size in zip(box.low, counts, box.size, strict=True)]
    grid = np.empty((*map(len, axes), 3))
    grid[..., 0], grid[..., 1], grid[..., 2] = axes[0][:, None, None], axes[1][:, None], axes[2]
    return grid.reshape(-1, 3)


def _is_inside_hull(mesh: TriangleMesh, points: Points, thickness: float) -> Bool[np.ndarray, " n"]:
    """Returns which points lie inside the hull of a mesh, flat ones thickened (metres); none where it has no hull.

    The points lie well within the mesh's box: of a mesh with a vertex at each corner of its box all are inside.
    """
    if has_all_corners(mesh):
        return np.ones(len(points), dtype=np.bool_)
    from scipy.spatial import ConvexHull, QhullError  # local: it takes 0.3 s to import, and not all need a hull

    try:
        planes = ConvexHull(_thickened(few_corners(mesh.vertices, _HULL_CORNERS), thickness)).equations
    except (QhullError, ValueError):
        return np.zeros(len(points), dtype=np.bool_)
    return np.asarray((points @ planes[:, :3].T <= -planes[:, 3] - 1e-6).all(axis=1))


def _looks(caster: RayCaster, points: Points) -> np.ndarray:
    """Returns how far one sees from each point along the six axis directions, (points, 6)."""
    origins, directions = np.repeat(points, 6, axis=0), np.tile(_DIRECTIONS, (len(points), 1))
    return caster.distances(origins, directions).reshape(-1, 6)


def _depths(caster: RayCaster, points: Points, box: Box, least: float) -> Scalars:
    """Returns how far each point is from any face, at most a box's largest side; 0 where no direction leads out.

    Of what is no farther than `least` it is enough to find one face: it is given 0, too. Most is found across the
    thinnest side of the box.
    """
    depth, leads_out = np.full(len(points), float(box.size.max())), np.zeros(len(points), dtype=bool)
    left = np.arange(len(points))
    for direction in _DIRECTIONS[np.argsort(np.repeat(box.size, 2), kind="stable")]:
        seen = caster.along(points[left], direction)
        depth[left] = np.minimum(depth[left], seen)
        leads_out[left] |= np.isinf(seen)
        left = left[depth[left] > least]
    return np.where(leads_out & (depth > least), depth, 0.0)


def _cut(piece: _Piece, pit: Vec3) -> list[_Piece]:
    """Returns both sides of a wall of the pit: at best one where what lies beyond it has no pit and is no mere rim.

    Else the two are as even as they can be.
    """
    fallback, most = list[_Piece](), 0.0
    for axis, sign, position in islice(_walls(piece, pit), _TRIES):
        require_time()
        board, rest = piece.halves(axis, sign, position - sign * piece.config.past_wall)
        if not len(board.mesh.faces) or not len(rest.mesh.faces):
            continue
        if board.area >= piece.config.rim * piece.area and board.pit is None:
            return [board, rest]
        smaller = min(board.area, rest.area)
        if smaller > most:
            fallback, most = [board, rest], smaller
    return fallback


def _walls(piece: _Piece, pit: Vec3) -> Iterator[tuple[int, float, float]]:
    """Yields axis, sense and position of each wall seen from the pit, the largest faces of the box first.

    The edges of a hole through a board come before them. Cuts at the corners nearest to the pit along the long sides
    come last: where no wall is seen, as in the opening of a sheet, they are its edges.
    """
    yield from (wall for hole in piece.holes if hole.middle is pit for wall in hole.edges(piece.mesh.box))
    seen = _looks(piece.caster, pit[None])[0]
    size = piece.mesh.box.size
    order = sorted(range(6), key=lambda k: float(size[k // 2]))  # the face across a short side is large
    for k in order:
        if np.isfinite(seen[k]):
            yield k // 2, float(_DIRECTIONS[k, k // 2]), float(pit[k // 2] + _DIRECTIONS[k, k // 2] * seen[k])
    for axis in map(int, np.argsort(-size)[:2]):
        corners = np.unique(piece.mesh.vertices[piece.mesh.faces, axis])
        yield from ((axis, 1.0, float(at)) for at in corners[corners > pit[axis]][:1])
        yield from ((axis, -1.0, float(at)) for at in corners[corners < pit[axis]][-1:])


def _thickened(points: np.ndarray, least: float) -> Points:
    """Returns points that are at least `least` apart in every direction: flat sets are doubled along their normal."""
    offsets = points - points.mean(axis=0)
    for axis in np.linalg.eigh(offsets.T @ offsets)[1].T:
        extent = float(np.ptp(points @ axis))
        if extent < least:
            points = np.vstack([points - axis * (least - extent) / 2, points + axis * (least - extent) / 2])
    return points
