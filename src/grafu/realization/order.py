"""Which joint must be open before which: a drawer behind a door, a door under another's overlap. It builds no hardware.

A joint that runs into a closed neighbour waits for it, if the neighbour, open, is out of the way and does not itself
wait; else its opening ends where the neighbour begins, and the report says so.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final

from grafu.articulation.waiting import all_before
from grafu.geometry.intersection import MeshCollider, MovingBody
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.realization.config import RealizationConfig
from grafu.realization.hinge.border import part_axes
from grafu.realization.limits import Motion, in_the_way, sweep, swept_box
from grafu.realization.scene import Obstacle, Scene


@final
@dataclass(frozen=True, eq=False)
class Moving:
    """A joint as built so far: the mover, its motion, its opening, and the movers that it meets at rest."""

    mover: str
    motion: Motion
    upper: float
    in_way: tuple[str, ...]


@final
@dataclass(frozen=True, slots=True)
class Order:
    """What one joint waits for, and how far it may open."""

    after: tuple[str, ...]
    upper: float


def order_joints(movings: Sequence[Moving], scene: Scene, config: RealizationConfig) -> dict[str, Order]:
    """Returns for each mover the movers that must be open first, and its opening."""
    by_id = {moving.mover: moving for moving in movings}
    orders: dict[str, Order] = {}
    waits: dict[str, set[str]] = {}
    for moving in sorted(movings, key=lambda m: len(m.in_way)):
        after, upper = [], moving.upper
        for name in moving.in_way:
            other = by_id.get(name)
            waits_for_us = moving.mover in all_before(name, waits)
            if other is not None and not waits_for_us and _free_of(moving, _open(other, scene), scene, config):
                after.append(name)
            else:
                upper = min(upper, _until(moving, scene.moving_mesh(name), scene, config))
        waits[moving.mover] = set(after)
        orders[moving.mover] = Order(tuple(after), upper)
    return orders


def _open(other: Moving, scene: Scene) -> Obstacle:
    """Returns a neighbour as an obstacle in its open pose, its hardware counted in."""
    meshes = [scene.moving_mesh(other.mover), *(v.mesh for v in scene.hardware_of(other.mover))]
    opened = merge_meshes(meshes).transformed(other.motion(other.upper))
    return Obstacle(other.mover, MeshCollider(opened))


def _body(moving: Moving, scene: Scene, config: RealizationConfig) -> MovingBody:
    axes = part_axes(scene.parts[moving.mover].mesh)
    return scene.moving_body(moving.mover, config.depth * scene.unit, axes)


def _free_of(moving: Moving, obstacle: Obstacle, scene: Scene, config: RealizationConfig) -> bool:
    return not sweep(
        _body(moving, scene, config), moving.motion, moving.upper, [obstacle], config.coarse_poses
    ).blockers


def _until(moving: Moving, mesh: TriangleMesh, scene: Scene, config: RealizationConfig) -> float:
    """Returns how far a mover opens before it meets a neighbour that stays closed."""
    obstacle = Obstacle("", MeshCollider(mesh))
    way = swept_box(scene.moving_mesh(moving.mover).box, moving.motion, moving.upper)
    verdict = sweep(
        _body(moving, scene, config), moving.motion, moving.upper, in_the_way([obstacle], way), config.fine_poses
    )
    # What overlaps at rest already cannot be avoided by opening less.
    return verdict.free if verdict.share and verdict.free > 0 else moving.upper
