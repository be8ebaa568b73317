"""Doors, flaps and drawers for the cells of a layout, with their true motions. It knows no case.

A door turns about the front edge on its hinge side: there it touches neither its neighbour nor, given a gap of its
thickness squared over twice its width, the far side of an inset opening. Fronts face -Y.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import pi
from typing import Literal, final

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.synth.assembly import Motion, Piece
from grafu.synth.drawer_box import drawer_box
from grafu.synth.finish import PLAIN, Finish, surface_of
from grafu.synth.handles import handle_pieces, held_side, opposite
from grafu.synth.layout import Bay, Cell, Door, Drawer, Edge, Edges, Layout, Pair, Partition, Rect, Side, divide
from grafu.synth.leaves import LeafShape, leaf_surfaces
from grafu.synth.shapes import board
from grafu.vocabulary import JointType, PartLabel

Mount = Literal["overlay", "inset"]
BEHIND_ROOM = 0.05  # metres between a door and the fronts behind it: their knobs need 26 mm
BEHIND_SIDE = 0.035  # metres on either side of the fronts behind a door: an inset door stands there when open


@final
@dataclass(frozen=True, slots=True)
class Setting:
    """Where fronts sit, metres: `plane` is the y of the case's front and `back` that of its back panel's inner face.

    Openings lie `panel` apart; walls behind them stand back by `wall` (half of it on either side of a partition).
    An overlay front stands `seat` before the plane and covers at most `lap` of a panel; an inset front is flush.
    """

    plane: float
    back: float
    mount: Mount = "overlay"
    thickness: float = 0.018
    gap: float = 0.003
    seat: float = 0.001
    lap: float = 1.0
    panel: float = 0.018
    wall: float = 0.0
    slide_gap: float = 0.0125
    finish: Finish = PLAIN

    @property
    def front(self) -> float:
        """The y of the fronts' outer faces."""
        return self.plane - self.seat - self.thickness if self.mount == "overlay" else self.plane

    @property
    def behind(self) -> float:
        """The y of the fronts' inner faces."""
        return self.front + self.thickness


def front_rect(cell: Cell, setting: Setting) -> Rect:
    """Returns the outline of a cell's front: its opening moved outwards (overlay) or inwards (inset) edge by edge."""
    o, e = cell.opening, cell.edges
    left, right, bottom, top = (_reach(edge, setting) for edge in (e.left, e.right, e.bottom, e.top))
    return Rect(o.x0 - left, o.x1 + right, o.z0 - bottom, o.z1 + top)


def front_pieces(cell: Cell, setting: Setting) -> tuple[Piece, ...]:
    """Returns everything that fills a cell: fronts, what lies behind them, shelves."""
    return tuple(_MAKERS[type(cell.leaf)](cell, setting))


def partition_piece(partition: Partition, setting: Setting) -> Piece:
    """Returns a divider or shelf that runs to the back, or a rail 60 mm deep behind the front."""
    r = partition.rect
    depth = min(0.06, (setting.back - setting.plane) / 3)
    back = setting.back if partition.kind == "panel" else setting.plane + depth
    surface = surface_of(board((r.x0, setting.plane, r.z0), (r.x1, back, r.z1)), setting.finish.case)
    if partition.kind == "rail":
        return Piece(PartLabel.BAR, "rail_bar", (surface,))
    label = PartLabel.DIVIDER if partition.upright else PartLabel.SHELF
    return Piece(label, label.value, (surface,))


def inner_span(cell: Cell, setting: Setting) -> tuple[float, float]:
    """Returns the x between the walls of a cell: behind a face frame they stand further apart than its opening."""
    room = {Edge.CASE: setting.wall, Edge.SHARED: setting.wall / 2}
    return cell.opening.x0 - room.get(cell.edges.left, 0.0), cell.opening.x1 + room.get(cell.edges.right, 0.0)


def _reach(edge: Edge, setting: Setting) -> float:
    if edge is Edge.SEAM:
        return -setting.gap / 2
    if setting.mount == "inset" or edge is Edge.STOP:
        return -setting.gap
    cover = setting.panel - setting.gap if edge is Edge.CASE else (setting.panel - setting.gap) / 2
    return min(cover, setting.lap)


def _door_pieces(cell: Cell, setting: Setting) -> Iterator[Piece]:
    door = cell.leaf
    assert isinstance(door, Door)
    limited = replace(door, opening=_opening(door, cell.edges))
    yield _door(limited, front_rect(cell, setting), setting)
    yield from _shelves(door.shelves, cell, setting)
    if door.behind is not None:
        yield from _behind(door.behind, cell, setting)


def _pair_pieces(cell: Cell, setting: Setting) -> Iterator[Piece]:
    pair, o, e = cell.leaf, cell.opening, cell.edges
    assert isinstance(pair, Pair)
    middle, edge = o.center[0], Edge.STOP if pair.muntin else Edge.SEAM
    door = Door("left", pair.leaf, pair.handle, pair.opening, hold=pair.hold, grip=pair.grip)
    half = replace(o, x1=middle - pair.muntin / 2), replace(o, x0=middle + pair.muntin / 2)
    left = Cell(door, half[0], replace(e, right=edge))
    right = Cell(replace(door, hinge="right"), half[1], replace(e, left=edge))
    yield from _door_pieces(left, setting)
    yield from _door_pieces(right, setting)
    if pair.muntin:
        yield _muntin(replace(front_rect(left, setting), x0=half[0].x1, x1=half[1].x0), setting)
    yield from _shelves(pair.shelves, cell, setting)
    if pair.behind is not None:
        yield from _behind(pair.behind, cell, setting)


def _drawer_pieces(cell: Cell, setting: Setting) -> Iterator[Piece]:
    drawer, rect, finish = cell.leaf, front_rect(cell, setting), setting.finish
    assert isinstance(drawer, Drawer)
    o, depth = cell.opening, setting.back - 0.02 - setting.behind
    inner = Rect(o.x0 + setting.slide_gap, o.x1 - setting.slide_gap, o.z0 + 0.012, max(o.z1 - 0.02, o.z0 + 0.02))
    box = drawer_box(drawer.box, inner, (setting.behind, setting.behind + depth))
    leaf = _leaf(drawer, rect, None, setting)
    surfaces = (*leaf_surfaces(leaf, finish), *(surface_of(mesh, finish.inside) for mesh in box))
    middle = rect.center
    slide = Axis(vec3(middle[0], setting.front, middle[1]), vec3(0.0, -1.0, 0.0))
    motion = Motion(JointType.PRISMATIC, slide, drawer.travel * depth)
    handle = handle_pieces(drawer.handle, drawer.hold, leaf, None, finish.metal)
    yield Piece(PartLabel.DRAWER, "drawer", surfaces, motion, handle)


def _bay_pieces(cell: Cell, setting: Setting) -> Iterator[Piece]:
    assert isinstance(cell.leaf, Bay)
    yield from _shelves(cell.leaf.shelves, cell, setting)


_MAKERS: dict[type, Callable[[Cell, Setting], Iterator[Piece]]] = {
    Door: _door_pieces,
    Pair: _pair_pieces,
    Drawer: _drawer_pieces,
    Bay: _bay_pieces,
}


def _door(door: Door, rect: Rect, setting: Setting) -> Piece:
    (x, z), y = rect.center, setting.front
    pins = {
        "left": (vec3(rect.x0, y, z), vec3(0.0, 0.0, -1.0)),
        "right": (vec3(rect.x1, y, z), vec3(0.0, 0.0, 1.0)),
        "top": (vec3(x, y, rect.z1), vec3(-1.0, 0.0, 0.0)),
        "bottom": (vec3(x, y, rect.z0), vec3(1.0, 0.0, 0.0)),
    }
    motion = Motion(JointType.REVOLUTE, Axis(*pins[door.hinge]), door.opening)
    leaf = _leaf(door, rect, door.hinge, setting)
    handle = handle_pieces(door.handle, door.hold, leaf, door.hinge, setting.finish.metal)
    return Piece(PartLabel.DOOR, "door", leaf_surfaces(leaf, setting.finish), motion, handle)


def _leaf(front: Door | Drawer, rect: Rect, hinge: Side | None, setting: Setting) -> LeafShape:
    free = opposite(hinge) if hinge else "top"
    return LeafShape(
        front.leaf, rect, setting.front, setting.thickness, free, front.grip, held_side(front.hold, hinge) or free
    )


def _opening(door: Door, edges: Edges) -> float:
    """Returns how far a door opens, radians: at most square where something juts out beside its pin."""
    return min(door.opening, pi / 2) if getattr(edges, door.hinge) is Edge.STOP else door.opening


def _muntin(rect: Rect, setting: Setting) -> Piece:
    back = max(setting.plane, setting.behind)
    mesh = board((rect.x0, setting.front, rect.z0), (rect.x1, back, rect.z1))
    return Piece(PartLabel.BAR, "muntin", (surface_of(mesh, setting.finish.front),))


def _shelves(count: int, cell: Cell, setting: Setting) -> Iterator[Piece]:
    front, half = max(setting.plane, setting.behind) + 0.01, min(setting.panel, 0.018) / 2
    x0, x1 = inner_span(cell, setting)
    for k in range(count):
        z = cell.opening.z0 + cell.opening.height * (k + 1) / (count + 1)
        mesh = board((x0, front, z - half), (x1, setting.back, z + half))
        yield Piece(PartLabel.SHELF, "shelf", (surface_of(mesh, setting.finish.inside),))


def _behind(layout: Layout, cell: Cell, setting: Setting) -> Iterator[Piece]:
    """Yields inset fronts inside an opening, between two fillers that keep them clear of the door."""
    o, plane = cell.opening, max(setting.plane, setting.behind) + BEHIND_ROOM
    side = BEHIND_SIDE if setting.mount == "inset" else 0.018
    rect = replace(o, x0=o.x0 + side, x1=o.x1 - side)
    for low, high in zip(inner_span(cell, setting), (rect.x0, rect.x1), strict=True):
        mesh = board((min(low, high), plane, o.z0), (max(low, high), setting.back, o.z1))
        yield Piece(PartLabel.DIVIDER, "divider", (surface_of(mesh, setting.finish.inside),))
    inner = replace(setting, plane=plane, mount="inset", wall=0.0)
    for item in divide(layout, rect, Edges(), setting.panel):
        yield from (partition_piece(item, inner),) if isinstance(item, Partition) else front_pieces(item, inner)
