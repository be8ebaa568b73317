"""The front of a door, flap, lid or drawer: the face that a person who opens it looks at. It casts no rays.

Front coordinates, metres: u to the right, b inwards (against the direction in which it opens), v up, right-handed, so
that a front that faces -Y has the object frame's axes. Lids face up: there, v points to the back. The origin is the
lower left corner of the box around the moving body in these axes, on its foremost plane.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Mat3, Points, Vec3, distinct, freeze_arrays, vec3
from grafu.geometry.box import Box, yaw_of
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.scene.border import border_frame, part_axes
from grafu.scene.scene import JointMotion, Scene
from grafu.vocabulary import PartLabel

Side = Literal["left", "right", "bottom", "top"]
OPPOSITE: dict[Side, Side] = {"left": "right", "right": "left", "top": "bottom", "bottom": "top"}

_TILTED = np.radians(3.0)  # below, a front counts as upright: bowed and bevelled ones are seldom exact
_PANEL = 0.25  # of its length across: a tilted front is thinner than this seen along its own face
_SLIDES = 0.12  # of its length along its path: a part that is thinner, square to its path, slides sideways as a panel
_LYING = 0.7  # cosine: a face that looks up or down more than this has no up of its own


@final
@dataclass(frozen=True, eq=False, slots=True)
class Front(ArrayValue):
    """See the module's docstring; `rotation` has right, inwards and up as columns in the object frame.

    `hinge` is the side that it is hung on, None where it slides. `held` is the edge that a hand opens it at: opposite
    the hinge, or the one that follows as a panel slides aside; None: a drawer. `depth` is the moving body's extent
    inwards.
    """

    origin: Vec3
    rotation: Mat3
    width: float
    depth: float
    height: float
    hinge: Side | None
    held: Side | None

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float64)

    @property
    def right(self) -> Vec3:
        """The direction to the right, in the object frame."""
        return self.rotation[:, 0]

    @property
    def inwards(self) -> Vec3:
        """The direction away from who opens it, in the object frame."""
        return self.rotation[:, 1]

    @property
    def up(self) -> Vec3:
        """The direction up along the front, in the object frame."""
        return self.rotation[:, 2]

    def to_object(self, points: Points) -> Points:
        """Returns points (u, b, v) in the object frame."""
        return points @ self.rotation.T + self.origin

    def to_front(self, points: Points) -> Points:
        """Returns points of the object frame as (u, b, v)."""
        return (points - self.origin) @ self.rotation

    def box_of(self, points: Points) -> Box:
        """Returns the box around points of the object frame, in (u, b, v)."""
        return Box.around(self.to_front(points))


def front_of(scene: Scene, moving_id: str) -> Front:
    """Returns the front of a moving body of the scene, its handles left out of account.

    Raises:
        KeyError: if the scene has no such moving body, or no motion for it.
    """
    return scene.once(_front, moving_id)


def _front(scene: Scene, moving_id: str) -> Front:
    mesh = _body_mesh(scene, moving_id)
    joint_motion = scene.joint_motions[moving_id]
    if joint_motion.kind.turns:
        return _hinged(mesh, scene.parts[moving_id].mesh, joint_motion)
    return _sliding(mesh, scene.parts[moving_id].mesh, joint_motion, scene)


def body_members(scene: Scene, moving_id: str) -> tuple[str, ...]:
    """Returns the ids of a moving body and of all that rides on it but handles."""
    members = scene.moving_bodies[moving_id].members
    return tuple(m for m in members if m == moving_id or scene.parts[m].label is not PartLabel.HANDLE)


def _body_mesh(scene: Scene, moving_id: str) -> TriangleMesh:
    members = body_members(scene, moving_id)
    if members == scene.moving_bodies[moving_id].members:
        return scene.moving_mesh(moving_id)
    return merge_meshes([scene.parts[m].mesh for m in members])


def _hinged(mesh: TriangleMesh, leaf: TriangleMesh, joint_motion: JointMotion) -> Front:
    border = border_frame(leaf, joint_motion.axis)
    x, out, along = (border.rotation[:, k] for k in range(3))
    turn = yaw_of(leaf.vertices @ border.rotation)
    if abs(turn) > _TILTED:
        a, b = np.cos(turn) * x + np.sin(turn) * out, np.cos(turn) * out - np.sin(turn) * x
        size = np.ptp(leaf.vertices @ np.column_stack([a, b]), axis=0)
        if size[1] < _PANEL * size[0] and size[1] < border.thickness:
            x, out = a, b
    up = _upmost((x, along), out)
    front = _framed(mesh, out, up)
    towards = front.rotation.T @ x
    hinge: Side = ("left" if towards[0] > 0 else "right") if abs(towards[0]) > 0.5 else "bottom"
    if hinge == "bottom" and towards[2] < 0:
        hinge = "top"
    return replace(front, hinge=hinge, held=OPPOSITE[hinge])


def _sliding(mesh: TriangleMesh, leaf: TriangleMesh, joint_motion: JointMotion, scene: Scene) -> Front:
    axes, direction = part_axes(leaf), joint_motion.axis.direction
    size = np.ptp(leaf.vertices @ axes, axis=0)
    along = int(np.argmax(np.abs(axes.T @ direction)))
    thin = min(range(2), key=lambda k: float(size[k]))  # an upright panel: level trays slide as they lie
    out = direction
    if along not in (thin, 2) and size[thin] < min(_SLIDES * size[along], _SLIDES * size[2]):
        still = np.mean([p.box.center for p in scene.static_parts], axis=0) if scene.static_parts else leaf.box.center
        away = float((leaf.box.center - still) @ axes[:, thin])
        before = away if abs(away) > 1e-9 else float(vec3(0.0, -1.0, 0.0) @ axes[:, thin])
        out = axes[:, thin] * (1.0 if before > 0 else -1.0)
    front = _framed(mesh, out, _upmost([axes[:, k] for k in range(3)], out))
    aside = float(front.right @ direction)
    return front if abs(aside) < _LYING else replace(front, held="left" if aside > 0 else "right")


def _upmost(directions: Sequence[Vec3], out: Vec3) -> Vec3:
    """Returns which of some directions or their opposites is up on a face that looks `out`, made square to it."""
    wanted = vec3(0.0, 0.0, 1.0) if abs(float(out[2])) < _LYING else vec3(0.0, 1.0, 0.0)
    square = [d - out * float(d @ out) for d in directions]
    lengths = [float(np.linalg.norm(d)) for d in square]
    unit = [d / n for d, n in zip(square, lengths, strict=True) if n > 0.5]
    best = max(unit, key=lambda d: abs(float(d @ wanted)))
    return best if float(best @ wanted) > 0 else -best


def _framed(mesh: TriangleMesh, out: Vec3, up: Vec3) -> Front:
    rotation = np.column_stack([np.cross(up, out), -out, up])
    box = Box.around(mesh.vertices[distinct(mesh.faces)] @ rotation)
    width, depth, height = (float(side) for side in box.size)
    return Front(rotation @ box.low, rotation, width, depth, height, None, None)
