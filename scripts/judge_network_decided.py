"""Judges the edges and hinges of completed graphs where the input decides them. `judge_network.py` prints it.

A part that the input lacks decides nothing, and a door whose handle is missing or in the middle may hang on either
side: edges of such parts and doors are left out, of what is true and of what was found.
"""

from collections import Counter
from collections.abc import Iterable, Sequence

from grafu.data.pair import GraphPair
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph

KINDS = ("hinge", "rail", "attached")
Decided = Counter[tuple[str, str]]
"""By kind of edge, how many are right, found and true; of `joint`, how many doors are right, and how many there are."""


def judge_decided(found: FunctionalGraph, pair: GraphPair, undecided: frozenset[str]) -> Decided:
    """Returns how many edges between parts of the input are right; `undecided` doors are left out."""
    counts: Decided = Counter()
    for kind in KINDS:
        mine, true = (_pairs(_edges(graph, kind), pair, undecided) for graph in (found, pair.target))
        counts += Counter({(kind, "right"): len(mine & true), (kind, "found"): len(mine), (kind, "true"): len(true)})
    motions = {hinge.child: (hinge.border, hinge.sign) for hinge in found.hinges}
    doors = [hinge for hinge in pair.target.hinges if hinge.child in pair.input and hinge.child not in undecided]
    counts["joint", "right"] += sum(motions.get(door.child) == (door.border, door.sign) for door in doors)
    counts["joint", "true"] += len(doors)
    return counts


def _edges(graph: FunctionalGraph, kind: str) -> Iterable[Hinge | Rail | Attached]:
    return {"hinge": graph.hinges, "rail": graph.rails, "attached": graph.attachments}[kind]


def _pairs(
    edges: Iterable[Hinge | Rail | Attached], pair: GraphPair, undecided: frozenset[str]
) -> set[tuple[str, str]]:
    ends = {(edge.child, edge.parent) for edge in edges}
    return {(a, b) for a, b in ends if a in pair.input and b in pair.input and a not in undecided}


def decided_table(counts: Sequence[Decided]) -> str:
    """Returns F1 of each kind of edge and the fraction of doors that turn as they should, with how many there are."""
    total: Decided = sum(counts, Counter())
    lines = ["| where the input decides | there are | figure |", "|---|---|---|"]
    for kind in KINDS:
        both = total[kind, "found"] + total[kind, "true"]
        lines.append(f"| {kind} | {total[kind, 'true']} | {2 * total[kind, 'right'] / both if both else 0:.3f} |")
    doors = total["joint", "true"]
    lines.append(f"| joint | {doors} | {total['joint', 'right'] / doors if doors else 0:.3f} |")
    return "\n".join(lines)
