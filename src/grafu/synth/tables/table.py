"""Tables: drawers that hang under a top between four legs, on one side or two, with all that carpenters add."""

from collections.abc import Iterator
from math import pi
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import from_rotation, rotation_matrix
from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.case.bases import stretcher_pieces, waist
from grafu.synth.case.construction import Stretcher, TopEdge
from grafu.synth.case.legs import Leg, LegShape, lean
from grafu.synth.fronts.front import front_pieces
from grafu.synth.fronts.layout import Cell, CellRow, Drawer, Edge, Edges, Layout, Rect, divide
from grafu.synth.fronts.setting import Setting
from grafu.synth.pieces.assembly import PieceDraft, Span, assemble, both_sides, plank, solid
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.pieces.shapes import arched_rail
from grafu.synth.tables.table_parts import WITHIN_ROUND, Outline, mirror_pieces, on_top, table_legs, table_top
from grafu.vocabulary import PartLabel

TWO_DRAWERS = CellRow((Drawer(), Drawer()), between="nothing")
SPINE = 0.03  # metres: the thickness of the board that runs lengthwise (26608: 41 mm)
MOULDING = 0.015  # metres that a moulding around a top juts out
APRON = 0.02  # metres: the thickness of aprons
APRON_SETBACK = 0.01  # metres that aprons stand back behind the legs' outer faces


@final
@dataclass(frozen=True, slots=True)
class DrawerTable:
    """A table with hanging drawers, metres: nothing but its legs and aprons stands beside them.

    `apron` is the height of the drawers' zone below the top; `slide_gap` what a drawer box keeps from the legs' inner
    faces on either side; with `two_sided`, the back has the same drawers. The top is `top` thick and juts out by
    `overhang` beyond the legs. Legs are `leg` wide and of any shape; `stretcher` bars join them at `stretcher_at` of
    the height. `arch` is the height of an arched rail below the drawers. `guides` run along the drawers' sides.
    A hutch stands on the top at its back, or a mirror of that height, which tilts by `swivel` radians. `rails` is the
    height of bars above and below the drawers; `boarded` makes them one board with openings. A `spine` is a board that
    runs lengthwise behind the drawers.
    A straight top has a `moulding` of that height around it, which ends above the drawers. The back apron covers the
    fraction `modesty` of the room below it.

    Raises:
        ValueError: if the legs leave no room between them or below the top, or the rails none for drawers.
    """

    name: str = "table"
    width: float = 1.2
    depth: float = 0.6
    height: float = 0.75
    top: float = 0.025
    leg: float = 0.06
    apron: float = 0.12
    has_aprons: bool = True
    two_sided: bool = False
    layout: Layout = TWO_DRAWERS
    slide_gap: float = 0.02
    finish: Finish = PLAIN
    leg_shape: LegShape = "square"
    leg_foot: float = 0.6
    overhang: float = 0.0
    outline: Outline = "straight"
    edge: TopEdge = "square"
    glass: bool = False
    stretcher: Stretcher = "none"
    stretcher_at: float = 0.25
    arch: float = 0.0
    guides: bool = False
    hutch: Cabinet | None = None
    mirror: float = 0.0
    swivel: float = 0.0
    rails: float = 0.0
    boarded: bool = False
    spine: bool = False
    moulding: float = 0.0
    modesty: float = 0.0
    front: float = 0.018
    gap: float = 0.003

    def __post_init__(self) -> None:
        x, y = self.half
        if min(x, y) <= self.leg or self.under - self.apron - self.arch <= 0 or 3 * self.rails >= self.apron:
            size = f"{self.width} x {self.depth} x {self.height} m with legs of {self.leg} m"
            raise ValueError(f"`DrawerTable` needs room between its legs and rails, and below its drawers: got {size}")

    @property
    def half(self) -> tuple[float, float]:
        """How far the legs' outer faces stand from the middle, along x and y."""
        ratio = WITHIN_ROUND if self.outline == "round" else 1.0
        return ratio * self.width / 2 - self.overhang, ratio * self.depth / 2 - self.overhang

    @property
    def under(self) -> float:
        """The height of the top's underside."""
        return self.height - self.top


def make_table(spec: DrawerTable) -> Asset:
    """Returns the table with its true joints.

    Raises:
        ValueError: if the layout leaves some drawer no room.
    """
    return assemble(spec.name, [*_frame(spec), *_below(spec), *_above(spec), *_all_fronts(spec)])


def _all_fronts(spec: DrawerTable) -> Iterator[PieceDraft]:
    for angle in (0.0, pi) if spec.two_sided else (0.0,):
        turn = from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle))
        for piece in _fronts(spec):
            yield piece.transformed(turn) if angle else piece


def _fronts(spec: DrawerTable) -> Iterator[PieceDraft]:
    (x, y), z, low = spec.half, spec.under, spec.under - spec.apron
    x -= spec.leg
    back = -SPINE / 2 if spec.spine else -0.005 if spec.two_sided else y - spec.leg
    near = spec.front - y if spec.rails else -y
    setting = Setting(-y, back, "inset", spec.front, spec.gap, slide_gap=spec.slide_gap, finish=spec.finish)
    edges = Edges() if spec.rails else Edges(bottom=Edge.SEAM, top=Edge.STOP)
    rails: list[Span] = [((-x, -y, z0), (x, near, z0 + spec.rails)) for z0 in (low, z - spec.rails) if spec.rails]
    for item in divide(spec.layout, Rect(-x, x, low + spec.rails, z - spec.rails), edges, 0.018):
        if isinstance(item, Cell):
            yield from front_pieces(item, setting)
            continue
        r = item.rect
        spans: list[Span] = [((r.x0, near, low), (r.x1, back, z))]
        if spec.rails:  # its front end stands between the bars
            (rails if spec.boarded else spans).append(((r.x0, -y, r.z0), (r.x1, near, r.z1)))
        yield plank(PartLabel.MISC, "tabletop_connector", spec.finish.case, *spans)
    if rails and spec.boarded:
        yield plank(PartLabel.SIDE_PANEL, "apron_front", spec.finish.case, *rails)
        return
    for span in rails:
        yield plank(PartLabel.BAR, "apron_rail", spec.finish.case, span)


def _frame(spec: DrawerTable) -> Iterator[PieceDraft]:
    (x, y), z, leg, wood = spec.half, spec.under, spec.leg, spec.finish.case
    box = Box(vec3(-spec.width / 2, -spec.depth / 2, z), vec3(spec.width / 2, spec.depth / 2, spec.height))
    yield table_top(spec.outline, box, spec.edge, spec.glass, spec.finish)
    shape = Leg(spec.leg_shape, leg, spec.leg_foot)
    yield from table_legs(shape, (x - leg / 2, y - leg / 2), z, spec.apron, spec.finish)
    if spec.moulding and spec.outline == "straight":
        yield _moulding(spec, box)
    if spec.spine:
        end = x - min(APRON_SETBACK, leg / 4) - APRON if spec.has_aprons else x
        span = ((-end, -SPINE / 2, z - spec.apron), (end, SPINE / 2, z))
        yield plank(PartLabel.MISC, "tabletop_connector", wood, span)
    if not spec.has_aprons:
        return
    out = x - min(APRON_SETBACK, leg / 4)
    for side, at in both_sides(((out - APRON, leg - y, z - spec.apron), (out, y - leg, z))):
        yield plank(PartLabel.SIDE_PANEL, f"apron_{side}", wood, at)
    if not spec.two_sided:
        low = (z - spec.apron) * (1 - spec.modesty)
        if spec.stretcher != "none":
            low = max(low, min(_stretcher_at(spec) + 0.03, z - spec.apron))
        span = ((leg - x, y - leg, low), (x - leg, y - leg + APRON, z))
        yield plank(PartLabel.BACK_PANEL, "apron_back", wood, span)
    if spec.guides:
        yield from _guides(spec, out - APRON)


def _guides(spec: DrawerTable, out: float) -> Iterator[PieceDraft]:
    """Yields bars above and below along the drawers' outer sides, between them and the side aprons."""
    (x, y), z, b = spec.half, spec.under, 0.3 * spec.apron
    inner = x - spec.leg - 0.8 * spec.slide_gap
    start = max(spec.leg, spec.front + 0.005) - y
    if out - inner < 0.004:
        return
    for low in (z - spec.apron, z - b):
        for _, at in both_sides(((inner, start, low), (out, y - spec.leg, low + b))):
            yield plank(PartLabel.BAR, "drawer_guide", spec.finish.case, at)


def _moulding(spec: DrawerTable, top: Box) -> PieceDraft:
    """Returns four boards around a straight top: as one part, above the drawers' path."""
    (x0, y0, _), (x1, y1, high) = top.low.tolist(), top.high.tolist()
    low, t = max(high - spec.moulding, spec.under - spec.rails), MOULDING
    spans: tuple[Span, ...] = (
        ((x0 - t, y0 - t, low), (x1 + t, y0, high)),
        ((x0 - t, y1, low), (x1 + t, y1 + t, high)),
        ((x0 - t, y0, low), (x0, y1, high)),
        ((x1, y0, low), (x1 + t, y1, high)),
    )
    return plank(PartLabel.BAR, "moulding", spec.finish.case, *spans)


def _stretcher_at(spec: DrawerTable) -> float:
    return max(spec.stretcher_at * (spec.under - spec.apron), min(0.03, 0.7 * spec.leg))


def _below(spec: DrawerTable) -> Iterator[PieceDraft]:
    """Yields the stretchers and the arched rail."""
    (x, y), leg = spec.half, spec.leg
    bar = min(0.03, 0.7 * leg)
    z = _stretcher_at(spec)
    shape = Leg(spec.leg_shape, leg, spec.leg_foot)
    out = lean(shape, z, spec.under - spec.apron) - leg / 2
    yield from stretcher_pieces(spec.stretcher, (x + out, y + out), bar, z, spec.finish, waist(shape))
    if spec.arch:
        low = spec.under - spec.apron - spec.arch
        box = Box(vec3(leg - x, -y, low), vec3(x - leg, APRON - y, low + spec.arch))
        yield solid(PartLabel.BAR, "apron", spec.finish.case, [arched_rail(box, 0.7 * spec.arch)])


def _above(spec: DrawerTable) -> Iterator[PieceDraft]:
    if spec.hutch is not None:
        yield from on_top(spec.hutch, spec.depth, spec.height)
    if spec.mirror:
        yield from mirror_pieces(0.55 * spec.width, spec.mirror, spec.depth, spec.height, spec.finish, spec.swivel)
