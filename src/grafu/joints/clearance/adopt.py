"""Static parts that move with a moving part: what lies enclosed in it, fittings of its hinge, the pin of its hinge."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.part import Part
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation
from grafu.joints.clearance.carve import Path, obstruction
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_config import DrawnConfig
from grafu.joints.report import Clearance
from grafu.scene.scene import MovingBody, Scene
from grafu.vocabulary import PartLabel

_FITTINGS = (PartLabel.MISC, PartLabel.UNKNOWN)


def adopt(scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig) -> tuple[Scene, list[Clearance]]:
    """Lets static parts that lie enclosed in the moving part move with it: the drawer's own half of its old rails."""
    box = scene.parts[path.moving].box.grown(config.clearance.enclosed * config.depth * scene.extent)
    inside = [name for name in ids if bool(box.contains(scene.parts[name].box.corners()).all())]
    return _joined(scene, path, inside, f"lies enclosed in {path.moving} and moves with it")


def adopt_fittings(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig
) -> tuple[Scene, list[Clearance]]:
    """Lets small static parts at the pin of a leaf, which are drawn sunk into it, move with it: hinges and clamps."""
    if not path.is_turn:
        return scene, []
    leaf, least = scene.parts[path.moving].box, config.depth * scene.extent
    sunk = [
        name
        for name in ids
        if scene.parts[name].label in _FITTINGS
        and float(scene.parts[name].box.axis_gaps(leaf).max()) < -least
        and float(scene.parts[name].box.size.max()) <= 2 * config.clearance.fitting
        and _from_pin(scene.parts[name].box.corners(), path) <= config.clearance.fitting
    ]
    return _joined(scene, path, sunk, f"is a fitting at the hinge of {path.moving}, sunk into it, and moves with it")


def adopt_pins(
    scene: Scene, path: Path, ids: Sequence[str], config: RealizationConfig
) -> tuple[Scene, list[Clearance]]:
    """Lets static rods that lie along the axis of a leaf, and are drawn all through it, turn with it.

    Where such a pin is drawn into what carries it as well, it is made thinner about its axis.
    """
    if not path.is_turn:
        return scene, []
    drawn = config.hinge.drawn
    pins = [name for name in ids if _is_through(scene.parts[name].mesh, scene.parts[path.moving].mesh, path, drawn)]
    turning, done = _joined(scene, path, pins, f"is the pin that {path.moving} turns about, drawn through it")
    for left in drawn.thinned if pins else ():
        thinner = turning.replaced([_thinned(scene.parts[name], path, left) for name in pins])
        if not obstruction(thinner, path, config).blockers:
            eased = [Clearance(name, "eased", 0.0, 1.0 - left, "cut into what carries it") for name in pins]
            return thinner, [*done, *(eased if left < 1.0 else ())]
    return turning, done


def _is_through(pin: TriangleMesh, leaf: TriangleMesh, path: Path, drawn: DrawnConfig) -> bool:
    """Whether a mesh is a rod about the axis of a turn, within the outline of a leaf from end to end of it."""
    if _from_pin(pin.vertices, path) > drawn.radii[1]:
        return False
    rod, outline = (Box.around(mesh.vertices @ path.axes) for mesh in (pin, leaf))
    along = int(np.argmax(rod.size))
    across = [k for k in range(3) if k != along]
    is_inside = (rod.center[across] > outline.low[across]) & (rod.center[across] < outline.high[across])
    return bool(is_inside.all()) and float(rod.size[along]) >= drawn.rod * float(outline.size[along])


def _thinned(part: Part, path: Path, left: float) -> Part:
    """Returns a pin with its radius about the axis of a turn times `left`."""
    T = path.motion(min(path.reach, 1.0))
    direction = np.array([T[2, 1] - T[1, 2], T[0, 2] - T[2, 0], T[1, 0] - T[0, 1]])
    direction /= np.linalg.norm(direction)
    point = np.linalg.lstsq(np.eye(3) - T[:3, :3], T[:3, 3], rcond=None)[0]
    along = np.outer(direction, direction)
    A = along + left * (np.eye(3) - along)
    to_thinner = from_rotation(A, point - A @ point)
    return replace(part, surfaces=tuple(surface.transformed(to_thinner) for surface in part.surfaces))


def _from_pin(points: Points, path: Path) -> float:
    """Returns how far the farthest of some points is from the axis of a turn, metres."""
    angle = min(path.reach, 1.0)
    T = path.motion(angle)
    moved = np.linalg.norm(points @ T[:3, :3].T + T[:3, 3] - points, axis=1)
    return float(moved.max()) / (2.0 * float(np.sin(angle / 2)))


def _joined(scene: Scene, path: Path, ids: Sequence[str], why: str) -> tuple[Scene, list[Clearance]]:
    """Returns the scene in which static parts move with the moving part."""
    if not ids:
        return scene, []
    moving = scene.moving_bodies[path.moving]
    moving_bodies = {**scene.moving_bodies, path.moving: MovingBody(moving.id, (*moving.members, *ids))}
    return replace(scene, moving_bodies=moving_bodies), [Clearance(part, "joined", 0.0, 0.0, why) for part in ids]
