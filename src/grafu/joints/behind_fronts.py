"""What stands behind a front, told by boxes and contacts: the groups of parts within its outline, and what holds them.

Racks, pull-out units and the bins of tilting fronts are found in this way; those of fronts turned about Z are not.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence

import numpy as np

from grafu.asset.labels import sense_of
from grafu.asset.part import Asset, Part
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.touching import near_pairs, touching_pairs
from grafu.graph.edges import Slide
from grafu.graph.functional_graph import FunctionalGraph, joined_groups
from grafu.joints.plan import JointRequest
from grafu.vocabulary import PartLabel

_DEPTH = 1
_ACROSS = [0, 2]
_AS_DEEP = 0.9  # of the deepest part's depth: the wires along a rack, not those across it


def is_within_outline(box: Box, front: Box, clear: float) -> bool:
    """Whether a box lies within the outline of a front that faces -Y, by `clear` metres, and ends behind it."""
    low, high = front.low + clear, front.high - clear
    inside = np.all(box.low[_ACROSS] >= low[_ACROSS]) and np.all(box.high[_ACROSS] <= high[_ACROSS])
    return bool(inside and box.high[_DEPTH] > front.high[_DEPTH])


def groups_within(inside: Collection[str], graph: FunctionalGraph) -> Iterator[tuple[str, ...]]:
    """Yields the ids of parts in groups that hang together by contact."""
    touching = {name: [other for other in graph.neighbours[name] if other in inside] for name in inside}
    yield from (tuple(sorted(group)) for group in joined_groups(touching))


def touched_by(group: Collection[str], asset: Asset, graph: FunctionalGraph, own: Collection[str]) -> set[str]:
    """Returns the parts that a group of them touches, other than itself and what is the front's `own`.

    Nodes of the graph that are only predicted hold nothing.
    """
    parts = {part.id for part in asset.parts}
    return {name for member in group for name in graph.neighbours[member] if name in parts} - {*group, *own}


def groups_held_by(
    own: Collection[str], inside: Collection[str], asset: Asset, tolerance: float, soft: Collection[str] = ()
) -> Iterator[tuple[str, ...]]:
    """Yields the ids of parts in groups that hang together, and touch one of `own`, and nothing that holds them.

    Handles hold nothing, nor do runners, hinges and the like that `own` does not touch; their names tell them.

    Args:
        own: what moves as one.
        inside: the parts that may hang on it; others hold what they touch.
        asset: all parts.
        tolerance: as near as this, meshes touch (metres).
        soft: parts that hold nothing either, such as gaskets.
    """
    hard = (part for part in asset.parts if part.id not in soft or part.id in own)
    parts = [part for part in hard if part.label is not PartLabel.HANDLE or part.id in own]
    near = [(a, b) for a, b in near_pairs([p.box for p in parts], tolerance) if {parts[a].id, parts[b].id} & {*inside}]
    touching: dict[str, set[str]] = {part.id: set() for part in parts}
    for a, b in touching_pairs([part.mesh for part in parts], near, tolerance):
        touching[parts[a].id].add(parts[b].id)
        touching[parts[b].id].add(parts[a].id)
    runners = {p.id for p in parts if sense_of(p.source.name).is_fitting and not touching[p.id] & {*own}} - {*own}
    hanging = {name for name in inside if name in touching} - runners
    for group in joined_groups({name: touching[name] & hanging for name in hanging}):
        touched = {other for name in group for other in touching[name]} - group - runners
        if touched and touched <= {*own}:
            yield tuple(sorted(group))


def sliding_out(parts: Sequence[Part], source: str) -> JointRequest:
    """Returns the joint of parts that slide out towards -Y as one: that of the largest, with the others on it.

    It is one of those that reach as far back as any: a joint slides as far as its part is deep.
    """
    depth = _AS_DEEP * max(float(part.box.size[_DEPTH]) for part in parts)
    deep = [part for part in parts if part.box.size[_DEPTH] >= depth]
    largest = max(deep, key=lambda part: float(np.prod(np.sort(part.box.size)[1:])))
    others = tuple(part.id for part in parts if part is not largest)
    axis = Axis(Box.enclosing(part.box for part in parts).center, vec3(0.0, -1.0, 0.0))
    return JointRequest(largest.id, Slide.joint_type, axis, source, attached=others)


def static_boxes(asset: Asset, moving: Collection[str]) -> Mapping[str, Box]:
    """Returns the boxes of the parts that neither move nor are called doors or drawers, by id."""
    return {part.id: part.box for part in asset.parts if part.id not in moving and not part.label.is_movable}
