"""Takes a trace off the meeting edges of two leaves that are thick, meet without a gap, and would jam as they open.

The edge of a leaf that is far from its pin moves a little towards the other leaf before it leaves the seam: by the
square of its thickness over twice its width.
"""

from dataclasses import replace
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Mat3, Vec3, distinct
from grafu.geometry.box import Box
from grafu.geometry.components import faces_of_parts, part_numbers
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import transform_points
from grafu.joints.clearance_config import ClearanceConfig
from grafu.joints.config import RealizationConfig
from grafu.joints.plan import JointRequest
from grafu.joints.report import Clearance
from grafu.scene.border import part_axes
from grafu.scene.scene import JointMotion, Scene

_POSES = 16


@final
@dataclass(frozen=True, eq=False, slots=True)
class _Edge:
    """The free edge of a leaf along `across`, a unit vector from its pin: where it is at rest, and how far it comes."""

    axes: Mat3
    column: int
    sign: float
    at_rest: float
    farthest: float

    @property
    def across(self) -> Vec3:
        return np.asarray(self.sign * self.axes[:, self.column])


def trimmed_at_seam(
    request: JointRequest, scene: Scene, config: RealizationConfig
) -> tuple[Scene, tuple[Clearance, ...]]:
    """Returns the scene with the free edge of a leaf pressed back from the leaf that it meets, and a record of that.

    The first of two leaves gives way until each passes the other while that is closed. Nothing is pressed where the
    tolerated penetration is enough for that, or where more is needed than `config.max_trim` of the leaf's width.
    """
    own_motion = scene.joint_motions.get(request.moving)
    part, depth = scene.parts[request.moving], config.depth * scene.extent
    own = _edge(part, own_motion or JointMotion(request.axis, request.type, 0.0, is_built=False), config.clearance)
    if own is None:
        return scene, ()
    for name in scene.others_than(request.moving):
        motion = scene.joint_motions.get(name)
        if motion is None or abs(float(motion.axis.direction @ request.axis.direction)) < config.clearance.parallel:
            continue
        other = _edge(scene.parts[name], motion, config.clearance)
        if other is None or not _meet((part.box, own), (scene.parts[name].box, other), config.clearance):
            continue
        gap = -(own.at_rest + other.at_rest)
        overlap = max(own.farthest - own.at_rest, other.farthest - other.at_rest) - gap
        amount = overlap + depth
        width = float(part.box.size @ np.abs(own.across))
        if gap < -depth or overlap <= depth or amount > config.max_trim * width:
            continue
        pressed = _pressed(part, own, amount)
        if pressed is not None:
            why = f"its edge would run into that of {name}, which it meets without a gap"
            return scene.replaced([pressed]), (Clearance(part.id, "trimmed", amount, amount / width, why),)
    return scene, ()


def _edge(part: Part, motion: JointMotion, config: ClearanceConfig) -> _Edge | None:
    """Returns the free edge of a leaf that turns; None of what slides, or turns about its thin side."""
    if not motion.kind.turns or not len(part.mesh.faces):
        return None
    axes = np.asarray(part_axes(part.mesh))
    local = part.mesh.vertices @ axes
    size, along = np.ptp(local, axis=0), int(np.argmax(np.abs(motion.axis.direction @ axes)))
    thin = int(np.argmin(size))
    if along == thin or abs(float(motion.axis.direction @ axes[:, along])) < config.parallel:
        return None
    column = 3 - along - thin
    middle = (local[:, column].min() + local[:, column].max()) / 2
    sign = float(np.sign(middle - motion.axis.point @ axes[:, column])) or 1.0
    turned = (transform_points(motion.axis.rotation(angle), part.mesh.vertices) for angle in _angles(config))
    reached = [float((sign * points @ axes[:, column]).max()) for points in turned]
    return _Edge(axes, column, sign, reached[0], max(reached))


def _angles(config: ClearanceConfig) -> list[float]:
    return np.linspace(0.0, config.seam, _POSES).tolist()


def _meet(own: tuple[Box, _Edge], other: tuple[Box, _Edge], config: ClearanceConfig) -> bool:
    """Whether the free edges of two leaves look at each other, and lie one beside the other."""
    (box, edge), (theirs, facing) = own, other
    if float(edge.across @ facing.across) > -config.parallel:
        return False
    sideways = np.abs(edge.across) < config.parallel
    shared = np.minimum(box.high, theirs.high) - np.maximum(box.low, theirs.low)
    return bool((shared[sideways] >= config.meeting * np.minimum(box.size, theirs.size)[sideways]).all())


def _pressed(part: Part, edge: _Edge, amount: float) -> Part | None:
    """Returns a leaf whose edge is pressed back; None where a piece of it would be pressed flat."""
    limit = edge.at_rest - amount
    surfaces = []
    for surface in part.surfaces:
        local = surface.mesh.vertices @ edge.axes
        along = edge.sign * local[:, edge.column]
        if any(float(along[faces].min()) > limit for faces in _vertices_of_pieces(surface.mesh)):
            return None
        local[:, edge.column] = edge.sign * np.minimum(along, limit)
        surfaces.append(replace(surface, mesh=TriangleMesh(local @ edge.axes.T, surface.mesh.faces)))
    return replace(part, surfaces=tuple(surfaces))


def _vertices_of_pieces(mesh: TriangleMesh) -> list[np.ndarray]:
    return [distinct(mesh.faces[faces]) for faces in faces_of_parts(part_numbers(mesh))]
