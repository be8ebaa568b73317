"""The solids that are cut away: convex, in the grip frame (X along the gripped edge, Y towards it, Z outwards).

The grip frame: a door or drawer front seen from before it, with the edge at which it is gripped on top.

X runs along the gripped edge, Y across the front towards it, Z outwards, right-handed; the frame shares its origin with
the object frame. It is a `grafu.scene.front.Front`, turned. A door is gripped opposite its hinge, a drawer at its upper
edge, a sliding door at the edge that trails when it opens.
"""

from dataclasses import replace
from itertools import pairwise
from typing import final

import numpy as np

from grafu.additions.grip.config import GripConfig, GripKind, GripProfile, GripSize, GripSizes
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Points, Scalars, distinct, freeze_arrays
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.solids import ConvexSolid
from grafu.scene.front import Front
from grafu.shapes import Float


@final
@dataclass(frozen=True, eq=False)
class GripFrame(ArrayValue):
    """See the module's docstring; `rotation` has X, Y, Z as columns in the object frame, `box` is in the frame."""

    rotation: Mat3
    box: Box

    def __post_init__(self) -> None:
        freeze_arrays(self, "rotation")

    @property
    def length(self) -> float:
        """The gripped edge's length."""
        return float(self.box.size[0])

    @property
    def breadth(self) -> float:
        """The front's side across the gripped edge."""
        return float(self.box.size[1])

    def local(self, points: Points) -> Points:
        """Returns points of the object frame in the grip frame."""
        return points @ self.rotation

    def in_object(self, points: Points) -> Points:
        """Returns points of the grip frame in the object frame."""
        return points @ self.rotation.T


def grip_frame(mesh: TriangleMesh, front: Front, config: GripConfig) -> GripFrame:
    """Returns the grip frame of a part on a front: its upper edge is the one that a hand opens the front at.

    A drawer has no such edge: there it is the one that the config names, of one that faces up the nearer edge.
    """
    upper = front.up if abs(float(front.up[2])) > abs(float(front.inwards[2])) else -front.up
    if front.held is None:
        towards = upper if config.drawer_side == "top" else -upper
    else:
        towards = {"left": -front.right, "right": front.right, "top": front.up, "bottom": -front.up}[front.held]
    out = -front.inwards
    rotation = np.column_stack([np.cross(towards, out), towards, out])
    return GripFrame(rotation, Box.around(mesh.vertices[distinct(mesh.faces)] @ rotation))


Outline = Float[np.ndarray, "n 2"]

QUARTER_EDGES = 6
"""Straight edges of a quarter turn."""
TURN_EDGES = 4 * QUARTER_EDGES
"""Straight edges of a whole turn, and of the half turn of a notch."""
BOTTOM_LEVELS = 5
"""Levels of a rounded bottom."""
RIM_SLICES = 3
"""Slices of a rounded rim."""
RIM_TRACE = 0.05
"""Fraction of a rim's radius by which what cuts it ends above the face: an edge in the very face leaves slivers."""
DIGITS = 9
"""Decimals to which the corners of a circle are rounded before it is asked on which side of its middle they lie."""
LEVEL_TOLERANCE = 1e-9
"""Distance from a level up to which a corner lies on it, metres."""


@final
@dataclass(frozen=True, slots=True)
class GripCut:
    """One grip in the grip frame: its middle (x, y), where an edge notch's y is the edge itself; its size; its levels.

    It is cut from `top`, above the front, down to `bottom`; `face` is the level of the front's face. `is_hollow` states
    that there is nothing but sheets to cut, so that the cut needs a lining. Levels hold in the middle; elsewhere they
    rise with the front's face, `tilt` along x and y.
    """

    kind: GripKind
    profile: GripProfile
    x: float
    y: float
    size: GripSize
    top: float
    face: float
    bottom: float
    is_hollow: bool = False
    tilt: tuple[float, float] = (0.0, 0.0)

    def lift(self, x: Scalars, y: Scalars) -> Scalars:
        """Returns how much higher a tilted front lies at some points than in the grip's middle."""
        return self.tilt[0] * (x - self.x) + self.tilt[1] * (y - self.y)

    @property
    def box(self) -> Box:
        """The box around all that is cut, without what stands over the edge or the face."""
        half, width = self.size.length / 2, self.size.width
        low, high = (self.y - width, self.y) if self.kind is GripKind.EDGE else (self.y - width / 2, self.y + width / 2)
        return Box(np.array([self.x - half, low, self.bottom]), np.array([self.x + half, high, self.face]))


def tilted(cut: GripCut, points: Points) -> Points:
    """Returns points that were made for a level front as they lie on the tilted one."""
    return points + np.column_stack([np.zeros((len(points), 2)), cut.lift(points[:, 0], points[:, 1])])


def cutters(cut: GripCut, sizes: GripSizes) -> tuple[ConvexSolid, ...]:
    """Returns the solids of a grip, in the grip frame, as they are on a level front."""
    rounded = cut.profile == "rounded"
    if cut.kind is GripKind.GROOVE:
        outline = _oval(cut) if rounded else _rectangle(cut)
        # sheets are cut by the outline alone, which is quick; what curves is their lining
        solids = [_groove(cut, sizes) if rounded and not cut.is_hollow else _prism(outline, cut.bottom, cut.top)]
    elif cut.kind is GripKind.EDGE:
        solids = [_prism(_notch(cut, sizes.beyond * cut.size.width), cut.bottom, cut.top)]
    else:
        solids = _stages(cut, sizes) if _is_rounded(cut) else [_prism(_oval(cut), cut.bottom, cut.top)]
    return tuple(solid for solid in solids if solid is not None)


def lining(cut: GripCut, sizes: GripSizes) -> TriangleMesh:
    """Returns the walls of a grip in a hollow board, in the grip frame, as on a level front: they look into it."""
    if cut.kind is GripKind.GROOVE:
        (solid,) = cutters(replace(cut, top=cut.face, is_hollow=False), sizes)
    else:
        outline = _notch(cut, 0.0) if cut.kind is GripKind.EDGE else _oval(cut)
        made = _prism(outline, cut.face - cut.size.depth, cut.face)
        assert made is not None
        solid = made
    level = np.abs(solid.mesh.triangles[:, :, 2] - cut.face).max(axis=1) < LEVEL_TOLERANCE
    if cut.kind is not GripKind.GROOVE:
        level |= np.abs(solid.mesh.triangles[:, :, 2] - cut.face + cut.size.depth).max(axis=1) < LEVEL_TOLERANCE
    if cut.kind is GripKind.EDGE:
        level |= np.abs(solid.mesh.triangles[:, :, 1] - cut.y).max(axis=1) < LEVEL_TOLERANCE
    walls = solid.mesh.with_faces(~level)
    return TriangleMesh(walls.vertices, walls.faces[:, ::-1])


def _prism(outline: Outline, bottom: float, top: float) -> ConvexSolid | None:
    return ConvexSolid.around(np.vstack([_at(outline, bottom), _at(outline, top)]))


def _at(outline: Outline, level: float) -> Points:
    return np.column_stack([outline, np.full(len(outline), level)])


def _rectangle(cut: GripCut) -> Outline:
    half = np.array([cut.size.length, cut.size.width]) / 2
    return np.array([cut.x, cut.y]) + half * np.array([(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)])


def _oval(cut: GripCut, grown: float = 0.0) -> Outline:
    """Returns a slot with round ends, a circle where it is as long as wide; grown or shrunk all round."""
    size = np.array([cut.size.length, cut.size.width])
    radius = float(size.min()) / 2
    ends = size / 2 - radius
    angles = _half_turn(TURN_EDGES, 2 * np.pi)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    return np.array([cut.x, cut.y]) + (radius + grown) * circle + ends * np.sign(np.round(circle, DIGITS))


def _groove(cut: GripCut, sizes: GripSizes) -> ConvexSolid | None:
    """Returns a hollow with round ends whose walls curve into its bottom."""
    depth = cut.face - cut.bottom
    radius = sizes.bottom_radius * min(depth, 0.5 * min(cut.size.length, cut.size.width))
    angles = np.linspace(0.0, np.pi / 2, BOTTOM_LEVELS + 1)
    levels = [(cut.bottom + radius * (1 - np.sin(a)), -radius * (1 - np.cos(a))) for a in angles]
    points = [_at(_oval(cut, inset), level) for level, inset in levels]
    return ConvexSolid.around(np.vstack([_at(_oval(cut), cut.top), *points]))


def _notch(cut: GripCut, over: float) -> Outline:
    """Returns half an ellipse or a rectangle that goes `over` metres beyond the edge."""
    half, width = cut.size.length / 2, cut.size.width
    if cut.profile == "sharp":
        inner = np.array([(-half, -width), (half, -width)])
    else:
        angles = np.linspace(-np.pi, 0.0, TURN_EDGES + 1)
        inner = np.column_stack([half * np.cos(angles), width * np.sin(angles)])
    return np.array([cut.x, cut.y]) + np.vstack([inner, [(half, over), (-half, over)]])


def union(cut: GripCut, sizes: GripSizes) -> TriangleMesh | None:
    """Returns the watertight surface around all of a grip's cutters, in their frame; None: there is one."""
    if not _is_rounded(cut):
        return None
    rings = [_at(_oval(cut, grown), level) for grown, level in _hole_levels(cut, sizes)]
    count, size = len(rings), len(rings[0])
    points = np.vstack([*rings, rings[0].mean(axis=0), rings[-1].mean(axis=0)])
    at = np.arange(size)
    after = (at + 1) % size
    faces = [np.column_stack([np.full(size, count * size), after, at])]
    for k in range(0, (count - 1) * size, size):
        faces.append(np.column_stack([k + at, k + after, k + size + after]))
        faces.append(np.column_stack([k + at, k + size + after, k + size + at]))
    last = (count - 1) * size
    faces.append(np.column_stack([np.full(size, count * size + 1), last + at, last + after]))
    return TriangleMesh(points, np.vstack(faces))


def _is_rounded(cut: GripCut) -> bool:
    return cut.kind is GripKind.HOLE and cut.profile == "rounded" and not cut.is_hollow


def _hole_levels(cut: GripCut, sizes: GripSizes) -> list[tuple[float, float]]:
    """Returns by how much a hole with a rounded rim is wider, and at which level, upwards: a quarter turn outwards."""
    radius = sizes.rim_radius * (cut.face - cut.bottom)
    angles = np.linspace(np.pi / 2, 0.0, RIM_SLICES + 1)
    rim = [(float(radius * (1 - np.sin(a))), float(cut.face - radius * (1 - RIM_TRACE - np.cos(a)))) for a in angles]
    return [(0.0, cut.bottom), *rim, (radius, cut.top)]


def _stages(cut: GripCut, sizes: GripSizes) -> list[ConvexSolid | None]:
    """Returns the convex slices of a hole with a rounded rim."""
    rings = [_at(_oval(cut, grown), level) for grown, level in _hole_levels(cut, sizes)]
    return [ConvexSolid.around(np.vstack(pair)) for pair in pairwise(rings)]


def _half_turn(pieces: int, turn: float) -> Scalars:
    """Returns the angles of the corners of a turn in straight pieces, none of them straight ahead."""
    return np.arange(pieces) * turn / pieces + turn / pieces / 2
