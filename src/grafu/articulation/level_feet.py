"""Feet that are drawn too short reach the floor where the piece collides: else it rocks or leans, and fronts roll open.

Real furniture has glides that are turned until it stands level. As drawn, the legs of one end may be shorter than the
others, or a pedestal may hang above the floor because its glides were left out.
"""

from collections.abc import Mapping
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.collision_clearance import Shapes
from grafu.articulation.collision_shapes import CollisionShape, ShapeBody, corners_of
from grafu.articulation.convex_pieces import hull_of
from grafu.articulation.floor_clearance import carrying_links, floor_below, lowest_of
from grafu.articulation.kinematics import REST
from grafu.articulation.mass import MassProperties
from grafu.articulation.stability import Stability, StabilityConfig, stability_of
from grafu.articulation.sweep import moved_to_full
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat4, vec3
from grafu.geometry.box import Box, OrientedBox
from grafu.geometry.budget import require_time
from grafu.geometry.config_checks import require_positive

_UPRIGHT = 1.0 - 1e-6  # of a unit vector: an axis that rises by more stands upright


@final
@dataclass(frozen=True, slots=True)
class LevelFeetConfig:
    """Which feet are lengthened, and when; lengths in metres.

    Raises:
        ValueError: if a number is not above 0.
    """

    short: float = 0.012
    """Shapes of the static body that end no higher than this above the lowest one are its feet, too."""
    hanging: float = 0.06
    """Where it leans all the same, those that end up to this height become feet: glides and castors that were left out
    are as high, the lowest plinths are higher."""
    touching: float = 0.001
    """What ends no higher than this above the lowest shape stands on the floor as drawn."""
    steady: float = 0.02
    """A piece whose centre of mass is so far within what it stands on as drawn is left as it is."""
    thinnest: float = 0.002
    """Least thickness of a lengthened foot that is no box."""
    poses: int = 25
    """In how many poses of each motion the room below a short foot must be free."""

    def __post_init__(self) -> None:
        require_positive(self, *self.__dataclass_fields__)


DEFAULT_LEVEL_FEET_CONFIG = LevelFeetConfig()


def level_feet(
    articulated: ArticulatedObject,
    masses: Mapping[str, MassProperties],
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: LevelFeetConfig = DEFAULT_LEVEL_FEET_CONFIG,
) -> tuple[Shapes, str]:
    """Returns the shapes of each link, the root's feet all as long as the longest, and a note (empty: none was short).

    Nothing changes where the piece stands safely on what touches the floor as drawn, where it stands on wheels, and
    where longer feet would not help. No foot grows into the way of what moves. Masses and shapes are those of all links
    by id, object frame at rest.
    """
    floor = floor_below(shapes)
    body = shapes[articulated.root]
    if not body or articulated.root not in carrying_links(articulated, shapes, floor):
        return dict(shapes), ""
    as_drawn = StabilityConfig(on_floor=config.touching)
    drawn = stability_of(articulated, masses, shapes, as_drawn)
    short = [k for k, shape in enumerate(body) if floor + config.touching < lowest_of(shape) <= floor + config.hanging]
    if not short or (drawn is not None and drawn.margin >= config.steady):
        return dict(shapes), ""
    longer = {
        k: _lengthened(body[k], floor, config) for k in _with_room_below(articulated, shapes, short, floor, config)
    }
    found, note = dict(shapes), ""
    for reach in _reaches([lowest_of(body[k]) - floor for k in longer], drawn, config):
        feet = {k: foot for k, foot in longer.items() if lowest_of(body[k]) <= floor + reach}
        tried = {**shapes, articulated.root: tuple(feet.get(k, shape) for k, shape in enumerate(body))}
        level = stability_of(articulated, masses, tried, as_drawn)
        if not feet or level is None or (drawn is not None and level.margin <= drawn.margin):
            continue
        if reach <= config.short or level.closed_margin >= config.steady:
            found, note = tried, _note(max(lowest_of(body[k]) for k in feet) - floor)
        if level.closed_margin >= (0.0 if reach <= config.short else config.steady):
            break
    return found, note


def _note(most: float) -> str:
    return f"feet end up to {1000 * most:.0f} mm above the floor: where it collides, all of them reach it"


def _reaches(heights: list[float], drawn: Stability | None, config: LevelFeetConfig) -> list[float]:
    """Returns up to which heights above the floor feet are lengthened, to be tried in this order.

    What ends little higher than a foot that is lengthened is one, too.
    """
    leans = drawn is None or drawn.closed_margin < 0
    longer = sorted({height for height in heights if height > config.short} if leans else ())
    return [config.short, *(height + config.short for height in longer)]


def _with_room_below(
    articulated: ArticulatedObject,
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    short: list[int],
    floor: float,
    config: LevelFeetConfig,
) -> list[int]:
    """Returns which of the root's shapes have no moving shape between their lower ends and the floor in any pose."""
    moving = {link: held for link, held in shapes.items() if link != articulated.root}
    places: dict[str, list[Mat4]] = {link: [REST] for link in moving}
    for joint in articulated.free_joints:
        require_time()
        for poses in moved_to_full(articulated, joint.id, config.poses):
            for link, T in poses.items():
                places[link].append(T)
    near = [
        _low_bounds(shape, np.stack(places[link]), floor + config.hanging) for link in moving for shape in moving[link]
    ]
    lows, highs = np.concatenate([np.zeros((0, 2, 3)), *near]).swapaxes(0, 1)
    rooms = ((k, _below(shapes[articulated.root][k], floor, config)) for k in short)
    return [k for k, room in rooms if not np.all((lows <= room.high) & (highs >= room.low), axis=1).any()]


def _low_bounds(shape: CollisionShape, Ts: np.ndarray, height: float) -> np.ndarray:
    """Returns the bounds, (n, 2, 3), of a shape in those of its poses, (m, 4, 4), that reach below a height."""
    bounds = ShapeBody("", shape).bounds_at(Ts)
    return bounds[bounds[:, 0, 2] < height]


def _below(foot: CollisionShape, floor: float, config: LevelFeetConfig) -> Box:
    """Returns the room between a shape's lower end and the floor."""
    points, low = corners_of(foot), lowest_of(foot)
    end = Box.around(points[points[:, 2] <= low + config.touching])
    return Box(vec3(end.low[0], end.low[1], floor), vec3(end.high[0], end.high[1], low))


def _lengthened(foot: CollisionShape, floor: float, config: LevelFeetConfig) -> CollisionShape:
    """Returns a shape whose lower end is moved down to the floor."""
    points = corners_of(foot)
    low = float(points[:, 2].min())
    if isinstance(foot, OrientedBox) and (np.abs(foot.rotation[2]) >= _UPRIGHT).any():
        more = (low - floor) / 2
        half = foot.half + more * (np.abs(foot.rotation[2]) >= _UPRIGHT)
        return replace(foot, center=foot.center - vec3(0.0, 0.0, more), half=half)
    end = points[points[:, 2] <= low + config.touching]
    hull = hull_of(np.vstack([points, end - vec3(0.0, 0.0, low - floor)]), config.thinnest)
    return foot if hull is None else hull
