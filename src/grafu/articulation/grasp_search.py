"""The grasp frames of an object: of each handle, and of edges, recesses and knobs where a link has none.

It looks at the surfaces as they are drawn: where a gripper's two fingers find room on both sides of a bar, knob or
edge. What can be held at all is for others to say.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Joint, Link, Visual
from grafu.articulation.finger_fit import Facing, FingerFit, FingerFitConfig, FingerSpace
from grafu.articulation.grasp_frame import GraspFrame, GraspKind
from grafu.articulation.kinematics import all_before
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.mesh import merge_meshes, mesh_near
from grafu.geometry.transform import rotation_matrix
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True)
class GraspHint:
    """How a link can be held, as far as it is known: by which part (empty: its own surface), and about where.

    `center` is in the object frame at rest; None: in the middle of the part.
    """

    kind: GraspKind
    part: str = ""
    center: Vec3 | None = None
    length: float = 0.0


DEFAULT_FINGER_CONFIG = FingerFitConfig()


def with_grasps(
    articulated: ArticulatedObject, hints: Mapping[str, GraspHint], config: FingerFitConfig = DEFAULT_FINGER_CONFIG
) -> ArticulatedObject:
    """Returns the object with the grasp frames of its moving links; `hints` are by links, others have no grasp.

    Each handle of a link has a frame. Where it has none, there is one at the hint's place.
    """
    surroundings = _Surroundings(articulated)
    taken: set[str] = set()
    found: list[GraspFrame] = []
    for link in articulated.links_from_root:
        joint = articulated.joint_of.get(link.id)
        if joint is None or not joint.kind.moves or link.id not in hints:
            continue
        for name, held in _held(link, hints[link.id]):
            frame = _frame_of(surroundings.at(joint), joint, link, held, config)
            if frame is not None:
                unique = name if name not in taken else f"{link.id}_{name}"
                taken.add(unique)
                found.append(replace(frame, name=unique))
    return replace(articulated, grasps=tuple(found))


def _held(link: Link, hint: GraspHint) -> Iterator[tuple[str, GraspHint]]:
    """Yields the name of each grasp of a link, and what is held."""
    handles = [v for v in link.rigid_visuals if v.label is PartLabel.HANDLE and len(v.mesh.faces)]
    for handle in handles:
        yield f"{handle.name}_grasp", GraspHint("handle", handle.name)
    if not handles:
        yield f"{link.id}_grasp", hint


@final
class _Surroundings:
    """What is around the hand at each joint at rest: all that does not open before it. Not a value."""

    def __init__(self, articulated: ArticulatedObject) -> None:
        self._object = articulated
        self._waits = {j.id: j.after for j in articulated.joints}
        self._made: dict[frozenset[str], Facing] = {}

    def at(self, joint: Joint) -> Facing:
        """Returns the surfaces around a joint's link and on it."""
        before = all_before(joint.id, self._waits)
        gone = frozenset(j.child for j in self._object.joints if j.id in before)
        if gone not in self._made:
            links = (link for link in self._object.links if link.id not in gone)
            meshes = [v.mesh for link in links for v in link.rigid_visuals if len(v.mesh.faces)]
            self._made[gone] = Facing(meshes)
        return self._made[gone]


def _frame_of(around: Facing, joint: Joint, link: Link, hint: GraspHint, config: FingerFitConfig) -> GraspFrame | None:
    part = next((v for v in link.rigid_visuals if v.name == hint.part and len(v.mesh.faces)), None)
    body = merge_meshes([v.mesh for v in link.rigid_visuals])
    if not len(body.faces):
        return None
    if part is not None and hint.center is None:
        target, middle, length = part.mesh, part.mesh.box.center, 0.0
    else:
        middle = body.box.center if hint.center is None else np.asarray(hint.center)
        whole = hint.kind == "itself"
        target = body if whole else mesh_near([body], Box.from_center(middle, np.full(3, config.around)))
        length = 0.0 if whole else hint.length
    if not len(target.faces):
        return None
    fingers = FingerSpace(target, around, config)
    largest = max(link.rigid_visuals, key=lambda v: v.mesh.box.diagonal if len(v.mesh.faces) else 0.0)
    fit = _best(fingers, _approaches(joint, hint, largest, middle), middle, length, config)
    if fit is None:
        return None
    name = part.name if part is not None else _nearest(link, fit.position)
    width, depth = (fit.width, fit.depth) if fit.depth >= config.least_depth else (fit.width, 0.0)
    return GraspFrame("", link.id, name, hint.kind, fit.position, fit.approach, fit.closing, width, depth)


def _best(
    fingers: FingerSpace, approaches: Iterable[Mat3], middle: Vec3, length: float, config: FingerFitConfig
) -> FingerFit | None:
    """Returns the first approach with room enough; else that with most room, else how closed fingers hook in."""
    best: FingerFit | None = None
    first: Mat3 | None = None
    for axes in approaches:
        free = first is None
        first = axes if first is None else first
        for turned in (axes, np.column_stack([axes[:, 1], -axes[:, 0], axes[:, 2]])):
            for fit in fingers.fits(turned, middle, length, free):
                if best is None or fit.rank(config) > best.rank(config):
                    best = fit
        if best is not None and best.depth >= config.enough:
            return best
    if best is not None and best.depth >= config.least_depth:
        return best
    hook = None if first is None else fingers.hook(first, middle)
    return hook or best


def _approaches(joint: Joint, hint: GraspHint, largest: Visual, middle: Vec3) -> Iterator[Mat3]:
    """Yields frames (columns x, y, z; z approaches): against the way it opens, then from all its sides."""
    own = rotation_matrix(np.array([0.0, 0.0, 1.0]), yaw_of(largest.mesh.vertices))
    opens = joint.kind.sets_off(joint.axis, middle)
    if hint.kind == "itself" and joint.kind.turns:
        opens = np.asarray(joint.axis.direction)
    along = int(np.argmax(np.abs(own.T @ opens)))
    sign = 1.0 if own[:, along] @ opens >= 0 else -1.0
    sides = [(along, -sign), *((k, s) for k in range(3) if k != along for s in (-1.0, 1.0))]
    if hint.kind == "itself":
        sides.insert(1, (along, sign))
    for axis, sense in sides:
        z, y = sense * own[:, axis], own[:, (axis + 1) % 3]
        yield np.column_stack([np.cross(y, z), y, z])


def _nearest(link: Link, point: Vec3) -> str:
    """Returns the name of the part of a link whose box is nearest to a point: the smallest of those around it."""

    def distance(visual: Visual) -> tuple[float, float]:
        box = visual.mesh.box
        outside = np.maximum(np.maximum(box.low - point, point - box.high), 0.0)
        return round(float(np.linalg.norm(outside)), 4), box.diagonal

    return min((v for v in link.rigid_visuals if len(v.mesh.faces)), key=distance).name
