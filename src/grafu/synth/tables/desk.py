"""Desks: a top on one or two pedestals, with drawers between them, a modesty panel, a return, a hutch."""

from collections.abc import Iterator
from dataclasses import replace
from typing import final

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.transform import translation
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.case.case import Case
from grafu.synth.case.construction import STANDING, Base, TopEdge
from grafu.synth.case.legs import Leg
from grafu.synth.fronts.front import front_pieces
from grafu.synth.fronts.layout import Cell, Drawer, Edge, Edges, Layout, Rect, Stack, divide
from grafu.synth.fronts.setting import Mount, Setting
from grafu.synth.pieces.assembly import PieceDraft, assemble, plank, solid
from grafu.synth.pieces.finish import PLAIN, Finish
from grafu.synth.tables.table_parts import on_top, table_leg, table_top
from grafu.vocabulary import PartLabel

THREE_DRAWERS = Stack((Drawer(), Drawer(), Drawer()), (2.0, 1.0, 1.0), "nothing")
SETBACK = 0.02  # metres that pedestals stand back behind the top's front and back edges
END_PANEL = 0.025  # metres: the panel that carries a top where no pedestal does


@final
@dataclass(frozen=True, slots=True)
class Desk:
    """A top on one or two pedestals, metres; on the side without a pedestal it rests on a panel, or on `legs`.

    Below the top, `middle` fills a zone `apron` high between the pedestals. `modesty` is the fraction of the height
    that a panel between them covers at the back. Pedestals stand on `base`, and `lift` below the top, joined to it by
    blocks. A return of length `wing` runs towards the front at the end without a pedestal. A hutch stands on the top's
    back.

    Raises:
        ValueError: if the pedestals do not fit beside each other, or leave the middle no room.
    """

    name: str = "desk"
    width: float = 1.4
    depth: float = 0.65
    height: float = 0.75
    top: float = 0.025
    pedestal_width: float = 0.4
    left: Layout | None = None
    right: Layout | None = THREE_DRAWERS
    finish: Finish = PLAIN
    mount: Mount = "overlay"
    front: float = 0.018
    panel: float = 0.018
    gap: float = 0.003
    edge: TopEdge = "square"
    legs: Leg | None = None
    middle: Layout | None = None
    apron: float = 0.1
    modesty: float = 0.0
    base: Base = STANDING
    lift: float = 0.0
    wing: float = 0.0
    hutch: Cabinet | None = None

    def __post_init__(self) -> None:
        free = self.width - sum(self._end(layout) for layout in (self.left, self.right))
        if self.wing and None not in (self.left, self.right):
            raise ValueError("a `Desk` with a wing must have an end without a pedestal: got two pedestals")
        if free <= 0.1:
            raise ValueError(f"`Desk` needs 0.1 m between its ends: got {free:.3f} m on {self.width} m")

    @property
    def under(self) -> float:
        """The height of the top's underside."""
        return self.height - self.top

    @property
    def knee_room(self) -> tuple[float, float]:
        """The x between the two ends."""
        return self._end(self.left) - self.width / 2, self.width / 2 - self._end(self.right)

    def _end(self, layout: Layout | None) -> float:
        if layout is not None:
            return self.pedestal_width
        return END_PANEL if self.legs is None else self.legs.thick + 0.02


def make_desk(spec: Desk) -> Asset:
    """Returns the desk with its true joints.

    Raises:
        ValueError: if the pedestals' layouts leave some cell no room.
    """
    pieces = [*_tops(spec)]
    for layout, side in ((spec.left, -1.0), (spec.right, 1.0)):
        pieces += _support(layout, side, spec)
    pieces += [*_between(spec), *_wing(spec)]
    if spec.hutch is not None:
        pieces += on_top(spec.hutch, spec.depth, spec.height)
    return assemble(spec.name, pieces)


def _tops(spec: Desk) -> Iterator[PieceDraft]:
    x, y = spec.width / 2, spec.depth / 2
    box = Box(vec3(-x, -y, spec.under), vec3(x, y, spec.height))
    yield table_top("straight", box, spec.edge, False, spec.finish)


def _support(layout: Layout | None, side: float, spec: Desk) -> Iterator[PieceDraft]:
    if layout is not None:
        yield from _pedestal(layout, side, spec)
    elif spec.legs is not None:
        leg = spec.legs
        x, y = spec.width / 2 - 0.01 - leg.thick / 2, spec.depth / 2 - SETBACK - leg.thick / 2
        for sy in (-1.0, 1.0):
            meshes = table_leg(leg, (side * x, sy * y), (side, sy), spec.under, 0.0)
            yield solid(PartLabel.LEG, "leg", spec.finish.case, meshes)
    else:
        x = spec.width / 2
        ends = sorted((side * x, side * (x - END_PANEL)))
        span = ((ends[0], -spec.depth / 2, 0.0), (ends[1], spec.depth / 2, spec.under))
        yield plank(PartLabel.SIDE_PANEL, "side_panel", spec.finish.case, span)


def _pedestal(layout: Layout, side: float, spec: Desk) -> Iterator[PieceDraft]:
    high, deep = spec.under - spec.lift, spec.depth - 2 * SETBACK
    case = Case(spec.pedestal_width, high, deep, panel=spec.panel, base=spec.base)
    cabinet = Cabinet(case=case, layout=layout, mount=spec.mount, front=spec.front, gap=spec.gap, finish=spec.finish)
    middle = side * (spec.width - spec.pedestal_width) / 2
    shift = translation(vec3(middle, 0.0, 0.0))
    for piece in cabinet_pieces(cabinet):
        yield piece.transformed(shift)
    if spec.lift:
        x, y = 0.5 * spec.pedestal_width, 0.35 * deep
        span = ((middle - 0.8 * x, -y, high), (middle + 0.8 * x, y, spec.under))
        yield plank(PartLabel.MISC, "tabletop_connector", spec.finish.case, span)


def _between(spec: Desk) -> Iterator[PieceDraft]:
    """Yields what fills the knee room: the modesty panel and the fronts below the top."""
    x0, x1 = spec.knee_room
    y, wood = spec.depth / 2 - SETBACK, spec.finish.case
    if spec.modesty:
        low = spec.under * (1 - spec.modesty)
        yield plank(PartLabel.BACK_PANEL, "modesty_panel", wood, ((x0, y - spec.panel, low), (x1, y, spec.under)))
    if spec.middle is None:
        return
    back = y - spec.panel - 0.002
    setting = Setting(-y, back, "inset", spec.front, spec.gap, slide_gap=0.0125, finish=spec.finish)
    edges = Edges(bottom=Edge.SEAM, top=Edge.STOP)
    for item in divide(spec.middle, Rect(x0, x1, spec.under - spec.apron, spec.under), edges, spec.panel):
        if isinstance(item, Cell):
            yield from front_pieces(item, setting)
            continue
        r = item.rect
        yield plank(PartLabel.MISC, "tabletop_connector", wood, ((r.x0, -y, r.z0), (r.x1, back, r.z1)))


def _wing(spec: Desk) -> Iterator[PieceDraft]:
    """Yields a return that runs on towards the front at the end without a pedestal, on a panel at its own end."""
    if not spec.wing:
        return
    y, wide = -spec.depth / 2, min(0.5, 0.4 * spec.width)
    x0 = -spec.width / 2 if spec.left is None else spec.width / 2 - wide
    x1 = x0 + wide
    box = Box(vec3(x0, y - spec.wing, spec.under), vec3(x1, y, spec.height))
    yield replace(table_top("straight", box, spec.edge, False, spec.finish), stem="return_top")
    span = ((x0, y - spec.wing, 0.0), (x1, y - spec.wing + END_PANEL, spec.under))
    yield plank(PartLabel.SIDE_PANEL, "return_panel", spec.finish.case, span)
