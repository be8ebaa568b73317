"""The built-in handles: one table of styles and real-world sizes, and the shapes. It builds nothing until asked.

Bars: on posts, bent, arched, strips, edge profiles, drop handles. Cups: hollow shells on the front, open below for the
fingers. Knobs: turned ones from a table of profiles, square ones, rings. Frame: see `handle`.
"""

from collections.abc import Callable
from functools import cache, lru_cache

import numpy as np
from shapely.geometry import Polygon

from grafu.errors import TemplateError
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import Rings, Section, chamfered_rectangle, circle, loft, sheet, swept
from grafu.templates.solids import extrude, placed, turned
from grafu.templates.template import HandleSize, HandleTemplate

Meshes = tuple[TriangleMesh, ...]
_CACHED = 128  # shapes kept per style: a piece of furniture repeats a few sizes
_X, _Y, _Z = vec3(1.0, 0.0, 0.0), vec3(0.0, 1.0, 0.0), vec3(0.0, 0.0, 1.0)


@lru_cache(_CACHED)
def round_bar(length: float, protrusion: float) -> Meshes:
    """Returns a round bar on two round posts near its ends."""
    return _on_posts(length, protrusion, circle(min(0.006, protrusion / 4, length / 8), 12), 0.8, 0.004)


@lru_cache(_CACHED)
def tee_bar(length: float, protrusion: float) -> Meshes:
    """Returns a thick round bar whose ends reach far beyond its posts."""
    return _on_posts(length, protrusion, circle(min(0.007, protrusion / 4, length / 8), 16), 0.6, 0.005)


@lru_cache(_CACHED)
def strip(length: float, protrusion: float) -> Meshes:
    """Returns a flat strip, broad to the front, on two posts."""
    half = min(0.003, protrusion / 6), min(0.009, length / 6)
    return _on_posts(length, protrusion, chamfered_rectangle(half, 0.0015), 0.84, 0.005)


@lru_cache(_CACHED)
def square_bar(length: float, protrusion: float) -> Meshes:
    """Returns a square bar bent at right angles to the front at both ends."""
    half = min(0.005, protrusion / 4, length / 8)
    x, y = length / 2 - half, half - protrusion
    path = np.array([(-x, 0.0, 0.0), (-x, y, 0.0), (x, y, 0.0), (x, 0.0, 0.0)])
    return (swept(path, chamfered_rectangle((half, half), 0.3 * half), _Z),)


@lru_cache(_CACHED)
def slim_bar(length: float, protrusion: float) -> Meshes:
    """Returns a thin rod bent round to the front at both ends."""
    radius = min(0.004, protrusion / 5, length / 8)
    x, y = length / 2 - radius, radius - protrusion
    bend = min(0.6 * -y, 0.5 * x)
    angles = np.linspace(0.0, np.pi / 2, 5)
    corner = np.column_stack([-x + bend * (1 - np.cos(angles)), y + bend * (1 - np.sin(angles)), np.zeros(5)])
    path = np.vstack([[(-x, 0.0, 0.0)], corner, corner[::-1] * (-1.0, 1.0, 1.0), [(x, 0.0, 0.0)]])
    return (swept(path, circle(radius, 8), _Z),)


@lru_cache(_CACHED)
def arched_bar(length: float, protrusion: float) -> Meshes:
    """Returns a flat band that rises from the front in an arch."""
    half = min(0.003, protrusion / 6, length / 10)
    angles = np.linspace(0.0, np.pi, 15)
    x, y = -(length / 2 - half) * np.cos(angles), (half - protrusion) * np.sin(angles) ** 0.8
    path = np.column_stack([x, y, np.zeros(15)])
    path[[0, -1], 1] = 0.0
    band = swept(path, circle(half, 8, flat=2.0), _Z, (-_Y, _Y))
    fill = np.array([length, protrusion, 1.0]) / np.array([*band.box.size[:2], 1.0])  # its mitres stand out a little
    return (TriangleMesh(band.vertices * fill, band.faces),)


@lru_cache(_CACHED)
def profile(length: float, protrusion: float) -> Meshes:
    """Returns a long edge profile: a plate on the front whose upper edge juts out and bends down for the fingers."""
    wall, top = min(0.002, protrusion / 6), min(0.014, length / 4)
    bend = min(0.006, protrusion / 2, top)
    tip = top - min(0.011, 2 * top)
    angles = np.linspace(np.pi / 2, 0.0, 4)
    turn = np.column_stack([np.cos(angles), np.sin(angles)])
    outer = np.array([protrusion - bend, top - bend]) + bend * turn
    inner = np.array([protrusion - bend, top - bend]) + (bend - wall) * turn[::-1]
    plate, lip = [(0.0, -top), (0.0, top)], [(protrusion, tip), (protrusion - wall, tip)]
    section = np.vstack([plate, outer, lip, inner, [(wall, top - wall), (wall, -top)]])
    return (placed(extrude(Polygon(section), -length / 2, length / 2), -_Y, _Z, -_X),)


@lru_cache(_CACHED)
def bail(length: float, protrusion: float) -> Meshes:
    """Returns a drop handle: a bow that hangs from two posts on rosettes."""
    radius = min(0.0035, protrusion / 4, length / 12)
    foot = min(0.011, length / 6)
    x, y = length / 2 - foot, radius - protrusion
    feet = [((0.0, 0.0), (foot, 0.0), (foot, 0.0015), (0.7 * foot, 0.004), (0.0, 0.004))]
    posts = [
        placed(turned(profile, 10), _X, _Z, -_Y).translated(vec3(side * x, 0.0, 0.0))
        for side in (-1.0, 1.0)
        for profile in (*feet, ((0.0, 0.0), (1.4 * radius, 0.0), (1.4 * radius, protrusion), (0.0, protrusion)))
    ]
    angles = np.linspace(0.0, np.pi, 11)
    drop = min(0.55 * x, 0.03)
    bow = np.column_stack([-x * np.cos(angles), np.full(11, y), -drop * np.sin(angles) ** 0.7])
    return (*posts, swept(bow, circle(radius, 8), -_Y))


def _on_posts(length: float, protrusion: float, section: Section, ratio: float, radius: float) -> Meshes:
    """Returns a straight bar of a section (depth, height) on two posts, `ratio` of its length apart."""
    y = float(section[:, 0].max()) - protrusion
    bar = swept(np.array([(-length / 2, y, 0.0), (length / 2, y, 0.0)]), section, _Z)
    post = circle(min(radius, length / 10), 8)
    feet = [np.array([(x, 0.0, 0.0), (x, y, 0.0)]) for x in (-ratio * length / 2, ratio * length / 2)]
    return (*(swept(path, post, _Z) for path in feet), bar)


_WALL = 0.002  # metres of metal
_END = 0.04  # radians short of the shell's ends, where it would be a point


@lru_cache(_CACHED)
def shell(length: float, protrusion: float) -> Meshes:
    """Returns a half dome."""
    return _cup((length, protrusion, min(0.42 * length, 0.04)), 2.0, 1.0)


@lru_cache(_CACHED)
def square_cup(length: float, protrusion: float) -> Meshes:
    """Returns a box-like cup with rounded edges."""
    return _cup((length, protrusion, min(0.4 * length, 0.03)), 8.0, 0.3)


@lru_cache(_CACHED)
def slim_cup(length: float, protrusion: float) -> Meshes:
    """Returns a long, low cup with a round back and straight ends."""
    return _cup((length, protrusion, min(0.2 * length, 0.02)), 16.0, 0.7)


def _cup(size: tuple[float, float, float], fullness: float, roundness: float) -> Meshes:
    """Returns a shell of a length, protrusion and height.

    Along x its sections shrink as a superellipse of exponent `fullness` (2: an ellipse); `roundness` is the exponent of
    its sections' sine and cosine (1: round, towards 0: boxy).
    """
    inner = tuple(max(side - 2 * _WALL if k == 0 else side - _WALL, 0.5 * side) for k, side in enumerate(size))
    outer_grid, inner_grid = (_grid(s, fullness, roundness) for s in (size, (inner[0], inner[1], inner[2])))
    rise = np.array([0.0, 0.0, size[2] / 2])
    return (sheet(outer_grid - rise, inner_grid - rise),)


def _grid(size: tuple[float, float, float], fullness: float, roundness: float) -> Rings:
    """Returns points on the shell, stations from right to left by steps from its foot above to its lip below."""
    along, round_ = np.linspace(_END, np.pi - _END, 13), np.linspace(0.0, np.pi / 2, 6)
    ratio = np.cos(along) / np.cos(_END)
    narrowing = (1 - np.abs(np.cos(along)) ** fullness) ** (1 / fullness)
    out, up = np.sin(round_) ** roundness, np.maximum(np.cos(round_), 0.0) ** roundness
    up[-1] = 0.0  # the cosine of a right angle is not quite nothing
    grid = np.empty((13, 6, 3))
    grid[..., 0] = (size[0] / 2 * ratio)[:, None]
    grid[..., 1] = -size[1] * narrowing[:, None] * out
    grid[..., 2] = size[2] * narrowing[:, None] * up
    return grid


_SIDES = 16

# Profiles from the foot outwards: fractions of the greatest radius and of the protrusion.
ROUND = ((0.45, 0.0), (0.38, 0.3), (0.62, 0.42), (0.92, 0.55), (1.0, 0.7), (0.9, 0.86), (0.6, 0.97), (0.0, 1.0))
FLAT = ((0.35, 0.0), (0.35, 0.62), (0.94, 0.62), (1.0, 0.68), (1.0, 0.94), (0.94, 1.0), (0.0, 1.0))
MUSHROOM = ((0.5, 0.0), (0.32, 0.15), (0.32, 0.5), (0.9, 0.56), (1.0, 0.64), (0.86, 0.84), (0.5, 0.96), (0.0, 1.0))
CONE = ((0.4, 0.0), (0.95, 0.92), (1.0, 0.95), (0.95, 1.0), (0.0, 1.0))
TURNED = (
    (0.9, 0.0), (0.9, 0.07), (0.45, 0.12), (0.36, 0.32), (0.52, 0.4), (0.36, 0.48), (0.85, 0.62), (1.0, 0.75),
    (0.8, 0.9), (0.3, 0.95), (0.22, 1.0), (0.0, 1.0),
)  # fmt: skip


def knob(profile: tuple[tuple[float, float], ...]) -> Callable[[float, float], Meshes]:
    """Returns the shape of a turned knob; its length is its diameter."""

    @lru_cache(_CACHED)
    def shape(length: float, protrusion: float) -> Meshes:
        rows = [(0.0, 0.0), *((radius * length / 2, ratio * protrusion) for radius, ratio in profile)]
        return (placed(turned(rows, _SIDES), _X, _Z, -_Y),)

    return shape


@lru_cache(_CACHED)
def square_knob(length: float, protrusion: float) -> Meshes:
    """Returns a square knob with bevelled edges on a square stem."""
    steps = ((0.45, 0.0), (0.45, 0.45), (0.95, 0.45), (1.0, 0.5), (1.0, 0.92), (0.9, 1.0))
    rings = []
    for ratio, out in steps:
        half = ratio * length / 2
        flat = chamfered_rectangle((half, half), 0.1 * half)
        rings.append(np.column_stack([flat[:, 0], np.full(8, -out * protrusion), flat[:, 1]]))
    return (loft(np.stack(rings)),)


@lru_cache(_CACHED)
def ring(length: float, protrusion: float) -> Meshes:
    """Returns a ring that hangs from a boss on a rosette; the foot plane's origin is the ring's middle."""
    thickness = min(0.003, protrusion / 4, length / 10)
    radius = length / 2 - thickness / np.cos(np.pi / 16)  # a mitred ring stands out at its 16 corners
    angles = 2 * np.pi * np.arange(16) / 16
    path = radius * np.column_stack([np.cos(angles), np.zeros(16), np.sin(angles)])
    hoop = swept(path, circle(thickness, 8), -_Y, closed=True).translated(vec3(0.0, thickness - protrusion, 0.0))
    wide = 0.32 * length
    steps = (1.0, 0.0), (1.0, 0.12), (0.5, 0.25), (0.4, 1.0), (0.0, 1.0)
    boss = [(0.0, 0.0), *((ratio * wide, out * protrusion) for ratio, out in steps)]
    return (placed(turned(boss, 12), _X, _Z, -_Y).translated(vec3(0.0, 0.0, length / 2 - thickness)), hoop)


# Sizes are those of common furniture handles; bars come in hole distances of 96 to 480 mm and as rods of up to 1.2 m,
# edge profiles by the metre.
HANDLES: tuple[HandleTemplate, ...] = (
    HandleTemplate("bar-round", "Round bar", "bar", HandleSize(0.16, 0.034), 1.2, round_bar),
    HandleTemplate("bar-square", "Square bar", "bar", HandleSize(0.138, 0.032), 1.2, square_bar),
    HandleTemplate("bar-slim", "Bent rod", "bar", HandleSize(0.136, 0.028), 0.5, slim_bar),
    HandleTemplate("bar-arched", "Arched band", "bar", HandleSize(0.13, 0.026), 0.35, arched_bar),
    HandleTemplate("bar-tee", "Bar beyond its posts", "bar", HandleSize(0.188, 0.035), 1.2, tee_bar),
    HandleTemplate("bar-strip", "Flat strip", "bar", HandleSize(0.17, 0.025), 1.2, strip),
    HandleTemplate("bar-profile", "Edge profile", "bar", HandleSize(0.2, 0.02), 3.0, profile),
    HandleTemplate("bail", "Drop handle", "bar", HandleSize(0.1, 0.024), 0.2, bail, turns=False),
    HandleTemplate("knob-round", "Round knob", "knob", HandleSize(0.03, 0.026), 0.05, knob(ROUND)),
    HandleTemplate("knob-flat", "Flat knob", "knob", HandleSize(0.032, 0.022), 0.06, knob(FLAT)),
    HandleTemplate("knob-mushroom", "Mushroom", "knob", HandleSize(0.033, 0.028), 0.05, knob(MUSHROOM)),
    HandleTemplate("knob-square", "Square knob", "knob", HandleSize(0.028, 0.026), 0.05, square_knob),
    HandleTemplate("knob-cone", "Cone", "knob", HandleSize(0.024, 0.026), 0.045, knob(CONE)),
    HandleTemplate("knob-turned", "Turned knob", "knob", HandleSize(0.034, 0.034), 0.055, knob(TURNED)),
    HandleTemplate("ring", "Ring", "knob", HandleSize(0.045, 0.018), 0.08, ring, turns=False),
    HandleTemplate("cup-shell", "Shell", "cup", HandleSize(0.09, 0.026), 0.16, shell, turns=False),
    HandleTemplate("cup-square", "Square cup", "cup", HandleSize(0.08, 0.024), 0.16, square_cup, turns=False),
    HandleTemplate("cup-slim", "Slim cup", "cup", HandleSize(0.12, 0.018), 0.3, slim_cup, turns=False),
)


@cache
def handle_template(template_id: str) -> HandleTemplate:
    """Returns a built-in handle.

    Raises:
        TemplateError: if there is no such handle.
    """
    for template in HANDLES:
        if template.id == template_id:
            return template
    raise TemplateError(f"`template_id` must be one of {', '.join(t.id for t in HANDLES)}: got {template_id!r}")
