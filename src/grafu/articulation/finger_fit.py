"""Where two fingers fit round something: measured by rays against what is held and against all that is around it."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import product
from typing import final

import numpy as np

from grafu.articulation.grasp_frame import FINGER_GAP, FINGER_REACH, FINGER_THICKNESS, FINGER_WIDTH
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mask, Mat3, Points, Scalars, Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive
from grafu.geometry.mesh import TriangleMesh, merge_meshes, mesh_near
from grafu.geometry.raycast import RayCaster

_ACROSS = 25  # rays over what is held, from side to side
_PLACES = (0.5, 0.35, 0.65, 0.2, 0.8)  # along a bar, as fractions: the middle first
_ON_FINGER = (np.linspace(-0.5, 0.5, 7), np.linspace(0.0, 1.0, 4))  # rays of a finger: along the bar, and outwards
_ROUNDING = 1e-6  # metres
_LOOKED_AT = 16  # to look whether so many faces are near takes as long as to prepare one for rays
_LEVELS = (0.001, 0.003, 0.006)  # metres past the surface at which the width is measured


@final
@dataclass(frozen=True, slots=True)
class FingerFitConfig:
    """What counts as a fit; lengths in metres.

    Raises:
        ValueError: if a number is not above 0.
    """

    opening: float = 0.08
    """The widest opening of a gripper: that of the Franka hand; wider things are not held between its fingers."""
    enough: float = 0.012
    """Depth of the fingers' room at which an approach is taken and no other is tried."""
    least_depth: float = 0.005
    """Fingers with less room hold nothing."""
    start: float = 0.05
    """How far before the surface fingers begin to move in a straight line."""
    foremost: float = 0.004
    """What lies no deeper than this behind the foremost point is the face of what is held."""
    around: float = 0.05
    """Half the side of the cube in which an edge or recess is looked at."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


@final
@dataclass(frozen=True, eq=False)
class FingerFit:
    """One way to hold: see `GraspFrame`; `aside` is the distance from the middle of what is held, metres."""

    position: Vec3
    approach: Vec3
    closing: Vec3
    width: float
    depth: float
    aside: float = 0.0

    def rank(self, config: FingerFitConfig) -> tuple[float, float, float]:
        """Returns what is larger for a better fit: room, then nearness to the middle, then a narrow grip."""
        return round(min(self.depth, config.enough), 4), -round(self.aside, 3), -round(self.width, 3)


@final
class Facing:
    """Surfaces, ready for rays that also ask which side of a face they meet; not a value.

    Most rays end near what is held: of what lies far from it nothing is prepared for them.
    """

    def __init__(self, meshes: Sequence[TriangleMesh]) -> None:
        self._meshes = meshes
        self._left = sum(len(mesh.faces) for mesh in meshes) // 2  # faces that may be prepared apart: then all are

    @cached_property
    def caster(self) -> RayCaster:
        """All surfaces, for rays of any length."""
        return RayCaster(self._mesh)

    @cached_property
    def _mesh(self) -> TriangleMesh:
        return merge_meshes(self._meshes)

    @cached_property
    def _normals(self) -> Points:
        return self._mesh.face_normals

    @cached_property
    def _ends(self) -> tuple[Points, Points]:
        """The lowest and highest corners of the boxes around the surfaces."""
        boxes = [mesh.box for mesh in self._meshes]
        return np.reshape([b.low for b in boxes], (-1, 3)), np.reshape([b.high for b in boxes], (-1, 3))

    def near(self, box: Box) -> RayCaster:
        """Returns the faces whose boxes meet a box, for rays of which nothing is asked beyond it.

        It may return more: all, where these are prepared, or what is near so many places takes longer than they do.
        """
        lows, highs = self._ends
        meets = np.all((lows <= box.high) & (highs >= box.low), axis=1)
        looked_at = [self._meshes[k] for k in np.flatnonzero(meets).tolist()]
        self._left -= sum(len(mesh.faces) for mesh in looked_at) // _LOOKED_AT
        if "caster" in self.__dict__ or self._left <= 0:
            return self.caster
        found = mesh_near(looked_at, box)
        self._left -= len(found.faces)
        return RayCaster(found) if self._left > 0 else self.caster

    def begins_inside(self, origins: Points, direction: Vec3) -> Mask:
        """Whether rays first meet a face from behind: they begin in a solid."""
        faces, _ = self.caster.first_faces(origins, direction)
        return np.asarray((faces >= 0) & (self._normals[faces] @ direction > 0))


def _reached(axes: Mat3, low: np.ndarray, high: np.ndarray, start: float) -> Box:
    """Returns a box around all that fingers reach which begin `start` metres before what is held.

    `low` and `high` are the ends of that along the axes, the columns. Beyond `FINGER_REACH` past it all room is alike.
    """
    corners = np.array(list(product(*zip(low, high, strict=True)))) @ axes.T
    return Box.around(corners).grown(start + FINGER_REACH + FINGER_WIDTH + FINGER_THICKNESS + FINGER_GAP)


@final
class FingerSpace:
    """What is held and what is around it, ready for rays; not a value."""

    def __init__(self, target: TriangleMesh, around: Facing, config: FingerFitConfig) -> None:
        self._target, self._around = target, around
        self._held = RayCaster(target)
        self._prepared: tuple[Box, RayCaster] | None = None
        self._config = config

    def fits(self, axes: Mat3, middle: Vec3, length: float, free: bool) -> Iterator[FingerFit]:
        """Yields how it is held with the frame `axes` (columns x, y closing, z approach) at places along x.

        They lie within `length` metres about `middle`; 0: over all that is held. `free` states that fingers come from
        outside the piece; else those that would begin within a solid have no room.
        """
        local = self._target.vertices @ axes
        low, high = local.min(axis=0), local.max(axis=0)
        near = self._near(_reached(axes, low, high, self._config.start))
        if length:
            center = float(middle @ axes[:, 0])
            low[0], high[0] = max(low[0], center - length / 2), min(high[0], center + length / 2)
        if high[0] < low[0]:
            return
        for place in _PLACES:
            x = float(low[0] + place * (high[0] - low[0]))
            fit = self._fit(axes, x, (low, high), near)
            if fit is not None and (free or not self._begins_inside(axes, fit)):
                yield replace(fit, aside=abs(place - 0.5) * float(high[0] - low[0]))

    def _near(self, box: Box) -> RayCaster:
        """Returns what is near, prepared once: all approaches look at one box from its sides."""
        if self._prepared is None or not self._prepared[0].contains(box.corners()).all():
            larger = (box if self._prepared is None else box.union(self._prepared[0])).grown(_ROUNDING)
            self._prepared = larger, self._around.near(larger)
        return self._prepared[1]

    def _fit(self, axes: Mat3, x: float, ends: tuple[np.ndarray, np.ndarray], near: RayCaster) -> FingerFit | None:
        config, (low, high) = self._config, ends
        y = low[1] + (np.arange(_ACROSS) + 0.5) / _ACROSS * (high[1] - low[1])
        before = float(low[2]) - config.start
        depth = before + self._cast(self._held, axes, np.column_stack([np.full(_ACROSS, x), y]), before)
        if not np.isfinite(depth).any():
            return None
        surface = float(depth.min())
        face = np.flatnonzero(depth <= surface + config.foremost)
        run = max(np.split(face, np.flatnonzero(np.diff(face) > 1) + 1), key=len)
        sides = self._sides(axes, x, float(y[run].mean()), surface)
        if sides is None:
            return None
        width, at = sides[1] - sides[0], (sides[0] + sides[1]) / 2
        hit = before + float(self._cast(self._held, axes, np.array([[x, at]]), before)[0])
        if not np.isfinite(hit) or hit > surface + config.foremost:
            return None
        room = min(self._room(near, axes, (x, sides[1]), 1.0, hit), self._room(near, axes, (x, sides[0]), -1.0, hit))
        position = axes @ np.array([x, at, hit])
        return FingerFit(position, axes[:, 2], axes[:, 1], width, max(min(room, FINGER_REACH), 0.0))

    def _sides(self, axes: Mat3, x: float, y: float, surface: float) -> tuple[float, float] | None:
        """Returns where fingers that close about y meet what is held; None where it is wider than a gripper opens."""
        out = (self._config.opening + FINGER_GAP) / 2
        found = []
        for sign in (-1.0, 1.0):
            start = [np.array([x, y + sign * out, surface + level]) for level in _LEVELS]
            origins = np.array(start) @ axes.T
            met = self._held.along(origins, -sign * axes[:, 1])
            met = met[met < 2 * out]
            if not len(met) or met.min() < FINGER_GAP / 2:
                return None
            found.append(y + sign * (out - float(met.min())))
        return (found[0], found[1]) if found[1] > found[0] else None

    def _room(self, near: RayCaster, axes: Mat3, side: tuple[float, float], sign: float, surface: float) -> float:
        """Returns how far past the surface a finger has room beside what is held."""
        along, out = _ON_FINGER
        x = side[0] + FINGER_WIDTH * along
        y = side[1] + sign * (FINGER_GAP + FINGER_THICKNESS * out)
        grid = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1).reshape(-1, 2)
        before = surface - self._config.start
        return float(self._cast(near, axes, grid, before).min()) - self._config.start

    def _begins_inside(self, axes: Mat3, fit: FingerFit) -> bool:
        """Whether a finger beside a fit begins behind a face that looks away from it."""
        along, out = np.meshgrid(*_ON_FINGER)
        aside = fit.width / 2 + FINGER_GAP + FINGER_THICKNESS * out.ravel()
        places = FINGER_WIDTH * along.ravel()[:, None] * axes[:, 0]
        before = fit.position - self._config.start * fit.approach
        beside = [before + places + sign * aside[:, None] * fit.closing for sign in (-1.0, 1.0)]
        return bool(self._around.begins_inside(np.vstack(beside), axes[:, 2]).any())

    def hook(self, axes: Mat3, middle: Vec3) -> FingerFit | None:
        """Returns how closed fingers enter at a place and pull at the nearest wall; None where nothing is behind it."""
        x, y, z = axes.T @ middle
        before = float((self._target.vertices @ axes[:, 2]).min()) - self._config.start
        hit = before + float(self._cast(self._held, axes, np.array([[x, y]]), before)[0])
        if not np.isfinite(hit):
            near = self._target.vertices[int(np.argmin(np.linalg.norm(self._target.vertices - middle, axis=1)))]
            return FingerFit(near, axes[:, 2], axes[:, 1], 0.0, 0.0, float(np.linalg.norm(near - middle)))
        position = axes @ np.array([x, y, hit])
        inside = position - axes[:, 2] * min(max(hit - z, _LEVELS[0]), FINGER_THICKNESS / 2)
        options = [sign * axes[:, k] for k in (1, 0) for sign in (-1.0, 1.0)]
        walls = [float(self._around.caster.along(inside[None], side)[0]) for side in options]
        return FingerFit(position, axes[:, 2], options[int(np.argmin(walls))], 0.0, 0.0, 0.0)

    @staticmethod
    def _cast(caster: RayCaster, axes: Mat3, places: np.ndarray, before: float) -> Scalars:
        """Returns how far rays along the approach go, from places (x, y) at the height `before`."""
        origins = np.column_stack([places, np.full(len(places), before)]) @ axes.T
        return caster.along(origins, axes[:, 2])
