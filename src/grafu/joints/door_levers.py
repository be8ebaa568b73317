"""Levers of doors, which turn about the stem at one of their ends, and the bolts of latches, which move with them.

A lever is found by its shape, on a door that works already: a bar across the door that stands off it and is held at the
end which is nearer to the door's free edge. A bar that is held at both ends is a pull.
"""

from collections.abc import Collection, Iterator, Sequence
from typing import final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject, Coupling, Joint, Link, Visual, VisualRole
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.halves import half_of
from grafu.geometry.mesh import TriangleMesh
from grafu.graph.edges import Hinge, Slide
from grafu.joints.lever_config import LeverConfig
from grafu.joints.plan import JointRequest
from grafu.scene.border import part_axes
from grafu.shapes import Float

SOURCE = "rule"
"""`JointRequest.source` of a lever and its bolt: their shape tells."""
_ACROSS, _DEPTH, _UP = 0, 1, 2
_UPRIGHT = np.array([0.0, 0.0, 1.0])


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Leaf:
    """A door as it is built: its own box in its axes, as rows across, in depth and up, and its free side (-1 or 1)."""

    visual: Visual
    axes: Mat3
    box: Box
    free: float

    def local(self, mesh: TriangleMesh) -> TriangleMesh:
        """Returns a mesh in the coordinates of the door's axes."""
        return TriangleMesh(mesh.vertices @ self.axes, mesh.faces)

    def to_object(self, point: Sequence[float]) -> Vec3:
        """Returns a point of the door's axes in the object frame."""
        return np.asarray(self.axes @ np.asarray(point))


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Lever:
    """A lever, and where its stem lies across the door and up, in the door's axes, metres."""

    name: str
    stem: Float[np.ndarray, " 2"]


def lever_requests(
    made: ArticulatedObject, doors: Collection[str], config: LeverConfig = LeverConfig()
) -> tuple[JointRequest, ...]:
    """Returns the joints of levers on doors that turn, and of the bolts that follow these.

    Two levers on one stem are one joint, which turns downwards. A bolt moves in as its lever turns.

    Args:
        made: the object with the doors' joints.
        doors: the ids of the parts that are doors with levers.
        config: what counts as a lever; lengths in the scale of the object (`at_scale`).
    """
    found: list[JointRequest] = []
    for joint in made.joints:
        if joint.child in doors and joint.kind.turns and abs(float(joint.axis.direction[2])) > config.upright:
            leaf = _leaf(joint, made.link(joint.child))
            if leaf is not None:
                found += _of_leaf(leaf, made.link(joint.child), config)
    return tuple(found)


def _leaf(joint: Joint, link: Link) -> _Leaf | None:
    visual = next((visual for visual in link.visuals if visual.name == link.id), None)
    if visual is None:
        return None
    axes = _upright_axes(part_axes(visual.mesh), visual.mesh)
    box = Box.around(visual.mesh.vertices @ axes)
    pin = joint.axis.point @ axes
    return _Leaf(visual, axes, box, float(np.sign(box.center[_ACROSS] - pin[_ACROSS])))


def _upright_axes(axes: Mat3, mesh: TriangleMesh) -> Mat3:
    """Returns a board's axes in the order across, depth, up."""
    up = int(np.argmax(np.abs(axes[_UP])))
    thin = min((k for k in range(3) if k != up), key=lambda k: float(np.ptp(mesh.vertices @ axes[:, k])))
    return np.column_stack([axes[:, 3 - up - thin], axes[:, thin], np.sign(axes[_UP, up]) * axes[:, up]])


def _of_leaf(leaf: _Leaf, link: Link, config: LeverConfig) -> Iterator[JointRequest]:
    """Yields the joints of a door's levers, each with that of its bolt."""
    pieces = [v for v in link.visuals if v is not leaf.visual and v.role is VisualRole.PART and not v.label.is_movable]
    left = [lever for visual in pieces if (lever := _lever(visual, leaf, config)) is not None]
    while left:
        first = left.pop(0)
        pair = [other for other in left if float(np.abs(other.stem - first.stem).max()) <= config.coaxial]
        left = [other for other in left if other not in pair]
        names = {first.name, *(other.name for other in pair)}
        yield _request(first, tuple(other.name for other in pair), leaf, config)
        for visual in pieces:
            if visual.name not in names and (bolt := _bolt(visual, first, leaf, config)) is not None:
                yield bolt


def _lever(visual: Visual, leaf: _Leaf, config: LeverConfig) -> _Lever | None:
    """Returns a piece as a lever; None where it does not have the shape or the place of one."""
    mesh = leaf.local(visual.mesh)
    long, high = float(mesh.box.size[_ACROSS]), float(mesh.box.size[_UP])
    if not (config.long[0] <= long <= config.long[1] and high <= config.high * long):
        return None
    off = (float(leaf.box.low[_DEPTH] - mesh.box.low[_DEPTH]), float(mesh.box.high[_DEPTH] - leaf.box.high[_DEPTH]))
    side = int(np.argmax(off))
    if off[side] < config.off:
        return None
    stem = _stem(mesh, leaf, side, config.near * off[side])
    if stem is None or float(np.ptp(stem[:, 0])) > config.stem * long:
        return None
    middle = stem.min(axis=0) / 2 + stem.max(axis=0) / 2
    aside = float(middle[0] - mesh.box.center[_ACROSS]) * leaf.free
    out = float(middle[0] - leaf.box.center[_ACROSS]) * leaf.free
    if aside < config.aside * long or out < config.free * float(leaf.box.size[_ACROSS]):
        return None
    return _Lever(visual.name, middle)


def _stem(mesh: TriangleMesh, leaf: _Leaf, side: int, deep: float) -> Float[np.ndarray, "n 2"] | None:
    """Returns where a piece passes from a door's face on, so far: across and up; None where nothing of it does."""
    sign = 1.0 if side else -1.0
    face = leaf.box.high if side else leaf.box.low
    normal = np.array([0.0, sign, 0.0])
    slab = half_of(half_of(mesh, normal, face), -normal, face + deep * normal)
    return slab.vertices[:, [_ACROSS, _UP]] if len(slab.faces) else None


def _request(lever: _Lever, attached: tuple[str, ...], leaf: _Leaf, config: LeverConfig) -> JointRequest:
    """Returns the joint of a lever: about its stem, so that the end which points to the hinges goes down."""
    point = leaf.to_object((lever.stem[0], leaf.box.center[_DEPTH], lever.stem[1]))
    towards = -leaf.free * leaf.axes[:, _ACROSS]
    axis = Axis(point, np.cross(_UPRIGHT, towards))
    return JointRequest(lever.name, Hinge.joint_type, axis, SOURCE, config.turn, attached=attached)


def _bolt(visual: Visual, lever: _Lever, leaf: _Leaf, config: LeverConfig) -> JointRequest | None:
    """Returns the joint of a latch's bolt: a small piece that stands out of the door's free edge near the lever."""
    box = leaf.local(visual.mesh).box
    if not config.bolt[0] <= float(box.size.max()) <= config.bolt[1]:
        return None
    edge, end = (leaf.box.high, box.high) if leaf.free > 0 else (leaf.box.low, box.low)
    out = float(end[_ACROSS] - edge[_ACROSS]) * leaf.free
    within = leaf.box.low[_DEPTH] <= box.low[_DEPTH] and box.high[_DEPTH] <= leaf.box.high[_DEPTH]
    near = abs(float(box.center[_UP] - lever.stem[1])) <= config.beside * float(leaf.box.size[_UP])
    if not (config.out <= out <= float(box.size[_ACROSS]) and within and near):
        return None
    axis = Axis(visual.mesh.box.center, -leaf.free * leaf.axes[:, _ACROSS])
    follows = Coupling(lever.name, out / config.turn)
    return JointRequest(visual.name, Slide.joint_type, axis, SOURCE, out, coupling=follows)
