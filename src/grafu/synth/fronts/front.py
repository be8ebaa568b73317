"""Doors, flaps and drawers for the cells of a layout, with their true motions.

A door turns about the front edge on its hinge side: there it touches neither its neighbour nor, given a gap of its
thickness squared over twice its width, the far side of an inset opening. Fronts face -Y.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import pi

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.synth.fronts.drawer_box import drawer_box, tray_level, tray_meshes
from grafu.synth.fronts.gliding import Folding, Lift, PullOut, Sliding, WasteBins
from grafu.synth.fronts.gliding_front import folding_pieces, sliding_pieces
from grafu.synth.fronts.handles import gripped_side, handle_pieces, held_along, opposite
from grafu.synth.fronts.interior import RUNNER, interior_pieces, runner_pieces
from grafu.synth.fronts.layout import (
    CURVED,
    Blank,
    Cell,
    Door,
    Drawer,
    Edge,
    Edges,
    Layout,
    OpenCell,
    Pair,
    Partition,
    Rect,
    Side,
    Tilt,
    divide,
)
from grafu.synth.fronts.leaf_relief import LeafShape, bend_at_hinge
from grafu.synth.fronts.leaves import leaf_surfaces
from grafu.synth.fronts.lift_front import lift_pieces
from grafu.synth.fronts.pull_out_front import bin_pieces, pull_out_pieces
from grafu.synth.fronts.setting import Setting, front_rect, inner_span
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, plank
from grafu.synth.pieces.finish import surface_of
from grafu.synth.pieces.shapes import board
from grafu.vocabulary import JointType, PartLabel

BEHIND_ROOM = 0.05  # metres between a door and the fronts behind it: their knobs need 26 mm
TRAY_GAP = 0.001  # metres on either side of a tray that no runners carry: it lies in grooves
RAIL_DEPTH = 0.06  # metres
HINGE_RAIL = (0.016, 0.01)  # metres below and above a seam: drawers' boxes keep 20 mm and 12 mm clear there
BEHIND_SIDE = 0.035  # metres on either side of the fronts behind a door: an inset door stands there when open


def front_pieces(cell: Cell, setting: Setting) -> tuple[PieceDraft, ...]:
    """Returns everything that fills a cell: fronts, what lies behind them, shelves."""
    return tuple(_MAKERS[type(cell.leaf)](cell, setting))


def partition_pieces(partition: Partition, setting: Setting) -> Iterator[PieceDraft]:
    """Yields a divider or shelf that runs to the back, a rail 60 mm deep behind the front, or an open level frame.

    The frame has such a rail in front and at the back and a drawer's rail along either wall; an upright one is a panel.
    """
    r, wood = partition.rect, setting.finish.case
    depth = min(RAIL_DEPTH, (setting.back - setting.plane) / 3)
    y0, y1 = setting.plane, setting.back
    if partition.kind == "panel" or (partition.kind == "frame" and partition.upright):
        label = PartLabel.DIVIDER if partition.upright else PartLabel.SHELF
        yield plank(label, label.value, wood, ((r.x0, y0, r.z0), (r.x1, y1, r.z1)))
        return
    yield plank(PartLabel.BAR, "rail_bar", wood, ((r.x0, y0, r.z0), (r.x1, y0 + depth, r.z1)))
    if partition.kind == "frame":
        wide = min(depth, r.width / 4)
        yield plank(PartLabel.BAR, "rail_bar", wood, ((r.x0, y1 - depth, r.z0), (r.x1, y1, r.z1)))
        for low, high in ((r.x0, r.x0 + wide), (r.x1 - wide, r.x1)):
            yield plank(PartLabel.BAR, "drawer_rail", wood, ((low, y0 + depth, r.z0), (high, y1 - depth, r.z1)))


def _door_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    door = cell.leaf
    assert isinstance(door, Door)
    rect = front_rect(cell, setting)
    yield _door(replace(door, opening=_opening(door, cell.edges, rect.width)), rect, setting)
    yield from _hinge_rail(door, cell, setting)
    if door.behind is not None:
        yield from _behind(door.behind, cell, setting)
    else:
        yield from interior_pieces(door.shelves, door.inside, cell, setting)


def _pair_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    pair, o, e = cell.leaf, cell.opening, cell.edges
    assert isinstance(pair, Pair)
    middle, edge = o.center[0], Edge.STOP if pair.muntin else Edge.SEAM
    door = Door("left", pair.leaf, pair.handle, pair.opening, hold=pair.hold, grip=pair.grip)
    half = replace(o, x1=middle - pair.muntin / 2), replace(o, x0=middle + pair.muntin / 2)
    left = Cell(door, half[0], replace(e, right=edge))
    right = Cell(replace(door, hinge="right"), half[1], replace(e, left=edge))
    for half_cell in (left, right):
        rect, leaf = front_rect(half_cell, setting), half_cell.leaf
        assert isinstance(leaf, Door)
        yield _door(replace(leaf, opening=_opening(leaf, half_cell.edges, rect.width)), rect, setting)
    if pair.muntin:
        yield _muntin(replace(front_rect(left, setting), x0=half[0].x1, x1=half[1].x0), setting)
    if pair.behind is not None:
        yield from _behind(pair.behind, cell, setting)
    else:
        yield from interior_pieces(pair.shelves, pair.inside, cell, setting)


def _drawer_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    drawer, rect, finish = cell.leaf, front_rect(cell, setting), setting.finish
    assert isinstance(drawer, Drawer)
    o, start = cell.opening, setting.plane if drawer.box == "tray" else setting.behind
    depth = drawer.depth * (setting.back - 0.02 - start)
    side = setting.slide_gap if drawer.box != "tray" or drawer.runners else TRAY_GAP
    inner = Rect(o.x0 + side, o.x1 - side, o.z0 + 0.012, max(o.z1 - 0.02, o.z0 + 0.02))
    surfaces = [surface_of(mesh, finish.inside) for mesh in drawer_box(drawer.box, inner, (start, start + depth))]
    handle: tuple[PieceDraft, ...] = ()
    if drawer.box != "tray":
        leaf = _leaf(drawer, rect, None, setting)
        surfaces = [*leaf_surfaces(leaf, finish), *surfaces]
        handle = handle_pieces(drawer.handle, drawer.hold, leaf, None, finish.metal)
    middle = rect.center
    slide = Axis(vec3(middle[0], setting.front, middle[1]), vec3(0.0, -1.0, 0.0))
    motion = PieceMotion(JointType.PRISMATIC, slide, drawer.travel * depth)
    yield PieceDraft(PartLabel.DRAWER, "drawer", tuple(surfaces), motion, handle)
    thick = min(RUNNER[0], 0.8 * setting.slide_gap)
    if drawer.runners and thick > 0.002:
        z = tray_level(inner) + 0.01 if drawer.box == "tray" else o.z0 + 0.35 * o.height
        yield from runner_pieces(cell, setting, z, thick)


def _tilt_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields a front that tilts about its lower edge, its tray with it."""
    tilt, o, rect = cell.leaf, cell.opening, front_rect(cell, setting)
    assert isinstance(tilt, Tilt)
    door = _door(Door("bottom", tilt.leaf, tilt.handle, tilt.opening, hold=tilt.hold, grip=tilt.grip), rect, setting)
    if tilt.tray:
        side = max(setting.slide_gap, setting.gap)
        inner = Rect(o.x0 + side, o.x1 - side, o.z0, o.z1)
        trays = tray_meshes(inner, (setting.front, rect.z0), setting.behind, setting.back)
        inside = tuple(surface_of(mesh, setting.finish.inside) for mesh in trays)
        door = replace(door, surfaces=(*door.surfaces, *inside))
    yield door


def _blank_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields a board that touches the case: against its front where overlaid, filling the opening where inset."""
    blank = cell.leaf
    assert isinstance(blank, Blank)
    tight = replace(setting, seat=0.0, gap=0.0) if setting.mount == "inset" else replace(setting, seat=0.0)
    leaf = LeafShape(blank.leaf, front_rect(cell, tight), tight.front, tight.thickness)
    yield PieceDraft(PartLabel.FACE_FRAME, blank.name, leaf_surfaces(leaf, setting.finish))
    for handle in handle_pieces(blank.handle, blank.hold, leaf, None, setting.finish.metal):
        yield replace(handle, label=PartLabel.MISC, stem="false_pull")


def _bay_pieces(cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    assert isinstance(cell.leaf, OpenCell)
    yield from interior_pieces(cell.leaf.shelves, cell.leaf.inside, cell, setting)


_MAKERS: dict[type, Callable[[Cell, Setting], Iterator[PieceDraft]]] = {
    Door: _door_pieces,
    Pair: _pair_pieces,
    Drawer: _drawer_pieces,
    Tilt: _tilt_pieces,
    Blank: _blank_pieces,
    OpenCell: _bay_pieces,
    Sliding: sliding_pieces,
    Folding: folding_pieces,
    Lift: lift_pieces,
    PullOut: pull_out_pieces,
    WasteBins: bin_pieces,
}


def _door(door: Door, rect: Rect, setting: Setting) -> PieceDraft:
    (x, z), y = rect.center, setting.front
    pins = {
        "left": (vec3(rect.x0, y, z), vec3(0.0, 0.0, -1.0)),
        "right": (vec3(rect.x1, y, z), vec3(0.0, 0.0, 1.0)),
        "top": (vec3(x, y, rect.z1), vec3(-1.0, 0.0, 0.0)),
        "bottom": (vec3(x, y, rect.z0), vec3(1.0, 0.0, 0.0)),
    }
    motion = PieceMotion(JointType.REVOLUTE, Axis(*pins[door.hinge]), door.opening)
    leaf = _leaf(door, rect, door.hinge, setting)
    handle = handle_pieces(door.handle, door.hold, leaf, door.hinge, setting.finish.metal)
    return PieceDraft(PartLabel.DOOR, "door", leaf_surfaces(leaf, setting.finish), motion, handle)


def _hinge_rail(door: Door, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the bar that carries a flap which meets another front at its hinge: behind it, beyond the seam."""
    if door.hinge not in ("top", "bottom") or getattr(cell.edges, door.hinge) is not Edge.SEAM:
        return
    o, (x0, x1) = cell.opening, inner_span(cell, setting)
    z0, z1 = (o.z1, o.z1 + HINGE_RAIL[1]) if door.hinge == "top" else (o.z0 - HINGE_RAIL[0], o.z0)
    y = setting.inner
    yield plank(PartLabel.BAR, "hinge_rail", setting.finish.case, ((x0, y, z0), (x1, y + RAIL_DEPTH / 2, z1)))


def _leaf(front: Door | Drawer, rect: Rect, hinge: Side | None, setting: Setting) -> LeafShape:
    side, free = gripped_side(front.hold, hinge), opposite(hinge) if hinge else "top"
    grip = front.grip, side, held_along(front.hold, side)
    return LeafShape(front.leaf, rect, setting.front, setting.thickness, free, *grip)


def _opening(door: Door, edges: Edges, width: float) -> float:
    """Returns how far a door opens, radians: at most square where something juts out beside its pin, a curved one less.

    Above and below a flap that may also be a bowed neighbour; beside a door it is a neighbour for what juts out of the
    door itself near its pin, its belly or a handle along an edge.
    """
    edge, level = getattr(edges, door.hinge), door.hinge in ("top", "bottom")
    square = pi / 2 - bend_at_hinge(door.leaf, width)
    bulky = door.leaf in CURVED or door.hold.place not in ("usual", "free edge")
    clear = edge is Edge.CASE or (edge is not Edge.STOP and not level and not bulky)
    return door.opening if clear else min(door.opening, square)


def _muntin(rect: Rect, setting: Setting) -> PieceDraft:
    back = max(setting.plane, setting.behind)
    mesh = board((rect.x0, setting.front, rect.z0), (rect.x1, back, rect.z1))
    return PieceDraft(PartLabel.BAR, "muntin", (surface_of(mesh, setting.finish.front),))


def _behind(layout: Layout, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields inset fronts inside an opening, between two fillers that keep them clear of the door; or bins, without."""
    if isinstance(layout, WasteBins):
        yield from bin_pieces(replace(cell, leaf=layout), setting)
        return
    o, plane = cell.opening, setting.inner + BEHIND_ROOM
    side = BEHIND_SIDE if setting.mount == "inset" else 0.018
    rect = replace(o, x0=o.x0 + side, x1=o.x1 - side)
    for low, high in zip(inner_span(cell, setting), (rect.x0, rect.x1), strict=True):
        mesh = board((min(low, high), plane, o.z0), (max(low, high), setting.back, o.z1))
        yield PieceDraft(PartLabel.DIVIDER, "divider", (surface_of(mesh, setting.finish.inside),))
    inner = replace(setting, plane=plane, mount="inset", wall=0.0, case_wall=None, borders=None, frame=0.0)
    for item in divide(layout, rect, Edges(), setting.panel):
        yield from partition_pieces(item, inner) if isinstance(item, Partition) else front_pieces(item, inner)
