"""Lifting columns of desks: posts in sleeves that carry a top. They slide up in step, with all that they carry.

They are found by boxes and contacts, whatever the parts are called: a slim upright part with a wall close to each of
its four sides, or inside a tube, that stands off the floor and reaches out of its sleeve to what lies above.
"""

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.graph.edges import Slide
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.joints.config import LiftConfig
from grafu.joints.plan import JointRequest, RealizationPlan

SOURCE = "rule"
"""`JointRequest.source` of a lifting column: its shape alone tells."""
_LEVEL = (0, 1)


def with_lifts(plan: RealizationPlan, graph: FunctionalGraph, config: LiftConfig = LiftConfig()) -> RealizationPlan:
    """Returns the plan in which lifting columns slide up with what they carry; the plan itself where there are none.

    The first column carries all; the others follow it. A joint on what is carried moves with it. Joints that the plan
    has stay as they are. `graph` holds the parts of the input alone; lengths of `config` are in the scale of the model
    (`at_scale`).
    """
    moving = {part for request in plan.joints for part in (request.moving, *request.attached)}
    static = [node for node in graph.nodes if node.id not in moving]
    columns = {node: top for node in static if (top := _sleeve_top(node, static, graph, config)) is not None}
    if not columns:
        return plan
    carried = _carried(columns, static, graph)
    if not _bears_a_top((graph.node(part).box for part in carried), graph.box, config):
        return plan
    leader, *others = columns
    riding = [r for r in plan.joints if not r.parent and _rides(r, carried, graph, config)]
    parts = [part for r in riding for part in (r.moving, *r.attached)]
    ids = {node.id for node in columns}
    travel = config.travel * min(top - float(node.box.low[2]) for node, top in columns.items())
    lifts = [_lift(leader, travel, (*(p for p in carried if p not in ids), *parts), None)]
    lifts += [_lift(node, travel, (), Coupling(leader.id)) for node in others]
    kept = (replace(r, parent=leader.id) if r in riding else r for r in plan.joints)
    refused = tuple(refusal for refusal in plan.refused if refusal.part not in ids)
    return replace(plan, joints=(*kept, *lifts), refused=refused)


def _lift(node: PartNode, travel: float, attached: tuple[str, ...], coupling: Coupling | None) -> JointRequest:
    axis = Axis(node.box.center, vec3(0.0, 0.0, 1.0))
    return JointRequest(node.id, Slide.joint_type, axis, SOURCE, travel, (), attached, coupling=coupling)


def _sleeve_top(node: PartNode, static: list[PartNode], graph: FunctionalGraph, config: LiftConfig) -> float | None:
    """Returns the height at which a column leaves its sleeve; None where the part is no column in a sleeve."""
    box = node.box
    tall, floor = float(box.size[2]), float(graph.box.low[2])
    if max(box.size[:2]) > config.slim * tall or tall < config.tall * float(graph.box.size[2]):
        return None
    if float(box.low[2]) < floor + config.off_floor:
        return None
    near = [other.box for other in static if other is not node and _guides(other.box, box, config)]
    walls = [
        [wall for wall in near if _is_beside(wall, box, axis, sign, config)] for axis in _LEVEL for sign in (-1, 1)
    ]
    if not all(walls):
        return None
    return max(float(wall.high[2]) for side in walls for wall in side)


def _guides(wall: Box, column: Box, config: LiftConfig) -> bool:
    """Whether a part stands along enough of the column's height, and ends below the column's upper end."""
    tall = float(column.size[2])
    along = min(wall.high[2], column.high[2]) - max(wall.low[2], column.low[2])
    return bool(along >= config.engaged * tall and wall.high[2] <= column.high[2] - config.out * tall)


def _is_beside(wall: Box, column: Box, axis: int, sign: int, config: LiftConfig) -> bool:
    """Whether a part is the sleeve's wall on this side of the column, or a tube around it."""
    across = 1 - axis
    shared = min(wall.high[across], column.high[across]) - max(wall.low[across], column.low[across])
    if shared < config.faces * column.size[across]:
        return False
    face = column.high[axis] if sign > 0 else -column.low[axis]
    inner, outer = (wall.low[axis], wall.high[axis]) if sign > 0 else (-wall.high[axis], -wall.low[axis])
    is_wall = abs(inner - face) <= config.gap
    is_tube = inner < face and 0 < outer - face <= config.tube
    return bool(is_wall or is_tube)


def _carried(columns: dict[PartNode, float], static: list[PartNode], graph: FunctionalGraph) -> list[str]:
    """Returns the columns and all static parts above the sleeves that hang together with them."""
    top = min(columns.values())
    above = {node.id for node in static if float(node.box.center[2]) > top}
    found, queue = dict.fromkeys(node.id for node in columns), [node.id for node in columns]
    while queue:
        for other in graph.neighbours[queue.pop()]:
            if other in above and other not in found:
                found[other] = None
                queue.append(other)
    return list(found)


def _bears_a_top(carried: Iterable[Box], whole: Box, config: LiftConfig) -> bool:
    """Whether some part that is carried covers much of the plan."""
    least = config.covers * float(np.prod(whole.size[:2]))
    return any(float(np.prod(box.size[:2])) >= least for box in carried)


def _rides(request: JointRequest, carried: list[str], graph: FunctionalGraph, config: LiftConfig) -> bool:
    """Whether what carries a joint is carried by the columns: its mounts, else all static parts that it touches.

    Of mounts the nearest counts, and those within `config.gap` of it: a predicted one that is farther off, such as the
    sleeve of a column, carries nothing.
    """
    moving, holders = graph.node(request.moving).box, request.mounts or tuple(graph.neighbours[request.moving])
    gaps = [moving.gap(graph.node(part).box) for part in holders]
    holders = tuple(part for part, gap in zip(holders, gaps, strict=True) if gap <= min(gaps) + config.gap)
    return bool(holders) and sum(part in carried for part in holders) * 2 > len(holders)
