"""Parts whose names are of another part, where the network is sure of it.

Data sets call every front a door, or a flap the front of a drawer, and now and then what a handle pulls is called a
part that stays. Other labels from names are kept: where the network contradicts those of real furniture it is as often
wrong as right.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace

from grafu.asset.part import Asset
from grafu.completion.config import MisnamedConfig
from grafu.completion.probabilities import Probabilities
from grafu.graph.arrays import LABELS
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

_FRONTS = (PartLabel.DOOR, PartLabel.DRAWER)
_NOT_STILL = (*_FRONTS, PartLabel.HANDLE, PartLabel.UNKNOWN)


def has_named(graph: FunctionalGraph, named: Collection[str], config: MisnamedConfig) -> bool:
    """Whether the network may overrule the name of a part, which `named` states; motions that are stated are kept."""
    return any(_is_open(node, graph, named) or _is_pulled(node, graph, named, config) for node in graph.nodes)


def corrected_fronts(
    graph: FunctionalGraph, probabilities: Probabilities, named: Collection[str], config: MisnamedConfig
) -> tuple[Decision, ...]:
    """Returns for each misnamed front the decision that it is a door or drawer, and not what it is named.

    `named` are the parts whose labels rest on their names alone.
    """
    found = []
    for k, node in enumerate(graph.nodes):
        if _is_open(node, graph, named):
            least = config.front
        elif _is_pulled(node, graph, named, config):
            least = config.still
        else:
            continue
        scores = {label: float(probabilities.label[k, LABELS.index(label)]) for label in {node.label, *_FRONTS}}
        other = max(_FRONTS, key=scores.__getitem__)
        if other is not node.label and scores[other] >= least:
            found.append(Decision(node.id, "label", other.value, scores[other], node.label.value, scores[node.label]))
    return tuple(found)


def _is_open(node: PartNode, graph: FunctionalGraph, named: Collection[str]) -> bool:
    return node.label in _FRONTS and node.id in named and node.id not in graph.moving


def _is_pulled(node: PartNode, graph: FunctionalGraph, named: Collection[str], config: MisnamedConfig) -> bool:
    """Whether a bar that touches no door or drawer touches a part that stays by its name alone."""
    if node.label in _NOT_STILL or node.id not in named or node.id in graph.moving:
        return False
    near = graph.neighbours[node.id]
    return any(_is_bar(graph.node(name), config) and not _is_of_a_front(name, graph) for name in near)


def _is_bar(node: PartNode, config: MisnamedConfig) -> bool:
    _, wide, long = sorted(node.box.size.tolist())
    return node.label is PartLabel.HANDLE and long >= config.bar * wide


def _is_of_a_front(handle: str, graph: FunctionalGraph) -> bool:
    return any(graph.node(other).label in _FRONTS for other in graph.neighbours[handle])


def _misnamed_fronts(completion: GraphCompletion) -> Sequence[Decision]:
    """Returns the decisions that corrected a name, as the completion has them in the end."""
    label_of, given = {node.id: node.label for node in completion.completed.nodes}, completion.input
    return [
        decision
        for decision in completion.decisions
        if decision.question == "label"
        and decision.part in given
        and label_of[decision.part] in _FRONTS
        and given.node(decision.part).label not in (PartLabel.UNKNOWN, label_of[decision.part])
    ]


def with_corrected_fronts(asset: Asset, completion: GraphCompletion) -> Asset:
    """Returns the asset in which misnamed doors and drawers are what the completion takes them for, and notes on it."""
    found = _misnamed_fronts(completion)
    if not found:
        return asset
    labels = {decision.part: PartLabel(decision.choice) for decision in found}
    parts = tuple(
        replace(part, label=labels[part.id], labelled_by="prediction") if part.id in labels else part
        for part in asset.parts
    )
    return replace(asset, parts=parts, notes=(*asset.notes, *(_note(decision, asset) for decision in found)))


_KEEPS = {  # words of `--move`
    PartLabel.DOOR: "left moves it as a door",
    PartLabel.DRAWER: "slides moves it as a drawer",
}


def _note(decision: Decision, asset: Asset) -> str:
    part = asset.part(decision.part)
    seen = f"is a {decision.choice} by its shape ({decision.score:.0%})"
    keeps = f"--move {part.id}={_KEEPS.get(part.label, 'fixed keeps it still')}"
    return f"{part.id} is called a {part.label}, but {seen}: {keeps}"
