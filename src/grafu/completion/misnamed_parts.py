"""Parts whose names are of another part, where the network is sure of it.

Data sets call every front a door, or a flap the front of a drawer, and now and then a door or drawer is called a part
that stays, or a panel is called a door. Lids, trays and boxes keep their names: their shapes are also those of tops,
shelves and cases.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace

import numpy as np

from grafu.asset.part import Asset
from grafu.completion.config import MisnamedConfig
from grafu.completion.features import GraphFeatures
from grafu.completion.probabilities import Probabilities
from grafu.completion.visibility import FROM_THE_FRONT
from grafu.graph.arrays import LABELS
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.shapes import Float
from grafu.vocabulary import PartLabel

_FRONTS = (PartLabel.DOOR, PartLabel.DRAWER)
_NO_NAMES = (PartLabel.HANDLE, PartLabel.UNKNOWN)
_PANELS = (PartLabel.SIDE_PANEL, PartLabel.BACK_PANEL, PartLabel.BOTTOM_PANEL)


def has_named(graph: FunctionalGraph, named: Collection[str]) -> bool:
    """Whether the network may overrule the name of a part, which `named` states; motions that are stated are kept."""
    return any(_may_be_misnamed(node, graph, named) for node in graph.nodes)


def corrected_names(
    graph: FunctionalGraph,
    features: GraphFeatures,
    probabilities: Probabilities,
    named: Collection[str],
    config: MisnamedConfig,
) -> tuple[Decision, ...]:
    """Returns for each misnamed part the decision that it is a door, drawer or panel, and not what it is named.

    `features` and `probabilities` are of the graph; `named` are the parts whose labels rest on their names alone.
    """
    asked = [(k, node) for k, node in enumerate(graph.nodes) if _may_be_misnamed(node, graph, named)]
    others = {
        k: likeliest for k, node in asked if (likeliest := _likeliest_other(node, probabilities.label[k], config))
    }
    if not others:
        return ()
    seen = features.visibility[:, FROM_THE_FRONT]
    found = []
    for k, (other, score) in others.items():
        node = graph.nodes[k]
        least = _least(node, other, graph, config, float(seen[k]))
        if least is not None and score >= least:
            own = float(probabilities.label[k, LABELS.index(node.label)])
            found.append(Decision(node.id, "label", other.value, score, node.label.value, own))
    return tuple(found)


def _may_be_misnamed(node: PartNode, graph: FunctionalGraph, named: Collection[str]) -> bool:
    return node.label not in _NO_NAMES and node.id in named and node.id not in graph.moving


def _likeliest_other(
    node: PartNode, probabilities: Float[np.ndarray, " labels"], config: MisnamedConfig
) -> tuple[PartLabel, float] | None:
    """Returns the likeliest label that a name may be wrong for; None where it is that of the name, or not likely."""
    choices = (*_FRONTS, *_PANELS) if node.label in _FRONTS else _FRONTS
    scores = {label: float(probabilities[LABELS.index(label)]) for label in choices}
    other = max(scores, key=scores.__getitem__)
    is_likely = scores[other] >= min(config.front, config.still, config.bare, config.panel)
    return (other, scores[other]) if other is not node.label and is_likely else None


def _least(
    node: PartNode, other: PartLabel, graph: FunctionalGraph, config: MisnamedConfig, seen: float
) -> float | None:
    """Returns the least probability of another label that overrules a name; None where none does.

    `seen` is the fraction of the part that is visible from the front.
    """
    handles = [each for each in map(graph.node, graph.neighbours[node.id]) if each.label is PartLabel.HANDLE]
    if other in _PANELS:
        return None if handles else config.panel
    if node.label in _FRONTS:
        return config.front
    bars = [handle for handle in handles if _is_bar(handle, config)]
    if any(not _is_of_a_front(bar, graph) for bar in bars):
        return config.still
    if _holds_a_front(node, graph, config):
        return None
    is_shown = seen >= config.seen and len(handles) - len(bars) <= config.knobs
    return config.bare if is_shown else None


def _holds_a_front(node: PartNode, graph: FunctionalGraph, config: MisnamedConfig) -> bool:
    """Whether a door or drawer is for the most part in the box of a part: rails and cases look like drawers."""
    fronts = (other.box for other in graph.nodes if other.label in _FRONTS and other is not node)
    return any(node.box.shared_volume(box) >= config.held * box.volume > 0.0 for box in fronts)


def _is_bar(handle: PartNode, config: MisnamedConfig) -> bool:
    _, wide, long = sorted(handle.box.size.tolist())
    return long >= config.bar * wide


def _is_of_a_front(handle: PartNode, graph: FunctionalGraph) -> bool:
    return any(graph.node(other).label in _FRONTS for other in graph.neighbours[handle.id])


def _corrections(completion: GraphCompletion) -> Sequence[Decision]:
    """Returns the decisions that corrected a name, as the completion has them in the end."""
    label_of, given = {node.id: node.label for node in completion.completed.nodes}, completion.input
    return [
        decision
        for decision in completion.decisions
        if decision.question == "label"
        and decision.part in given
        and given.node(decision.part).label not in (PartLabel.UNKNOWN, label_of[decision.part])
    ]


def with_corrected_names(asset: Asset, completion: GraphCompletion) -> Asset:
    """Returns the asset in which misnamed parts are what the completion takes them for, and notes on it."""
    found = _corrections(completion)
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
