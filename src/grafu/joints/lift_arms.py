"""The arms that lift a flap upright: two at each end of it, of one length, so that it moves parallel to itself.

They run beside the walls of the case, from pivots behind the flap forward and down to pivots on its inner face. Where
they fit is found by sweeps of arms and flap. Everything is in the object frame at rest.
"""

from collections.abc import Iterator, Sequence
from itertools import product
from math import cos, pi, sin
from typing import final

import numpy as np
from shapely.geometry import LineString, Polygon
from shapely.geometry.base import BaseGeometry

from grafu.articulation.articulated_object import Visual, VisualRole
from grafu.articulation.swing import Swing
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Material
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import from_rotation, translation
from grafu.joints.leaves import UP, Leaf
from grafu.joints.lift_arm_config import LiftArmConfig
from grafu.joints.limits import PoseFunction, in_the_way, opening_values, swept_box
from grafu.scene.obstacles import Obstacle
from grafu.templates.solids import STEEL, ZINC, disc, extrude, finished, rectangle
from grafu.vocabulary import PartLabel

_SIDES = (-1.0, 1.0)
_ROUND = 16  # corners of a pin
_QUARTER = 4  # corners of a quarter of an arm's round end
_LAYERS = ("plate", "arm", "second arm", "bracket")  # side by side, from the wall inwards


@final
@dataclass(frozen=True, eq=False)
class ArmPlace:
    """Where arms would run: `length` (metres), `angle` below the horizontal at rest (radians), pivots (depth, height).

    Depth counts from the flap's inner face into the case, height along Z. `walls` are the places of the walls' inner
    faces along the flap's right.
    """

    leaf: Leaf
    length: float
    angle: float
    on_case: tuple[float, float]
    on_flap: tuple[float, float]
    walls: tuple[float, float]
    config: LiftArmConfig

    @property
    def T_object_side(self) -> Mat4:
        """Maps (depth, height, right) to the object frame."""
        R = np.column_stack([-self.leaf.front, UP, self.leaf.right])
        return np.asarray(from_rotation(R, np.asarray(self.leaf.front * self.leaf.back)))

    @property
    def turn(self) -> float:
        """How far the arms turn at most, radians."""
        return self.angle + min(self.angle, self.config.steepest) - self.config.spare

    @property
    def offset(self) -> tuple[float, float]:
        """Where the pivots of the second arm are from those of the first: in no direction that the arms come to."""
        across = (pi - self.angle + min(self.angle, self.config.steepest)) / 2
        return -self.config.spacing * cos(across), self.config.spacing * sin(across)

    def second(self, at: tuple[float, float], k: int = 1) -> tuple[float, float]:
        """Returns the pivot of the second arm beside one of the first; of the first itself where `k` is 0."""
        return at[0] + k * self.offset[0], at[1] + k * self.offset[1]

    def axis(self, at: tuple[float, float]) -> Axis:
        """Returns the level axis through a pivot, between the walls; about it arms turn forward and up."""
        point = self.T_object_side @ np.array([*at, sum(self.walls) / 2, 1.0])
        return Axis(point[:3], -self.leaf.right)

    def shift(self, value: float) -> Vec3:
        """Returns by how much the flap has moved when the arms have turned by `value` radians."""
        arm = np.array(self.on_flap) - np.array(self.on_case)
        at = value - self.angle
        moved = np.array([-cos(at), sin(at)]) * self.length - arm
        return np.asarray(-self.leaf.front * moved[0] + UP * moved[1])

    def rise(self, value: float) -> float:
        """Returns how far the flap has risen when the arms have turned by `value` radians, metres."""
        return float(self.shift(value)[2])


def arm_places(leaf: Leaf, walls: tuple[float, float], depth: float, config: LiftArmConfig) -> Iterator[ArmPlace]:
    """Yields arms for a flap before a case so deep (metres): those that lift it furthest first."""
    low, high = leaf.height
    tall = high - low
    for rise, start, angle in product(config.rises, config.lows, config.angles):
        length = rise * tall / (sin(angle) + sin(min(angle, config.steepest)))
        flap = (config.behind, low + start * tall + config.width / 2)
        case = (flap[0] + length * cos(angle), flap[1] + length * sin(angle))
        if case[0] + config.plate < depth and flap[1] + rise * tall < high:
            yield ArmPlace(leaf, length, angle, case, flap, walls, config)


def walls_beside(leaf: Leaf, rays: RayCaster, config: LiftArmConfig) -> tuple[tuple[float, float], float] | None:
    """Returns where the walls behind a flap's two ends are, along its right, and how deep the case is; None: open."""
    low, high = leaf.span(leaf.right)
    middle = sum(leaf.height) / 2
    start = leaf.right * ((low + high) / 2) + leaf.front * (leaf.back - config.plate) + UP * middle
    gaps = [float(rays.along(start[None], np.asarray(leaf.right * side))[0]) for side in _SIDES]
    depth = float(rays.along(start[None], np.asarray(-leaf.front))[0]) + config.plate
    walls = (low + high) / 2 - gaps[0], (low + high) / 2 + gaps[1]
    beyond = config.plate  # an overlay flap covers the walls; one that is narrower than its opening by much has none
    if not np.isfinite([*walls, depth]).all() or walls[0] < low - beyond or walls[1] > high + beyond:
        return None
    return walls, depth


@final
@dataclass(frozen=True, eq=False)
class Arms:
    """The arms of a flap with what holds them: on the case, turning, and on the flap; `swinging` turn on the case."""

    static: tuple[Visual, ...]
    moving: tuple[Visual, ...]
    swinging: tuple[Visual, ...]
    dynamic: tuple[Visual, ...]


def arms_of(place: ArmPlace, name: str, moving: str) -> Arms:
    """Returns the arms at a place; `name` is the flap's, `moving` the link that the arms are."""
    parts: tuple[list[Visual], ...] = ([], [], [], [])
    for side, wall, word in zip(_SIDES, place.walls, ("left", "right"), strict=True):
        for kind, visual in enumerate(_at_end(place, wall, -side, f"hinge_{name}_lift_{word}", moving)):
            parts[kind].append(visual)
    return Arms(*(tuple(visuals) for visuals in parts))


def _at_end(place: ArmPlace, wall: float, inwards: float, name: str, moving: str) -> list[Visual]:
    """Returns plate, arm, second arm and bracket at one end of a flap, side by side from the wall inwards."""
    config, half = place.config, place.config.width / 2
    step = config.thick + config.clear
    bands = [(k * step, k * step + config.thick) for k in range(len(_LAYERS))]
    on_case, on_flap = ([place.second(at, k) for k in (0, 1)] for at in (place.on_case, place.on_flap))

    def made(shape: BaseGeometry, near: float, far: float) -> TriangleMesh:
        low, high = sorted((wall + inwards * near, wall + inwards * far))
        return extrude(shape, low, high).transformed(place.T_object_side)

    def around(pivots: Sequence[tuple[float, float]], near: float, far: float) -> Polygon:
        depths, heights = zip(*pivots, strict=True)
        return rectangle((min(depths) + near, max(depths) + far), (min(heights) - half, max(heights) + half))

    arms = [made(LineString([on_case[k], on_flap[k]]).buffer(half, quad_segs=_QUARTER), *bands[1 + k]) for k in (0, 1)]
    plate = made(around(on_case, -half, config.plate), *bands[0])
    bracket = made(around(on_flap, -config.behind - place.second((0.0, 0.0))[0], half), *bands[3])
    plate_pins = [made(disc(on_case[k], half / 2, _ROUND), bands[0][1], bands[1 + k][1]) for k in (0, 1)]
    bracket_pins = [made(disc(on_flap[k], half / 2, _ROUND), bands[1 + k][0], bands[3][0]) for k in (0, 1)]
    angles = np.linspace(0.0, place.turn, 2)
    swing = Swing(moving, place.axis(on_case[1]), angles, angles)
    return [
        _visual(f"{name}_static", merge_meshes([plate, *plate_pins]), ZINC),
        _visual(name, arms[0], STEEL),
        _visual(f"{name}_second", arms[1], STEEL, swing),
        _visual(f"{name}_dynamic", merge_meshes([bracket, *bracket_pins]), ZINC),
    ]


def _visual(name: str, mesh: TriangleMesh, material: Material, swing: Swing | None = None) -> Visual:
    return Visual(name, (finished(mesh, material),), VisualRole.HARDWARE, PartLabel.MISC, swing)


def furthest(
    place: ArmPlace, arms: Arms, flap: tuple[TriangleMesh, ...], obstacles: Sequence[Obstacle], depth: float
) -> float:
    """Returns how far arms and flap turn, radians, before either cuts into an obstacle by more than `depth` metres.

    What the flap meets at rest counts as free; arms must be free at rest, else it is 0.
    """
    arm = SweptBody(merge_meshes([v.mesh for v in arms.moving]), depth)
    second = SweptBody(merge_meshes([v.mesh for v in arms.swinging]), depth)
    held = SweptBody(merge_meshes([*flap, *(v.mesh for v in arms.dynamic)]), depth)
    own, beside = place.axis(place.on_case), place.axis(place.second(place.on_case))

    def lifted(value: float) -> Mat4:
        return np.asarray(translation(place.shift(value)))

    moves: tuple[tuple[SweptBody, PoseFunction], ...] = ((arm, own.rotation), (second, beside.rotation), (held, lifted))
    meshes = (arms.moving, arms.swinging, arms.dynamic)
    near = [
        in_the_way(obstacles, swept_box(Box.enclosing([v.mesh.box for v in of] + extra), motion, place.turn))
        for (_, motion), of, extra in zip(moves, meshes, ([], [], [m.box for m in flap]), strict=True)
    ]
    plates = SweptBody(merge_meshes([v.mesh for v in arms.static]), depth)
    plates.place(np.eye(4))
    if plates.penetrated([o.collider for o in obstacles]):
        return 0.0
    free = 0.0
    met: set[str] = set()
    for number, value in enumerate(opening_values(place.turn, place.config.poses)):
        for (body, motion), around in zip(moves, near, strict=True):
            body.place(motion(float(value)))
            found = {around[k].id for k in body.penetrated([o.collider for o in around])}
            if body is held and number == 0:
                met = found
            elif found - (met if body is held else set()):
                return free
        free = float(value)
    return free
