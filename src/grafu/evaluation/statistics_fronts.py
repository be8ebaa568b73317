"""Measures of doors, drawers, handles and tops of one model.

Made and real furniture pass through the same lines, so that a difference between them is one of the furniture. What is
judged is the geometry and the edges; a part is a door where the graph hangs it on a hinge or labels it so.
"""

from collections.abc import Iterable
from typing import Literal, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Points, Vec3
from grafu.geometry.box import Box
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.graph.motion import border_to_face, code_to_direction, plane_axes
from grafu.vocabulary import PartLabel

HingeSide = Literal["left", "right", "top", "bottom", "lid"]
HandlePlace = Literal["opposite", "centre", "same"]

_UP = np.array([0.0, 0.0, 1.0])
_THIRDS = (0.4, 0.6)  # between these fractions of the distance from pin to free edge, a handle is in the middle
_GRID = 12  # points a side at which a top is looked for
_LEVEL = 0.8  # least |cosine| between a face's normal and Z for it to be level
_BELOW = 0.03  # fraction of the object's largest side by which a top may lie below the upper edge of what it covers


@final
@dataclass(frozen=True, slots=True)
class MeasuredFront:
    """A door or a drawer as seen from in front of it: sizes in metres, `depth` across the front.

    `handles` are the boxes of its handles. `hinge_side` is where a door hangs, seen from outside (a lid's is `lid`);
    None for drawers and for doors whose motion is not stated. `along` holds for each handle how far it sits along the
    path from the pin (0) to the free edge (1); empty without a hinge.
    """

    node: PartNode
    width: float
    height: float
    depth: float
    handles: tuple[Box, ...] = ()
    hinge_side: HingeSide | None = None
    along: tuple[float, ...] = ()

    @property
    def handle_place(self) -> HandlePlace | None:
        """Where the first handle sits against the hinge; None without handle or hinge."""
        if not self.along:
            return None
        near, far = _THIRDS
        return "same" if self.along[0] < near else "opposite" if self.along[0] > far else "centre"

    @property
    def handle_ratio(self) -> float | None:
        """The length of the first handle as a fraction of the front's own length along it; None without a handle."""
        if not self.handles:
            return None
        size = self.handles[0].size
        longest = int(np.argmax(size))
        own = self.node.box.size[longest]
        return float(size[longest] / own) if own > 0 else None

    @property
    def handle_height(self) -> float | None:
        """The height of the first handle's middle on the front: 0 its lower edge, 1 its upper; None without."""
        if not self.handles or self.node.box.size[2] <= 0:
            return None
        return float((self.handles[0].center[2] - self.node.box.low[2]) / self.node.box.size[2])


def doors_of(graph: FunctionalGraph) -> tuple[MeasuredFront, ...]:
    """Returns the doors: what hangs on a hinge, and what is labelled so."""
    hinged = {edge.child: edge for edge in graph.hinges}
    nodes = [n for n in graph.nodes if n.id in hinged or n.label is PartLabel.DOOR]
    found = []
    for node in nodes:
        thin = node.box.thin_axis
        width, height = _width_and_height(node.box, thin)
        handles = _handles(graph, node)
        side: HingeSide | None = None
        along: tuple[float, ...] = ()
        if node.id in hinged:
            pin = code_to_direction(border_to_face(thin, hinged[node.id].border))
            side = _side(node.box, graph.box.center, pin)
            along = tuple(_way_from_pin(node.box, pin, handle) for handle in handles)
        found.append(MeasuredFront(node, width, height, float(node.box.size[thin]), handles, side, along))
    return tuple(found)


def drawers_of(graph: FunctionalGraph) -> tuple[MeasuredFront, ...]:
    """Returns the drawers: what runs on rails, and what is labelled so (then it is taken to open along Y)."""
    slides = {edge.child: edge.axis // 2 for edge in graph.rails}
    nodes = [n for n in graph.nodes if n.id in slides or n.label is PartLabel.DRAWER]
    found = []
    for node in nodes:
        across = slides.get(node.id, 1)
        width, height = _width_and_height(node.box, across)
        found.append(MeasuredFront(node, width, height, float(node.box.size[across]), _handles(graph, node)))
    return tuple(found)


def lacks_top(asset: Asset, graph: FunctionalGraph) -> bool:
    """Whether nothing level covers the topmost doors and drawers (without any: the whole footprint) by half.

    The space under judgement is a drawer's own box, or a door's box stretched to the far side of the object. Labels
    say only what moves; what covers is any level face of a part that stays.
    """
    moving = [front.node for front in (*doors_of(graph), *drawers_of(graph))]
    still = {n.id for n in graph.nodes} - {n.id for n in moving} - {n.id for n in graph.labelled(PartLabel.HANDLE)}
    faces = _level_faces(asset, still)
    if not moving:
        top = float(asset.box.high[2]) - 0.1 * float(asset.box.size[2])
        return _covered(faces, asset.box, top) < 0.5
    highest = max(float(n.box.high[2]) for n in moving)
    upper = [n for n in moving if n.box.high[2] > highest - 0.02 * asset.extent]
    spaces = [(_space_behind(n, asset.box), float(n.box.high[2]) - _BELOW * asset.extent) for n in upper]
    return float(np.mean([_covered(faces, box, level) for box, level in spaces])) < 0.5


def _width_and_height(box: Box, across: int) -> tuple[float, float]:
    """Returns the sides of a front whose depth runs along `across`; a lid's longer side counts as its width."""
    first, second = (float(box.size[a]) for a in plane_axes(across))
    return (first, second) if across != 2 else (max(first, second), min(first, second))


def _handles(graph: FunctionalGraph, node: PartNode) -> tuple[Box, ...]:
    return tuple(graph.node(edge.child).box for edge in graph.attachments if edge.parent == node.id)


def _side(box: Box, middle: Vec3, pin: Vec3) -> HingeSide:
    """Returns on which side the pin lies for who stands before the door, on its side away from the middle."""
    thin = box.thin_axis
    if thin == 2:
        return "lid"
    if abs(pin[2]) > 0.5:
        return "top" if pin[2] > 0 else "bottom"
    outward = np.zeros(3)
    outward[thin] = 1.0 if box.center[thin] > middle[thin] else -1.0
    return "right" if float(np.cross(_UP, outward) @ pin) > 0 else "left"


def _way_from_pin(box: Box, pin: Vec3, handle: Box) -> float:
    axis = int(np.argmax(np.abs(pin)))
    ratio = (float(handle.center[axis]) - box.low[axis]) / max(float(box.size[axis]), 1e-9)
    return float(np.clip(1.0 - ratio if pin[axis] > 0 else ratio, 0.0, 1.0))


def _space_behind(node: PartNode, around: Box) -> Box:
    thin = node.box.thin_axis
    if node.label is PartLabel.DRAWER or thin == 2:
        return node.box
    low, high = node.box.low.copy(), node.box.high.copy()
    if node.box.center[thin] > around.center[thin]:
        low[thin] = around.low[thin]
    else:
        high[thin] = around.high[thin]
    return Box(low, high)


def _level_faces(asset: Asset, ids: Iterable[str]) -> np.ndarray:
    """Returns the corners of all near-level triangles of some parts, (n, 3, 3)."""
    meshes = [asset.part(i).mesh for i in sorted(ids)]
    found = [m.triangles[np.abs(m.face_normals[:, 2]) > _LEVEL] for m in meshes if len(m.faces)]
    return np.concatenate(found) if found else np.zeros((0, 3, 3))


def _covered(faces: np.ndarray, box: Box, level: float) -> float:
    """Returns the fraction of a grid over a box's footprint that lies under a face at `level` metres or above."""
    high = faces[faces[:, :, 2].max(axis=1) >= level]
    steps = (np.arange(_GRID) + 0.5) / _GRID
    x, y = np.meshgrid(box.low[0] + steps * box.size[0], box.low[1] + steps * box.size[1])
    points = np.stack([x.ravel(), y.ravel()], axis=1)
    if not len(high):
        return 0.0
    low_xy, high_xy = high[:, :, :2].min(axis=1), high[:, :, :2].max(axis=1)
    near = np.all((high_xy >= box.low[:2]) & (low_xy <= box.high[:2]), axis=1)
    return float(_inside_any(points, high[near][:, :, :2]).mean())


def _inside_any(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Returns for each point (n, 2) whether it lies in one of the triangles (m, 3, 2)."""
    edges = np.roll(triangles, -1, axis=1) - triangles
    away = points[:, None, None, :] - triangles[None]
    turns = edges[None, ..., 0] * away[..., 1] - edges[None, ..., 1] * away[..., 0]
    inside = np.all(turns >= 0, axis=2) | np.all(turns <= 0, axis=2)
    return inside.any(axis=1)


def boxes_of(nodes: Iterable[PartNode]) -> tuple[Points, Points]:
    """Returns the low and high corners of the nodes' boxes, a row each."""
    boxes = [n.box for n in nodes]
    return np.array([b.low for b in boxes]).reshape(-1, 3), np.array([b.high for b in boxes]).reshape(-1, 3)
