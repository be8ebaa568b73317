"""Free slots that fire become new parts: which label and box, and whether they are truly new. No edges yet.

Shelves that a regular row lacks become new parts, too.
"""

from typing import final

import numpy as np

from grafu.completion.answers import decision_of
from grafu.completion.decode_config import ADDABLE
from grafu.completion.features import object_frame
from grafu.completion.regular_shelves import missing_shelves
from grafu.completion.selection import parent_ratios
from grafu.completion.view import GraphView
from grafu.completion.votes import ranking_of
from grafu.dataclass import dataclass
from grafu.geometry.box import Box
from grafu.geometry.touching import near_pairs
from grafu.graph.arrays import LABEL_CODES
from grafu.graph.completion import BY_RULE, Decision
from grafu.graph.edges import Contact
from grafu.graph.edit import with_edges
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.parse import ParsingConfig
from grafu.vocabulary import PartLabel

_ADDABLE = [LABEL_CODES[label] for label in ADDABLE]


@final
@dataclass(frozen=True)
class NewPart:
    """A part that a free slot or a rule adds, why, and, of a handle, the door or drawer that it is for."""

    node: PartNode
    decisions: tuple[Decision, ...]
    parent: str | None = None


def new_parts(view: GraphView, held: frozenset[str]) -> tuple[NewPart, ...]:
    """Returns what the free slots add, the surest first; `held` are the doors and drawers that have a handle.

    A handle comes only to a door or drawer that has none, no part where one of its label is already, and only labels
    that may be added.
    """
    found: list[NewPart] = []
    seen = len(view.graph.nodes)
    fired = [
        k for k in range(seen, len(view.probabilities.exists)) if view.probabilities.exists[k] >= view.config.fires
    ]
    for slot in sorted(fired, key=lambda k: -float(view.probabilities.exists[k])):
        others = (*view.graph.nodes, *(part.node for part in found))
        part = _part_of(slot, view, others)
        if part is None or _is_there(part.node, others, view):
            continue
        if part.node.label is not PartLabel.HANDLE:
            found.append(part)
        elif part.parent is not None and part.parent not in held:
            held |= {part.parent}
            found.append(part)
    return tuple(found)


def weighed(view: GraphView) -> tuple[tuple[PartLabel, float], ...]:
    """Returns the labels of which free slots propose a part without adding one, each with its highest probability."""
    free = np.arange(len(view.graph.nodes), len(view.probabilities.exists))
    ratios, exists = view.probabilities.label[free][:, _ADDABLE], view.probabilities.exists[free]
    asked = (ratios.sum(axis=1) >= view.config.addable) & (exists < view.config.fires)
    of_label = [asked & (ratios.argmax(axis=1) == k) for k in range(len(ADDABLE))]
    return tuple((label, float(exists[k].max())) for label, k in zip(ADDABLE, of_label, strict=True) if k.any())


def regular_parts(view: GraphView) -> tuple[NewPart, ...]:
    """Returns the shelves that regular rows lack, where none is yet: a rule adds them, not a slot."""
    found: list[NewPart] = []
    for shelf in missing_shelves(view.graph, view.config.regular):
        others = (*view.graph.nodes, *(part.node for part in found))
        node = PartNode(_new_id(PartLabel.SHELF, others), PartLabel.SHELF, shelf.box)
        if not _is_there(node, others, view):
            answer = Decision(node.id, "exists", "yes", shelf.score, "no", 1.0 - shelf.score, BY_RULE)
            found.append(NewPart(node, (answer,)))
    return tuple(found)


def with_parts(graph: FunctionalGraph, parts: tuple[NewPart, ...]) -> FunctionalGraph:
    """Returns the graph with new parts, in contact with what their boxes touch."""
    nodes = (*graph.nodes, *(part.node for part in parts))
    larger = FunctionalGraph(graph.model_id, nodes, graph.edges)
    margin = ParsingConfig().box_tolerance * float(graph.box.size.max())
    pairs = near_pairs([node.box for node in nodes], margin)
    return with_edges(larger, [Contact(nodes[a].id, nodes[b].id) for a, b in pairs if b >= len(graph.nodes)])


def _part_of(slot: int, view: GraphView, others: tuple[PartNode, ...]) -> NewPart | None:
    """Returns the part of a slot; None if its label may not be added, or if it is a handle without a parent."""
    probabilities = view.probabilities
    ratios = probabilities.label[slot, _ADDABLE]
    if ratios.sum() < view.config.addable:
        return None
    ranking = ranking_of([label.value for label in ADDABLE], ratios)
    label = PartLabel(ranking.choice)
    origin, scale = object_frame(view.graph)
    half = np.maximum(probabilities.half[slot], view.config.least_half)
    box = Box.from_center(probabilities.centre[slot] * scale + origin, half * scale)
    name = _new_id(label, others)
    exists = float(probabilities.exists[slot])
    decisions = (
        Decision(name, "exists", "yes", exists, "no", max(1.0 - exists, 0.0)),
        decision_of(name, "label", ranking),
    )
    node = PartNode(name, label, box)
    if label is not PartLabel.HANDLE:
        return NewPart(node, decisions)
    parent = _parent_of(slot, node, view)
    return None if parent is None else NewPart(node, decisions, parent)


def _parent_of(slot: int, handle: PartNode, view: GraphView) -> str | None:
    near = view.moving_bodies[view.gaps(handle, view.moving_bodies) <= view.config.reach * view.extent]
    if not len(near):
        return None
    ratios, _ = parent_ratios(slot, near, view)
    return ranking_of(view.ids(near), ratios).choice


def _new_id(label: PartLabel, others: tuple[PartNode, ...]) -> str:
    taken = {node.id for node in others}
    stem = f"{label.value.replace(' ', '_')}_added_"
    return next(name for name in (f"{stem}{k}" for k in range(1, len(taken) + 2)) if name not in taken)


def _is_there(node: PartNode, others: tuple[PartNode, ...], view: GraphView) -> bool:
    """Whether a part of this label stands in the same place already."""
    slack = view.config.slack * view.extent
    alike = (other.box for other in others if other.label is node.label)
    return any(node.box.intersection_over_union(box, slack) > view.config.overlap for box in alike)
