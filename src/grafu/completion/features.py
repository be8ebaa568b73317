"""What the network sees of a graph, as arrays: the one definition, for training and for use. No torch.

Labels and edges are codes; boxes and points stand in a frame of the object's own size. What a pair of parts has in
common (their distance, their gaps) the network works out from the boxes, so that a mirror image or one more node needs
no second pass over the points.

Points of parts in groups, many parts at once: spread anchors, and the nearest points of each (PointNet++).

Everything is the same for the same points, and for one part alone as for many.

What the network states about one graph, as plain arrays.
"""

from dataclasses import fields, replace
from typing import final

import numpy as np

from grafu.completion.name_codes import name_codes
from grafu.completion.visibility import visibility_of
from grafu.dataclass import dataclass
from grafu.geometry.arrays import ArrayValue, Points, freeze_arrays
from grafu.graph.arrays import KindSet, graph_arrays
from grafu.graph.functional_graph import FunctionalGraph
from grafu.shapes import Float, Float32, Float64, Int64


@final
@dataclass(frozen=True, eq=False, slots=True)
class Scores(ArrayValue):
    """Logits and boxes of s slots: first one for each node that was seen, then the free ones.

    Boxes stand in the normalised frame of the features. A pair (i, j) asks about i as the child (the door, drawer or
    handle) and j as what carries it. `parent_abstain` and `hinge_abstain` speak for no slot at all. Codes are those of
    `grafu.graph.arrays` and, for motions, the authors'. `body` is that two parts move as one, `ajar` that a part is
    drawn open, `piece` the kind of the whole piece, in the order of `PieceKind`.
    """

    exists: Float32[np.ndarray, " s"]
    category: Float32[np.ndarray, "s labels"]
    centre: Float32[np.ndarray, "s 3"]
    half: Float32[np.ndarray, "s 3"]
    edge: Float32[np.ndarray, "s s kinds"]
    parent: Float32[np.ndarray, "s s"]
    parent_abstain: float
    hinge_target: Float32[np.ndarray, "s s"]
    hinge_abstain: float
    border: Float32[np.ndarray, "s s 4"]
    sign: Float32[np.ndarray, "s s 2"]
    slide: Float32[np.ndarray, "s s 6"]
    body: Float32[np.ndarray, "s s"]
    ajar: Float32[np.ndarray, " s"]
    piece: Float32[np.ndarray, " pieces"]

    def __post_init__(self) -> None:
        freeze_arrays(self, dtype=np.float32)


SCORE_NAMES: tuple[str, ...] = tuple(field.name for field in fields(Scores))


# The fractional parts of multiples of these fill the unit cube evenly (Roberts' sequence: the root of x^4 = x + 1).
_SPREAD = 1.0 / 1.2207440846057596 ** np.arange(1, 4)


def group_points(
    clouds: Float32[np.ndarray, "n p 3"], anchors: int, neighbours: int, radius: float | None = None
) -> tuple[Float32[np.ndarray, "n g 3"], Float32[np.ndarray, "n g s 3"]]:
    """Returns for each cloud its anchors, spread farthest apart, and each anchor's nearest points relative to it.

    With a radius, they are the first of its points within that, in their order, repeated where they are fewer.
    """
    if not len(clouds):
        shape = (0, anchors, neighbours, 3)
        return np.zeros((0, anchors, 3), dtype=np.float32), np.zeros(shape, dtype=np.float32)
    rows = np.arange(len(clouds))[:, None]
    centres = clouds[rows, farthest_points(clouds, anchors)]
    nearest = _nearest(clouds, centres, neighbours) if radius is None else _within(clouds, centres, neighbours, radius)
    groups = clouds[rows[:, :, None], nearest] - centres[:, :, None]
    return centres, groups


def farthest_points(clouds: Float32[np.ndarray, "n p 3"], count: int) -> np.ndarray:
    """Returns the places of `count` points of each cloud: the farthest from its mean, then ever the farthest from all.

    A cloud of fewer different points repeats its first ones.
    """
    across = np.ascontiguousarray(clouds.transpose(2, 0, 1))  # one coordinate at a time is twice as fast
    rows = np.arange(len(clouds))
    chosen = np.empty((len(clouds), count), dtype=np.int64)
    away = _squared(across, across.mean(axis=2))
    for k in range(count):
        chosen[:, k] = away.argmax(axis=1)
        from_last = _squared(across, across[:, rows, chosen[:, k]])
        away = from_last if k == 0 else np.minimum(away, from_last)
    return chosen


def box_points(low: Points, high: Points, count: int) -> Float[np.ndarray, "n p 3"]:
    """Returns points spread evenly over the surface of each box, always the same ones."""
    spread = (0.5 + np.arange(1, count + 1)[:, None] * _SPREAD) % 1.0
    size = high - low
    areas = size[:, [1, 2, 0]] * size[:, [2, 0, 1]]  # of the two faces square to each axis
    ends = np.cumsum(areas, axis=1)
    where = spread[None, :, 2] * ends[:, -1:]
    face = (where[:, :, None] >= ends[:, None, :2]).sum(axis=2)
    width = np.maximum(np.take_along_axis(areas, face, axis=1), 1e-300)
    within = (where - np.take_along_axis(ends - areas, face, axis=1)) / width
    rows, columns = np.indices(face.shape)
    ratios = np.empty((*face.shape, 3))
    ratios[rows, columns, (face + 1) % 3] = spread[None, :, 0]
    ratios[rows, columns, (face + 2) % 3] = spread[None, :, 1]
    ratios[rows, columns, face] = within >= 0.5
    return low[:, None] + ratios * size[:, None]


def resampled(points: Points, count: int) -> Float[np.ndarray, "p 3"]:
    """Returns exactly `count` of the points: evenly picked where there are more, repeated where there are fewer."""
    if len(points) == count:
        return points
    places = np.arange(count) * len(points) // count if len(points) > count else np.arange(count) % len(points)
    return points[places]


def _squared(across: Float32[np.ndarray, "3 n p"], centres: Float32[np.ndarray, "3 n"]) -> Float32[np.ndarray, "n p"]:
    """Returns the squared distance of each point from its cloud's centre."""
    x, y, z = across - centres[:, :, None]
    return x * x + y * y + z * z


def _nearest(clouds: Float32[np.ndarray, "n p 3"], centres: Float32[np.ndarray, "n g 3"], count: int) -> np.ndarray:
    """Returns the places of each centre's nearest points, in no order of theirs."""
    middle = clouds.mean(axis=1, keepdims=True)
    points, around = clouds - middle, centres - middle
    # Up to what is the same for all points of a centre, the squared distance.
    away = (points * points).sum(axis=2)[:, None, :] - 2.0 * (around @ points.transpose(0, 2, 1))
    return np.argpartition(away, count - 1, axis=2)[:, :, :count]


def _within(
    clouds: Float32[np.ndarray, "n p 3"], centres: Float32[np.ndarray, "n g 3"], count: int, radius: float
) -> np.ndarray:
    """Returns the places of the first `count` points within a radius of each centre; the first again where few are."""
    found = np.empty((*centres.shape[:2], count), dtype=np.int64)
    for places, points, around in zip(found, clouds, centres, strict=True):  # one part at a time: all pairs are many
        across = np.ascontiguousarray(around.T)[:, :, None] - np.ascontiguousarray(points.T)[:, None, :]
        inside = (across * across).sum(axis=0) <= radius * radius
        order = np.where(inside, np.arange(len(points)), len(points) - 1)
        first = np.sort(order, axis=1)[:, :count]
        places[:] = np.where(np.arange(count) < inside.sum(axis=1)[:, None], first, first[:, :1])
    return found


@final
@dataclass(frozen=True, slots=True)
class FeatureConfig:
    """How many points of a part the network sees, and which kinds of edges it knows.

    The paper samples 512 points a part and groups them in two stages; `anchors` x `neighbours` is the first. Few groups
    cost accuracy nothing that was seen and save most of the encoder's time; the authors' first stage has 256 x 32.
    `radius` (of the object's size) makes groups of the first points within it, as the authors' has with 0.2; None: of
    the nearest ones.

    Raises:
        ValueError: if a number is less than 1, the radius not above 0, or `neighbours` or `anchors` exceed `points`.
    """

    points: int = 512
    anchors: int = 32
    neighbours: int = 16
    kinds: KindSet = "all"
    radius: float | None = None

    def __post_init__(self) -> None:
        if self.radius is not None and self.radius <= 0:
            raise ValueError(f"`radius` must be above 0, or None: got {self.radius}")
        if not all(1 <= number <= self.points for number in (self.anchors, self.neighbours)):
            raise ValueError(f"`anchors` and `neighbours` must be 1 to `points`: got {self}")


@final
@dataclass(frozen=True, eq=False, slots=True)
class GraphFeatures(ArrayValue):
    """What is seen of n nodes, in the order of the graph; codes are those of `grafu.graph.arrays`.

    `boxes` are centre and half size, `anchors` a part's points spread farthest apart,
    `groups` the nearest points of each anchor, relative to it; all in the normalised frame, in which an object point x
    (metres) is (x - origin) / scale: the object stands on z = 0, centred in x and y, its largest side 1. `edges` are
    symmetric, null where there is none and on the diagonal. `names` are the pieces of the input's own words
    (`name_codes`), `transparent` the fractions of their surfaces through which one sees.
    """

    labels: Int64[np.ndarray, " n"]
    boxes: Float32[np.ndarray, "n 6"]
    anchors: Float32[np.ndarray, "n g 3"]
    groups: Float32[np.ndarray, "n g s 3"]
    edges: Int64[np.ndarray, "n n"]
    names: Int64[np.ndarray, "n c"]
    transparent: Float32[np.ndarray, " n"]
    origin: Float64[np.ndarray, "3"]
    scale: float

    def __post_init__(self) -> None:
        freeze_arrays(self, "labels", "edges", "names", dtype=np.int64)
        freeze_arrays(self, "boxes", "anchors", "groups", "transparent", dtype=np.float32)
        freeze_arrays(self, "origin", dtype=np.float64)

    @property
    def visibility(self) -> Float32[np.ndarray, "n 18"]:
        """How much of each part is visible from each side, and what lies behind it (`visibility_of`)."""
        return visibility_of(self.anchors, self.groups)


def graph_features(graph: FunctionalGraph, config: FeatureConfig = FeatureConfig()) -> GraphFeatures:
    """Returns what the network sees of a graph; nodes without points are seen as the surface of their box."""
    origin, scale = object_frame(graph)
    arrays = graph_arrays(graph, config.kinds)
    centre, half = arrays.boxes[:, :3], arrays.boxes[:, 3:]
    boxes = np.hstack([centre - origin, half]) / scale
    clouds = (_clouds(graph, centre - half, centre + half, config.points) - origin) / scale
    anchors, groups = group_points(clouds.astype(np.float32), config.anchors, config.neighbours, config.radius)
    names = name_codes([node.source_name for node in graph.nodes])
    transparent = np.array([node.transparent for node in graph.nodes], dtype=np.float32)
    return GraphFeatures(
        arrays.labels, boxes.astype(np.float32), anchors, groups, arrays.edges, names, transparent, origin, scale
    )


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
