"""Judges what a completion adds to graphs that lack parts, by what the input shows. `judge_network.py` prints it.

A handle is as good as sure where another front shows one; where none does, the piece may well have been made without
handles, and the input does not show which it is.
"""

from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.linalg import norm
from scipy.optimize import linear_sum_assignment

from grafu.data.pair import GraphPair
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.metrics.graph_accuracy import NEAR
from grafu.vocabulary import PartLabel

LABELS = (PartLabel.TOP_PANEL, PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL, PartLabel.SHELF, PartLabel.DIVIDER)
HANDLES = ("handle, another front shows one", "handle, no front shows one", "handle of a front that is missing, too")
KINDS = (*(label.value for label in LABELS), *HANDLES)
ASKED = ("natural", "lacking")
Added = Counter[tuple[str, str]]
"""By kind, how many are missing, were added, and are right."""


def judge_added(found: FunctionalGraph, pair: GraphPair) -> Added:
    """Returns for each kind how many parts are missing, how many were added, and how many of these are right.

    A part is right where its category is that of a missing one whose middle is near (`NEAR`), one to one.
    """
    extent = float(pair.target.box.size.max())
    counts: Added = Counter()
    for kind in KINDS:
        missing, added = (_of_kind(kind, graph, pair) for graph in (pair.target, found))
        counts[kind, "missing"] += len(missing)
        counts[kind, "added"] += len(added)
        counts[kind, "right"] += _pairs(missing, added, NEAR * extent)
    return counts


def _of_kind(kind: str, graph: FunctionalGraph, pair: GraphPair) -> list[PartNode]:
    """Returns the parts of a kind that a graph has and the input has not."""
    new = [node for node in graph.nodes if node.id not in pair.input]
    if kind not in HANDLES:
        return [node for node in new if node.label.value == kind]
    fronts = {edge.child: edge.parent for edge in graph.attachments}
    is_shown = any(edge.child in pair.input for edge in pair.target.attachments)
    handles = [node for node in new if node.label is PartLabel.HANDLE]
    return [node for node in handles if _kind_of_handle(fronts.get(node.id, ""), is_shown, pair) == kind]


def _kind_of_handle(front: str, is_shown: bool, pair: GraphPair) -> str:
    if front not in pair.input:
        return HANDLES[2]
    return HANDLES[0] if is_shown else HANDLES[1]


def _pairs(missing: Sequence[PartNode], added: Sequence[PartNode], near: float) -> int:
    """Returns how many added parts are near missing ones, one to one; near is in metres."""
    if not missing or not added:
        return 0
    apart = np.array([[norm(a.box.center - m.box.center) for m in missing] for a in added])
    rows, columns = linear_sum_assignment(apart > near)
    return int((apart[rows, columns] <= near).sum())


def added_table(found: Sequence[dict[str, Added]]) -> str:
    """Returns for each kind, of all models, how many are missing and how many are added, and the F1."""
    head = ["added", *(f"{name}, {what}" for name in ASKED for what in ("missing", "added", "F1"))]
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    totals = {name: sum((one[name] for one in found), Counter()) for name in ASKED}
    for kind in KINDS:
        cells = []
        for total in totals.values():
            missing, added, right = (total[kind, what] for what in ("missing", "added", "right"))
            cells += [str(missing), str(added), f"{2 * right / (missing + added):.3f}" if missing + added else "-"]
        lines.append(f"| {kind} | {' | '.join(cells)} |")
    return "\n".join(lines)
