"""What tables and desks consist of besides drawers: tops, legs, hutches, mirrors."""

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal

import numpy as np

from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import translation
from grafu.graph.edges import Turn
from grafu.synth.cabinets.cabinet import Cabinet, cabinet_pieces
from grafu.synth.case.bases import CORNERS, METAL
from grafu.synth.case.construction import Top, TopEdge
from grafu.synth.case.legs import Leg, leg_meshes
from grafu.synth.case.tops import top_meshes
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, both_sides, plank, solid
from grafu.synth.pieces.finish import Finish
from grafu.synth.pieces.shapes import board, prism
from grafu.vocabulary import PartLabel

Outline = Literal["straight", "round"]
WITHIN_ROUND = 0.66  # a rectangle of this fraction of a round top's sides lies within it (0.66^2 * 2 < 1)


SWIVEL_ROOM, POST, PLAY = 0.03, 0.025, 0.003  # metres: below a mirror that tilts, its posts' width, beside these


def table_top(outline: Outline, box: Box, edge: TopEdge, glass: bool, finish: Finish) -> PieceDraft:
    """Returns a top that fills the box: straight with edges of any kind, or round (oval where the box is longer)."""
    material = finish.glass if glass else finish.case
    if outline == "round":
        angles = 2 * np.pi * np.arange(32) / 32
        (x, y, _), (a, b, _) = box.center.tolist(), box.half.tolist()
        ring = tuple((x + a * float(np.cos(t)), y + b * float(np.sin(t))) for t in angles)
        meshes = [prism(ring, float(box.low[2]), float(box.high[2]))]
    else:
        meshes = top_meshes(Top("over", edge=edge), box)
    return solid(PartLabel.TOP_PANEL, "table_top", material, meshes)


def table_legs(leg: Leg, feet: tuple[float, float], high: float, apron: float, finish: Finish) -> Iterator[PieceDraft]:
    """Yields four legs up to `high`, their middles at (+-x, +-y); shaped ones are square blocks beside the apron."""
    material = finish.metal if leg.shape in METAL else finish.case
    for sx, sy in CORNERS:
        yield solid(PartLabel.LEG, "leg", material, table_leg(leg, (sx * feet[0], sy * feet[1]), (sx, sy), high, apron))


def table_leg(
    leg: Leg, at: tuple[float, float], outward: tuple[float, float], high: float, apron: float
) -> list[TriangleMesh]:
    """Returns the solids of one leg."""
    if leg.shape in ("square", "caster") or not apron:
        return leg_meshes(leg, at, outward, high)
    h, low = leg.thick / 2, high - apron
    block = board((at[0] - h, at[1] - h, low), (at[0] + h, at[1] + h, high))
    return [*leg_meshes(leg, at, outward, low), block]


def on_top(cabinet: Cabinet, depth: float, height: float) -> list[PieceDraft]:
    """Returns a hutch that stands on a top of this depth and height, at its back edge."""
    back = cabinet.case.depth / 2 + (cabinet.case.back.thickness if cabinet.case.back.planted else 0.0)
    lift = translation(vec3(0.0, depth / 2 - back, height))
    return [piece.transformed(lift) for piece in cabinet_pieces(cabinet)]


def mirror_pieces(
    width: float, height: float, depth: float, base: float, finish: Finish, swivel: float = 0.0
) -> Iterator[PieceDraft]:
    """Yields a framed mirror that stands on a top of this depth at the height `base`, at its back edge.

    It tilts forward by up to `swivel` radians between two posts, about a level axis through its middle; 0: it is fixed.
    """
    x, y, w = width / 2, depth / 2 - 0.03, min(0.04, width / 8)
    z0, z1 = base + (SWIVEL_ROOM if swivel else 0.0), base + height
    bars = (
        ((-x, y, z0), (w - x, y + 0.02, z1)),
        ((x - w, y, z0), (x, y + 0.02, z1)),
        ((w - x, y, z0), (x - w, y + 0.02, z0 + w)),
        ((w - x, y, z1 - w), (x - w, y + 0.02, z1)),
    )
    frame = plank(PartLabel.MISC, "mirror_frame", finish.case, *bars)
    pane = plank(PartLabel.MISC, "mirror", finish.glass, ((w - x, y + 0.008, z0 + w), (x - w, y + 0.012, z1 - w)))
    if not swivel:
        yield from (frame, pane)
        return
    middle = (z0 + z1) / 2
    for side, span in both_sides(((x + PLAY, y, base), (x + PLAY + POST, y + 0.02, middle + POST))):
        yield plank(PartLabel.MISC, f"mirror_post_{side}", finish.case, span)
    axis = Axis(vec3(0.0, y + 0.01, middle), vec3(1.0, 0.0, 0.0))
    yield replace(frame, motion=PieceMotion(Turn.joint_type, axis, swivel), attached=(pane,))
