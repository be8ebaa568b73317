"""Feet that are drawn a little too short reach the floor where the piece collides: else it rocks, and fronts roll open.

Real furniture has glides that are turned until it stands level.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.collision_clearance import Shapes
from grafu.articulation.collision_shapes import CollisionShape, corners_of
from grafu.articulation.convex_pieces import hull_of
from grafu.articulation.mass import MassProperties
from grafu.articulation.stability import StabilityConfig, stability_of
from grafu.geometry.arrays import vec3
from grafu.geometry.box import OrientedBox
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
    touching: float = 0.001
    """What ends no higher than this above the lowest shape stands on the floor as drawn."""
    steady: float = 0.02
    """A piece whose centre of mass is so far within what it stands on as drawn is left as it is."""
    thinnest: float = 0.002
    """Least thickness of a lengthened foot that is no box."""

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

    Nothing changes where the piece stands safely on what touches the floor as drawn, nor where longer feet would not
    help. Masses and shapes are those of all links by id, object frame at rest.
    """
    lows = {id(shape): float(corners_of(shape)[:, 2].min()) for held in shapes.values() for shape in held}
    floor = min(lows.values(), default=0.0)
    body = shapes[articulated.root]
    feet = [shape for shape in body if floor + config.touching < lows[id(shape)] <= floor + config.short]
    if not feet or not _would_help(articulated, masses, shapes, config):
        return dict(shapes), ""
    longer = {id(foot): _lengthened(foot, floor, config) for foot in feet}
    most = 1000 * (max(lows[key] for key in longer) - floor)
    note = f"feet end up to {most:.0f} mm above the floor: where it collides, all of them reach it"
    return {**shapes, articulated.root: tuple(longer.get(id(shape), shape) for shape in body)}, note


def _would_help(
    articulated: ArticulatedObject,
    masses: Mapping[str, MassProperties],
    shapes: Mapping[str, tuple[CollisionShape, ...]],
    config: LevelFeetConfig,
) -> bool:
    drawn, level = (
        stability_of(articulated, masses, shapes, StabilityConfig(on_floor=reach))
        for reach in (config.touching, config.short)
    )
    return level is not None and (drawn is None or drawn.margin < min(config.steady, level.margin))


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
