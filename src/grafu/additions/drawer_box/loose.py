"""Boards of a drawer box that are parts of their own in the input, without a stated motion.

They lie behind a mere front, within its outline, hang together with it and with nothing that is static, and make at
least both sides of a box with a bottom or a back. What is labelled as a panel of the case is none of them. Boards that
touch the case as well are not told from parts of it.
"""

import numpy as np

from grafu.additions.closed_scene import ClosedScene
from grafu.additions.drawer_box.config import DrawerBoxConfig
from grafu.additions.drawer_box.verdict import box_verdict
from grafu.asset.part import Part
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.joints.plan import JointRequest
from grafu.joints.rail.body_region import DrawerFrame
from grafu.vocabulary import PartLabel

CASE_LABELS = frozenset(
    {PartLabel.TOP_PANEL, PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.FACE_FRAME, PartLabel.LEG}
)


def loose_boards(
    request: JointRequest, mesh: TriangleMesh, frame: DrawerFrame, closed: ClosedScene, config: DrawerBoxConfig
) -> tuple[str, ...]:
    """Returns the ids of the still parts that are boards of the box behind a mere front; none where they make no box.

    `mesh` is the front in its own frame.
    """
    touch = max(min(config.touch, config.touch_ratio * frame.width), 1e-6)
    near: dict[str, TriangleMesh] = {}
    for part in closed.scene.static_parts:
        if part.label not in CASE_LABELS and _is_behind(_local_box(part, frame), frame, touch):
            near[part.id] = TriangleMesh(_local(part.mesh.vertices, frame), part.mesh.faces)
    held = _hanging_together(mesh.box, _apart(near, closed, config.probe.apart * touch), touch)
    rest = [p for p in closed.scene.static_parts if p.id not in held]
    if not held or not any(_reaches_behind(_local_box(p, frame), frame, config.probe.carrier) for p in rest):
        return ()
    whole = merge_meshes([mesh, *(near[part_id] for part_id in held)])
    depth = float(whole.box.high[1])
    verdict = box_verdict(
        request.moving,
        whole,
        DrawerFrame(frame.origin, frame.rotation, frame.width, depth, frame.height),
        config,
        closed.drawers,
    )
    there = {name for name, ratio in verdict.ratios if ratio >= config.covered}
    is_box = {"side_left", "side_right"} <= there and there & {"bottom", "back"}
    return held if is_box else ()


def _local(points: Points, frame: DrawerFrame) -> Points:
    return np.asarray((points - frame.origin) @ frame.rotation)


def _local_box(part: Part, frame: DrawerFrame) -> Box:
    return Box.around(_local(part.box.corners(), frame))


def _is_behind(box: Box, frame: DrawerFrame, touch: float) -> bool:
    """Whether a part lies behind a front and within its outline."""
    beside = max(abs(float(box.low[0])), abs(float(box.high[0]))) <= frame.width / 2 + touch
    level = max(abs(float(box.low[2])), abs(float(box.high[2]))) <= frame.height / 2 + touch
    return beside and level and float(box.low[1]) >= frame.depth - 2 * touch - 0.5 * frame.depth


def _reaches_behind(box: Box, frame: DrawerFrame, ratio: float) -> bool:
    """Whether a part reaches this fraction of a front's smaller side behind it: it may carry what slides there."""
    return float(box.high[1]) > frame.depth + ratio * min(frame.width, frame.height)


def _apart(near: dict[str, TriangleMesh], closed: ClosedScene, touch: float) -> dict[str, TriangleMesh]:
    """Returns those of the parts that touch no still part but one another."""
    colliders = {obstacle.id: obstacle.collider for obstacle in closed.scene.static_obstacles}
    left = dict(near)
    changed = bool(left)
    while changed:
        others = [name for name in colliders if name not in left]
        fixed = [
            name
            for name in left
            if any(
                colliders[name].box.overlaps(colliders[other].box, touch)
                and colliders[name].distance(colliders[other]) <= touch
                for other in others
            )
        ]
        left = {name: mesh for name, mesh in left.items() if name not in fixed}
        changed = bool(fixed)
    return left


def _hanging_together(front: Box, near: dict[str, TriangleMesh], touch: float) -> tuple[str, ...]:
    """Returns those of the parts that touch the front, or one that does, by their boxes."""
    held: list[str] = []
    reached = [front]
    while reached:
        box = reached.pop()
        for part_id, mesh in near.items():
            if part_id not in held and mesh.box.overlaps(box, touch):
                held.append(part_id)
                reached.append(mesh.box)
    return tuple(sorted(held))
