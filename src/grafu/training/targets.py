"""What the network is to answer about a graph, as arrays, and the padded batch of several.

Boxes stand in the frame of the INPUT graph's features, since that is where the network answers. Batches of ever new
sizes would be slow: for each size of a product oneDNN builds code of its own, keeps a thousand of them, and litters the
heap with those that it drops. With sizes in steps a few dozen are made once.
"""

from collections.abc import Sequence
from dataclasses import fields, replace
from typing import final

import numpy as np
import torch
from torch import Tensor

from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, freeze_arrays
from grafu.graph.arrays import NONE, NULL, UNKNOWN, KindSet, graph_arrays
from grafu.graph.functional_graph import FunctionalGraph
from grafu.graph.piece_facts import NOT_KNOWN, PieceFacts, fact_codes
from grafu.shapes import Bool, Float32, Float64, Int64

SLOT_STEP = 4  # graphs of a batch have so many nodes, or a multiple
ROW_STEP = 64  # and their points as many rows


def stepped(size: int, step: int) -> int:
    """Returns the least multiple of `step` that is not below `size`."""
    return -(-size // step) * step


def padded(arrays: Sequence[np.ndarray], shape: tuple[int, ...], fill: float | int | bool) -> Tensor:
    """Returns the arrays, each filled up to `shape`, one behind another; there is at least one."""
    stacked = np.full((len(arrays), *shape), fill, dtype=arrays[0].dtype)
    for row, array in zip(stacked, arrays, strict=True):
        row[tuple(slice(size) for size in array.shape)] = array
    return torch.from_numpy(stacked)


_PLANE_AXES = np.array([[1, 2], [0, 2], [0, 1]])  # of a door's box, by its thin axis, ascending


@final
@dataclass(frozen=True, eq=False, slots=True)
class GraphTargets(ArrayValue):
    """The answers for one graph of t nodes, given n of them.

    The fields up to `slide` are those of `grafu.graph.arrays.GraphArrays`, with `boxes` in the normalised frame of the
    input. `thin` is the thin axis of each box. `anchors` names, for each input node, the node that it is. `bodies`,
    `ajar` and `piece` are those of `grafu.graph.piece_facts.FactCodes`.
    """

    labels: Int64[np.ndarray, " t"]
    boxes: Float32[np.ndarray, "t 6"]
    edges: Int64[np.ndarray, "t t"]
    child: Bool[np.ndarray, "t t"]
    border: Int64[np.ndarray, " t"]
    sign: Int64[np.ndarray, " t"]
    slide: Int64[np.ndarray, " t"]
    thin: Int64[np.ndarray, " t"]
    anchors: Int64[np.ndarray, " n"]
    bodies: Int64[np.ndarray, " t"]
    ajar: Int64[np.ndarray, " t"]
    piece: Int64[np.ndarray, ""]

    def __post_init__(self) -> None:
        freeze_arrays(self)


@final
@dataclass(frozen=True)
class TargetBatch:
    """The answers for several graphs, padded: `mask` marks the true nodes, `anchors` is `NONE` where n is padding."""

    labels: Int64[Tensor, "b t"]
    boxes: Float32[Tensor, "b t 6"]
    edges: Int64[Tensor, "b t t"]
    child: Bool[Tensor, "b t t"]
    border: Int64[Tensor, "b t"]
    sign: Int64[Tensor, "b t"]
    slide: Int64[Tensor, "b t"]
    anchors: Int64[Tensor, "b n"]
    bodies: Int64[Tensor, "b t"]
    ajar: Int64[Tensor, "b t"]
    piece: Int64[Tensor, " b"]
    mask: Bool[Tensor, "b t"]

    def to(self, device: torch.device | str) -> "TargetBatch":
        """Returns the same batch on a device."""
        moved = {f.name: getattr(self, f.name).to(device, non_blocking=True) for f in fields(self)}
        return replace(self, **moved)


def graph_targets(
    target: FunctionalGraph,
    given: Sequence[str],
    origin: Float64[np.ndarray, "3"],
    scale: float,
    kinds: KindSet = "all",
    facts: PieceFacts = NOT_KNOWN,
) -> GraphTargets:
    """Returns the answers for a functional graph of which the nodes `given` are seen, in the order of the input.

    `origin` (metres) and `scale` (metres per unit) are those of the input's features: x becomes (x - origin) / scale.

    Raises:
        KeyError: if a given id is not in the target.
    """
    arrays = graph_arrays(target, kinds)
    place = {node.id: k for k, node in enumerate(target.nodes)}
    boxes = np.hstack([(arrays.boxes[:, :3] - origin) / scale, arrays.boxes[:, 3:] / scale])
    codes = fact_codes(facts, list(place))
    return GraphTargets(
        labels=arrays.labels,
        boxes=boxes.astype(np.float32),
        edges=arrays.edges,
        child=arrays.child,
        border=arrays.border,
        sign=arrays.sign,
        slide=arrays.slide,
        thin=np.array([node.box.thin_axis for node in target.nodes], dtype=np.int64),
        anchors=np.array([place[name] for name in given], dtype=np.int64),
        bodies=codes.bodies,
        ajar=codes.ajar,
        piece=np.array(codes.kind, dtype=np.int64),
    )


def mirrored_targets(targets: GraphTargets, across: int) -> GraphTargets:
    """Returns the answers for the mirror image across axis 0 (X) or 1 (Y).

    Raises:
        ValueError: if `across` is not 0 or 1.
    """
    if across not in (0, 1):
        raise ValueError(f"`across` must be 0 (X) or 1 (Y): got {across}")
    boxes = targets.boxes.copy()
    boxes[:, across] *= -1
    axes = _PLANE_AXES[targets.thin]
    slot = np.maximum(targets.border, 0) // 2
    pinned, along = (np.take_along_axis(axes, s[:, None], axis=1)[:, 0] for s in (slot, 1 - slot))
    return replace(
        targets,
        boxes=boxes,
        border=_flipped(targets.border, pinned == across),
        sign=_flipped(targets.sign, along != across),
        slide=_flipped(targets.slide, targets.slide // 2 == across),
    )


def stack_targets(graphs: Sequence[GraphTargets], step: int = 1) -> TargetBatch:
    """Returns the graphs as one padded batch of sizes in steps; padding is null, `NONE` and not marked in `mask`.

    Raises:
        ValueError: if there is no graph.
    """
    if not graphs:
        raise ValueError("a batch must hold at least one graph: got none")
    t = stepped(max(len(g.labels) for g in graphs), step)
    n = stepped(max(len(g.anchors) for g in graphs), step)
    return TargetBatch(
        labels=padded([g.labels for g in graphs], (t,), UNKNOWN),
        boxes=padded([g.boxes for g in graphs], (t, 6), 0.0),
        edges=padded([g.edges for g in graphs], (t, t), NULL),
        child=padded([g.child for g in graphs], (t, t), False),
        border=padded([g.border for g in graphs], (t,), NONE),
        sign=padded([g.sign for g in graphs], (t,), NONE),
        slide=padded([g.slide for g in graphs], (t,), NONE),
        anchors=padded([g.anchors for g in graphs], (n,), NONE),
        bodies=padded([g.bodies for g in graphs], (t,), NONE),
        ajar=padded([g.ajar for g in graphs], (t,), NONE),
        piece=torch.tensor([int(g.piece) for g in graphs]),
        mask=padded([np.ones(len(g.labels), dtype=bool) for g in graphs], (t,), False),
    )


def _flipped(codes: np.ndarray, where: np.ndarray) -> np.ndarray:
    """Returns the codes with their last bit, the side or sense, turned where asked and where there is a code."""
    return np.where(where & (codes != NONE), codes ^ 1, codes)
