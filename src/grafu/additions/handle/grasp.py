"""How a door or drawer can be grasped as it is: by a handle, a recess, an edge, or not at all. It adds nothing."""

import numpy as np

from grafu.additions.handle.grasp_config import GraspConfig
from grafu.additions.handle.grips import grips_on
from grafu.additions.handle.relief import Relief, Reliefs
from grafu.additions.step import Grasp
from grafu.asset.part import Part
from grafu.joints.racks import is_grid
from grafu.joints.rail.search import is_column
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

NAMELESS_LABELS = (PartLabel.MISC, PartLabel.UNKNOWN)


_UP = 2


def find_grasp(
    scene: Scene, moving_id: str, config: GraspConfig = GraspConfig(), reliefs: Reliefs | None = None
) -> Grasp:
    """Returns how a moving body of the scene can be grasped at rest.

    Handles come first; then what fingers can reach round, get into or pinch, wherever it opens the moving body: on
    doors beyond `config.lever` of the distance from the hinge. `reliefs` are the scene's, if they exist already.

    Raises:
        KeyError: if the scene has no such moving body, or no motion for it.
    """
    joint_motion = scene.joint_motions[moving_id]
    if joint_motion.kind.slides and is_column(scene.parts[moving_id].mesh, joint_motion.axis.direction):
        return Grasp(moving_id, "driven", 1.0, "a column is lifted by its drive, or with what it carries")
    handle = held_by_label(scene, moving_id, config)
    if handle is None and _is_leaf(scene, moving_id):
        box = scene.parts[moving_id].box
        edge = box.center + box.half * joint_motion.axis.direction
        return Grasp(moving_id, "edge", 1.0, "a leaf of a table is drawn out by its edge", edge, float(box.size.max()))
    reliefs = reliefs or Reliefs(scene, config.relief)
    return handle or _without_label(scene, moving_id, reliefs.of(moving_id), config)


def _is_leaf(scene: Scene, moving_id: str) -> bool:
    """Whether a moving body is a level board that slides level and is no drawer: the leaf of a table."""
    part, joint_motion = scene.parts[moving_id], scene.joint_motions[moving_id]
    level = int(np.argmax(np.abs(joint_motion.axis.direction))) != _UP and part.box.thin_axis == _UP
    return joint_motion.kind.slides and level and not part.label.is_movable


def find_grasps(scene: Scene, config: GraspConfig = GraspConfig(), reliefs: Reliefs | None = None) -> dict[str, Grasp]:
    """Returns the grasp of every moving body of the scene."""
    reliefs = reliefs or Reliefs(scene, config.relief)
    return {moving: find_grasp(scene, moving, config, reliefs) for moving in scene.moving_bodies}


def held_by_label(scene: Scene, moving_id: str, config: GraspConfig = GraspConfig()) -> Grasp | None:
    """Returns how a moving body is grasped by a part on it that is called a handle; None where there is none."""
    members = (scene.parts[m] for m in scene.moving_bodies[moving_id].members if m != moving_id)
    handle = next((part for part in members if part.label is PartLabel.HANDLE), None)
    return None if handle is None else _held_by(handle, moving_id, config.labelled, "a handle rides on it")


def _without_label(scene: Scene, moving_id: str, relief: Relief, config: GraspConfig) -> Grasp:
    """Returns how a moving body can be grasped on which no part rides that is called a handle."""
    for member in scene.moving_bodies[moving_id].members:
        part = scene.parts[member]
        if member != moving_id and part.label in NAMELESS_LABELS and _sticks_out(part, relief, config):
            return _held_by(part, moving_id, config.unlabelled, "a small part sticks out of its front")
    for part in scene.static_parts:
        if part.label is PartLabel.HANDLE and _sits_on(part, relief, config.sits):
            return _held_by(part, moving_id, config.unattached, "a handle sits on it that nothing attaches to it")
    best = max(grips_on(relief, config), key=lambda g: (g.confidence, g.length), default=None)
    body = scene.moving_mesh(moving_id)
    if best is None and is_grid(body):
        box = body.box
        rim = np.array([box.center[0], box.low[1], box.high[2]])
        return Grasp(moving_id, "edge", config.unlabelled, "fingers hold its wires", rim, float(box.size[0]))
    if best is None:
        return Grasp(moving_id, "none", 1.0, "no handle, and no edge, hollow or gap with room for fingers")
    return Grasp(moving_id, best.kind, best.confidence, best.why, best.center, best.length)


def _held_by(part: Part, moving_id: str, confidence: float, why: str) -> Grasp:
    length = float(part.box.size.max())
    return Grasp(moving_id, "handle", confidence, why, part.box.center, length, part.id)


def _sticks_out(part: Part, relief: Relief, config: GraspConfig) -> bool:
    """Whether a part that rides on a moving body is small and stands out before its face."""
    if not len(part.mesh.faces):
        return False
    box, front = relief.front.box_of(part.mesh.vertices), relief.front
    small = float(box.size[0] * box.size[2]) < config.small * front.width * front.height
    out = relief.factor * config.stands_out
    return small and float(box.low[1]) <= relief.plane - out and float(box.size[1]) >= out


def _sits_on(part: Part, relief: Relief, gap: float) -> bool:
    """Whether a part that moves with nothing sits on the face of a moving body."""
    if not len(part.mesh.faces):
        return False
    box, outline = relief.front.box_of(part.mesh.vertices), relief.outline
    u, _, v = box.center
    within = outline.low[0] < u < outline.high[0] and outline.low[2] < v < outline.high[2]
    near = relief.factor * gap
    return bool(within and box.low[1] < relief.plane and box.high[1] > relief.plane - near)
