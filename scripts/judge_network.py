"""Judges weights on synthetic furniture that no training saw: what the whole completion gets right, decode included.

    python scripts/judge_network.py [--rule] [--weights FILE] [--count 200] [--jobs 2] [--seed 990002]

Each model is asked about as it was found, with its labels hidden, and lacking parts (`grafu.data.corruption.corrupt`).
Prints a table in Markdown, the paper's column beside ours, with the half widths of 95 % intervals from resampled
models; then, of the doors as they were found, how many turn as they should, by what their handles say of the hinge's
side; then, how often it states what the whole piece is, what is drawn ajar and what moves as one with a door or drawer,
and how often that is right; last, edges and hinges where the input decides them (`judge_network_decided.py`). With
--rule the rule-based baseline is judged instead, which states nothing of the whole piece.
"""

import argparse
import sys
import time
from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import fields
from functools import partial
from pathlib import Path

import numpy as np
from judge_network_added import ASKED as ASKED_TO_ADD
from judge_network_added import Added, added_table, judge_added
from judge_network_decided import Decided, decided_table, judge_decided

from grafu.completion.features import FeatureConfig
from grafu.completion.network import complete_by_network
from grafu.completion.rule import complete_by_rule
from grafu.completion.session import SHIPPED_WEIGHTS, NetworkSession, open_network
from grafu.data.corruption.corrupt import VARIANTS, asked_pairs
from grafu.data.pair import GraphPair, specimen_pair
from grafu.evaluation.dataset import TEST_SEED
from grafu.graph.completion import GraphCompletion
from grafu.graph.edges import Hinge
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.piece_facts import STATIC
from grafu.metrics.graph_accuracy import GraphAccuracy, graph_accuracy, total_accuracy
from grafu.synth.generate import make_specimen

# Supplement, Loss Ablation: the full loss.
PAPER = {
    "existence": 0.972,
    "category": 0.957,
    "edges": 0.770,
    "contact": 0.884,
    "hinge": 0.656,
    "rail": 0.447,
    "attached": 0.855,
    "border": 0.922,
    "sign": 0.975,
    "joint": 0.899,
    "slide": 0.997,
}
OFF_MIDDLE = 0.1  # of a door's width: a handle nearer its middle states nothing about the hinge's side
DOOR_KINDS = ("a handle off the middle", "a handle in the middle", "its handle missing", "no handle")
Accuracies = Mapping[str, GraphAccuracy]
Doors = Mapping[str, tuple[int, int]]
FACTS = {"kind": "the kind of the piece", "ajar": "parts drawn ajar", "rides": "parts that move with a door or drawer"}
ASKED = ("natural", "masked")
Facts = Mapping[tuple[str, str], tuple[int, int, int]]


def main() -> int:
    """Judges, and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--weights", type=Path, default=SHIPPED_WEIGHTS)
    parser.add_argument("--rule", action="store_true", help="judge the rule-based baseline instead")
    parser.add_argument("--count", type=int, default=200, help="models (default: 200)")
    parser.add_argument("--seed", type=int, default=TEST_SEED)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    began = time.perf_counter()
    with ProcessPoolExecutor(options.jobs) as pool:
        found: list[Accuracies] = []
        doors: list[Doors] = []
        facts: list[Facts] = []
        added: list[dict[str, Added]] = []
        decided: list[Decided] = []
        weights = None if options.rule else options.weights
        for one in pool.map(partial(judge, weights, options.seed), range(options.count), chunksize=4):
            found.append(one[0])
            doors.append(one[1])
            facts.append(one[2])
            added.append(one[3])
            decided.append(one[4])
            print(f"  {len(found)}/{options.count}, {time.perf_counter() - began:.0f} s", file=sys.stderr, end="\r")
    print(file=sys.stderr)
    of_network = [] if options.rule else [fact_table(facts), added_table(added)]
    print(table(found), door_table(doors), *of_network, decided_table(decided), sep="\n\n")
    return 0


def judge(weights: Path | None, seed: int, number: int) -> tuple[Accuracies, Doors, Facts, dict[str, Added], Decided]:
    """Returns the figures of one model: by variant, its doors, facts, added parts, and where the input decides.

    Without weights it is judged by the rules.
    """
    complete = complete_by_rule if weights is None else partial(complete_by_weights, open_network(weights))
    natural = specimen_pair(make_specimen(seed, number, FeatureConfig().points))
    pairs = asked_pairs(natural, number)
    completed = {name: complete(pair.input) for name, pair in pairs.items()}
    accuracies = {name: graph_accuracy(completed[name], pair.target) for name, pair in pairs.items()}
    facts = {(name, what): n for name in ASKED for what, n in judge_facts(completed[name], pairs[name]).items()}
    added = {name: judge_added(completed[name].completed, pairs[name]) for name in ASKED_TO_ADD}
    graph = completed["natural"].completed
    undecided = frozenset(h.child for h in natural.target.hinges if is_undecided(h, natural))
    return accuracies, judge_doors(graph, natural), facts, added, judge_decided(graph, natural, undecided)


def judge_facts(found: GraphCompletion, pair: GraphPair) -> dict[str, tuple[int, int, int]]:
    """Returns of each kind of fact how many that are stated are right, are stated, and are true."""
    facts, attached = pair.facts, {edge.child for edge in pair.target.attachments}
    stated = {
        "kind": set() if found.piece is None else {str(found.piece.kind)},
        "ajar": {decision.part for decision in found.decisions if decision.question == "ajar"},
        "rides": set(found.rides),
    }
    bodies = facts.bodies.items()
    true = {
        "kind": set() if facts.kind is None else {str(facts.kind)},
        "ajar": {name for name in facts.ajar or () if name in pair.input},
        "rides": {(body, name) for name, body in bodies if body not in (STATIC, name) and name not in attached},
    }
    return {what: (len(stated[what] & true[what]), len(stated[what]), len(true[what])) for what in FACTS}


def fact_table(facts: Sequence[Facts]) -> str:
    """Returns of each kind of fact how many are found, and how many of those that are stated are right."""
    head = ["of the whole piece", "there are", *(f"{what}, {name}" for name in ASKED for what in ("found", "right"))]
    lines = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    for what, words in FACTS.items():
        counts = {name: np.sum([one[name, what] for one in facts], axis=0).tolist() for name in ASKED}
        cells = [f"{right / n:.3f}" if n else "-" for right, *of in counts.values() for n in reversed(of)]
        lines.append(f"| {words} | {counts[ASKED[0]][2]} | {' | '.join(cells)} |")
    return "\n".join(lines)


def judge_doors(found: FunctionalGraph, pair: GraphPair) -> Doors:
    """Returns for each kind of door how many turn as they should, and how many there are."""
    motions = {hinge.child: (hinge.border, hinge.sign) for hinge in found.hinges}
    counts = dict.fromkeys(DOOR_KINDS, (0, 0))
    for hinge in pair.target.hinges:
        if hinge.child in pair.input:
            kind = door_kind(hinge, pair)
            right, all_of_kind = counts[kind]
            counts[kind] = (right + (motions.get(hinge.child) == (hinge.border, hinge.sign)), all_of_kind + 1)
    return counts


def is_undecided(hinge: Hinge, pair: GraphPair) -> bool:
    """Whether nothing that the input shows of a door tells the side on which it hangs."""
    return hinge.child in pair.input and door_kind(hinge, pair) != DOOR_KINDS[0]


def door_kind(hinge: Hinge, pair: GraphPair) -> str:
    """Returns what the input shows of the side on which a door hangs."""
    handles = [edge.child for edge in pair.target.attachments if edge.parent == hinge.child]
    shown = [pair.input.node(name).box for name in handles if name in pair.input]
    if not shown:
        return DOOR_KINDS[2] if handles else DOOR_KINDS[3]
    box = pair.input.node(hinge.child).box
    across = [axis for axis in range(3) if axis != box.thin_axis][hinge.border // 2]
    off = max(abs(float(handle.center[across] - box.center[across])) for handle in shown)
    return DOOR_KINDS[0] if off > OFF_MIDDLE * float(box.size[across]) else DOOR_KINDS[1]


def door_table(doors: Sequence[Doors]) -> str:
    """Returns how many doors of each kind turn as they should."""
    lines = ["| the input shows of a door | doors | turn as they should |", "|---|---|---|"]
    for kind in DOOR_KINDS:
        right, count = (sum(one[kind][k] for one in doors) for k in (0, 1))
        lines.append(f"| {kind} | {count} | {right / count:.3f} |" if count else f"| {kind} | 0 | - |")
    return "\n".join(lines)


def complete_by_weights(network: NetworkSession, graph: FunctionalGraph) -> GraphCompletion:
    """Returns a graph as a network completes it."""
    named = {node.id for node in graph.nodes if node.source_name}
    return complete_by_network(graph, network, network.features, named=named)


def table(found: Sequence[Accuracies]) -> str:
    """Returns the figures of all models as a table."""
    lines = [f"{len(found)} models, each asked about in {len(VARIANTS)} ways.", ""]
    lines += [f"| figure | {' | '.join(VARIANTS)} | paper |", "|---|" + "---|" * (len(VARIANTS) + 1)]
    for name in (field.name for field in fields(GraphAccuracy)):
        cells = [cell([one[variant] for one in found], name) for variant in VARIANTS]
        lines.append(f"| {name} | {' | '.join(cells)} | {PAPER.get(name, '')} |")
    return "\n".join(lines)


def cell(accuracies: Sequence[GraphAccuracy], name: str) -> str:
    """Returns one figure with the half width of its interval."""
    value = getattr(total_accuracy(accuracies), name).value
    pairs = np.array([(getattr(a, name).part, getattr(a, name).whole) for a in accuracies])
    rng = np.random.default_rng(0)
    drawn = pairs[rng.integers(len(pairs), size=(1000, len(pairs)))].sum(axis=1)
    resampled = drawn[drawn[:, 1] > 0]
    if not len(resampled):
        return "-"
    low, high = np.percentile(resampled[:, 0] / resampled[:, 1], [2.5, 97.5])
    return f"{value:.3f} ± {(high - low) / 2:.3f}"


if __name__ == "__main__":
    sys.exit(main())
