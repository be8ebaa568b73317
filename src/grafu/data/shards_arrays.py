"""One model as plain arrays, and back: what a shard holds of each model.

Training reads these arrays without making a graph of them; `arrays_to_record` makes the checked values. A surface point
takes four bytes, a place on a grid of 1625 steps along each side of the part's box:

    code = (x * 1625 + y) * 1625 + z,   x, y, z = 0..1624 from the box's low corner to its high one

1625 is the largest number whose cube fits into 32 bits. The error is at most 1/3248 of the box's side along each axis:
0.3 mm on a board of one metre, where 512 points lie centimetres apart. What lies on a face of the box stays on it.
Coding what was decoded changes nothing.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import final, get_args

import numpy as np

from grafu.data.pair import Record
from grafu.dataclass import dataclass
from grafu.errors import GraphError
from grafu.geometry.arrays import Points
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.arrays import KIND_CODES, KIND_OF, LABEL_CODES, LABELS, NONE
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Rail, Slide, Turn, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.piece_facts import FactCodes, fact_codes, facts_of
from grafu.shapes import Bool, Float, Float64, Int, Int32, UInt8, UInt16, UInt32
from grafu.synth.specimen import Defect, DefectKind
from grafu.vocabulary import EdgeKind

STEPS = 1625
LARGEST_ERROR = 1 / (2 * (STEPS - 1))  # of the box's side, along each axis

Boxes = Float[np.ndarray, "parts 2 3"]
Counts = Int[np.ndarray, " parts"]
Codes = UInt32[np.ndarray, " p"]

_OUTSIDE = 1e-3  # of the box's diagonal: so far may a point lie outside (readers and files round), and is laid onto it
_OUTSIDE_METRES = 1e-5


def points_to_codes(points: Points, boxes: Boxes, counts: Counts) -> Codes:
    """Returns the codes of all points; `counts` states how many points belong to each box in turn (low, high; metres).

    Raises:
        GraphError: if a point lies outside its box.
    """
    low, size = _per_point(boxes, counts)
    far = np.maximum(low - points, points - low - size).max(axis=1, initial=-np.inf)
    if np.any(far > _OUTSIDE * np.linalg.norm(size, axis=1) + _OUTSIDE_METRES):
        raise GraphError(f"the points of a node must lie in its box: one lies {far.max():.3g} m outside")
    ratio = np.divide(points - low, size, out=np.zeros_like(points), where=size > 0)
    grid = np.rint(np.clip(ratio, 0, 1) * (STEPS - 1)).astype(np.uint32)
    return (grid[:, 0] * STEPS + grid[:, 1]) * STEPS + grid[:, 2]


def codes_to_points(codes: Codes, boxes: Boxes, counts: Counts) -> Points:
    """Returns the points of all codes, metres, in the frame of the boxes (float64)."""
    rest = codes // STEPS
    grid = np.empty((len(codes), 3))
    np.subtract(codes, rest * STEPS, out=grid[:, 2], casting="unsafe")
    np.floor_divide(rest, STEPS, out=grid[:, 0], casting="unsafe")
    np.subtract(rest, (rest // STEPS) * STEPS, out=grid[:, 1], casting="unsafe")
    low, size = boxes[:, 0], boxes[:, 1] - boxes[:, 0]
    if len(counts) and np.all(counts == counts[0]):
        per_box = grid.reshape(len(counts), -1, 3)
        per_box *= size[:, None] / (STEPS - 1)
        per_box += low[:, None]
        return np.minimum(per_box, boxes[:, None, 1]).reshape(-1, 3)
    lows, sizes = _per_point(boxes, counts)
    return np.minimum(lows + grid * (sizes / (STEPS - 1)), lows + sizes)


def _per_point(boxes: Boxes, counts: Counts) -> tuple[Points, Points]:
    """Returns the low corner and the side lengths of each point's box."""
    return np.repeat(boxes[:, 0], counts, axis=0), np.repeat(boxes[:, 1] - boxes[:, 0], counts, axis=0)


DEFECT_KINDS: tuple[DefectKind, ...] = get_args(DefectKind)
ABSENT = 255  # the given label of a node that is not given; what is not known of a part or a piece
NO_BODY = 65_535  # the body of a part whose body is not known

EdgeArray = UInt16[np.ndarray, "edges 4"]
GivenEdgeArray = UInt16[np.ndarray, "given_edges 4"]
ByteArray = UInt8[np.ndarray, " parts"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class ModelArrays:
    """One model: arrays along its nodes (in the truth's order) and its edges.

    `labels` are codes (`grafu.graph.arrays`), `given_labels` too, or `ABSENT`. `boxes` hold low and high corner,
    metres; `transparent` the transparent fractions of surfaces. A row of `edges` (the truth's) and `given_edges` is:
    place of the first node (the parent), of the second (the child), code of the kind, motion: 2 * border + sign of a
    hinge, signed axis of a rail, slide or turn, else 0. That a part follows another is left out. `bodies` are 0 for
    parts that stand, else 1 more than the place of the moving part that they move as one with, `NO_BODY` where it is
    not known; `ajar` is 0 or 1, or `ABSENT`; `piece` a place in `PIECES`, or `ABSENT`.
    `points` are coded as in `shards_points`, `counts` of them for each node.
    """

    model_id: str
    family: str
    node_ids: Sequence[str]
    source_names: Sequence[str]
    labels: ByteArray
    given_labels: ByteArray
    bodies: UInt16[np.ndarray, " parts"]
    ajar: ByteArray
    piece: int
    removable: Bool[np.ndarray, " parts"]
    boxes: Boxes
    transparent: Float64[np.ndarray, " parts"]
    edges: EdgeArray
    given_edges: GivenEdgeArray
    defects: tuple[Defect, ...]
    counts: Int32[np.ndarray, " parts"]
    points: Codes


def record_to_arrays(record: Record) -> ModelArrays:
    """Returns the record as arrays.

    Raises:
        GraphError: if a node's points lie outside its box.
    """
    nodes = record.truth.nodes
    places = {node.id: place for place, node in enumerate(nodes)}
    given = {node.id: LABEL_CODES[node.label] for node in record.given.nodes}
    boxes = np.array([(n.box.low, n.box.high) for n in nodes], dtype=np.float64).reshape(-1, 2, 3)
    counts = np.array([0 if n.points is None else len(n.points.points) for n in nodes], dtype=np.int32)
    clouds = [n.points.points for n in nodes if n.points is not None]
    return ModelArrays(
        record.model_id,
        record.family,
        tuple(places),
        tuple(n.source_name for n in nodes),
        np.array([LABEL_CODES[n.label] for n in nodes], dtype=np.uint8),
        np.array([given.get(n.id, ABSENT) for n in nodes], dtype=np.uint8),
        *_fact_arrays(fact_codes(record.facts, list(places))),
        np.array([n.id in record.removable for n in nodes], dtype=np.bool_),
        boxes,
        np.array([n.transparent for n in nodes], dtype=np.float64),
        _edge_array(record.truth.edges, places),
        _edge_array(record.given.edges, places),
        record.defects,
        counts,
        points_to_codes(np.concatenate(clouds) if clouds else np.zeros((0, 3)), boxes, counts),
    )


def arrays_to_record(arrays: ModelArrays) -> Record:
    """Returns the record that the arrays say.

    Raises:
        GraphError: if the graphs break an invariant.
    """
    nodes = _nodes(arrays)
    given_nodes = tuple(
        node if code == label else replace(node, label=LABELS[code])
        for node, code, label in zip(nodes, arrays.given_labels.tolist(), arrays.labels.tolist(), strict=True)
        if code != ABSENT
    )
    ids = arrays.node_ids
    return Record(
        arrays.model_id,
        arrays.family,
        FunctionalGraph(arrays.model_id, given_nodes, _edges(arrays.given_edges, ids)),
        FunctionalGraph(arrays.model_id, nodes, _edges(arrays.edges, ids)),
        frozenset(ids[place] for place in np.flatnonzero(arrays.removable).tolist()),
        arrays.defects,
        facts_of(_fact_codes(arrays), ids),
    )


def _fact_arrays(codes: FactCodes) -> tuple[np.ndarray, np.ndarray, int]:
    bodies = np.where(codes.bodies == NONE, NO_BODY, codes.bodies).astype(np.uint16)
    ajar = np.where(codes.ajar == NONE, ABSENT, codes.ajar).astype(np.uint8)
    return bodies, ajar, ABSENT if codes.kind == NONE else codes.kind


def _fact_codes(arrays: ModelArrays) -> FactCodes:
    bodies, ajar = arrays.bodies.astype(np.int64), arrays.ajar.astype(np.int64)
    kind = NONE if arrays.piece == ABSENT else arrays.piece
    return FactCodes(np.where(bodies == NO_BODY, NONE, bodies), np.where(ajar == ABSENT, NONE, ajar), kind)


def _nodes(arrays: ModelArrays) -> tuple[PartNode, ...]:
    columns = zip(
        arrays.node_ids,
        arrays.labels.tolist(),
        arrays.boxes,
        _clouds(arrays),
        arrays.source_names,
        arrays.transparent.tolist(),
        strict=True,
    )
    return tuple(
        PartNode(node_id, LABELS[label], Box(box[0], box[1]), cloud, source, transparent)
        for node_id, label, box, cloud, source, transparent in columns
    )


def _clouds(arrays: ModelArrays) -> list[PointCloud | None]:
    if not len(arrays.points):
        return [None] * len(arrays.counts)
    points = codes_to_points(arrays.points, arrays.boxes, arrays.counts)
    ends = np.cumsum(arrays.counts).tolist()
    return [
        PointCloud(points[end - count : end]) if count else None
        for end, count in zip(ends, arrays.counts.tolist(), strict=True)
    ]


def _edge_array(edges: Sequence[Edge], places: dict[str, int]) -> EdgeArray:
    rows = []
    for edge in edges:
        a, b = ends_of(edge)
        rows.append((places[a], places[b], KIND_CODES[kind_of(edge)], _motion_code(edge)))
    return np.array(rows, dtype=np.uint16).reshape(-1, 4)


def _motion_code(edge: Edge) -> int:
    if isinstance(edge, Hinge):
        return 2 * edge.border + edge.sign
    return 0 if isinstance(edge, Contact | Attached) else edge.axis


def _edges(rows: EdgeArray, ids: Sequence[str]) -> tuple[Edge, ...]:
    return tuple(_edge(ids[a], ids[b], KIND_OF[kind], code) for a, b, kind, code in rows.tolist())


def _edge(first: str, second: str, kind: EdgeKind, code: int) -> Edge:
    if kind is EdgeKind.CONTACT:
        return Contact(first, second)
    if kind is EdgeKind.ATTACHED:
        return Attached(first, second)
    if kind is EdgeKind.HINGE:
        return Hinge(first, second, code // 2, code % 2)  # type: ignore[arg-type]  # the edge checks its codes
    along: type[Rail | Slide | Turn] = Rail if kind is EdgeKind.RAIL else Slide if kind is EdgeKind.SLIDE else Turn
    return along(first, second, code)  # type: ignore[arg-type]
