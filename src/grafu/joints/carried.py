"""What hangs on a door or drawer alone moves with it: posts of a bar, a pane, a knob's rose, boards of a drawer.

Whatever a part is called, it falls if nothing holds it. Parts that touch each other, but nothing that is static
other than small things like themselves, are carried by the moving part that they touch: from its outer side or within
it, and no larger than it.
"""

from collections.abc import Mapping

import numpy as np

from grafu.geometry.arrays import Vec3
from grafu.geometry.box import Box
from grafu.graph.edges import SignedAxis
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import code_to_direction, opening_face
from grafu.joints.config import PlanConfig
from grafu.vocabulary import PartLabel

_HANGING = (PartLabel.MISC, PartLabel.UNKNOWN, PartLabel.HANDLE, PartLabel.BAR)


def carried_parts(
    graph: FunctionalGraph, fixed_to: Mapping[str, str], config: PlanConfig = PlanConfig()
) -> tuple[tuple[str, str], ...]:
    """Returns the pairs (moving part, part that it carries) that contacts alone tell.

    Args:
        graph: a completed graph: contacts, hinges and rails.
        fixed_to: by the id of each part of which it is known what carries it, the id of that.
        config: how large such parts may be.
    """
    directions = _directions(graph)
    carrier = dict.fromkeys(directions, "") | dict(fixed_to) | {edge.child: edge.parent for edge in graph.attachments}
    loose = {n.id for n in graph.nodes if n.label in _HANGING and n.id not in carrier}
    if not directions or not loose:
        return ()
    found: list[tuple[str, str]] = []
    for cluster in _clusters(graph, loose):
        touched = {other for part in cluster for other in graph.neighbours[part]} - cluster
        moving_parts = {carrier.get(other, other) or other for other in touched}
        if len(moving_parts) != 1 or not moving_parts <= set(directions):
            continue
        moving = moving_parts.pop()
        nodes = [graph.node(part) for part in cluster]
        if all(_may_carry(graph.node(moving), code_to_direction(directions[moving]), n.box, config) for n in nodes):
            found += [(moving, node.id) for node in graph.nodes if node.id in cluster]
    return tuple(found)


def _directions(graph: FunctionalGraph) -> Mapping[str, SignedAxis]:
    """Returns for each moving part the direction in which it opens."""
    directions: dict[str, SignedAxis] = {rail.child: rail.axis for rail in graph.rails}
    for hinge in graph.hinges:
        directions[hinge.child] = opening_face(graph.node(hinge.child).box.thin_axis, hinge.border, hinge.sign)
    return directions


def _clusters(graph: FunctionalGraph, loose: set[str]) -> list[set[str]]:
    """Returns the loose parts in groups that hang together by contact."""
    left, found = set(loose), []
    while left:
        cluster, queue = set[str](), [min(left)]
        while queue:
            part = queue.pop()
            if part in left:
                left.remove(part)
                cluster.add(part)
                queue += [other for other in graph.neighbours[part] if other in left]
        found.append(cluster)
    return sorted(found, key=lambda cluster: min(cluster))


def _may_carry(moving: PartNode, outward: Vec3, box: Box, config: PlanConfig) -> bool:
    """Whether a box lies before a moving part or within it, inside its outline and clearly smaller."""
    axis = int(np.argmax(np.abs(outward)))
    others = [a for a in range(3) if a != axis]
    inner = moving.box.low[axis] if outward[axis] > 0 else -moving.box.high[axis]
    before = float(box.center @ np.abs(outward)) * float(outward[axis]) >= inner
    spare = config.beyond * moving.box.size
    inside = all(
        box.low[a] >= moving.box.low[a] - spare[a] and box.high[a] <= moving.box.high[a] + spare[a] for a in others
    )
    areas = [float(np.prod(b.size[others])) for b in (box, moving.box)]
    flat = float(box.size[axis]) <= 0.5 * float(moving.box.size[axis])  # a pane may fill its door
    return bool(before and inside and (areas[0] <= config.carried_area * areas[1] or flat))
