"""What the network sees of a graph, as arrays: the one definition, for training and for use. No torch.

Labels and edges are codes; boxes and points stand in a frame of the object's own size. What a pair of parts has in
common (their distance, their gaps) the network works out from the boxes, so that a mirror image or one more node needs
no second pass over the points.
"""

from dataclasses import dataclass, replace
from typing import final

import numpy as np
from jaxtyping import Float32, Float64, Int64

from grafu.completion.points_grouping import box_points, group_points, resampled
from grafu.geometry.arrays import ArrayValue, Points, freeze_arrays
from grafu.graph.arrays import graph_arrays
from grafu.graph.functional_graph import FunctionalGraph


@final
@dataclass(frozen=True, slots=True)
class FeatureConfig:
    """How many points of a part the network sees.

    The paper samples 512 points a part and groups them in two stages; `anchors` x `neighbours` is the first. Few groups
    cost accuracy nothing that was seen and save most of the encoder's time; the authors' first stage has 256 x 32.

    Raises:
        ValueError: if a number is less than 1, or `neighbours` or `anchors` exceed `points`.
    """

    points: int = 512
    anchors: int = 32
    neighbours: int = 16

    def __post_init__(self) -> None:
        if not all(1 <= number <= self.points for number in (self.anchors, self.neighbours)):
            raise ValueError(f"`anchors` and `neighbours` must be 1 to `points`: got {self}")


@final
@dataclass(frozen=True, eq=False, slots=True)
class GraphFeatures(ArrayValue):
    """What is seen of n nodes, in the order of the graph; codes are those of `grafu.graph.arrays`.

    `boxes` are centre and half size, `anchors` a part's points spread farthest apart,
    `groups` the nearest points of each anchor, relative to it; all in the normalised frame, in which an object point x
    (metres) is (x - origin) / scale: the object stands on z = 0, centred in x and y, its largest side 1. `edges` are
    symmetric, null where there is none and on the diagonal.
    """

    labels: Int64[np.ndarray, " n"]
    boxes: Float32[np.ndarray, "n 6"]
    anchors: Float32[np.ndarray, "n g 3"]
    groups: Float32[np.ndarray, "n g s 3"]
    edges: Int64[np.ndarray, "n n"]
    origin: Float64[np.ndarray, "3"]
    scale: float

    def __post_init__(self) -> None:
        freeze_arrays(self, "labels", "edges", dtype=np.int64)
        freeze_arrays(self, "boxes", "anchors", "groups", dtype=np.float32)
        freeze_arrays(self, "origin", dtype=np.float64)


def graph_features(graph: FunctionalGraph, config: FeatureConfig = FeatureConfig()) -> GraphFeatures:
    """Returns what the network sees of a graph; nodes without points are seen as the surface of their box."""
    origin, scale = object_frame(graph)
    arrays = graph_arrays(graph)
    centre, half = arrays.boxes[:, :3], arrays.boxes[:, 3:]
    boxes = np.hstack([centre - origin, half]) / scale
    clouds = (_clouds(graph, centre - half, centre + half, config.points) - origin) / scale
    anchors, groups = group_points(clouds.astype(np.float32), config.anchors, config.neighbours)
    return GraphFeatures(arrays.labels, boxes.astype(np.float32), anchors, groups, arrays.edges, origin, scale)


def object_frame(graph: FunctionalGraph) -> tuple[Float64[np.ndarray, "3"], float]:
    """Returns the origin (metres) and the scale (metres per unit) of a graph's features."""
    box = graph.box
    size = float(box.size.max())
    return np.array([box.center[0], box.center[1], box.low[2]]), size if size > 0 else 1.0


def mirrored(features: GraphFeatures, across: int) -> GraphFeatures:
    """Returns what is seen of the mirror image across axis 0 (X) or 1 (Y) of the normalised frame.

    Nearest and farthest points stay so in a mirror: nothing is grouped again.

    Raises:
        ValueError: if `across` is not 0 or 1 (gravity is not mirrored).
    """
    if across not in (0, 1):
        raise ValueError(f"`across` must be 0 (X) or 1 (Y): got {across}")
    signs = np.ones(3, dtype=np.float32)
    signs[across] = -1.0
    boxes = features.boxes.copy()
    boxes[:, :3] *= signs
    return replace(features, boxes=boxes, anchors=features.anchors * signs, groups=features.groups * signs)


def _clouds(graph: FunctionalGraph, low: Points, high: Points, count: int) -> Float64[np.ndarray, "n p 3"]:
    """Returns `count` points of each node, metres."""
    clouds = np.empty((len(graph.nodes), count, 3))
    bare = [k for k, node in enumerate(graph.nodes) if node.points is None]
    clouds[bare] = box_points(low[bare], high[bare], count)
    for k, node in enumerate(graph.nodes):
        if node.points is not None:
            clouds[k] = resampled(node.points.points, count)
    return clouds
