"""Stays on lids and flaps that open upwards, after all else is built: only where there is room, else they are left out.

A stay is hardware: a bracket on a wall of the case, one on the leaf, a tube on the first and a rod on the second that
point at one another in every pose. It is no joint and no constraint; what holds the leaf in a simulator is its
joint (`articulation.counterbalance`).
"""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link, Visual, VisualRole
from grafu.articulation.swing import Swing
from grafu.dataclass import dataclass
from grafu.geometry.appearance import Surface
from grafu.geometry.arrays import Mat3, Scalars, Vec3, vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.intersection import MeshCollider
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.raycast import RayCaster
from grafu.geometry.swept_body import SweptBody
from grafu.geometry.transform import from_rotation
from grafu.joints.config import RealizationConfig
from grafu.joints.limits import is_free
from grafu.joints.realize import Realized
from grafu.joints.report import Installed
from grafu.joints.stay_config import StayConfig
from grafu.joints.stay_places import StayPlace, places
from grafu.scene.border import BorderFrame, border_frame, without_handle
from grafu.scene.obstacles import Obstacle
from grafu.scene.scale import metre_on
from grafu.templates.stay import leaf_bracket, rod_surfaces, tube_surfaces, wall_bracket
from grafu.vocabulary import PartLabel

_SIDES = (1.0, -1.0)


def with_stays(realized: Realized, config: RealizationConfig = RealizationConfig()) -> Realized:
    """Returns what was realized with stays on its lids and flaps, and how many each joint has in the report."""
    made = realized.object
    extent = float(Box.enclosing(link.mesh.box for link in made.links if len(link.mesh.faces)).size.max())
    metre = metre_on(extent)
    scaled, counts = at_scale(config, metre), dict[str, int]()
    for joint in made.free_joints:
        if _takes_stays(made, joint, scaled.stay):
            made, counts[joint.child] = _with_stays_on(made, joint, extent, metre, scaled)
    outcomes = tuple(
        replace(o, stays=counts[o.moving]) if isinstance(o, Installed) and o.moving in counts else o
        for o in realized.report.outcomes
    )
    return replace(realized, object=made, report=replace(realized.report, outcomes=outcomes))


def _takes_stays(made: ArticulatedObject, joint: Joint, config: StayConfig) -> bool:
    """Whether a leaf on the case opens upwards, far enough, about a level axis, and no joint follows it."""
    if not joint.kind.turns or not joint.kind.limited or joint.parent != made.root or joint.limits.lower > 0:
        return False
    if any(other.coupling is not None and other.coupling.leader == joint.id for other in made.joints):
        return False
    level = abs(float(joint.axis.direction[2])) <= config.level
    center = made.link(joint.child).body_mesh.box.center
    rises = float(joint.kind.displacement(joint.axis, center[None], joint.limits.upper)[0, 2]) > 0
    return level and rises and joint.limits.upper >= config.opening


@final
@dataclass(frozen=True, eq=False)
class _Leaf:
    """One lid or flap with what stands around it: all else at rest, and the other joints with what they move."""

    joint: Joint
    frame: BorderFrame
    mesh: TriangleMesh
    rays: RayCaster
    walls: RayCaster
    around: tuple[Obstacle, ...]
    others_moving: tuple[tuple[Joint, SweptBody], ...]
    depth: float
    metre: float
    config: StayConfig

    @property
    def angles(self) -> Scalars:
        """The openings at which a stay is tested and its turn is tabled."""
        return np.linspace(0.0, self.joint.limits.upper, self.config.poses)


def _with_stays_on(
    made: ArticulatedObject, joint: Joint, extent: float, metre: float, config: RealizationConfig
) -> tuple[ArticulatedObject, int]:
    """Returns the object with the stays that one leaf has room for, and their number."""
    leaf = _leaf(made, joint, extent, metre, config)
    if leaf is None:
        return made, 0
    found = [stay for side in _SIDES if (stay := _stay_on(leaf, side)) is not None]
    more: dict[str, list[Visual]] = {joint.parent: [], joint.child: []}
    for k, stay in enumerate(found):
        for link_id, visuals in ((joint.parent, stay.on_case), (joint.child, stay.on_leaf)):
            more[link_id] += [replace(v, name=f"support_{joint.child}_stay_{k}_{v.name}") for v in visuals]
    links = tuple(Link(link.id, (*link.visuals, *more.get(link.id, ()))) for link in made.links)
    return (replace(made, links=links) if found else made), len(found)


def _leaf(
    made: ArticulatedObject, joint: Joint, extent: float, metre: float, config: RealizationConfig
) -> _Leaf | None:
    """Returns a leaf ready for stays; None where it is too small for any."""
    link, around = made.link(joint.child), config.hinge.survey
    own = next((v.mesh for v in link.visuals if v.name == joint.child), link.body_mesh)
    frame = without_handle(border_frame(own, joint.axis), own, around.front, around.rounding)
    if frame.width < config.stay.narrowest or frame.length < config.stay.shortest:
        return None
    others = [other for other in made.links if other.id != joint.child]
    depth = config.depth * extent
    others_moving = [other for other in made.moving_joints if other.id != joint.id and other.parent == made.root]
    root = [v for v in made.link(made.root).rigid_visuals if len(v.mesh.faces)]
    return _Leaf(
        joint,
        frame,
        merge_meshes([visual.mesh for visual in link.rigid_visuals]),
        RayCaster(own),
        RayCaster(merge_meshes([visual.mesh for visual in root])),
        tuple(Obstacle(v.name, MeshCollider(v.mesh)) for o in others for v in o.rigid_visuals if len(v.mesh.faces)),
        tuple((other, SweptBody(made.link(other.child).mesh, depth)) for other in others_moving),
        depth,
        metre,
        config.stay,
    )


@final
@dataclass(frozen=True, eq=False)
class _Stay:
    """One stay at rest, object frame: what is fixed to the case and to the leaf, and what turns on either bracket."""

    wall_bracket: Visual
    tube: Visual
    leaf_bracket: Visual
    rod: Visual

    @property
    def on_case(self) -> tuple[Visual, ...]:
        """What the case holds."""
        return self.wall_bracket, self.tube

    @property
    def on_leaf(self) -> tuple[Visual, ...]:
        """What the leaf holds."""
        return self.leaf_bracket, self.rod


def _stay_on(leaf: _Leaf, side: float) -> _Stay | None:
    """Returns the first stay that fits at one end of a leaf."""
    frame, config = leaf.frame, leaf.config
    x, y, _ = frame.to_border(leaf.joint.axis.closest_point(frame.origin)[None])[0]
    axis, tested = np.array([float(x), float(y)]), 0
    for place, parts in places(axis, -frame.thickness, frame.width, leaf.angles, config):
        wall = _wall(leaf, place, side)
        face = None if wall is None else _face(leaf, place, wall - side * config.off_wall)
        if wall is None or face is None:
            continue
        stay = _built(leaf, place, parts, (side, wall, face))
        tested += 1
        if _is_free(stay, leaf):
            return stay
        if tested == config.tries:
            return None
    return None


def _wall(leaf: _Leaf, place: StayPlace, side: float) -> float | None:
    """Returns the z, in the border frame, of the wall beside the case's pivot; None where it is not flat."""
    frame, config = leaf.frame, leaf.config
    start, near = side * config.start * frame.length, config.plate
    steps = [(a * near, b * near) for a in (-1.0, 0.0, 1.0) for b in (-1.0, 0.0, 1.0)]
    points = np.array([[place.case[0] + a, place.case[1] + b, start] for a, b in steps])
    met = leaf.walls.along(frame.to_object(points), frame.direction(0.0, 0.0, side))
    if not np.all(np.isfinite(met)) or float(np.ptp(met)) > config.even:
        return None
    wall = start + side * float(met.min())
    return wall if abs(wall) - config.off_wall <= frame.length / 2 - config.end else None


def _face(leaf: _Leaf, place: StayPlace, z: float) -> float | None:
    """Returns the y of the leaf's inner face before the rod's pivot; None where it is not flat, or too far off."""
    frame, config = leaf.frame, leaf.config
    steps = [(a * config.plate, b * config.plate / 2) for a in (-1.0, 0.0, 1.0) for b in (-1.0, 0.0, 1.0)]
    points = np.array([[place.leaf[0] + a, place.leaf[1], z + b] for a, b in steps])
    met = leaf.rays.along(frame.to_object(points), frame.direction(0.0, 1.0, 0.0))
    if not np.all(met <= config.farthest) or float(np.ptp(met)) > config.even:
        return None
    return float(place.leaf[1]) + float(met.min())


def _built(leaf: _Leaf, place: StayPlace, parts: tuple[float, float], found: tuple[float, float, float]) -> _Stay:
    """Returns the stay of a place; `found` are the side, the wall's z and the y of the leaf's face."""
    side, wall, face = found
    frame, metre, z = leaf.frame, leaf.metre, wall - side * leaf.config.off_wall
    inwards = np.diag([-side, 1.0, -side])  # brackets have their wall behind them, their lug away from it
    span = place.leaf - place.case
    u, v = span / np.linalg.norm(span), np.array([-span[1], span[0]]) / np.linalg.norm(span)
    along = np.array([[u[0], v[0], 0.0], [u[1], v[1], 0.0], [0.0, 0.0, 1.0]])
    back = along @ np.diag([-1.0, -1.0, 1.0])
    case, pivot = (vec3(float(point[0]), float(point[1]), z) for point in (place.case, place.leaf))
    on_wall, on_leaf = vec3(float(case[0]), float(case[1]), wall), vec3(float(pivot[0]), face, z)
    turns, angles = place.turns(leaf.angles), leaf.angles

    def visual(name: str, surfaces: tuple[Surface, ...], R: Mat3, at: Vec3, turned: Scalars | None = None) -> Visual:
        T = np.asarray(frame.T_object_border @ from_rotation(R, at))
        moved = tuple(surface.transformed(T) for surface in surfaces)
        axis = Axis(frame.to_object(at[None])[0], frame.rotation[:, 2])
        swing = None if turned is None else Swing(leaf.joint.child, axis, angles, turned)
        return Visual(name, moved, VisualRole.HARDWARE, PartLabel.MISC, swing)

    height = face - float(pivot[1])
    return _Stay(
        visual("bracket", wall_bracket(leaf.config.off_wall, metre), inwards, on_wall),
        visual("tube", tube_surfaces(parts[0], metre), along, case, turns),
        visual("lid_bracket", leaf_bracket(height, metre), inwards, on_leaf),
        visual("rod", rod_surfaces(parts[1], metre), back, pivot, turns - angles),
    )


def _is_free(stay: _Stay, leaf: _Leaf) -> bool:
    """Whether a stay cuts into nothing on its way, and no other moving body into it while the leaf is closed."""
    still, turning, moving = (
        SweptBody(visual.mesh, leaf.depth, leaf.frame.rotation)
        for visual in (stay.wall_bracket, stay.tube, stay.leaf_bracket)
    )
    rod, own = SweptBody(stay.rod.mesh, leaf.depth, leaf.frame.rotation), MeshCollider(leaf.mesh)
    assert stay.tube.swing is not None
    assert stay.rod.swing is not None
    for value in leaf.angles:
        T = leaf.joint.motion(float(value))
        own.place(T)
        turning.place(stay.tube.swing.motion(float(value)))
        moving.place(T)
        rod.place(np.asarray(T @ stay.rod.swing.motion(float(value))))
        if any(body.penetrates(own) for body in (still, turning, rod)):
            return False
        if any(body.penetrates(other.collider) for body in (still, turning, moving, rod) for other in leaf.around):
            return False
    closed = [Obstacle("stay", MeshCollider(visual.mesh)) for visual in (*stay.on_case, *stay.on_leaf)]
    return all(is_free(body, j.motion, j.limits.upper, closed, leaf.config.poses) for j, body in leaf.others_moving)
