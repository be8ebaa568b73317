"""Plates at a slant, seen from the side: fall fronts, and doors and lids that are drawn half open. Z is up."""

from math import atan2, cos, pi, radians, sin
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3, vec3
from grafu.geometry.box import yaw_of
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import rotation_about

_DEPTH, _UP = 1, 2


@final
@dataclass(frozen=True, slots=True)
class LeaningConfig:
    """What a plate that leans is, seen from the side.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    least: float = radians(10)
    """How far it leans at least from upright and from level (radians): fronts of some drawers slope a little."""
    thin: float = 0.15
    """Its thickness at most (fraction of its length from the lower to the upper edge)."""

    def __post_init__(self) -> None:
        require_positive(self, "least")
        require_ratios(self, "thin")


def leans(mesh: TriangleMesh, config: LeaningConfig = LeaningConfig()) -> bool:
    """Whether a mesh is a plate at a slant."""
    if not len(mesh.vertices):
        return False
    along, across = _directions(mesh)
    thick, length = (float(np.ptp(mesh.vertices @ direction)) for direction in (across, along))
    slant = float(np.abs(along[[_DEPTH, _UP]]).min())
    return slant >= sin(config.least) and thick <= config.thin * length


def laid_level(mesh: TriangleMesh) -> TriangleMesh:
    """Returns a plate at a slant, turned down about its lower edge to the side that it leans to."""
    along, _ = _directions(mesh)
    lowest = mesh.vertices[int(np.argmin(mesh.vertices[:, _UP]))]
    level = 0.0 if along[_DEPTH] > 0 else pi
    turn = level - atan2(float(along[_UP]), float(along[_DEPTH]))
    return mesh.transformed(rotation_about(lowest, vec3(1.0, 0.0, 0.0), turn))


def _directions(mesh: TriangleMesh) -> tuple[Vec3, Vec3]:
    """Returns the unit directions along a plate, upwards, and across it, both seen from the side."""
    side = mesh.vertices[:, [_DEPTH, _UP]]
    angle = yaw_of(np.column_stack([side, np.zeros(len(side))]))
    first, second = vec3(0.0, cos(angle), sin(angle)), vec3(0.0, -sin(angle), cos(angle))
    along, across = sorted((first, second), key=lambda direction: -float(np.ptp(mesh.vertices @ direction)))
    return along * (1.0 if along[_UP] >= 0 else -1.0), across
