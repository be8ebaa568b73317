"""The drawer frame, and the body region of a drawer: where its container runs, behind the pulling board.

X runs across the drawer (right-handed with Z up), Y from the front into the cabinet, against the sliding direction. The
origin is the middle of the drawer's front side: it fills |x| <= width / 2, 0 <= y <= depth, |z| <= height / 2. A
sliding door is framed alike, but lying: X up, so that its flanks are its lower and upper edges, where tracks belong.
"""

from collections.abc import Callable
from itertools import pairwise
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Mat4, Points, Vec3, freeze_arrays, median, row_medians, vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.raycast import RayCaster
from grafu.geometry.shells import shell_numbers
from grafu.geometry.transform import from_rotation, transform_points
from grafu.joints.rail_config import BodyConfig, DrawerConfig
from grafu.scene.border import SNAP, part_axes

_SLIDE, _HEIGHT = 41, 25  # rays along the slide and over the height; the authors cast 25 x 11, trays need finer rows
_FINER = 24  # rows between two of those, where a body begins and ends: to a thousandth of the depth


@final
@dataclass(frozen=True, eq=False, slots=True)
class DrawerFrame(ArrayValue):
    """See the module's docstring; `rotation` has X, Y, Z as columns in the object frame."""

    origin: Vec3
    rotation: Mat3
    width: float
    depth: float
    height: float

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    @property
    def T_object_drawer(self) -> Mat4:
        """Maps drawer coordinates to the object frame."""
        return from_rotation(self.rotation, self.origin)

    @property
    def slide(self) -> Vec3:
        """The unit direction in which the drawer opens, in the object frame."""
        return -self.rotation[:, 1]

    def to_object(self, points: Points) -> Points:
        """Returns points of the drawer frame in the object frame."""
        return transform_points(self.T_object_drawer, points)


def drawer_frame(
    mesh: TriangleMesh, direction: Vec3, lying: bool = False, config: DrawerConfig = DrawerConfig()
) -> DrawerFrame | None:
    """Returns the frame of a part that slides along a unit direction; None where it slides up or down.

    The direction is snapped to the nearest level axis of the part's own box within 8 degrees, else kept. `lying` frames
    a sliding door.
    """
    if abs(float(direction[2])) > config.level:
        return None
    axes = part_axes(mesh)
    nearest = int(np.argmax(np.abs(axes.T @ direction)))
    snapped = axes[:, nearest] * np.sign(float(axes[:, nearest] @ direction))
    slide = snapped if float(snapped @ direction) > SNAP else direction
    up = vec3(0.0, 0.0, 1.0)
    y = -slide / np.linalg.norm(slide)
    x = up if lying else np.cross(y, up)
    return _framed(mesh, x / np.linalg.norm(x), y)


def lift_frame(mesh: TriangleMesh, direction: Vec3) -> DrawerFrame | None:
    """Returns the frame of a part that slides up or down, within 8 degrees; None where it slides another way.

    X is its longer level side, Z its shorter one: of a sash or a shutter, guides run along the sides in X.
    """
    if abs(float(direction[2])) < SNAP * float(np.linalg.norm(direction)):
        return None
    y = vec3(0.0, 0.0, -float(np.sign(direction[2])))
    axes = part_axes(mesh)
    level = axes[:, np.argsort(np.abs(axes[2]))[:2]]
    x = level[:, int(np.argmax(np.ptp(mesh.vertices @ level, axis=0)))] * vec3(1.0, 1.0, 0.0)
    return _framed(mesh, x / np.linalg.norm(x), y)


def _framed(mesh: TriangleMesh, x: Vec3, y: Vec3) -> DrawerFrame:
    rotation = np.column_stack([x, y, np.cross(x, y)])
    local = Box.around(mesh.vertices @ rotation)
    center = local.center
    origin = rotation @ vec3(float(center[0]), float(local.low[1]), float(center[2]))
    width, depth, height = (float(s) for s in local.size)
    return DrawerFrame(origin, rotation, width, depth, height)


@final
@dataclass(frozen=True, slots=True)
class BodyRegion:
    """The container: the x of its flanks, its extent [front, back] along y, and the flanks' extent over z.

    `is_front_only` states that there is no container: rails hang on the back of the front, and must begin there.
    """

    left: float
    right: float
    front: float
    back: float
    bottom: float
    top: float
    is_front_only: bool = False

    @property
    def length(self) -> float:
        """The body's length along the slide."""
        return self.back - self.front

    @property
    def middle(self) -> float:
        """The x of the sagittal plane: midway between the flanks."""
        return (self.left + self.right) / 2

    @property
    def half_width(self) -> float:
        """Half the outer width."""
        return (self.right - self.left) / 2


def body_region(
    mesh: TriangleMesh, frame: DrawerFrame, tolerance: float, config: DrawerConfig = DrawerConfig()
) -> BodyRegion | None:
    """Returns the region around the median of the outer-width profile (supplement, eq. body region); None if no body.

    Each flank has its own profile: a front may stand out further on one side. `tolerance` is a fraction of the width. A
    board has no body, however long its edges are.
    """
    if is_board(frame, config):
        return None
    caster, body = RayCaster(mesh), config.body
    y, z = _grid(frame)
    flanks = _flanks(caster, frame, y, z, body)
    columns = _medians(flanks)
    if min(np.isfinite(columns).sum(axis=1)) < config.shortest * _SLIDE:
        return None
    band = max(tolerance * frame.width, body.even)
    medians = row_medians(columns)
    in_body = (np.abs(flanks - medians[:, None, None]) < band).all(axis=0)
    enough = max(body.met, body.met_ratio * float(in_body.sum(axis=1).max()))
    run = _longest_run(_bridged(in_body.sum(axis=1) >= enough, body))
    if run[1] - run[0] + 1 < config.shortest * _SLIDE:
        return None
    rows = _longest_run(in_body[run[0] : run[1] + 1].mean(axis=0) > body.long)
    if rows[1] < rows[0]:
        return None
    left, right = (median(flank[in_body]) for flank in flanks)
    lift = frame.height / _HEIGHT / 2

    def belongs(at: np.ndarray) -> np.ndarray:
        near = np.abs(_flanks(caster, frame, at, z, body) - medians[:, None, None]) < band
        return np.asarray(near.all(axis=0).sum(axis=1) >= enough)

    front, back = _ends(y[run[0]], y[run[1]], frame.depth, belongs)
    return BodyRegion(left, right, front, back, float(z[rows[0]] - lift), float(z[rows[1]] + lift))


def _ends(first: float, last: float, depth: float, belongs: Callable[[np.ndarray], np.ndarray]) -> tuple[float, float]:
    """Returns where a body begins before its first row of rays and ends behind its last: rows between two tell it."""
    cell = depth / _SLIDE
    reaches = min(cell, first), min(cell, depth - last)
    ratios = (np.arange(_FINER) + 0.5) / _FINER  # away from the body
    found = belongs(np.concatenate([first - reaches[0] * ratios, last + reaches[1] * ratios])).reshape(2, _FINER)
    run = [_FINER if row.all() else int(np.argmin(row)) for row in found]
    return float(first - reaches[0] * run[0] / _FINER), float(last + reaches[1] * run[1] / _FINER)


def is_board(frame: DrawerFrame, config: DrawerConfig = DrawerConfig()) -> bool:
    """Whether a drawer is a mere front: much less deep than it is wide and high, or as thin as boards are."""
    as_thin = min(config.thickest_board, config.slat * max(frame.width, frame.height))
    return frame.depth < max(config.shallow * min(frame.width, frame.height), as_thin)


def is_shallow(frame: DrawerFrame, config: DrawerConfig = DrawerConfig()) -> bool:
    """Whether a drawer may be a mere front with its pull, drawn as one: much less deep than wide or high."""
    return frame.depth < config.shallow * max(frame.width, frame.height)


def board_before_rack(
    mesh: TriangleMesh, frame: DrawerFrame, tolerance: float, config: DrawerConfig = DrawerConfig()
) -> TriangleMesh | None:
    """Returns the front board of a drawer whose mesh holds an open rack, too; None where it holds a body, or a board.

    The board is a shell of its own that fills the drawer's outline. Rails run beside the rack, from the board's back.
    """
    if is_shallow(frame, config) or body_region(mesh, frame, tolerance, config) is not None:
        return None
    number = shell_numbers(mesh)
    for k in range(int(number.max(initial=-1)) + 1):
        board = mesh.with_faces(number == k)
        local = Box.around((board.triangles.reshape(-1, 3) - frame.origin) @ frame.rotation)
        width, thickness, height = local.size.tolist()
        fills = width >= config.outline * frame.width and height >= config.outline * frame.height
        in_front = float(local.low[1]) <= config.shallow * frame.depth
        if fills and in_front and thickness < config.shallow * min(width, height):
            return board
    return None


def _medians(flanks: np.ndarray) -> np.ndarray:
    """Returns the median of each column of cells, of those that were met; NaN where none was."""
    count = np.isfinite(flanks).sum(axis=2)[..., None]
    rising = np.sort(flanks, axis=2)  # what was not met comes last
    lower, upper = (np.take_along_axis(rising, np.maximum(k, 0), axis=2) for k in ((count - 1) // 2, count // 2))
    return np.asarray(np.where(count > 0, (lower + upper) / 2, np.nan)[..., 0])


def _grid(frame: DrawerFrame) -> tuple[np.ndarray, np.ndarray]:
    """Returns the y and the z of the cells' centres."""
    y = (np.arange(_SLIDE) + 0.5) / _SLIDE * frame.depth
    z = ((np.arange(_HEIGHT) + 0.5) / _HEIGHT - 0.5) * frame.height
    return y, z


def _flanks(caster: RayCaster, frame: DrawerFrame, y: np.ndarray, z: np.ndarray, config: BodyConfig) -> np.ndarray:
    """Returns the x of the left and the right outside at each (y, z); NaN where there is none."""
    grid_y, grid_z = (a.ravel() for a in np.meshgrid(y, z, indexing="ij"))
    outside = frame.width / 2 + config.outside
    sides = []
    for sign in (-1.0, 1.0):
        origins = frame.to_object(np.column_stack([np.full_like(grid_y, sign * outside), grid_y, grid_z]))
        distance = caster.along(origins, -sign * frame.rotation[:, 0])
        sides.append(np.where(distance < outside, sign * (outside - distance), np.nan))
    return np.stack(sides).reshape(2, len(y), len(z))


def _bridged(flags: np.ndarray, config: BodyConfig) -> np.ndarray:
    """Returns the flags with short gaps between long runs filled: bins that stand one behind another are one body."""
    found, least = flags.copy(), config.beside_gap * len(flags)
    ends = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]]).astype(int))).reshape(-1, 2)
    for (start, end), (after, last) in pairwise(ends.tolist()):
        if after - end <= config.gap * len(flags) and min(end - start, last - after) >= least:
            found[end:after] = True
    return found


def _longest_run(flags: np.ndarray) -> tuple[int, int]:
    """Returns first and last index of the longest run of True; (0, -1) where there is none."""
    padded = np.concatenate([[False], flags, [False]])
    starts = np.flatnonzero(~padded[:-1] & padded[1:])
    ends = np.flatnonzero(padded[:-1] & ~padded[1:]) - 1
    if not len(starts):
        return 0, -1
    longest = int(np.argmax(ends - starts))
    return int(starts[longest]), int(ends[longest])
