"""Judges weights on made furniture that no training saw: what the whole completion gets right, decode included.

    python scripts/judge_network.py [--rule] [--weights FILE] [--count 200] [--jobs 2] [--seed 990002]

Each model is asked about as it was found, with its labels hidden, and lacking parts (`grafu.data.asked`). Prints one in
Markdown beside the paper's column, with the half widths of 95 % intervals from resampled models. With --rule the
carpenters' rules are judged instead.
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

from grafu.completion.features import FeatureConfig
from grafu.completion.network import complete_by_network
from grafu.completion.rule import complete_by_rule
from grafu.completion.session import SHIPPED_WEIGHTS, NetworkSession, open_network
from grafu.data.asked import VARIANTS, asked_pairs
from grafu.data.pair import specimen_pair
from grafu.graph.completion import GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph
from grafu.metrics.graph_accuracy import GraphAccuracy, graph_accuracy, total_accuracy
from grafu.synth.generate import make_specimen

TEST_SEED = 990_002  # as in grafu.training.source: kept for reporting
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
Accuracies = Mapping[str, GraphAccuracy]


def main() -> int:
    """Judges, and prints the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--weights", type=Path, default=SHIPPED_WEIGHTS)
    parser.add_argument("--rule", action="store_true", help="judge the carpenters' rules instead")
    parser.add_argument("--count", type=int, default=200, help="models (default: 200)")
    parser.add_argument("--seed", type=int, default=TEST_SEED)
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    began = time.perf_counter()
    with ProcessPoolExecutor(options.jobs) as pool:
        found: list[Accuracies] = []
        weights = None if options.rule else options.weights
        for one in pool.map(partial(judge, weights, options.seed), range(options.count), chunksize=4):
            found.append(one)
            print(f"  {len(found)}/{options.count}, {time.perf_counter() - began:.0f} s", file=sys.stderr, end="\r")
    print(file=sys.stderr)
    print(table(found))
    return 0


def judge(weights: Path | None, seed: int, number: int) -> Accuracies:
    """Returns the figures of one model by variant; without weights, those of the rules."""
    complete = complete_by_rule if weights is None else partial(complete_by_weights, open_network(weights))
    natural = specimen_pair(make_specimen(seed, number, FeatureConfig().points))
    pairs = asked_pairs(natural, number)
    return {name: graph_accuracy(complete(pair.input), pair.target) for name, pair in pairs.items()}


def complete_by_weights(network: NetworkSession, graph: FunctionalGraph) -> GraphCompletion:
    """Returns a graph as a network completes it."""
    return complete_by_network(graph, network, network.features)


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
