"""What the network states of the whole piece: what it is, which parts are drawn ajar, and which ride on what moves."""

from collections.abc import Collection, Mapping, Set

import numpy as np

from grafu.completion.decode_config import FactConfig
from grafu.completion.probabilities import Probabilities
from grafu.graph.completion import Decision, PieceGuess
from grafu.graph.functional_graph import FunctionalGraph
from grafu.vocabulary import PartLabel, PieceKind

_KINDS = tuple(PieceKind)
_RIDING = (PartLabel.MISC, PartLabel.UNKNOWN, PartLabel.BAR, PartLabel.FACE_FRAME)


def piece_guess(probabilities: Probabilities, config: FactConfig) -> PieceGuess | None:
    """Returns what the whole piece is; None where no kind is likely enough."""
    first, second = np.argsort(-probabilities.piece)[:2].tolist()
    score = float(probabilities.piece[first])
    if score < config.piece:
        return None
    return PieceGuess(_KINDS[first], score, _KINDS[second], float(probabilities.piece[second]))


def ajar_decisions(graph: FunctionalGraph, probabilities: Probabilities, config: FactConfig) -> tuple[Decision, ...]:
    """Returns a decision for each moving part of the input that is drawn open."""
    likely = zip(graph.nodes, probabilities.ajar.tolist(), strict=False)  # free slots come last
    return tuple(
        Decision(node.id, "ajar", "open", score, "closed", 1.0 - score)
        for node, score in likely
        if node.id in graph.moving and score >= config.ajar
    )


def rides(
    graph: FunctionalGraph, given: frozenset[str], probabilities: Probabilities, config: FactConfig
) -> tuple[tuple[str, str], ...]:
    """Returns the pairs (moving part, part that moves as one with it), beside attached handles and what moves itself.

    Such a part is a fitting, a bar or a frame; it touches the moving part, or what rides there, too, and nothing that
    stays: one that touches both, such as a drawn hinge, may belong to either, which the meshes decide.
    """
    place = {node.id: k for k, node in enumerate(graph.nodes)}
    held = graph.moving | {edge.child for edge in graph.attachments}
    loose = [node.id for node in graph.nodes if node.id in given - held and node.label in _RIDING]
    standing = _standing(loose, held, graph)
    loose = [name for name in loose if name not in standing]
    moving = [name for name in graph.moving if name in given]
    if not loose or not moving:
        return ()
    chances = probabilities.body[np.ix_([place[name] for name in loose], [place[name] for name in moving])]
    best = chances.argmax(axis=1)
    likely = {
        name: moving[column]
        for name, column, chance in zip(loose, best.tolist(), chances.max(axis=1).tolist(), strict=True)
        if chance >= config.rides
    }
    owner = {name: name for name in moving} | {edge.child: edge.parent for edge in graph.attachments}
    return tuple((body, name) for name, body in _touching(likely, owner, graph).items())


def _standing(loose: Collection[str], held: Set[str], graph: FunctionalGraph) -> Set[str]:
    """Returns the loose parts that touch what stays, such as a panel, directly or through other loose parts."""
    still = [node.id for node in graph.nodes if node.id not in held and node.id not in loose]
    found, queue = set[str](), still
    while queue:
        new = {name for name in graph.neighbours[queue.pop()] if name in loose} - found
        found |= new
        queue += new
    return found


def _touching(likely: Mapping[str, str], owner: Mapping[str, str], graph: FunctionalGraph) -> dict[str, str]:
    """Returns those parts that touch their moving part, or another one that rides there."""
    found: dict[str, str] = {}
    while True:
        known = {**owner, **found}
        more = {
            name: body
            for name, body in likely.items()
            if name not in found and any(known.get(other) == body for other in graph.neighbours[name])
        }
        if not more:
            return found
        found |= more
