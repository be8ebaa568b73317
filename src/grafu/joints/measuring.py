"""What is measured on joints that stand: in how many poses they still cut in, and how far their hardware comes loose.

A joint that cannot be measured within its fraction of the time is not delivered: its behaviour would be unknown.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.budget import within
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.transform import translation
from grafu.joints.build import Built
from grafu.joints.config import RealizationConfig
from grafu.joints.gaps import drawn_poses, gap_between, widest_gap
from grafu.joints.limits import in_the_way, sweep, swept_box
from grafu.joints.no_hardware import DRAWN
from grafu.joints.order import OpeningOrder
from grafu.joints.plan import JointRequest
from grafu.joints.report import Placement
from grafu.processes.cache import Cache
from grafu.refusal import Reason, Refusal
from grafu.scene.border import part_axes
from grafu.scene.scene import Scene

_MEASURED_POSES = 50  # the paper's number of frames from rest to full extent

Figures = tuple[float, float]
"""The fraction of poses that collide with static parts, and the widest gap in metres to the static body."""


@final
@dataclass(frozen=True)
class Measured:
    """The joints that were built and measured, their figures and order by moving body, and a scene of these alone."""

    built: tuple[Built, ...]
    figures: Mapping[str, Figures]
    orders: Mapping[str, OpeningOrder]
    scene: Scene
    skipped: tuple[Refusal, ...] = ()


def measure_all(
    built: Sequence[Built], orders: Mapping[str, OpeningOrder], scene: Scene, config: RealizationConfig, cache: Cache
) -> Measured:
    """Returns what was measured on each joint; one that takes more than its fraction of the time is taken out again."""
    figures: dict[str, Figures] = {}
    skipped: list[Refusal] = []
    for k, one in enumerate(built):
        name = one.request.moving
        work = partial(_measured, one, orders[name].upper, scene, config, cache)
        found: Figures | Refusal = within(
            config.time.of_joint(len(built) - k), work, partial(Refusal, name, Reason.TOO_COMPLEX)
        )
        if isinstance(found, Refusal):
            skipped.append(found)
        else:
            figures[name] = found
    return _without({skip.part for skip in skipped}, Measured(tuple(built), figures, orders, scene, tuple(skipped)))


def _too_complex(name: str, why: str) -> Figures | Refusal:
    return Refusal(name, Reason.TOO_COMPLEX, why)


def _without(gone: set[str], measured: Measured) -> Measured:
    """Returns what is left when the joints of some moving bodies are taken out, with their hardware."""
    if not gone:
        return measured
    removed = [one for one in measured.built if one.request.moving in gone]
    pieces = {id(visual) for one in removed for visual in (*one.placement.static, *one.placement.dynamic)}
    hardware = tuple(pair for pair in measured.scene.hardware if id(pair[1]) not in pieces)
    orders = {
        name: replace(order, after=tuple(other for other in order.after if other not in gone))
        for name, order in measured.orders.items()
    }
    built = tuple(one for one in measured.built if one.request.moving not in gone)
    return replace(measured, built=built, orders=orders, scene=replace(measured.scene, hardware=hardware))


def _measured(built: Built, upper: float, scene: Scene, config: RealizationConfig, cache: Cache) -> Figures | Refusal:
    """Returns the fraction of poses that collide with static parts, and the widest gap in metres to the static body."""
    moving = built.request.moving
    motion = built.request.kind.along(built.placement.axis)
    aside = config.rack_gap * scene.extent if built.placement.template == DRAWN else 0.0  # what it stands off so far
    path = swept_box(scene.moving_mesh(moving).box, motion, upper).grown(aside)
    near = in_the_way(scene.static_obstacles, path)
    names = {*scene.moving_bodies[moving].members, *(obstacle.id for obstacle in near)}
    around = replace(
        scene,
        parts={name: part for name, part in scene.parts.items() if name in names},
        moving_bodies={moving: scene.moving_bodies[moving]},
        hardware=tuple((moving, visual) for visual in scene.hardware_of(moving)),
        joint_motions={},
    )
    return cache.value("measure", _measure, built.request, built.placement, upper, around, config)


def _measure(
    request: JointRequest, placement: Placement, upper: float, scene: Scene, config: RealizationConfig
) -> Figures:
    """Returns the same in a scene that holds only what is near the path of the moving body.

    What moves in what the model has, and stands off it as drawn, comes loose by as much as the gap grows.
    """
    moving = request.moving
    motion = request.kind.along(placement.axis)
    near = list(scene.static_obstacles)
    body = scene.swept_body(moving, config.depth * scene.extent, part_axes(scene.parts[moving].mesh))
    ratio = sweep(body, motion, upper, near, _MEASURED_POSES).ratio
    ends = [MeshCollider(v.mesh) for v in scene.hardware_of(moving)] or [MeshCollider(scene.moving_mesh(moving))]
    held = [MeshCollider(v.mesh) for v in placement.static] or [obstacle.collider for obstacle in near]
    swings = [(v.swing, held[k]) for k, v in enumerate(placement.static) if v.swing is not None]

    def gap_at(value: float, enough: float) -> float:
        for swing, collider in swings:
            collider.place(swing.motion(value))
        beside = np.zeros(3) if placement.slip is None else placement.slip.shift(value)
        return gap_between(ends, held, np.asarray(translation(beside) @ motion(value)), enough)

    as_drawn = drawn_poses(request.kind.slides) if placement.template == DRAWN else 0
    return ratio, widest_gap(gap_at, upper, as_drawn)
