"""What fills the room behind an opening: shelves with lips and cleats, dividers, rods, baskets."""

from collections.abc import Iterator

from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.synth.fronts.hold import Inside
from grafu.synth.fronts.layout import Cell, Edge
from grafu.synth.fronts.setting import Setting, inner_span
from grafu.synth.pieces.assembly import PieceDraft, Span, plank, solid
from grafu.synth.pieces.shapes import rod
from grafu.vocabulary import PartLabel

FRONT_ROOM = 0.01  # metres between fronts and the fittings behind them
LIP = 0.012  # metres: how thick the lip before a shelf is
CLEAT = (0.02, 0.04)  # metres: how wide and high bars under shelves are (47315 has 22 x 58 mm)
WALL_RAIL = 0.012  # metres: how thick level rails along the back wall are
BLOCK = (0.05, 0.018)  # metres: how wide and high blocks in the upper corners are
GLASS_SHELF = 0.006  # metres
WIRE = 0.002  # metres: the radius of a basket's wires
ROD = 0.0125  # metres: the radius of a hanging rod, 25 mm tubes being the usual ones
RUNNER = (0.011, 0.035)  # metres: how thick and how high slides are


def interior_pieces(shelves: int, inside: Inside, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields the shelves and fittings of one opening."""
    yield from _shelves(shelves, inside, cell, setting)
    o, (x0, x1) = cell.opening, inner_span(cell, setting)
    y0, y1 = setting.inner + FRONT_ROOM, setting.back
    room = o.height / (shelves + 1) - min(setting.panel, 0.018) / 2
    if inside.cleats and shelves and not inside.runners:
        yield from _cleats(shelves, inside, cell, setting)
    if inside.blocks and not inside.rod:
        yield from _blocks(inside, cell, setting)
    if inside.dividers:
        near = setting.inner + inside.setback + (LIP if inside.lip and shelves else 0.0)
        yield from _dividers(inside.dividers, ((x0, near, o.z0), (x1, y1, o.z0 + room)), setting)
    if inside.rod:
        z, y = o.z1 - min(0.06, 0.3 * room), (y0 + y1) / 2
        yield solid(PartLabel.BAR, "hanging_rod", setting.finish.metal, [rod(vec3(x0, y, z), vec3(x1, y, z), ROD, 10)])
    if inside.basket != "none":
        mesh = _basket if inside.basket == "wire" else _rack
        span = ((x0 + 0.01, y0 + 0.01, o.z0), (x1 - 0.01, y1 - 0.01, o.z0 + min(0.15, 0.6 * room)))
        yield solid(PartLabel.MISC, f"{inside.basket}_basket", setting.finish.metal, [mesh(span)])
    for k in range(inside.runners):
        yield from runner_pieces(cell, setting, o.z0 + o.height * (k + 1) / (inside.runners + 1), RUNNER[0])
    yield from _wall_rails(min(inside.rails, 1) if inside.dividers else inside.rails, cell, setting)


def runner_pieces(cell: Cell, setting: Setting, z: float, thick: float) -> Iterator[PieceDraft]:
    """Yields a slide on either wall of a cell at the height `z`, where there is a wall; `thick` into the opening."""
    o, (x0, x1) = cell.opening, inner_span(cell, setting)
    y0, y1, half = setting.inner + FRONT_ROOM, setting.back - 0.01, min(RUNNER[1], 0.3 * o.height) / 2
    walls = ((cell.edges.left, x0, o.x0 + thick), (cell.edges.right, o.x1 - thick, x1))
    for edge, low, high in walls:
        if edge is not Edge.SEAM:
            yield plank(
                PartLabel.MISC, "drawer_runner", setting.finish.metal, ((low, y0, z - half), (high, y1, z + half))
            )


def _shelves(count: int, inside: Inside, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    (x0, x1), y0, finish = inner_span(cell, setting), _shelf_front(inside, setting), setting.finish
    lip = 0.0 if inside.shelf == "glass" else min(inside.lip, 0.3 * cell.opening.height / (count + 1))
    near = y0 + (LIP if lip else 0.0)
    material = finish.glass if inside.shelf == "glass" else finish.inside
    for low, high in _levels(count, inside, cell, setting):
        yield plank(PartLabel.SHELF, "shelf", material, ((x0, near, low), (x1, setting.back, high)))
        if inside.band and inside.shelf != "glass" and not lip and setting.mount == "overlay":
            yield plank(PartLabel.BAR, "edge_strip", material, ((x0, y0 - setting.frame, low), (x1, y0, high)))
        if lip:
            yield plank(PartLabel.BAR, "shelf_lip", material, ((x0, y0, min(low, high - lip)), (x1, near, high)))


def _shelf_front(inside: Inside, setting: Setting) -> float:
    y0 = setting.inner + inside.setback
    return setting.back - 0.6 * (setting.back - y0) if inside.shelf == "short" else y0


def _levels(count: int, inside: Inside, cell: Cell, setting: Setting) -> Iterator[tuple[float, float]]:
    """Yields the heights of the shelves' lower and upper faces."""
    half = GLASS_SHELF / 2 if inside.shelf == "glass" else min(setting.panel, 0.018) / 2
    for k in range(count):
        z = cell.opening.z0 + cell.opening.height * (k + 1) / (count + 1)
        yield z - half, z + half


def _cleats(count: int, inside: Inside, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields a bar under either end of each shelf, where there is a wall."""
    (x0, x1), w = inner_span(cell, setting), CLEAT[0]
    high = min(CLEAT[1], 0.25 * cell.opening.height / (count + 1))
    y0 = _shelf_front(inside, setting) + (LIP if inside.lip else 0.0)
    y1 = setting.back - (WALL_RAIL if inside.rails else 0.0)
    for low, _ in _levels(count, inside, cell, setting):
        for edge, a, b in ((cell.edges.left, x0, x0 + w), (cell.edges.right, x1 - w, x1)):
            if edge is not Edge.SEAM:
                yield plank(PartLabel.BAR, "cleat", setting.finish.inside, ((a, y0, low - high), (b, y1, low)))


def _blocks(inside: Inside, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields blocks in the upper corners of a cell's room."""
    o, (x0, x1), (w, high) = cell.opening, inner_span(cell, setting), BLOCK
    y0, y1 = setting.inner + FRONT_ROOM, setting.back - (WALL_RAIL if inside.rails else 0.0)
    if min(x1 - x0, y1 - y0) < 3 * w or cell.edges.top is Edge.SEAM:
        return
    for edge, a, b in ((cell.edges.left, x0, x0 + w), (cell.edges.right, x1 - w, x1)):
        if edge is Edge.SEAM:
            continue
        for near in (y0, y1 - w):
            span = ((a, near, o.z1 - high), (b, near + w, o.z1))
            yield plank(PartLabel.MISC, "corner_block", setting.finish.inside, span)


def _dividers(count: int, room: Span, setting: Setting) -> Iterator[PieceDraft]:
    (x0, y0, z0), (x1, y1, z1) = room
    half = min(setting.panel, 0.012) / 2
    for k in range(count):
        x = x0 + (x1 - x0) * (k + 1) / (count + 1)
        yield plank(PartLabel.DIVIDER, "divider", setting.finish.inside, ((x - half, y0, z0), (x + half, y1, z1)))


def _basket(span: Span) -> TriangleMesh:
    """Returns an open basket: wires along and across its floor, which turn up at its sides, and a rim."""
    (x0, y0, z0), (x1, y1, z1) = span
    low, high, count = z0 + WIRE, z1 - WIRE, 6
    wires = []
    for k in range(count):
        x = x0 + (x1 - x0) * (k + 0.5) / count
        y = y0 + (y1 - y0) * (k + 0.5) / count
        wires += [_wire((x, y0, low), (x, y1, low)), _wire((x0, y, low), (x1, y, low))]
    for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)):
        wires.append(_wire((x, y, z0), (x, y, z1)))
    return merge_meshes([*wires, *_rim(span, high)])


def _rack(span: Span) -> TriangleMesh:
    """Returns a plate rack: two bars on the floor and a row of upright wires between them and a rim."""
    (x0, y0, z0), (x1, y1, z1) = span
    low, count = z0 + WIRE, 8
    wires = [_wire((x0, y, low), (x1, y, low)) for y in (y0, y1)]
    for k in range(count):
        x = x0 + (x1 - x0) * k / (count - 1)
        wires += [_wire((x, y0, z0), (x, y0, z1)), _wire((x, y1, z0), (x, y1, z1))]
    return merge_meshes([*wires, *_rim(span, z1 - WIRE)])


def _rim(span: Span, z: float) -> list[TriangleMesh]:
    (x0, y0, _), (x1, y1, _) = span
    corners = ((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))
    return [_wire(a, b) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True)]


def _wire(start: tuple[float, float, float], end: tuple[float, float, float]) -> TriangleMesh:
    return rod(vec3(*start), vec3(*end), WIRE, 4)


def _wall_rails(count: int, cell: Cell, setting: Setting) -> Iterator[PieceDraft]:
    """Yields bars along the back wall: the first below the top, the second above the bottom."""
    o, (x0, x1), high = cell.opening, inner_span(cell, setting), min(0.07, 0.2 * cell.opening.height)
    for z in (o.z1 - high, o.z0)[:count]:
        span = ((x0, setting.back - WALL_RAIL, z), (x1, setting.back, z + high))
        yield plank(PartLabel.BAR, "wall_rail", setting.finish.inside, span)
