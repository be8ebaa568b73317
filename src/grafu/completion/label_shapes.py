"""What boxes and contacts state about the labels of unlabelled parts, whatever the network states.

What a smaller front with a handle lies upon is no door or drawer, nor is what stands on the floor with several fronts
in its face, nor what is slim as a rod; the plate that a handle sits on is one; what touches nothing but handles is a
piece of one.
"""

from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from grafu.completion.decode_config import DecodeConfig, HeldFrontsConfig, HeldPlateConfig, OverlayConfig
from grafu.geometry.box import Box, overlap_across
from grafu.graph.arrays import DOOR, DRAWER, HANDLE, LABELS
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.vocabulary import PartLabel

_UP = 2
_LEAST = 1e-9  # no weight is less, so that fractions are finite


def without_slim(weights: np.ndarray, graph: FunctionalGraph, config: DecodeConfig) -> np.ndarray:
    """Returns the weights of labels (nodes, labels) in which unlabelled rods and buttons are no doors or drawers."""
    least = np.array([config.strip, config.button]) * float(graph.box.size.max())
    slim = [
        k
        for k, node in enumerate(graph.nodes)
        if node.label is PartLabel.UNKNOWN and (np.sort(node.box.size)[1:] < least).any()
    ]
    if not slim:
        return weights
    made = weights.copy()
    made[np.ix_(slim, [DOOR, DRAWER])] = 0.0
    return made


def held_by_handles(graph: FunctionalGraph, labels: Mapping[str, PartLabel]) -> frozenset[str]:
    """Returns the unlabelled nodes that touch handles and nothing else: the bar of a handle on its posts.

    `labels` are those that were found for unlabelled nodes. A door that touches its handle alone stays a door.
    """
    settled = {node.id: labels.get(node.id, node.label) for node in graph.nodes}
    return frozenset(
        name
        for name, label in labels.items()
        if not label.is_movable
        and (touched := graph.neighbours[name])
        and all(settled[other] is PartLabel.HANDLE for other in touched)
    )


def without_overlaid(weights: np.ndarray, graph: FunctionalGraph, config: DecodeConfig) -> np.ndarray:
    """Returns the weights of labels (nodes, labels) in which unlabelled parts behind smaller fronts are no fronts.

    Such a part is likely a door or a drawer by itself: a panel with openings, one of which the smaller front closes. It
    is one where a handle stands on it beside the smaller one, as on a door with a mirror.
    """
    likely = _likely(weights, graph)
    fronts = [k for k, label in enumerate(likely) if label in (DOOR, DRAWER)]
    handles = [graph.nodes[k].box for k, label in enumerate(likely) if label == HANDLE]
    made = weights
    for k in fronts:
        node = graph.nodes[k]
        if node.label is not PartLabel.UNKNOWN:
            continue
        others = (graph.nodes[i].box for i in fronts if i != k)
        if any(_lies_on(other, node.box, graph.box, handles, config.overlay) for other in others):
            made = made.copy() if made is weights else made
            made[k, [DOOR, DRAWER]] = 0.0
    return made


def without_cases(weights: np.ndarray, graph: FunctionalGraph, config: DecodeConfig) -> np.ndarray:
    """Returns the weights of labels (nodes, labels) in which unlabelled bodies with fronts in their face are no fronts.

    Such a body stands on the floor, which no drawer does, and several doors or drawers lie side by side in its face.
    """
    fronts = [k for k, label in enumerate(_likely(weights, graph)) if label in (DOOR, DRAWER)]
    floor = float(graph.box.low[2]) + config.held_fronts.floor * float(graph.box.size.max())
    cases = [
        k
        for k in fronts
        if graph.nodes[k].label is PartLabel.UNKNOWN
        and float(graph.nodes[k].box.low[2]) <= floor
        and _has_fronts(
            graph.nodes[k].box, [graph.nodes[i].box for i in fronts if i != k], graph.box, config.held_fronts
        )
    ]
    if not cases:
        return weights
    made = weights.copy()
    made[np.ix_(cases, [DOOR, DRAWER])] = 0.0
    return made


def with_held(weights: np.ndarray, graph: FunctionalGraph, config: DecodeConfig) -> np.ndarray:
    """Returns the weights of labels (nodes, labels) in which the unlabelled plate that a handle sits on is a front.

    Such a plate stands upright at a face of the whole, nothing else behind the handle is a door or drawer, and the
    network holds it for possible.
    """
    likely = _likely(weights, graph)
    held: set[int] = set()
    for k, node in enumerate(graph.nodes):
        if likely[k] != HANDLE or weights[k, HANDLE] < config.held.handle * weights[k].sum():
            continue
        behind = [i for i, other in enumerate(graph.nodes) if i != k and _is_behind(other.box, node.box)]
        if any(likely[i] in (DOOR, DRAWER) for i in behind):
            continue
        plates = [i for i in behind if _is_front_plate(graph.nodes[i], graph.box, config.held)]
        moves = {i: float(weights[i, [DOOR, DRAWER]].sum() / max(weights[i].sum(), _LEAST)) for i in plates}
        best = max(moves, key=lambda i: moves[i], default=None)
        held |= {best} if best is not None and moves[best] >= config.held.possible else set()
    if not held:
        return weights
    made, rows = weights.copy(), sorted(held)
    made[rows] = 0.0
    made[np.ix_(rows, [DOOR, DRAWER])] = weights[np.ix_(rows, [DOOR, DRAWER])]
    return made


def _is_behind(box: Box, handle: Box) -> bool:
    """Whether the middle of a handle lies in the outline of what is no farther from it than the handle is deep."""
    thin = box.thin_axis
    gap = max(float(box.low[thin] - handle.high[thin]), float(handle.low[thin] - box.high[thin]))
    inside = (box.low <= handle.center) & (handle.center <= box.high)
    return bool(np.delete(inside, thin).all() and gap <= handle.size[thin])


def _is_front_plate(node: PartNode, whole: Box, config: HeldPlateConfig) -> bool:
    """Whether an unlabelled node is an upright plate at a face of the whole."""
    box, thin = node.box, node.box.thin_axis
    if node.label is not PartLabel.UNKNOWN or thin == _UP:
        return False
    others = np.delete(box.size, thin)
    if box.size[thin] > config.thin * others.min():
        return False
    behind = min(float(box.low[thin] - whole.low[thin]), float(whole.high[thin] - box.high[thin]))
    return behind <= config.face * float(whole.size[thin])


def _likely(weights: np.ndarray, graph: FunctionalGraph) -> list[int]:
    """Returns the number of the label of each node, of unlabelled ones of the likeliest."""
    return [
        LABELS.index(node.label) if node.label is not PartLabel.UNKNOWN else int(weights[k].argmax())
        for k, node in enumerate(graph.nodes)
    ]


def _has_fronts(body: Box, fronts: Sequence[Box], whole: Box, config: HeldFrontsConfig) -> bool:
    """Whether several fronts lie side by side in one of the four upright faces of a body."""
    slack = config.spare * float(whole.size.max())
    for axis in (0, 1):
        across, depth = [1 - axis, 2], float(body.size[axis])
        plates = [
            box
            for box in fronts
            if float(box.size[axis]) <= config.thin * depth
            and bool(np.all(box.low >= body.low - slack) and np.all(box.high <= body.high + slack))
        ]
        for gaps in (
            [box.low[axis] - body.low[axis] for box in plates],
            [body.high[axis] - b.high[axis] for b in plates],
        ):
            in_face = [box for box, gap in zip(plates, gaps, strict=True) if gap <= config.face * depth]
            areas = [float(np.prod(box.size[across])) for box in in_face]
            covered = sum(areas) >= config.least * float(np.prod(body.size[across]))
            if len(in_face) > 1 and covered and not overlap_across(in_face, across, config.shared):
                return True
    return False


def _lies_on(front: Box, panel: Box, whole: Box, handles: list[Box], config: OverlayConfig) -> bool:
    """Whether a front lies before an upright panel, within its outline, and has all the handles of both.

    A drawer that is lower than deep is no panel that lies: what stands above it is another drawer.
    """
    thin = panel.thin_axis
    if thin == _UP:
        return False
    across = [axis for axis in range(3) if axis != thin]
    ratio = float(np.prod(front.size[across]) / max(np.prod(panel.size[across]), 1e-12))
    if not config.least <= ratio <= config.most or not _is_within(front, panel, across, config.spare):
        return False
    slack = config.before * float(whole.size.max())
    if panel.center[thin] < whole.center[thin]:
        is_before = front.high[thin] <= panel.low[thin] + slack
    else:
        is_before = front.low[thin] >= panel.high[thin] - slack
    held = list(_centers_on(panel, handles, across, slack))
    return bool(is_before and held and all(_is_within(one, front, across, config.spare) for one in held))


def _centers_on(panel: Box, handles: list[Box], across: list[int], slack: float) -> Iterator[Box]:
    """Yields the handles, as points, whose middles lie in a panel's outline."""
    for handle in handles:
        middle = Box(handle.center, handle.center)
        if bool(np.all(middle.low[across] >= panel.low[across] - slack)) and bool(
            np.all(middle.high[across] <= panel.high[across] + slack)
        ):
            yield middle


def _is_within(inner: Box, outer: Box, across: list[int], spare: float) -> bool:
    room = spare * outer.size[across]
    low, high = inner.low[across] - outer.low[across], outer.high[across] - inner.high[across]
    return bool(np.all(low >= -room) and np.all(high >= -room))
