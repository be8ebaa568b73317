"""Tells synthetic furniture from real: how well a classifier does it, and by what (a two-sample test).

    python scripts/two_sample.py MODELS... [--weights FILE] [--count 240] [--seed 990002]

MODELS are folders of real models, as `grafu evaluate --data` takes them. Each model, labels hidden, is what the
network's encoder makes of it (mean and maximum over its parts); a logistic regression on the first principal components
tells synthetic ones from real ones, in five parts that it was not fitted on. AUC 0.5: they look alike to the network;
1: they are always told apart. The same is done by simple measures of graphs, of which those that tell most are printed.
Needs torch.
"""

import argparse
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np
import torch  # noqa: TID251  # what the network sees lies in its encoder, which no exported file states
from jaxtyping import Bool, Float

from grafu.completion.features import GraphFeatures, graph_features
from grafu.completion.session import SHIPPED_WEIGHTS, open_network
from grafu.errors import FunctionalizationError
from grafu.evaluation.dataset import find_models, load_model
from grafu.graph.edit import relabelled
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.parse import ParsingConfig, parse_graph
from grafu.network.batch import one_graph
from grafu.network.grafu import GraFu
from grafu.network.stored import start_from, stored_config, stored_weights
from grafu.synth.generate import make_specimen
from grafu.training.source import TEST_SEED
from grafu.vocabulary import PartLabel

FOLDS = 5
COMPONENTS = 24  # principal components: more than a fifth of the real models would be learnt by heart
RIDGE = 1.0
STEPS = 30  # of Newton's method
TOLD = 10  # measures that are printed
Table = Float[np.ndarray, "models numbers"]


def main() -> int:
    """Compares, and prints the figures."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models", type=Path, nargs="+", help="folders of real models")
    parser.add_argument(
        "--weights", type=Path, default=SHIPPED_WEIGHTS, help="whose features (default: those that ship)"
    )
    parser.add_argument("--count", type=int, default=240, help="synthetic models (default: 240)")
    parser.add_argument("--seed", type=int, default=TEST_SEED)
    options = parser.parse_args()
    session = open_network(options.weights)
    file = options.weights.read_bytes()
    network = GraFu(stored_config(file)).eval()
    start_from(network, stored_weights(file))
    real = [graph for folder in options.models for graph in real_graphs(folder, session.features.points)]
    made = [hidden(make_specimen(options.seed, k, session.features.points).given) for k in range(options.count)]
    is_real = np.arange(len(real) + len(made)) < len(real)
    seen = [encoded(graph_features(graph, session.features), network) for graph in (*real, *made)]
    print(f"{len(real)} real models, {len(made)} synthetic with seed {options.seed}")
    print(f"by the network's features: AUC {cross_validated(np.array(seen), is_real):.3f}")
    plain = np.array([[measure(graph) for measure in MEASURES.values()] for graph in (*real, *made)])
    print(f"by {len(MEASURES)} simple measures: AUC {cross_validated(plain, is_real):.3f}; the most telling:")
    ratios = {name: auc(plain[:, k], is_real) for k, name in enumerate(MEASURES)}
    for name in sorted(ratios, key=lambda name: -abs(ratios[name] - 0.5))[:TOLD]:
        column = plain[:, list(MEASURES).index(name)]
        means = f"real {np.median(column[is_real]):.3g}, made {np.median(column[~is_real]):.3g} (medians)"
        print(f"  {name:28} {ratios[name]:.3f}  {means}")
    return 0


def real_graphs(folder: Path, points: int) -> list[FunctionalGraph]:
    """Returns the graphs of all models of a folder that can be read, labels hidden."""
    found = []
    for ref in find_models(folder):
        try:
            found.append(hidden(parse_graph(load_model(ref), ParsingConfig(points=points))))
        except FunctionalizationError as error:
            print(f"left out: {error}", file=sys.stderr)
    return found


def hidden(graph: FunctionalGraph) -> FunctionalGraph:
    """Returns the graph without labels."""
    return relabelled(graph, {node.id: PartLabel.UNKNOWN for node in graph.nodes})


@torch.inference_mode()
def encoded(features: GraphFeatures, network: GraFu) -> Float[np.ndarray, " numbers"]:
    """Returns the mean and the maximum of the encoded nodes."""
    names = ("labels", "boxes", "anchors", "groups", "edges", "visibility", "names")
    arrays = {name: torch.from_numpy(np.array(getattr(features, name))) for name in names}
    nodes = network.encoder(one_graph(**arrays))[0][0].double().numpy()
    return np.concatenate([nodes.mean(axis=0), nodes.max(axis=0)])


def cross_validated(table: Table, is_real: Bool[np.ndarray, " models"]) -> float:
    """Returns the AUC of a logistic regression over models that it was not fitted on."""
    order = np.random.default_rng(0).permutation(len(table))
    scores = np.empty(len(table))
    for fold in range(FOLDS):
        kept, left = order[np.arange(len(order)) % FOLDS != fold], order[fold::FOLDS]
        mean, spread = table[kept].mean(axis=0), table[kept].std(axis=0) + 1e-9
        whole = (table - mean) / spread
        axes = np.linalg.svd(whole[kept], full_matrices=False)[2][:COMPONENTS]
        components = np.column_stack([whole @ axes.T, np.ones(len(whole))])
        components[:, :-1] /= components[kept, :-1].std(axis=0) + 1e-9
        scores[left] = components[left] @ regression(components[kept], is_real[kept])
    return auc(scores, is_real)


def regression(table: Table, is_real: Bool[np.ndarray, " models"]) -> Float[np.ndarray, " numbers"]:
    """Returns the weights of a logistic regression with a penalty on large ones; both kinds count alike."""
    weights = np.zeros(table.shape[1])
    weight = np.where(is_real, 0.5 / is_real.mean(), 0.5 / (~is_real).mean())
    for _ in range(STEPS):
        odds = 1.0 / (1.0 + np.exp(-np.clip(table @ weights, -30, 30)))
        slope = table.T @ (weight * (odds - is_real)) + RIDGE * weights
        bend = (table * (weight * odds * (1 - odds))[:, None]).T @ table + RIDGE * np.eye(len(weights))
        weights -= np.linalg.solve(bend, slope)
    return weights


def auc(scores: Float[np.ndarray, " models"], is_real: Bool[np.ndarray, " models"]) -> float:
    """Returns how often a real model has a higher score than a made one; equal scores count half."""
    real, made = scores[is_real][:, None], scores[~is_real][None, :]
    return float(((real > made) + 0.5 * (real == made)).mean())


def _sizes(graph: FunctionalGraph) -> Float[np.ndarray, "nodes 3"]:
    return np.array([node.box.size for node in graph.nodes]) / float(graph.box.size.max())


def _flush(graph: FunctionalGraph) -> float:
    """Returns how many faces of boxes lie in one plane with a face of another part, as a fraction."""
    faces = np.array([np.concatenate([node.box.low, node.box.high]) for node in graph.nodes]) / graph.box.size.max()
    apart = np.abs(faces[:, None, :] - faces[None, :, :]) + np.eye(len(faces))[:, :, None]
    return float((apart.min(axis=1, initial=1.0) < 1e-5).mean())


def _hull(graph: FunctionalGraph) -> Float[np.ndarray, " nodes"]:
    """Returns for each part how far its points lie from the faces of its box, as a fraction of the box."""
    found = []
    for node in graph.nodes:
        points = node.points.points if node.points is not None else node.box.corners()
        inside = np.minimum(points - node.box.low, node.box.high - points) / np.maximum(node.box.size, 1e-9)
        found.append(float(inside.min(axis=1).mean()))
    return np.array(found)


def _overlap(graph: FunctionalGraph) -> float:
    """Returns the mean number of other parts whose box overlaps a part's by 1 mm on all axes."""
    low, high = (np.array([getattr(n.box, end) for n in graph.nodes]) for end in ("low", "high"))
    shared = np.minimum(high[:, None], high[None]) - np.maximum(low[:, None], low[None])
    return float(((shared > 1e-3).all(axis=2).sum(axis=1) - 1).mean())


MEASURES: Mapping[str, Callable[[FunctionalGraph], float]] = {
    "parts": lambda graph: len(graph.nodes),
    "width over height": lambda graph: float(graph.box.size[0] / graph.box.size[2]),
    "depth over height": lambda graph: float(graph.box.size[1] / graph.box.size[2]),
    "contacts of a part": lambda graph: 2 * len(graph.contacts) / len(graph.nodes),
    "thinnest side, median": lambda graph: float(np.median(_sizes(graph).min(axis=1))),
    "thinnest side, smallest": lambda graph: float(_sizes(graph).min()),
    "longest side, median": lambda graph: float(np.median(_sizes(graph).max(axis=1))),
    "small parts": lambda graph: float((_sizes(graph).max(axis=1) < 0.12).mean()),
    "thin parts": lambda graph: float((_sizes(graph).min(axis=1) < 0.04).mean()),
    "bulky parts": lambda graph: float((_sizes(graph).min(axis=1) > 0.15).mean()),
    "faces in one plane": _flush,
    "boxes that overlap": _overlap,
    "points inside boxes, mean": lambda graph: float(_hull(graph).mean()),
    "points inside boxes, most": lambda graph: float(_hull(graph).max()),
    "parts of one size": lambda graph: 1.0 - len({tuple(np.round(s, 3)) for s in _sizes(graph)}) / len(graph.nodes),
}


if __name__ == "__main__":
    sys.exit(main())
