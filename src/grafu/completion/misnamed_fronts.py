"""Doors that are called drawers, and drawers that are called doors, where the network is sure of it.

Data sets call every front a door, or a flap the front of a drawer. Other labels from names are kept: where the network
contradicts those of real furniture it is as often wrong as right, even where a handle seems to sit on a board.
"""

from collections.abc import Collection, Sequence
from dataclasses import replace

from grafu.asset.part import Asset
from grafu.completion.probabilities import Probabilities
from grafu.graph.arrays import LABELS
from grafu.graph.completion import Decision, GraphCompletion
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

_FRONTS = (PartLabel.DOOR, PartLabel.DRAWER)
_CODES = [LABELS.index(label) for label in _FRONTS]


def has_named(graph: FunctionalGraph, named: Collection[str]) -> bool:
    """Whether a part is a door or drawer by its name alone, which `named` states, and its motion is not stated."""
    return any(_is_open(node, graph, named) for node in graph.nodes)


def corrected_fronts(
    graph: FunctionalGraph, probabilities: Probabilities, named: Collection[str], least: float
) -> tuple[Decision, ...]:
    """Returns for each misnamed front the decision that it is a drawer and no door, or a door and no drawer.

    `named` are the parts whose labels rest on their names alone, `least` is the least probability that corrects one.
    """
    found = []
    for k, node in enumerate(graph.nodes):
        if not _is_open(node, graph, named):
            continue
        own = _FRONTS.index(node.label)
        scores = probabilities.label[k, _CODES]
        if float(scores[1 - own]) >= least:
            other, score = _FRONTS[1 - own].value, float(scores[1 - own])
            found.append(Decision(node.id, "label", other, score, node.label.value, float(scores[own])))
    return tuple(found)


def _is_open(node: PartNode, graph: FunctionalGraph, named: Collection[str]) -> bool:
    return node.label in _FRONTS and node.id in named and node.id not in graph.moving


def _misnamed_fronts(completion: GraphCompletion) -> Sequence[Decision]:
    """Returns the decisions that corrected a name, as the completion has them in the end."""
    label_of, given = {node.id: node.label for node in completion.completed.nodes}, completion.input
    return [
        decision
        for decision in completion.decisions
        if decision.question == "label"
        and decision.part in given
        and label_of[decision.part] in _FRONTS
        and given.node(decision.part).label in set(_FRONTS) - {label_of[decision.part]}
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


_KEEPS = {PartLabel.DOOR: "left", PartLabel.DRAWER: "slides"}  # words of `--move`


def _note(decision: Decision, asset: Asset) -> str:
    part = asset.part(decision.part)
    seen = f"is a {decision.choice} by its shape ({decision.score:.0%})"
    keeps = f"--move {part.id}={_KEEPS[part.label]} moves it as a {part.label}"
    return f"{part.id} is called a {part.label}, but {seen}: {keeps}"
