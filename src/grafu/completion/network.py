"""Completes a graph by the trained network: label the parts, add what is missing, then decode.

Labels come first, because edges are more accurate when labels are given. Free slots are evaluated again, with the parts
that they added as nodes of the input, until none fires: the number of handles has no limit. The last result is the mean
of two forward passes, on the graph and on its mirror image: their errors differ.

Labels of unlabelled parts: the network's category, which equal boards beside one another have the mean of, weighed by
whether anything could carry such a part, and by whether it is one of a row of fronts, which agree, or of a column of
wide ones, which are rather drawers. A panel on which a smaller front with a handle lies is no front, nor is a rod or a
button; what touches handles alone is a piece of one.

Labels that the input states are kept, whatever the network states, but for fronts that are called something else
(`misnamed_parts`).
"""

from collections.abc import Collection

import numpy as np

from grafu.completion.alike import with_alike
from grafu.completion.answers import decision_of
from grafu.completion.decode import complete_decoded, decode_graph
from grafu.completion.decode_config import DecodeConfig
from grafu.completion.features import FeatureConfig, GraphFeatures, graph_features, mirrored
from grafu.completion.label_shapes import held_by_handles, with_held, without_cases, without_overlaid, without_slim
from grafu.completion.misnamed_parts import corrected_names, has_named
from grafu.completion.probabilities import Probabilities, averaged, mirrored_back, probabilities_of
from grafu.completion.selection import borders_without_handle
from grafu.completion.session import GraphNetwork
from grafu.completion.slots import NewPart, new_parts, regular_parts, with_parts
from grafu.completion.votes import ranking_of
from grafu.geometry.arrays import Indices, Points, Scalars
from grafu.geometry.budget import fits, present_budget, require_room, require_time
from grafu.geometry.components import linked
from grafu.graph.arrays import ATTACHED, DOOR, DRAWER, HANDLE, HINGE, LABELS, RAIL, UNKNOWN
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.edges import Contact, ends_of
from grafu.graph.edit import relabelled
from grafu.graph.functional_graph import FunctionalGraph, is_allowed
from grafu.shapes import Bool, Int
from grafu.vocabulary import PartLabel

Group = Int[np.ndarray, " _"]  # numbers of nodes
_LEAST = 1e-9  # no weight is less, so that odds are finite
_CARRIED_BY = {DOOR: HINGE, DRAWER: RAIL, HANDLE: ATTACHED}


def choose_labels(
    graph: FunctionalGraph, probabilities: Probabilities, config: DecodeConfig
) -> tuple[dict[str, PartLabel], tuple[Decision, ...]]:
    """Returns a label, never `unknown`, for each unlabelled part, and its confidence.

    An edge that the input states at the part allows only the labels that it can join.
    """
    labels: dict[str, PartLabel] = {}
    decisions = []
    weights = with_alike(_weights(probabilities, len(graph.nodes), config), graph)
    weights = without_slim(weights, graph, config)
    weights = with_held(without_cases(without_overlaid(weights, graph, config), graph, config), graph, config)
    weights = _with_columns(weights, graph, config)
    for k, node in enumerate(graph.nodes):
        if node.label is not PartLabel.UNKNOWN:
            continue
        allowed = _allowed(graph, node.id, labels)
        ranking = ranking_of([label.value for label in LABELS], np.maximum(weights[k], _LEAST) * allowed)
        labels[node.id] = PartLabel(ranking.choice)
        decisions.append(decision_of(node.id, "label", ranking))
    grips = held_by_handles(graph, labels)
    kept = (decision for decision in decisions if decision.part not in grips)
    return labels | dict.fromkeys(grips, PartLabel.HANDLE), tuple(kept)


def _weights(probabilities: Probabilities, count: int, config: DecodeConfig) -> np.ndarray:
    """Returns the probability of each label of each node; less for what moves or is grasped if nothing carries it."""
    weights = probabilities.label[:count].copy()
    if count > 1:
        others = probabilities.edge[:count, :count] * (1.0 - np.eye(count))[..., None]
        for label, kind in _CARRIED_BY.items():
            carried = others[..., kind].max(axis=1)
            weights[:, label] *= config.edge_for_label + (1.0 - config.edge_for_label) * carried
    return weights


_ALIGNED = 0.05  # of a front's width, or of its height: how far the sides of fronts of one column, or row, differ
_BETWEEN = 0.5  # of a front's height: how far the next one may be, and how much the height of one column's may differ


def _with_columns(weights: np.ndarray, graph: FunctionalGraph, config: DecodeConfig) -> np.ndarray:
    """Returns the weights of labels where the fronts of a row or column agree on being doors or drawers.

    The odds of a row, and then of a column, wide fronts right above each other, are the mean of the logarithms.
    """
    made = weights
    for group in _rows(weights, graph):
        made = _agreed(made, group)
    for group in _columns(made, graph, config):
        made = _agreed(made, group)
    return made


def _agreed(weights: np.ndarray, group: Group) -> np.ndarray:
    """Returns the weights in which a group has common odds of drawers against doors."""
    odds = np.log(np.maximum(weights[group, DRAWER], _LEAST) / np.maximum(weights[group, DOOR], _LEAST))
    ratio = float(np.exp(odds.mean()))
    both = weights[group, DOOR] + weights[group, DRAWER]
    made = weights.copy()
    made[group, DRAWER], made[group, DOOR] = both * ratio / (1 + ratio), both / (1 + ratio)
    return made


def _columns(weights: np.ndarray, graph: FunctionalGraph, config: DecodeConfig) -> list[Group]:
    """Returns the columns of wide fronts, each as the numbers of its nodes."""
    low, high, fronts = _fronts(weights, graph)
    wide = (high - low)[:, 0] >= config.wide * (high - low)[:, 2]
    low, high, fronts = low[wide], high[wide], fronts[wide]
    size = high - low
    aside = np.maximum(np.abs(low[:, None, 0] - low[None, :, 0]), np.abs(high[:, None, 0] - high[None, :, 0]))
    between = np.maximum(low[:, None, 2] - high[None, :, 2], low[None, :, 2] - high[:, None, 2])
    near = (aside <= _ALIGNED * size[:, None, 0]) & (np.abs(between) <= _BETWEEN * size[:, None, 2])
    near &= np.abs(size[:, None, 2] - size[None, :, 2]) <= _BETWEEN * size[:, None, 2]
    return _groups(near, fronts)


def _rows(weights: np.ndarray, graph: FunctionalGraph) -> list[Group]:
    """Returns the rows of fronts of one height and in one plane, each as the numbers of its nodes.

    They are side by side, or mirror images of each other on the left and right of the piece.
    """
    low, high, fronts = _fronts(weights, graph)
    size = high - low
    apart = np.maximum(np.abs(low[:, None] - low[None]), np.abs(high[:, None] - high[None]))
    level = (apart[:, :, 2] <= _ALIGNED * size[:, None, 2]) & (apart[:, :, 1] <= _BETWEEN * size[:, None, 2])
    between = np.maximum(low[:, None, 0] - high[None, :, 0], low[None, :, 0] - high[:, None, 0])
    beside = np.abs(between) <= _BETWEEN * size[:, None, 2]
    ends = [node.box.low[0] for node in graph.nodes], [node.box.high[0] for node in graph.nodes]
    off = low[:, None, 0] + high[None, :, 0] - (min(ends[0]) + max(ends[1]))
    mirrored = np.maximum(np.abs(off), np.abs(off.T)) <= _ALIGNED * size[:, None, 0]
    return _groups(level & (beside | mirrored), fronts)


def _fronts(weights: np.ndarray, graph: FunctionalGraph) -> tuple[Points, Points, Indices]:
    """Returns the lowest and highest corners of what is most likely a door or drawer, and the numbers of its nodes."""
    fronts = np.flatnonzero(np.isin(weights.argmax(axis=1), (DOOR, DRAWER)))
    boxes = [graph.nodes[k].box for k in fronts]
    ends = ([box.low for box in boxes], [box.high for box in boxes])
    low, high = (np.array(corners).reshape(-1, 3) for corners in ends)
    return low, high, fronts


def _groups(near: Bool[np.ndarray, "n n"], fronts: Indices) -> list[Group]:
    """Returns the fronts that are near each other, directly or through others, in groups of two and more."""
    if len(fronts) < 2:
        return []
    number = linked(len(fronts), *np.nonzero(near))
    groups = (fronts[number == k] for k in range(int(number.max()) + 1))
    return [group for group in groups if len(group) > 1]


def _allowed(graph: FunctionalGraph, node_id: str, chosen: dict[str, PartLabel]) -> np.ndarray:
    """Returns 1 for each label, but `unknown`, that the stated edges at a node allow; for all where they allow none."""
    edges = [e for e in graph.edges if node_id in ends_of(e) and not isinstance(e, Contact)]
    allowed = np.ones(len(LABELS))
    allowed[UNKNOWN] = 0.0
    for k, label in enumerate(LABELS[:-1]):
        settled = {**chosen, node_id: label}
        ends = ([settled.get(end, graph.node(end).label) for end in ends_of(edge)] for edge in edges)
        allowed[k] = all(is_allowed(edge, *pair) for edge, pair in zip(edges, ends, strict=True))
    if not allowed.any():
        allowed[:-1] = 1.0
    return allowed


_ACROSS = 0  # furniture is alike on its left and right, not in front and behind
_BODIES_PER_ROUND = 4  # handles that one pass can add: the paper's free slots
_PAIR_BYTES = 4_500  # for each pair of parts, during a forward pass
_ADDING = 0.6  # of the time: adding what is missing


def complete_by_network(
    graph: FunctionalGraph,
    network: GraphNetwork,
    features: FeatureConfig,
    config: DecodeConfig = DecodeConfig(),
    named: Collection[str] = (),
) -> GraphCompletion:
    """Returns the graph with labels, handles, missing parts, and a motion or a refusal for each door and drawer.

    `features` states how many points the network takes. Nodes should have points; those without are sampled on their
    boxes. Scores of decisions are the network's probabilities, renormalised over what could be chosen. `named` are the
    parts whose labels rest on their names alone: of these the network corrects some (`MisnamedConfig`).

    Raises:
        TooComplex: if there are more pairs of parts than the budget in force allows.
    """
    if not graph.nodes:
        return GraphCompletion(graph, graph, "network")
    require_room(len(graph.nodes) ** 2, _PAIR_BYTES, f"the network's forward pass over {len(graph.nodes):,} parts")
    adding = present_budget().fraction(_ADDING)
    seen, labelling, known = label_parts(graph, network, features, config, named)
    added: list[NewPart] = []
    given = frozenset(node.id for node in graph.nodes)
    rounds, asked_rows, labelled = 0, False, seen
    first = inputs, probabilities = known or forward(seen, network, features)
    while True:
        parents = {part.node.id: part.parent for part in added if part.parent is not None}
        decoded = decode_graph(seen, probabilities, given, parents, config)
        most = config.rounds + len(decoded.view.moving_bodies) // _BODIES_PER_ROUND
        goes_on = rounds < most and adding.left > 0 and fits(len(seen.nodes) ** 2, _PAIR_BYTES)
        found = new_parts(decoded.view, decoded.held) if goes_on else ()
        if not found and not asked_rows:
            found, asked_rows = regular_parts(decoded.view), True
        if not found:
            break
        seen, rounds = with_parts(seen, found), rounds + 1
        added += found
        inputs, probabilities = forward(seen, network, features)
    if config.mirror:
        decoded = decode_graph(seen, with_image(probabilities, seen, inputs, network), given, parents, config)
    if any(part.node.label is PartLabel.HANDLE for part in added):
        decoded = decoded.stating(_borders_before(labelled, first, network, given, config))
    return complete_decoded(graph, decoded, labelling, added)


def _borders_before(
    graph: FunctionalGraph,
    seen: tuple[GraphFeatures, Probabilities],
    network: GraphNetwork,
    given: frozenset[str],
    config: DecodeConfig,
) -> dict[str, Scalars]:
    """Returns what was stated of the borders of doors without a handle before any was added: features, probabilities.

    With its own handle on a door, the network is sure of the side away from it, whatever it knew before.
    """
    inputs, probabilities = seen
    averaged = with_image(probabilities, graph, inputs, network) if config.mirror else probabilities
    return borders_without_handle(decode_graph(graph, averaged, given, {}, config).view)


def label_parts(
    graph: FunctionalGraph,
    network: GraphNetwork,
    features: FeatureConfig,
    config: DecodeConfig,
    named: Collection[str] = (),
) -> tuple[FunctionalGraph, tuple[Decision, ...], tuple[GraphFeatures, Probabilities] | None]:
    """Returns the graph with a label for each unlabelled part and each misnamed part, and the confidence of each.

    With it comes the forward pass on that graph, where there was one. `named` is as in `complete_by_network`.
    """
    has_unknown = any(node.label is PartLabel.UNKNOWN for node in graph.nodes)
    if not has_unknown and not has_named(graph, named):
        return graph, (), None
    known = forward(graph, network, features)
    corrections = corrected_names(graph, *known, named, config.misnamed)
    labels, decisions = choose_labels(graph, known[1], config)
    if not labels and not corrections:
        return graph, (), known
    corrected = {decision.part: PartLabel(decision.choice) for decision in corrections}
    return relabelled(graph, labels | corrected), (*decisions, *corrections), None


def forward(
    graph: FunctionalGraph, network: GraphNetwork, features: FeatureConfig
) -> tuple[GraphFeatures, Probabilities]:
    """Returns the features of a graph, and the probabilities that a network computes from them."""
    require_time()
    inputs = graph_features(graph, features)
    return inputs, probabilities_of(network(inputs))


def with_image(
    probabilities: Probabilities, graph: FunctionalGraph, inputs: GraphFeatures, network: GraphNetwork
) -> Probabilities:
    """Returns the mean of the probabilities of a graph and of its mirror image."""
    image = probabilities_of(network(mirrored(inputs, _ACROSS)))
    thin = np.array([node.box.thin_axis for node in graph.nodes], dtype=np.int64)
    return averaged(probabilities, mirrored_back(image, thin, _ACROSS), len(graph.nodes))
