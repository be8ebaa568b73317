"""Parametric drawer rails: a channel on the wall, a bar on the drawer that runs in it.

How a pose stays clean and connected, by construction (frames: `template.py`; t is the thickness, h the height):

* Whatever moves, and whatever it could meet, keeps one cross-section along the slide, and the two cross-sections are
  apart by `g` = min(0.2 mm, 3 % of t): nothing can meet at any travel, and with 15 % of the length still inside at
  full travel the ends stay within 0.5 mm.
* The channel fills x in [0, 0.55 t], z in [-h/2, h/2]; the bar runs behind the channel's lips, and the drawer's plate
  fills the rest up to x = t. Both are as long as the rail.
* The corner mount also has a shelf under the drawer: x from the plate to t + `shelf_width`, z in
  [-h/2 - `shelf_thickness`, -h/2]. Its support plane is the shelf's upper face, z = -h/2, x in [t, t + shelf_width].
"""

from functools import lru_cache
from typing import final

import numpy as np
from shapely.geometry import Polygon, box
from shapely.geometry.base import BaseGeometry
from shapely.ops import unary_union

from grafu.dataclass import dataclass
from grafu.errors import TemplateError
from grafu.geometry.appearance import Material, Surface
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.templates.solids import COATED, NYLON, SCREW, STEEL, ZINC, ball, disc, extrude, finished, placed, tube
from grafu.templates.template import RailModel, RailSize, RailTemplate, SnapPlane, TemplateEnd
from grafu.vocabulary import MechanismClass

TRAVEL = 0.85  # fraction of the length that a rail gives (it must keep a lap to carry the drawer)
_CHANNEL = 0.55  # fraction of the thickness that the static channel fills


@final
@dataclass(frozen=True, slots=True)
class RailStyle:
    """What tells one rail from another: its mount, its metal, and whether balls or rollers carry the drawer."""

    mechanism: MechanismClass
    static_material: Material
    dynamic_material: Material
    rollers: bool


CENTRE_STYLE = RailStyle(MechanismClass.CENTRE, ZINC, STEEL, rollers=False)
CORNER_STYLE = RailStyle(MechanismClass.CORNER, COATED, COATED, rollers=True)


@final
@dataclass(frozen=True, slots=True)
class _Section:
    """The cross-section's measures in metres: sheet `wall`, gap `g`, channel width `a`, bar and lip half heights."""

    t: float
    half: float
    wall: float
    g: float
    a: float
    bar: float
    lip: float

    @property
    def bar_x(self) -> tuple[float, float]:
        """The bar's extent across: behind the lips, off the channel's back by twice the gap (screw heads sit there)."""
        return self.wall + 2 * self.g, self.a - self.wall - self.g

    @property
    def lane(self) -> float:
        """The height of the lanes above and below the bar, in which balls or rollers sit."""
        return self.half - self.wall - self.bar


def _section(size: RailSize) -> _Section:
    t, half = size.thickness, size.height / 2
    wall = min(0.12 * t, 0.1 * half, 0.0015)
    bar = half - wall - min(0.3 * half, max(0.25 * t, 0.12 * half))
    return _Section(t, half, wall, min(2e-4, 0.03 * t), _CHANNEL * t, bar, 0.72 * bar)


def shelf_of(size: RailSize) -> tuple[float, float]:
    """Returns the corner mount's shelf: how far it reaches under the drawer and how thick it is, metres."""
    return min(0.012, 0.5 * size.height), min(0.0015, 0.08 * size.height)


def rail_model(id: str, title: str, style: RailStyle, natural: RailSize) -> RailModel:  # noqa: A002
    """Returns a model that builds this style at any size and remembers what it built."""

    @lru_cache(maxsize=256)
    def build(size: RailSize) -> RailTemplate:
        return build_rail(id, style, size)

    return RailModel(id, title, style.mechanism, natural, build)


def build_rail(id: str, style: RailStyle, size: RailSize) -> RailTemplate:  # noqa: A002
    """Returns a rail of a style and size in its own frame, closed.

    Raises:
        TemplateError: if a size is not positive.
    """
    if min(size.length, size.height, size.thickness) <= 0:
        raise TemplateError(f"rail `{id}` needs positive sizes: got {size}")
    section, corner = _section(size), style.mechanism is MechanismClass.CORNER
    u, v = vec3(0.0, size.length / 2.0, 0.0), vec3(0.0, 0.0, size.height / 2.0)
    static = TemplateEnd(_static_surfaces(style, size, section), SnapPlane(np.zeros(3), vec3(-1.0, 0.0, 0.0), u, v))
    flank = SnapPlane(vec3(size.thickness, 0.0, 0.0), vec3(1.0, 0.0, 0.0), u, v)
    dynamic = TemplateEnd(_dynamic_surfaces(style, size, section), flank)
    support = _support_plane(size) if corner else None
    return RailTemplate(id, style.mechanism, static, dynamic, TRAVEL * size.length, size, support)


def _support_plane(size: RailSize) -> SnapPlane:
    width, _ = shelf_of(size)
    center = vec3(size.thickness + width / 2.0, 0.0, -size.height / 2.0)
    return SnapPlane(center, vec3(0.0, 0.0, 1.0), vec3(0.0, size.length / 2.0, 0.0), vec3(width / 2.0, 0.0, 0.0))


def _static_surfaces(style: RailStyle, size: RailSize, c: _Section) -> tuple[Surface, ...]:
    holes = [(y, 0.0) for y in _stations(size)]
    radius = min(0.0026, 0.3 * c.half, 0.04 * size.length)
    back = box(-size.length / 2, -c.half, size.length / 2, c.half)
    drilled = back.difference(unary_union([disc(h, 1.35 * radius) for h in holes]))
    sheet = [_across(extrude(drilled, 0.0, c.wall)), _along(_channel_plan(c), size)]
    heads = merge_meshes([_across(extrude(disc(h, 1.4 * radius), 0.0, c.wall + 0.6 * c.g)) for h in holes])
    carriers = _rollers(size, c) if style.rollers else _balls(size, c)
    carrier_material = NYLON if style.rollers else STEEL
    parts = [(merge_meshes(sheet), style.static_material), (heads, SCREW), (carriers, carrier_material)]
    return tuple(finished(mesh, material) for mesh, material in parts)


def _channel_plan(c: _Section) -> BaseGeometry:
    """Returns the channel's flanges and lips in (x, z); the drilled back is made apart and laps them."""
    flange = box(0.5 * c.wall, c.half - c.wall, c.a, c.half)
    lip = box(c.a - c.wall, c.lip, c.a, c.half)
    upper = unary_union([flange, lip])
    return unary_union([upper, _flipped(upper)])


def _flipped(plan: Polygon) -> Polygon:
    return Polygon([(x, -z) for x, z in plan.exterior.coords])


def _dynamic_surfaces(style: RailStyle, size: RailSize, c: _Section) -> tuple[Surface, ...]:
    x0, x1 = c.bar_x
    plate_x = max(c.a + c.g, c.t - 2 * c.wall)
    bar = box(x0, -c.bar, x1, c.bar)
    stem = box(x1 - c.wall / 2, -c.lip + c.g, plate_x + 0.3 * (c.t - plate_x), c.lip - c.g)
    plan = unary_union([_hollow(bar, c), stem])
    slots = [(y, z * 0.86 * c.half) for y in _stations(size) for z in (-1.0, 1.0)]
    radius = min(0.0022, 0.1 * c.half, 0.04 * size.length)
    plate = box(-size.length / 2, -c.half, size.length / 2, c.half)
    drilled = plate.difference(unary_union([disc(s, radius) for s in slots]))
    solids = [_along(plan, size), _across(extrude(drilled, plate_x, c.t))]
    if style.mechanism is MechanismClass.CORNER:
        width, depth = shelf_of(size)
        sheet = c.t - plate_x
        shelf = box(plate_x + 0.1 * sheet, -c.half - depth, c.t + width, -c.half)
        tongue = box(plate_x + 0.25 * sheet, -c.half - depth / 2, plate_x + 0.75 * sheet, -c.half + c.wall)
        solids.append(_along(unary_union([shelf, tongue]), size))
    return (finished(merge_meshes(solids), style.dynamic_material),)


def _hollow(bar: Polygon, c: _Section) -> BaseGeometry:
    """Returns the bar's own section: a U open to the wall, so that it looks like bent sheet."""
    x0, _, x1, top = bar.bounds
    groove = box(x0 - c.wall, -top + 1.5 * c.wall, x1 - 1.5 * c.wall, top - 1.5 * c.wall)
    return bar.difference(groove)


def _stations(size: RailSize) -> list[float]:
    """Returns where along the slide the screws sit."""
    return [ratio * size.length for ratio in (-0.42, -0.2, 0.2, 0.42)]


def _balls(size: RailSize, c: _Section) -> TriangleMesh:
    """Returns a short cage of balls in both lanes near the rail's front; it stays with the channel."""
    radius = min(c.lane / 2 - c.g, (c.bar_x[1] - c.bar_x[0]) / 2)
    middle = (c.bar_x[0] + c.bar_x[1]) / 2
    one = ball(radius)
    pitch = max(2.6 * radius, 0.02 * size.length)
    count = max(1, min(4, int(0.3 * size.length / pitch)))
    rows = []
    for side in (-1.0, 1.0):
        z = side * (c.half - c.wall - 0.9 * radius)  # pressed a little into the flange that carries it
        front = -size.length / 2 + 1.5 * radius
        rows += [one.translated(vec3(middle, front + k * pitch, z)) for k in range(count)]
    return merge_meshes(rows)


def _rollers(size: RailSize, c: _Section) -> TriangleMesh:
    """Returns two nylon rollers in the lower lane, axles across; they stay with the channel."""
    radius = c.lane / 2 - c.g
    x0, x1 = c.bar_x
    wheel = tube(0.0, radius, (0.0, x1 - x0 + 0.5 * c.wall), 14)
    across = placed(wheel, vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0))
    z = -c.half + c.wall + 0.95 * radius
    return merge_meshes([across.translated(vec3(x0, y, z)) for y in (-0.47 * size.length, -0.35 * size.length)])


def _along(plan: BaseGeometry, size: RailSize) -> TriangleMesh:
    """Returns a cross-section in (x, z) drawn out along the whole rail."""
    return placed(
        extrude(plan, -size.length / 2, size.length / 2), vec3(1.0, 0.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(0.0, 1.0, 0.0)
    )


def _across(plate: TriangleMesh) -> TriangleMesh:
    """Returns a plate drawn in (y, z, x)."""
    return placed(plate, vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0), vec3(1.0, 0.0, 0.0))
