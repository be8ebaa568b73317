"""Bureaus: a cabinet with a writing room above, behind a flap that leans back and falls open to a level board."""

from collections.abc import Iterator
from math import atan2, hypot, pi, sin
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.transform import from_rotation, rotation_matrix, translation
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.fronts.front import front_pieces
from grafu.synth.fronts.layout import Cell, Door, Drawer, Edges, Rect, Stack
from grafu.synth.fronts.setting import Setting
from grafu.synth.pieces.assembly import PieceDraft, assemble, plank, solid
from grafu.synth.pieces.shapes import prism_along_x
from grafu.vocabulary import PartLabel

SILL_RAIL = 0.012  # metres: the height of the rail below the flap
SILL_ROOM = 0.005  # metres between it and the flap
HOLE_ROOM = 0.02  # metres between the flap and the pigeonholes
BACK = 0.006  # metres: a sheet
LEAST_SHELF = 0.12  # metres: the top's depth, where letters still fit below it
CHEST = Cabinet(layout=Stack((Drawer(), Drawer(), Drawer()), between="rail"))
FLAP = Door("bottom", handle="knob-round")


@final
@dataclass(frozen=True, slots=True)
class Bureau:
    """A cabinet and its writing room, metres: `rise` high, its top `shelf` deep, on a cabinet with a top between sides.

    The flap leans back between the room's sides and turns about its lower outer edge until it lies level; `flap` states
    what it looks like. `holes` pigeonholes with a shelf over them stand at the back.

    Raises:
        ValueError: if the top is another, or the room too low, not deep enough, or upright.
    """

    name: str = "bureau"
    lower: Cabinet = CHEST
    rise: float = 0.34
    shelf: float = 0.22
    flap: Door = FLAP
    holes: int = 5

    def __post_init__(self) -> None:
        if self.lower.case.top.kind != "between" or self.flap.hinge != "bottom" or self.holes < 0:
            raise ValueError(f"a `Bureau` needs a top between sides and a flap hinged below: got {self}")
        if not (LEAST_SHELF <= self.shelf <= self.lower.case.depth - 0.05 and self.rise > 0.15):
            size = f"{self.shelf} m on {self.lower.case.depth} m, {self.rise} m high"
            raise ValueError(f"a `Bureau` needs room behind its flap and a flap that leans: got a top {size}")

    @property
    def sill(self) -> float:
        """The height of the flap's pin above the cabinet: the inner edge of a leaning flap lies lower."""
        return SILL_RAIL + SILL_ROOM + self.lower.front

    @property
    def run(self) -> float:
        """How far behind the cabinet's front the top begins."""
        return self.lower.case.depth / 2 - self.shelf - self.lower.case.front

    @property
    def slope(self) -> float:
        """The angle between the flap and the floor, radians, below a right one."""
        return atan2(self.rise - self.sill, self.run)

    @property
    def length(self) -> float:
        """The length of the flap's opening along the slope: it ends below the top."""
        return (
            hypot(self.rise - self.sill, self.run)
            * (self.rise - self.sill - self.lower.case.panel)
            / (self.rise - self.sill)
        )


def make_bureau(spec: Bureau) -> Asset:
    """Returns the bureau with its true joints.

    Raises:
        ValueError: if the cabinet's layout leaves some cell no room.
    """
    lift = translation(vec3(0.0, 0.0, spec.lower.case.height))
    room = (*_room(spec), *_holes(spec), *_flap(spec))
    return assemble(spec.name, [*cabinet_pieces(spec.lower), *(piece.transformed(lift) for piece in room)])


def _room(spec: Bureau) -> Iterator[PieceDraft]:
    """Yields sides, top, back and the rail below the flap, standing on z = 0."""
    case, wood, z = spec.lower.case, spec.lower.finish.case, spec.rise
    y0, y1, t = case.front, case.depth / 2, case.panel
    x, near = case.width / 2, y1 - spec.shelf
    outline = ((y0, 0.0), (y1, 0.0), (y1, z), (near, z), (y0, spec.sill))
    for stem, low in (("upper_side_left", -x), ("upper_side_right", x - t)):
        yield solid(PartLabel.SIDE_PANEL, stem, wood, [prism_along_x(outline, low, low + t)])
    yield plank(PartLabel.TOP_PANEL, "upper_top", wood, ((t - x, near, z - t), (x - t, y1, z)))
    yield plank(PartLabel.BACK_PANEL, "upper_back", wood, ((t - x, y1 - BACK, 0.0), (x - t, y1, z - t)))
    yield plank(PartLabel.BAR, "sill", wood, ((t - x, y0, 0.0), (x - t, y0 + 2 * SILL_RAIL, SILL_RAIL)))


def _holes(spec: Bureau) -> Iterator[PieceDraft]:
    """Yields the shelf over the pigeonholes and the boards between them, behind the flap's upper end."""
    case, inside = spec.lower.case, spec.lower.finish.inside
    x, y1, z = case.width / 2 - case.panel, case.depth / 2 - BACK, 0.5 * spec.rise
    y0 = case.depth / 2 - spec.shelf + spec.lower.front / sin(spec.slope) + HOLE_ROOM
    half = min(case.panel, 0.01) / 2
    if spec.holes and y1 - y0 > 0.04:
        yield plank(PartLabel.SHELF, "pigeonhole_shelf", inside, ((-x, y0, z), (x, y1, z + 2 * half)))
        for middle in np.linspace(-x, x, spec.holes + 1)[1:-1].tolist():
            span = ((middle - half, y0, 0.0), (middle + half, y1, z))
            yield plank(PartLabel.DIVIDER, "pigeonhole", inside, span)


def _flap(spec: Bureau) -> Iterator[PieceDraft]:
    """Yields the flap: made upright, then leant back about its pin."""
    case = spec.lower.case
    x = case.width / 2 - case.panel
    setting = Setting(0.0, 0.1, "inset", spec.lower.front, spec.lower.gap, finish=spec.lower.finish)
    lean = from_rotation(rotation_matrix(vec3(1.0, 0.0, 0.0), spec.slope - pi / 2), vec3(0.0, case.front, spec.sill))
    flap = Door("bottom", spec.flap.leaf, spec.flap.handle, pi - spec.slope, hold=spec.flap.hold, grip=spec.flap.grip)
    for piece in front_pieces(Cell(flap, Rect(-x, x, 0.0, spec.length), Edges()), setting):
        yield piece.transformed(lean)
