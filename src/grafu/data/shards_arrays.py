"""One model as plain arrays, and back: what a shard holds of each model. It knows no files.

Training reads these arrays without making a graph of them; `arrays_to_record` makes the checked values.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import final, get_args

import numpy as np
from jaxtyping import Bool, Int32, UInt8, UInt16

from grafu.data.shards_points import Boxes, Codes, codes_to_points, points_to_codes
from grafu.data.shards_record import Record
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.arrays import KIND_CODES, KINDS, LABEL_CODES, LABELS
from grafu.graph.edges import Attached, Contact, Edge, Hinge, Rail, ends_of, kind_of
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.synth.specimen import Defect, DefectKind
from grafu.vocabulary import EdgeKind

DEFECT_KINDS: tuple[DefectKind, ...] = get_args(DefectKind)
ABSENT = 255  # the given label of a node that is not given

EdgeArray = UInt16[np.ndarray, "edges 4"]
GivenEdgeArray = UInt16[np.ndarray, "given_edges 4"]
ByteArray = UInt8[np.ndarray, " parts"]


@final
@dataclass(frozen=True, slots=True, eq=False)
class ModelArrays:
    """One model: arrays along its nodes (in the truth's order) and its edges.

    `labels` are codes (`grafu.graph.arrays`), `given_labels` too, or `ABSENT`. `boxes` hold low and high corner,
    metres. A row of `edges` (the truth's) and `given_edges` is: place of the first node (the parent), of the second
    (the child), code of the kind, motion: 2 * border + sign of a hinge, signed axis of a rail, else 0 (official.md 3).
    `points` are coded as in `shards_points`, `counts` of them for each node.
    """

    model_id: str
    family: str
    node_ids: Sequence[str]
    source_names: Sequence[str]
    labels: ByteArray
    given_labels: ByteArray
    removable: Bool[np.ndarray, " parts"]
    boxes: Boxes
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
        np.array([n.id in record.removable for n in nodes], dtype=np.bool_),
        boxes,
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
        node if code == label else PartNode(node.id, LABELS[code], node.box, node.points, node.source_name)
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
    )


def _nodes(arrays: ModelArrays) -> tuple[PartNode, ...]:
    columns = zip(
        arrays.node_ids, arrays.labels.tolist(), arrays.boxes, _clouds(arrays), arrays.source_names, strict=True
    )
    return tuple(
        PartNode(node_id, LABELS[label], Box(box[0], box[1]), cloud, source)
        for node_id, label, box, cloud, source in columns
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
    return edge.axis if isinstance(edge, Rail) else 0


def _edges(rows: EdgeArray, ids: Sequence[str]) -> tuple[Edge, ...]:
    return tuple(_edge(ids[a], ids[b], KINDS[kind], code) for a, b, kind, code in rows.tolist())


def _edge(first: str, second: str, kind: EdgeKind, code: int) -> Edge:
    if kind is EdgeKind.CONTACT:
        return Contact(first, second)
    if kind is EdgeKind.ATTACHED:
        return Attached(first, second)
    if kind is EdgeKind.HINGE:
        return Hinge(first, second, code // 2, code % 2)  # type: ignore[arg-type]  # the edge checks its codes
    return Rail(first, second, code)  # type: ignore[arg-type]
