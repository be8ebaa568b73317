"""Tables and desks: drawers that hang under a top between legs, on one side or two, and tops on pedestals."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import final

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, rotation_matrix, translation
from grafu.synth.assembly import Piece, assemble
from grafu.synth.cabinet import Cabinet, cabinet_pieces
from grafu.synth.case import Case
from grafu.synth.finish import PLAIN, Finish, surface_of
from grafu.synth.fronts import front_pieces
from grafu.synth.layout import Cell, Drawer, Edge, Edges, Layout, Rect, Row, Stack, divide
from grafu.synth.setting import Setting
from grafu.vocabulary import PartLabel

TWO_DRAWERS = Row((Drawer(), Drawer()), between="nothing")
THREE_DRAWERS = Stack((Drawer(), Drawer(), Drawer()), (2.0, 1.0, 1.0), "nothing")


@final
@dataclass(frozen=True, slots=True)
class Table:
    """A table with hanging drawers, metres: nothing but its legs and aprons stands beside them.

    `apron` is the height of the drawers' zone below the top; `slide_gap` what a drawer box keeps from the legs' inner
    faces on either side; with `two_sided`, the back has the same drawers.
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


@final
@dataclass(frozen=True, slots=True)
class Desk:
    """A top on one or two pedestals, metres; on the side without a pedestal it rests on a panel."""

    name: str = "desk"
    width: float = 1.4
    depth: float = 0.65
    height: float = 0.75
    top: float = 0.025
    pedestal_width: float = 0.4
    left: Layout | None = None
    right: Layout | None = THREE_DRAWERS
    finish: Finish = PLAIN


def make_table(spec: Table) -> Asset:
    """Returns the table with its true joints.

    Raises:
        ValueError: if the layout leaves some drawer no room.
    """
    sides = (0.0, pi) if spec.two_sided else (0.0,)
    fronts = [
        piece.transformed(from_rotation(rotation_matrix(vec3(0.0, 0.0, 1.0), angle)))
        for angle in sides
        for piece in _table_fronts(spec)
    ]
    return assemble(spec.name, [*_table_frame(spec), *fronts])


def make_desk(spec: Desk) -> Asset:
    """Returns the desk with its true joints.

    Raises:
        ValueError: if the pedestals do not fit.
    """
    pieces = [
        _board(PartLabel.TOP_PANEL, "table_top", _top(spec.width, spec.depth, spec.height, spec.top), spec.finish)
    ]
    for layout, side in ((spec.left, -1.0), (spec.right, 1.0)):
        pieces += _support(layout, side, spec)
    return assemble(spec.name, pieces)


def _table_fronts(spec: Table) -> Iterator[Piece]:
    x, z = spec.width / 2 - spec.leg, spec.height - spec.top
    back = 0.0 if spec.two_sided else spec.depth / 2 - spec.leg
    setting = Setting(-spec.depth / 2, back, "inset", slide_gap=spec.slide_gap, finish=spec.finish)
    edges = Edges(bottom=Edge.SEAM, top=Edge.STOP)
    for item in divide(spec.layout, Rect(-x, x, z - spec.apron, z), edges, 0.018):
        if isinstance(item, Cell):
            yield from front_pieces(item, setting)


def _table_frame(spec: Table) -> Iterator[Piece]:
    x, y, z, leg = spec.width / 2, spec.depth / 2, spec.height - spec.top, spec.leg
    yield _board(PartLabel.TOP_PANEL, "table_top", _top(spec.width, spec.depth, spec.height, spec.top), spec.finish)
    for px in (-x, x - leg):
        for py in (-y, y - leg):
            box = Box(vec3(px, py, 0.0), vec3(px + leg, py + leg, z))
            yield _board(PartLabel.LEG, "leg", box, spec.finish)
    if not spec.has_aprons:
        return
    for px in (-x + 0.01, x - leg + 0.01):
        box = Box(vec3(px, -y + leg, z - spec.apron), vec3(px + 0.02, y - leg, z))
        yield _board(PartLabel.SIDE_PANEL, "apron_side", box, spec.finish)
    if not spec.two_sided:
        box = Box(vec3(-x + leg, y - leg, z - spec.apron), vec3(x - leg, y - leg + 0.02, z))
        yield _board(PartLabel.BACK_PANEL, "apron_back", box, spec.finish)


def _support(layout: Layout | None, side: float, spec: Desk) -> list[Piece]:
    height = spec.height - spec.top
    if layout is None:
        x = side * (spec.width / 2 - 0.0125)
        box = Box.from_center(vec3(x, 0.0, height / 2), vec3(0.0125, spec.depth / 2, height / 2))
        return [_board(PartLabel.SIDE_PANEL, "side_panel", box, spec.finish)]
    case = Case(spec.pedestal_width, height, spec.depth - 0.04)
    shift = translation(vec3(side * (spec.width - spec.pedestal_width) / 2, 0.0, 0.0))
    return [p.transformed(shift) for p in cabinet_pieces(Cabinet(case=case, layout=layout, finish=spec.finish))]


def _top(width: float, depth: float, height: float, thickness: float) -> Box:
    return Box(vec3(-width / 2, -depth / 2, height - thickness), vec3(width / 2, depth / 2, height))


def _board(label: PartLabel, stem: str, box: Box, finish: Finish) -> Piece:
    return Piece(label, stem, (surface_of(TriangleMesh.box_mesh(box), finish.case),))
