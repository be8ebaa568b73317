"""Whether synthetic furniture is sound: it moves freely, its labels agree with its joints, its graph with both.

`faults_of` judges a tidy model, where every fault is one. `faults_in` judges a specimen: what its declared defects
explain is no fault. It mends nothing and draws nothing.
"""

from collections import Counter, defaultdict
from collections.abc import Iterator
from math import radians
from typing import Literal, final

import numpy as np

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.articulation.motion_kind import motion_kind
from grafu.articulation.sweep import values_before
from grafu.asset.part import AnnotatedJoint, Asset, Part
from grafu.dataclass import dataclass
from grafu.geometry.arrays import median
from grafu.graph.annotated import carrying_part
from grafu.graph.edges import Hinge, MotionEdge, Rail, Slide, Turn, kind_of
from grafu.graph.functional_graph import FunctionalGraph, joined_groups
from grafu.graph.motion import axis_to_hinge, direction_to_code
from grafu.shapes import Float
from grafu.synth.pieces.riding import bodies_of, moving_with
from grafu.synth.specimen import DefectKind, Specimen
from grafu.synth.truth.clashes import articulated_of, clashes_of
from grafu.vocabulary import PartLabel

FaultKind = Literal[
    "collision",  # a moving part cuts into another along its path, those it waits for being open
    "label",  # a door or drawer without a joint, two joints of one part, a drawer that turns; a label not declared
    "attached part",  # a handle that rides on nothing that moves, or is out of touch with what it moves with
    "limit",  # an opening that no such furniture has, or that does not lead out
    "size",  # a door or drawer too small to be one
    "double",  # two parts with one box
    "mount",  # a moving part without exactly one edge of its kind, a drawer without one or two, another parent
    "motion",  # an edge whose codes do not say what the joint does
    "loose",  # a part that no edges join to the rest
    "parts",  # the truth, the asset and the whole disagree about their parts
]

# The least and most that a joint opens. Doors: from shoe-cabinet fronts that tilt by 20 degrees to doors that fold back
# flat on their neighbours. Drawers: from an apothecary's to as far as the piece is long.
DOOR_OPENING = (radians(15), radians(185))
LEAST_SLIDE = 0.03
THICKEST_LEAF = 0.08  # metres: a deeper front that slides is a drawer
LEAST_DOOR, LEAST_DRAWER = 0.08, 0.03  # metres across a door, and in height: a keyboard's tray is hardly higher
ATTACHED_REACH = 0.01  # metres that a handle or board may stand off what it moves with, as in `asset.attached`
MOUNT_REACH = 0.05  # metres between the boxes of a door and of what its hinge sits on: no hinge is longer
_BESIDE = 0.05  # metres from a drawer within which parts are its case, and the fraction of its height that they share
_OUT = 0.3  # fraction of its path that a drawer must come out of its case: those behind doors begin within it
_SAME = 1e-4  # metres within which two boxes are one

BoxRows = Float[np.ndarray, "n 2 3"]
_EXPLAINS: dict[FaultKind, frozenset[DefectKind]] = {
    "collision": frozenset({"interpenetrating", "ajar", "floating"}),
    "attached part": frozenset({"floating"}),
    "mount": frozenset({"floating"}),
    "label": frozenset({"mislabelled"}),
    "parts": frozenset({"missing"}),
}


@final
@dataclass(frozen=True, slots=True)
class Fault:
    """What is wrong, the parts that it concerns (the culprit first), and the figures in words."""

    kind: FaultKind
    parts: tuple[str, ...]
    detail: str = ""


def faults_of(
    whole: Asset, articulated: ArticulatedObject | None = None, truth: FunctionalGraph | None = None
) -> tuple[Fault, ...]:
    """Returns all that is wrong with a synthetic model; nothing, where it is sound.

    Args:
        whole: the model with true labels, joints (lower 0) and attached parts.
        articulated: what `articulated_of` gives for it (none: it is worked out).
        truth: its functional graph (none: the graph is not judged).
    """
    wrong = (*_label_faults(whole), *_attached_faults(whole))
    if wrong:  # nothing below has a meaning
        return wrong
    articulated = articulated or articulated_of(whole)
    found = [
        *_limit_faults(whole),
        *_size_faults(whole),
        *_double_faults(whole),
        *_collision_faults(whole, articulated),
    ]
    if truth is not None:
        found += _graph_faults(whole, truth)
    return tuple(found)


def faults_in(specimen: Specimen, articulated: ArticulatedObject | None = None) -> tuple[Fault, ...]:
    """Returns all that is wrong with a specimen beyond the defects that it declares.

    Loose parts are no fault of a specimen: boards that became sheets stand apart by their thickness. Nor are limits:
    what lies beside a drawer is unknown where all of a case is one part.
    """
    concerned: dict[DefectKind, set[str]] = defaultdict(set)
    for defect in specimen.defects:
        concerned[defect.kind] |= {*defect.parts}
        concerned[defect.kind] |= {other for part in defect.parts for other in moving_with(specimen.whole, part)}

    def is_meant(fault: Fault) -> bool:
        explained = set[str]().union(*(concerned[kind] for kind in _EXPLAINS.get(fault.kind, ())))
        culprit, *others = fault.parts
        return culprit in explained or (bool(others) and set(others) <= explained)

    found = (*faults_of(specimen.whole, articulated, specimen.truth), *_given_faults(specimen))
    return tuple(fault for fault in found if fault.kind not in ("loose", "limit") and not is_meant(fault))


def _label_faults(whole: Asset) -> Iterator[Fault]:
    joints = Counter(joint.part for joint in (*whole.joints, *whole.small_joints))
    for part in whole.parts:
        if joints[part.id] > 1 or (part.label.is_movable and not joints[part.id]):
            yield Fault("label", (part.id,), f"a {part.label} with {joints[part.id]} joints")
    for joint in whole.joints:
        part, slides = whole.part(joint.part), motion_kind(joint.type).slides
        label, no_leaf = part.label, part.box.size.min() > THICKEST_LEAF
        wrong = {PartLabel.DRAWER: not slides, PartLabel.DOOR: slides and no_leaf}
        if wrong.get(label, label in (PartLabel.HANDLE, PartLabel.UNKNOWN)):
            yield Fault("label", (joint.part,), f"a {label} with a {joint.type} joint")


def _attached_faults(whole: Asset) -> Iterator[Fault]:
    moving_bodies = {joint.part for joint in whole.joints}
    for part in whole.parts:
        if part.carried_by is None:
            if part.label is PartLabel.HANDLE:
                yield Fault("attached part", (part.id,), "a handle that rides on nothing")
        elif part.carried_by not in moving_bodies:
            yield Fault("attached part", (part.id,), f"it rides on {part.carried_by}")
        else:
            gap = _gap_to_link(part, whole)
            if gap > (MOUNT_REACH if part.id in moving_bodies else ATTACHED_REACH):
                yield Fault("attached part", (part.id,), f"{gap:.3f} m off {part.carried_by} and all that rides on it")


def _gap_to_link(part: Part, whole: Asset) -> float:
    """Returns the distance between the boxes of an attached part and the nearest part that moves with it."""
    others = (p for p in whole.parts if p is not part and part.carried_by in (p.id, p.carried_by))
    return min(part.box.gap(other.box) for other in others)


def _limit_faults(whole: Asset) -> Iterator[Fault]:
    moving_bodies = {joint.part for joint in whole.joints}
    bodies = bodies_of(whole)
    still = np.array([[p.box.low, p.box.high] for p in whole.parts if bodies[p.id] not in moving_bodies])
    still = still.reshape(-1, 2, 3)
    for joint in whole.joints:
        if joint.lower != 0.0:
            yield Fault("limit", (joint.part,), f"from {joint.lower:.3f}, not from 0")
        if motion_kind(joint.type).turns and not DOOR_OPENING[0] <= joint.upper <= DOOR_OPENING[1]:
            yield Fault("limit", (joint.part,), f"opens by {joint.upper:.3f} rad")
        if motion_kind(joint.type).slides:
            yield from _slide_faults(whole, joint, still)


def _slide_faults(whole: Asset, joint: AnnotatedJoint, still: BoxRows) -> Iterator[Fault]:
    room = float(np.abs(joint.axis.direction) @ whole.box.size)
    if not LEAST_SLIDE <= joint.upper <= room:
        yield Fault("limit", (joint.part,), f"slides by {joint.upper:.3f} m of {room:.3f} m")
        return
    if whole.part(joint.part).label is not PartLabel.DRAWER:  # what else slides need not come out of anything
        return
    box, shift = whole.part(joint.part).box, joint.axis.direction * joint.upper
    gaps = np.maximum(still[:, 0] - box.high, box.low - still[:, 1])
    beside = still[(gaps.max(axis=1) < _BESIDE) & (gaps[:, 2] < -_BESIDE * box.size[2])]  # not what lies above or below
    if not len(beside):
        return
    out = np.maximum(beside[:, 0].min(axis=0) - box.low - shift, box.high + shift - beside[:, 1].max(axis=0)).max()
    if out < _OUT * joint.upper:
        yield Fault("limit", (joint.part,), f"slides out of its case by {out:.3f} of {joint.upper:.3f} m")


def _size_faults(whole: Asset) -> Iterator[Fault]:
    for joint in whole.joints:
        part = whole.part(joint.part)
        across = median(part.box.size)  # of a board, the shorter of the two sides that are seen
        if part.label is PartLabel.DOOR and across < LEAST_DOOR:
            yield Fault("size", (joint.part,), f"a door {across:.3f} m across")
        if part.label is PartLabel.DRAWER and part.box.size[2] < LEAST_DRAWER:
            yield Fault("size", (joint.part,), f"a drawer {part.box.size[2]:.3f} m high")


def _double_faults(whole: Asset) -> Iterator[Fault]:
    seen: dict[bytes, str] = {}
    corners = np.array([[p.box.low, p.box.high] for p in whole.parts])
    for part, row in zip(whole.parts, np.round(corners / _SAME).astype(np.int64), strict=True):
        first = seen.setdefault(row.tobytes(), part.id)
        if first != part.id:
            yield Fault("double", (part.id, first))


def _collision_faults(whole: Asset, articulated: ArticulatedObject) -> Iterator[Fault]:
    clashes, part_of = clashes_of(whole), {joint.id: joint.child for joint in articulated.joints}
    for joint in articulated.moving_joints:
        values = values_before(articulated, joint.id)
        hit = sorted(clashes.hits(joint.child, {part_of[j] for j, value in values.items() if value > 0}))
        if hit:
            yield Fault("collision", (joint.child, *hit), f"opening by {joint.limits.upper:.3f}")


def _graph_faults(whole: Asset, truth: FunctionalGraph) -> Iterator[Fault]:
    ids, labels = [n.id for n in truth.nodes], [n.label for n in truth.nodes]
    if ids != [p.id for p in whole.parts] or labels != [p.label for p in whole.parts]:
        yield Fault("parts", tuple({*ids} ^ {p.id for p in whole.parts}) or ("",), "nodes and parts differ")
        return
    joints = {joint.part: joint for joint in (*whole.joints, *whole.small_joints)}
    for joint in joints.values():
        if whole.part(joint.part).label is PartLabel.HANDLE:
            continue  # its attachment is its edge
        edges = truth.motions_of(joint.part)
        yield from _motion_faults(joint, edges, truth)
        above = carrying_part(joint.part, joints, whole)
        if above and {edge.parent for edge in edges} != {above}:
            yield Fault("mount", (joint.part, above), f"it is carried by {[edge.parent for edge in edges]}")
    yield from _attachment_faults(whole, truth)
    loose = _unreached(truth)
    if loose:
        yield Fault("loose", loose, "no edges join them to the rest")


def _motion_faults(joint: AnnotatedJoint, edges: tuple[MotionEdge, ...], truth: FunctionalGraph) -> Iterator[Fault]:
    node, turns = truth.node(joint.part), motion_kind(joint.type).turns
    drawer = node.label is PartLabel.DRAWER
    kind: type[MotionEdge] = Rail if drawer else Slide
    if turns:
        kind = Hinge if node.label is PartLabel.DOOR else Turn
    if not 1 <= len(edges) <= (2 if drawer else 1) or any(not isinstance(edge, kind) for edge in edges):
        yield Fault("mount", (joint.part,), f"a {node.label} with {[kind_of(edge).value for edge in edges]}")
        return
    for edge in edges:
        if isinstance(edge, Hinge):
            right = (edge.border, edge.sign) == axis_to_hinge(node.box, joint.axis)
        else:
            right = edge.axis == direction_to_code(joint.axis.direction)
        if not right or edge.coupling != joint.coupling:
            yield Fault("motion", (joint.part,), f"{edge}")
        if isinstance(edge, Hinge) and truth.node(edge.parent).box.gap(node.box) > MOUNT_REACH:
            yield Fault("mount", (joint.part, edge.parent), "the mount is out of a hinge's reach")


def _attachment_faults(whole: Asset, truth: FunctionalGraph) -> Iterator[Fault]:
    parent_of = {edge.child: edge.parent for edge in truth.attachments}
    for part in whole.parts:
        if part.label is PartLabel.HANDLE and parent_of.get(part.id) != part.carried_by:
            yield Fault("mount", (part.id,), f"attached to {parent_of.get(part.id)}, rides on {part.carried_by}")


def _unreached(truth: FunctionalGraph) -> tuple[str, ...]:
    """Returns the nodes outside the largest group that edges join."""
    largest = max(joined_groups(truth.neighbours), key=len, default=frozenset[str]())
    return tuple(node.id for node in truth.nodes if node.id not in largest)


def _given_faults(specimen: Specimen) -> Iterator[Fault]:
    """Yields what the asset, as modelled, has other than missing parts and unknown labels."""
    whole = {part.id: part for part in specimen.whole.parts}
    for part in specimen.asset.parts:
        true = whole[part.id]
        if part.label not in (true.label, PartLabel.UNKNOWN):
            yield Fault("label", (part.id,), f"given as {part.label}, is {true.label}")
        if not np.allclose([part.box.low, part.box.high], [true.box.low, true.box.high], atol=_SAME):
            yield Fault("parts", (part.id,), "it stands elsewhere than in the whole")
    for part_id in specimen.missing:
        yield Fault("parts", (part_id,), "it is missing")
    mounts, moving = {edge.parent for edge in specimen.truth.motions}, specimen.truth.moving
    for part_id in sorted(specimen.removable):
        if whole[part_id].label.is_movable or part_id in mounts | moving:
            yield Fault("parts", (part_id,), "removable, though it moves or carries what moves")
