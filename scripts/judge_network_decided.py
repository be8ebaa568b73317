"""Judges the edges and hinges of completed graphs where the input decides them. `judge_network.py` prints it.

A part that the input lacks decides nothing, and a door whose handle is missing or in the middle may hang on either
side: edges of such parts and doors are left out, of what is true and of what was found.

Where a front meets several pieces of the carcass at one place, such as a side panel and the edge strip on it, the
generator names one of them as its carrier, and nothing in the input tells which. So each figure is printed twice: with
the carrier that the generator named, and with any that stands, meets that one, and runs beside the front as that one
does: along most of the hinge's border, or of the drawer where it slides. Boxes of parts are compared.
"""

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import Final

from grafu.data.pair import GraphPair
from grafu.geometry.box import Box
from grafu.graph.edges import Attached, Hinge, Rail
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.motion import border_to_face
from grafu.graph.piece_facts import STATIC

KINDS = ("hinge", "rail", "attached")
NEAR: Final = 0.03  # metres: pieces of a carcass so near to each other, and to a front, meet there
MOST: Final = 0.5  # of a border, or of the length of a drawer
Decided = Counter[tuple[str, str]]
"""By kind of edge, how many are right, `alike`, found and true; of `joint`, how many doors are right, and are there.

An edge is alike where it is right or its carrier meets the true one (see above).
"""
Ends = tuple[str, str]


def judge_decided(found: FunctionalGraph, pair: GraphPair, undecided: frozenset[str]) -> Decided:
    """Returns how many edges between parts of the input are right; `undecided` doors are left out."""
    counts: Decided = Counter()
    for kind in KINDS:
        mine, true = (_pairs(_edges(graph, kind), pair, undecided) for graph in (found, pair.target))
        alike = len(mine & true) + len(_alike(mine - true, true - mine, pair))
        counts += Counter({(kind, "right"): len(mine & true), (kind, "found"): len(mine), (kind, "true"): len(true)})
        counts[kind, "alike"] += alike
    motions = {hinge.child: (hinge.border, hinge.sign) for hinge in found.hinges}
    doors = [hinge for hinge in pair.target.hinges if hinge.child in pair.input and hinge.child not in undecided]
    counts["joint", "right"] += sum(motions.get(door.child) == (door.border, door.sign) for door in doors)
    counts["joint", "true"] += len(doors)
    return counts


def _edges(graph: FunctionalGraph, kind: str) -> Iterable[Hinge | Rail | Attached]:
    return {"hinge": graph.hinges, "rail": graph.rails, "attached": graph.attachments}[kind]


def _pairs(edges: Iterable[Hinge | Rail | Attached], pair: GraphPair, undecided: frozenset[str]) -> set[Ends]:
    ends = {(edge.child, edge.parent) for edge in edges}
    return {(a, b) for a, b in ends if a in pair.input and b in pair.input and a not in undecided}


def _alike(found: set[Ends], true: set[Ends], pair: GraphPair) -> dict[Ends, Ends]:
    """Returns for edges that were found the true ones which they stand for, each once."""
    stands: dict[Ends, Ends] = {}
    for child, carrier in sorted(found):
        box = pair.input.node(carrier).box
        if not _stands(carrier, pair) or not _runs_beside(box, child, pair):
            continue
        left = sorted(edge for edge in true - set(stands.values()) if edge[0] == child and _stands(edge[1], pair))
        met = next((edge for edge in left if box.gap(pair.input.node(edge[1]).box) <= NEAR), None)
        if met is not None:
            stands[child, carrier] = met
    return stands


def _runs_beside(carrier: Box, child: str, pair: GraphPair) -> bool:
    """Whether a carrier is near a door's true hinge along most of it, or near a drawer along most of its depth."""
    box = pair.input.node(child).box
    hinge = next((hinge for hinge in pair.target.hinges if hinge.child == child), None)
    low, high = box.low.copy(), box.high.copy()
    if hinge is None:
        along = next((rail.axis // 2 for rail in pair.target.rails if rail.child == child), box.thin_axis)
    else:
        face = border_to_face(box.thin_axis, hinge.border)
        (low if face % 2 else high)[face // 2] = (high if face % 2 else low)[face // 2]
        along = 3 - box.thin_axis - face // 2
    side = Box(low, high)
    shared = float(min(side.high[along], carrier.high[along]) - max(side.low[along], carrier.low[along]))
    return carrier.gap(side) <= NEAR and shared >= MOST * float(box.size[along])


def _stands(part: str, pair: GraphPair) -> bool:
    return pair.facts.bodies.get(part) == STATIC


def decided_table(counts: Sequence[Decided]) -> str:
    """Returns F1 of each kind of edge and the fraction of doors that turn as they should, with how many there are."""
    total: Decided = sum(counts, Counter())
    lines = [
        "| where the input decides | there are | figure | with carriers that meet the true one |",
        "|---|---|---|---|",
    ]
    for kind in KINDS:
        both = total[kind, "found"] + total[kind, "true"]
        right, alike = (f"{2 * total[kind, what] / both if both else 0:.3f}" for what in ("right", "alike"))
        lines.append(f"| {kind} | {total[kind, 'true']} | {right} | {alike} |")
    doors = total["joint", "true"]
    lines.append(f"| joint | {doors} | {total['joint', 'right'] / doors if doors else 0:.3f} | |")
    return "\n".join(lines)
