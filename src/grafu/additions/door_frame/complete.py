"""Adds a frame of two jambs and a head around a door of a building that is drawn alone: something must carry it."""

import numpy as np

from grafu.additions.door_frame.config import DoorFrameConfig
from grafu.additions.likeness import surface_like
from grafu.additions.step import (
    Addition,
    Deficiency,
    DeficiencyKind,
    StepRequest,
    StepResult,
    added_part,
    free_ids,
)
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.joints.lone_leaves import lone_leaves_of
from grafu.scene.scene import Scene
from grafu.vocabulary import PartLabel

_WIDTH, _DEPTH, _UP = 0, 1, 2


def add_door_frame(scene: Scene, request: StepRequest, config: DoorFrameConfig | None) -> StepResult:
    """Returns the scene with a frame around a leaf that is drawn alone; without a config only the lack is stated."""
    leaves = lone_leaves_of(tuple(scene.parts.values()))
    moving = {joint.moving for joint in request.plan.joints}
    if not leaves or not moving.issuperset(leaf.id for leaf in leaves) or scene.still_parts:
        return StepResult(scene)
    names = " and ".join(leaf.id for leaf in leaves)
    lacking = (Deficiency(DeficiencyKind.DOOR_FRAME, leaves[0].id, "nothing is drawn that could carry it"),)
    if config is None:
        return StepResult(scene, deficiencies=lacking)
    riding = Box.enclosing(scene.moving_mesh(leaf.id).box for leaf in leaves)
    mesh = _frame(Box.enclosing(leaf.box for leaf in leaves), riding, at_scale(config, scene.metre))
    (name,) = free_ids("door_frame", 1, scene.parts)
    part = added_part(name, PartLabel.FACE_FRAME, (surface_like(mesh, list(leaves)),))
    why = f"{names} {'is' if len(leaves) == 1 else 'are'} drawn without a frame"
    return StepResult(scene.with_parts([part]), (Addition(part, why, "door frame"),), deficiencies=lacking)


def _frame(leaf: Box, moving: Box, config: DoorFrameConfig) -> TriangleMesh:
    """Returns two jambs beside a leaf and all that rides on it, and a head above, flush with the leaf's front face."""
    low, high = np.minimum(leaf.low, moving.low) - config.gap, np.maximum(leaf.high, moving.high) + config.gap
    front, back = float(leaf.low[_DEPTH]), float(leaf.low[_DEPTH] + max(config.depth, leaf.size[_DEPTH]))
    floor, head = float(leaf.low[_UP]), float(high[_UP])
    outer = float(low[_WIDTH]) - config.width, float(high[_WIDTH]) + config.width
    spans = (
        ((outer[0], floor), (float(low[_WIDTH]), head)),
        ((float(high[_WIDTH]), floor), (outer[1], head)),
        ((outer[0], head), (outer[1], head + config.width)),
    )
    boxes = (Box(np.array([a[0], front, a[1]]), np.array([b[0], back, b[1]])) for a, b in spans)
    return merge_meshes([TriangleMesh.box_mesh(box) for box in boxes])
