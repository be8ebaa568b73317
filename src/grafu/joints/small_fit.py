"""Small parts made to fit what they stand on: how far they move freely, and what must go of them for that."""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface, selected
from grafu.geometry.arrays import Mat4, Vec3
from grafu.geometry.box import Box
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import translation
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import blockers_at, in_the_way, swept_box, widest_free
from grafu.joints.plan import JointRequest
from grafu.joints.report import Clearance
from grafu.scene.border import part_axes
from grafu.scene.obstacles import Obstacle


@final
@dataclass(frozen=True, eq=False)
class TakenPart:
    """A small part: its visuals, the link that they are taken from, and everything else at rest."""

    request: JointRequest
    visuals: tuple[Visual, ...]
    link: Link
    others: tuple[Visual, ...]

    @property
    def carriers(self) -> tuple[Visual, ...]:
        """What else its link consists of: that carries it."""
        names = {visual.name for visual in self.visuals}
        return tuple(visual for visual in self.link.visuals if visual.name not in names)


def fitted(
    taken: TakenPart, wanted: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[float, TakenPart, tuple[Clearance, ...]]:
    """Returns how far a part moves freely, and the part made to fit.

    A button that meets what it stands on is made shorter by its travel, and travels half its length at most; a knob
    that is sunk into it ends on it.
    """
    if config.trim and taken.request.kind.turns:
        taken, notes = _seated(taken, wanted, made, config)
        return _opening(taken, wanted, made, config), taken, notes
    opening = _opening(taken, wanted, made, config)
    if opening >= config.restricted * wanted or taken.request.kind.turns or not config.trim:
        return opening, taken, ()
    length = _span(taken)
    travel = min(wanted, length / 2)
    shorter = _shortened(taken, travel)
    opening = _opening(shorter, travel, made, config)
    note = Clearance(taken.request.moving, "trimmed", travel, travel / length, "it would cut in as it is pressed")
    return opening, shorter, (note,)


def _passes_through(taken: TakenPart, depth: float) -> bool:
    """Whether a part stands out of both sides of what carries it along its axis, by more than `depth` metres."""
    direction = taken.request.axis.direction
    carrier = np.concatenate([visual.mesh.vertices @ direction for visual in taken.carriers])
    own = np.concatenate([visual.mesh.vertices @ direction for visual in taken.visuals])
    return bool(own.min() < carrier.min() - depth and own.max() > carrier.max() + depth)


def _seated(
    taken: TakenPart, wanted: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[TakenPart, tuple[Clearance, ...]]:
    """Returns a part whose inner end is pressed flat by the least depth at which it turns without cutting in.

    It stays as it is where it cuts into nothing at rest, or still does with as much of it pressed as may be, or where
    it stands out of both sides of what carries it: it has a bearing.
    """
    if _passes_through(taken, config.depth * extent_of(made)):
        return taken, ()
    length = _span(taken)
    low, high = 0.0, config.small.sunk * length
    if not _cuts(taken, 0.0, made, config) or _cuts(_pressed(taken, high), wanted, made, config):
        return taken, ()
    inner = _inner_end(taken, high)
    while high - low > config.depth * extent_of(made):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if _cuts(_pressed(inner, middle), wanted, made, config) else (low, middle)
    note = Clearance(taken.request.moving, "trimmed", high, high / length, "it was sunk into what it stands on")
    return _pressed(taken, high), (note,)


def _cuts(taken: TakenPart, upper: float, made: ArticulatedObject, config: RealizationConfig) -> bool:
    """Whether a part cuts into anything at rest, or before it has moved so far."""
    body, near = swept(taken, upper, made, config)
    motion = taken.request.kind.along(taken.request.axis)
    return bool(blockers_at(body, np.eye(4), near)) or (
        upper > 0 and widest_free(body, motion, upper, near, config.fine_poses, config.short) < upper
    )


def _inner_end(taken: TakenPart, depth: float) -> TakenPart:
    """Returns a part with only the faces that reach so far before its inner end, metres: others cut into nothing."""
    direction = _outward(taken)
    plane = depth + min(float((visual.mesh.vertices @ direction).min()) for visual in taken.visuals)

    def near(surface: Surface) -> Surface:
        ends = surface.mesh.triangles @ direction
        return selected(surface, np.flatnonzero(ends.min(axis=1) <= plane))

    visuals = (replace(v, surfaces=tuple(s for s in map(near, v.surfaces) if not s.is_empty)) for v in taken.visuals)
    return replace(taken, visuals=tuple(v for v in visuals if v.surfaces))


def _pressed(taken: TakenPart, depth: float) -> TakenPart:
    """Returns a part without what lies deeper than so far before its inner end, metres: pressed onto a plane."""
    direction = _outward(taken)
    plane = depth + min(float((visual.mesh.vertices @ direction).min()) for visual in taken.visuals)

    def pressed(mesh: TriangleMesh) -> TriangleMesh:
        short = np.maximum(plane - mesh.vertices @ direction, 0.0)
        return TriangleMesh(mesh.vertices + np.outer(short, direction), mesh.faces)

    visuals = (replace(v, surfaces=tuple(replace(s, mesh=pressed(s.mesh)) for s in v.surfaces)) for v in taken.visuals)
    return replace(taken, visuals=tuple(visuals))


def _outward(taken: TakenPart) -> Vec3:
    """Returns the direction of the axis that leads away from the middle of what carries the part."""
    direction = taken.request.axis.direction
    carrier = Box.enclosing(visual.mesh.box for visual in taken.carriers)
    own = Box.enclosing(visual.mesh.box for visual in taken.visuals)
    return direction if float((own.center - carrier.center) @ direction) >= 0 else -direction


def _opening(taken: TakenPart, wanted: float, made: ArticulatedObject, config: RealizationConfig) -> float:
    """Returns how far it moves before it meets what it does not meet at rest."""
    body, near = swept(taken, wanted, made, config)
    at_rest = set(blockers_at(body, np.eye(4), near))
    free = [obstacle for obstacle in near if obstacle.id not in at_rest]
    motion = taken.request.kind.along(taken.request.axis)
    return widest_free(body, motion, wanted, free, config.fine_poses, config.short)


def swept(
    taken: TakenPart, opening: float, made: ArticulatedObject, config: RealizationConfig
) -> tuple[SweptBody, list[Obstacle]]:
    """Returns a part as a body that moves, and what is near its path up to `opening`."""
    mesh = merge_meshes([visual.mesh for visual in taken.visuals])
    motion = taken.request.kind.along(taken.request.axis)
    box = swept_box(mesh.box, motion, opening)
    near = [Obstacle(v.name, MeshCollider(v.mesh)) for v in taken.others if v.mesh.box.overlaps(box)]
    return SweptBody(mesh, config.depth * extent_of(made), part_axes(mesh)), in_the_way(near, box)


def extent_of(made: ArticulatedObject) -> float:
    """Returns the largest side of the box around an object at rest, metres."""
    return float(Box.enclosing(link.mesh.box for link in made.links).size.max())


def _span(taken: TakenPart) -> float:
    along = np.concatenate([visual.mesh.vertices @ taken.request.axis.direction for visual in taken.visuals])
    return float(np.ptp(along))


def _shortened(taken: TakenPart, travel: float) -> TakenPart:
    """Returns a part that ends sooner on the side to which it moves, by its travel."""
    direction, length = taken.request.axis.direction, _span(taken)
    outer = min(float((visual.mesh.vertices @ direction).min()) for visual in taken.visuals)
    T = _scaling(direction, (length - travel) / length, outer)
    visuals = (replace(v, surfaces=tuple(s.transformed(T) for s in v.surfaces)) for v in taken.visuals)
    return replace(taken, visuals=tuple(visuals))


def _scaling(direction: np.ndarray, factor: float, place: float) -> Mat4:
    """Returns the scaling along a direction that leaves the plane at `place` along it where it is."""
    S = np.eye(4)
    S[:3, :3] += (factor - 1.0) * np.outer(direction, direction)
    return np.asarray(translation(place * direction) @ S @ translation(-place * direction))
