"""The shapes of bar handles: on posts, bent, arched, strips, edge profiles, drop handles. Frame: see `handle`."""

from functools import lru_cache

import numpy as np
from shapely.geometry import Polygon

from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.sweep import Section, chamfered_rectangle, circle, swept
from grafu.templates.solids import extrude, placed, turned

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


def _on_posts(length: float, protrusion: float, section: Section, share: float, radius: float) -> Meshes:
    """Returns a straight bar of a section (depth, height) on two posts, `share` of its length apart."""
    y = float(section[:, 0].max()) - protrusion
    bar = swept(np.array([(-length / 2, y, 0.0), (length / 2, y, 0.0)]), section, _Z)
    post = circle(min(radius, length / 10), 8)
    feet = [np.array([(x, 0.0, 0.0), (x, y, 0.0)]) for x in (-share * length / 2, share * length / 2)]
    return (*(swept(path, post, _Z) for path in feet), bar)
