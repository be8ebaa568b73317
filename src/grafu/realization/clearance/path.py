"""The way that must become free, and what stands in it."""

from dataclasses import dataclass
from typing import final

from grafu.geometry.arrays import Mat3
from grafu.geometry.box import Box
from grafu.geometry.components import connected_parts
from grafu.geometry.mesh import TriangleMesh
from grafu.realization.config import RealizationConfig
from grafu.realization.limits import PoseFunction, SweepVerdict, in_the_way, sweep, swept_box
from grafu.realization.scene import Scene


@final
@dataclass(frozen=True, eq=False)
class Path:
    """A motion from 0 to `reach` (radians if `is_turn`, else metres); the columns of `axes` are those of its box."""

    moving: str
    motion: PoseFunction
    reach: float
    axes: Mat3
    is_turn: bool


def obstruction(scene: Scene, path: Path, config: RealizationConfig) -> SweepVerdict:
    """Returns how far the static parts block the path of the moving body, and which of them do."""
    mesh = scene.moving_mesh(path.moving)
    body = scene.swept_body(path.moving, config.depth * scene.unit, path.axes)
    near = in_the_way(scene.static_obstacles, swept_box(mesh.box, path.motion, path.reach))
    return sweep(body, path.motion, path.reach, near, config.fine_poses)


def box_in(axes: Mat3, mesh: TriangleMesh) -> Box:
    """Returns the box around a mesh in the coordinates of `axes`."""
    return Box.around(mesh.vertices @ axes)


def piece_boxes(axes: Mat3, mesh: TriangleMesh) -> list[Box]:
    """Returns the boxes of the connected pieces in the coordinates of `axes`."""
    return [box_in(axes, piece) for piece in connected_parts(mesh)]
