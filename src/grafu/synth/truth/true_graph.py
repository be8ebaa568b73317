"""The true functional graph of synthetic furniture: what touches, and what carries each door, drawer and handle.

Contacts are what `parse_graph` finds, as for any input. Motions come from the true joints. The mount of a door is the
still part nearest to its pin, that of what else turns the one nearest to an end of its axis, those of a drawer the
nearest ones beside its flanks, that of what else slides the nearest one along its lower or upper edge, by distances
from real meshes; a part that touches nothing has its mount all the same. What rides on a moving part has that part as
its mount.
"""

from collections.abc import Sequence

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.sampling import point_triangle_distances
from grafu.graph.annotated import carrying_part
from grafu.graph.edges import Attached, Edge, Hinge, MotionEdge, Rail, Slide, Turn, ends_of
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import axis_to_hinge, axis_to_rail, direction_to_code
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

PIN_SAMPLES = np.linspace(0.1, 0.9, 5)  # fractions of a door's border: its ends are where other parts are nearest
RAIL_SAMPLES = np.linspace(0.25, 0.9, 4)  # fractions of a drawer's depth: the front itself often laps the case
LEAST_DEPTH = 0.15  # metres behind a front without a box in which its carriers are sought
REACH = 0.12  # metres from a flank within which a part can carry a rail: a wider gap needs a part above instead
NEAREST = 6  # parts whose meshes are asked, chosen by their boxes: a frame's box can hold a pin that the frame does not
HINGE_REACH = 0.04  # metres between a door's box and what carries it, where anything is that near: hinges are short
ALIKE = 0.003  # metres: of parts as near as this to the nearest one, the largest carries (a panel, not its edge sheet)
APART = 0.015  # metres added where a part does not touch what it might carry
ODD = 0.03  # metres added for odds and ends (runners, brackets): what they are screwed to carries


def true_graph(whole: Asset, points: int = 512, seed: int = 0) -> FunctionalGraph:
    """Returns the functional graph of an asset with true labels, joints and attached parts; `points` on each node.

    Raises:
        GraphError: if a door turns about an axis across its thin side.
    """
    return with_true_edges(parse_graph(whole, ParsingConfig(points=points, seed=seed)), whole)


def with_true_edges(graph: FunctionalGraph, whole: Asset) -> FunctionalGraph:
    """Returns the contact graph of an asset with an edge for each of its joints and each handle's attachment.

    Of a handle that turns as well (a lever) the attachment is the edge.

    Raises:
        GraphError: if a door turns about an axis across its thin side.
    """
    joints = {joint.part: joint for joint in (*whole.joints, *whole.small_joints)}
    carrier_of = {p.id: carrying_part(p.id, joints, whole) for p in whole.parts}
    still = [p for p in whole.parts if p.id not in joints and not carrier_of[p.id] and p.label.is_support]
    edges: list[Edge] = []
    for joint in joints.values():
        above = carrier_of[joint.part]
        edges += _joint_edges(joint, whole.part(joint.part), graph, [whole.part(above)] if above else still)
    for part in whole.parts:
        if part.label is PartLabel.HANDLE and part.carried_by and whole.part(part.carried_by).label.is_movable:
            edges.append(Attached(part.carried_by, part.id))
    return with_edges(graph, edges)


def pairs_apart(contacts: FunctionalGraph, truth: FunctionalGraph) -> frozenset[frozenset[str]]:
    """Returns the pairs of parts that a functional edge of the truth joins though they do not touch."""
    touching = {frozenset(ends_of(e)) for e in contacts.edges}
    return frozenset(frozenset(ends_of(e)) for e in truth.edges) - touching


def carriers(graph: FunctionalGraph) -> frozenset[str]:
    """Returns the parts that carry what moves, or a handle, in a functional graph."""
    return frozenset(e.parent for e in (*graph.motions, *graph.attachments))


def _joint_edges(joint: AnnotatedJoint, part: Part, graph: FunctionalGraph, able: list[Part]) -> list[MotionEdge]:
    """Returns the edges of a joint; `able` may carry it: the still parts, or the one moving part that it is on."""
    if not able:
        return []
    touching = set(graph.neighbours[part.id])
    if motion_kind(joint.type).turns:
        if part.label is not PartLabel.DOOR:
            bearing = _bearing(joint, part, able, touching)
            return [Turn(bearing, part.id, direction_to_code(joint.axis.direction), joint.coupling)]
        mount = _door_mount(joint, part, able, touching)
        return [Hinge(mount, part.id, *axis_to_hinge(part.box, joint.axis), joint.coupling)]
    code = axis_to_rail(joint.axis)
    if part.label is PartLabel.DRAWER:
        mounts = _drawer_mounts(joint, part, able, touching)
        return [Rail(mount, part.id, code, joint.coupling) for mount in mounts]
    return [Slide(_track(joint, part, able, touching), part.id, code, joint.coupling)]


def _track(joint: AnnotatedJoint, part: Part, able: list[Part], touching: set[str]) -> str:
    """Returns what a part slides on: what lies nearest along its lower edge or, of a door, its upper one.

    What slides up or down runs along its sides.
    """
    box, slide = part.box, int(np.argmax(np.abs(joint.axis.direction)))
    across = 2 if slide != 2 else 0 if box.thin_axis != 0 else 1
    found = []
    for end in (box.low, box.high) if part.label is PartLabel.DOOR or slide == 2 else (box.low,):
        samples = np.tile(box.center, (len(PIN_SAMPLES), 1))
        samples[:, slide] = box.low[slide] + PIN_SAMPLES * box.size[slide]
        samples[:, across] = end[across]
        found.append(_best(samples, able, touching))
    lower, *upper = found
    return next((name for name, distance in upper if distance < lower[1] - ALIKE), lower[0])


def _door_mount(joint: AnnotatedJoint, door: Part, still: list[Part], touching: set[str]) -> str:
    axis = joint.axis
    along = (door.box.corners() - axis.point) @ axis.direction
    near = [p for p in still if p.box.gap(door.box) <= HINGE_REACH] or still
    ratios = along.min() + PIN_SAMPLES * np.ptp(along)
    return _best(axis.point + ratios[:, None] * axis.direction, near, touching)[0]


def _bearing(joint: AnnotatedJoint, part: Part, able: list[Part], touching: set[str]) -> str:
    """Returns what holds a part that turns and is no door: what is nearest to one of the two ends of its axis."""
    axis = joint.axis
    along = (part.box.corners() - axis.point) @ axis.direction
    ends = [axis.point + float(end) * axis.direction for end in (along.min(), along.max())]
    return min((_best(end[None], able, touching) for end in ends), key=lambda found: found[1])[0]


def _drawer_mounts(joint: AnnotatedJoint, drawer: Part, still: list[Part], touching: set[str]) -> list[str]:
    """Returns one or two mounts: beside each flank; else what lies above; else the nearest part."""
    slide, up = joint.axis.direction, np.array([0.0, 0.0, 1.0])
    across = np.cross(up, slide)
    beside = [p for p in still if _ratio_of_height(drawer, p) > 0.3]
    found: dict[str, None] = {}
    for side in (-across, across):
        samples = _flank(drawer, slide, side)
        middle = float(np.mean(_span(drawer, side)))
        outside = [p for p in beside if _span(p, side)[1] > middle + 0.01]
        best = _best(samples, outside, touching) if outside else None
        if best and best[1] < REACH:
            found[best[0]] = None
    if found:
        return list(found)
    above = [p for p in still if p.box.high[2] > drawer.box.high[2] - 0.005 and p.box.center[2] > drawer.box.center[2]]
    top = _flank(drawer, slide, np.zeros(3))
    top[:, 2] = drawer.box.high[2]
    return [_best(top, above or still, touching)[0]]


def _flank(drawer: Part, slide: Vec3, side: Vec3) -> Points:
    """Returns points on a drawer's flank towards `side` (its middle where that is zero), from the front backwards."""
    center = drawer.box.center
    (inner, front), (_, flank) = _span(drawer, slide), _span(drawer, side)
    start = center + slide * (front - center @ slide) + side * (flank - center @ side)
    return np.asarray(start - np.outer(RAIL_SAMPLES * max(front - inner, LEAST_DEPTH), slide))


def _best(samples: Points, parts: Sequence[Part], touching: set[str]) -> tuple[str, float]:
    """Returns the part that carries what runs along the samples, and its mean distance in metres."""
    near = _nearest_boxes(samples, parts)
    distances = _mesh_distances(samples, near)
    score = distances + [APART * (p.id not in touching) + ODD * (p.label is PartLabel.MISC) for p in near]
    alike = np.flatnonzero(score <= score.min() + ALIKE)
    chosen = max(alike, key=lambda k: near[k].box.volume)
    return near[chosen].id, float(distances[chosen])


def _nearest_boxes(samples: Points, parts: Sequence[Part]) -> list[Part]:
    low, high = np.array([p.box.low for p in parts]), np.array([p.box.high for p in parts])
    outside = np.maximum(np.maximum(low[:, None] - samples, samples - high[:, None]), 0.0)
    order = np.argsort(np.linalg.norm(outside, axis=2).mean(axis=1), kind="stable")
    return [parts[k] for k in order[:NEAREST]]


def _mesh_distances(samples: Points, parts: Sequence[Part]) -> Float[np.ndarray, " parts"]:
    """Returns each part's mean distance from the samples."""
    counts = [len(p.mesh.faces) for p in parts]
    all_distances = point_triangle_distances(samples, np.concatenate([p.mesh.triangles for p in parts]))
    starts = np.concatenate([[0], np.cumsum(counts)[:-1]]).astype(np.int64)
    return np.asarray(np.minimum.reduceat(all_distances, starts, axis=1).mean(axis=0))


def _ratio_of_height(drawer: Part, part: Part) -> float:
    """Returns the overlap of the two heights as a fraction of the lower one."""
    shared = min(drawer.box.high[2], part.box.high[2]) - max(drawer.box.low[2], part.box.low[2])
    return float(shared / max(min(drawer.box.size[2], part.box.size[2]), 1e-9))


def _span(part: Part, direction: Vec3) -> tuple[float, float]:
    """Returns how far a part reaches along a direction, from and to, in metres from the origin."""
    along = part.mesh.vertices @ direction
    return float(along.min()), float(along.max())
