"""Tables with leaves that hang from hinges at the top's edges, straight or half round.

What carries the raised leaves may be drawn, with joints of its own (`drop_leaf_supports`).
"""

from collections.abc import Iterator
from dataclasses import replace
from math import pi
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Hinge
from grafu.synth.case.legs import Leg, LegShape
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, assemble, plank, straight
from grafu.synth.pieces.finish import PLAIN, Finish, surface_of
from grafu.synth.pieces.shapes import prism_along_x
from grafu.synth.sampling.chance import between
from grafu.synth.tables.drop_leaf_supports import LeafSupports, TableEnd, apron_of, bars_of, drawn_supports, supports_of
from grafu.synth.tables.table_parts import table_legs
from grafu.vocabulary import PartLabel

ARC = 17  # points along a round leaf's edge


@final
@dataclass(frozen=True, slots=True)
class DropLeafTable:
    """A table, metres: a fixed top of `width` by `depth` and, at its ends, `leaves` that hang and are `drop` long.

    Legs are `leg` wide, of any shape, and stand back from the top's edges by `overhang`; `supports` carry each leaf
    once it is raised (None: not drawn). Leaves are boards, or half round with `is_round`.

    Raises:
        ValueError: if there are neither one nor two leaves, they reach the floor, or supports find no room behind them.
    """

    name: str = "drop_leaf_table"
    width: float = 0.6
    depth: float = 0.8
    height: float = 0.75
    top: float = 0.022
    drop: float = 0.4
    leaves: int = 2
    leg: float = 0.05
    apron: float = 0.1
    gap: float = 0.002
    overhang: float = 0.02
    supports: LeafSupports | None = None
    finish: Finish = PLAIN
    leg_shape: LegShape = "square"
    leg_foot: float = 0.6
    is_round: bool = False

    def __post_init__(self) -> None:
        if self.leaves not in (1, 2) or self.drop > self.height - self.top:
            got = f"{self.leaves} of {self.drop} m"
            raise ValueError(f"`DropLeafTable` needs one or two leaves that end above the floor: got {got}")
        if self.supports and self.supports.kind != "loper" and self.supports.thickness >= self.overhang:
            got = f"{self.supports.thickness} m in {self.overhang} m"
            raise ValueError(f"`DropLeafTable.overhang` must hold the supports behind a leaf: got {got}")


def drawn_drop_leaf_table(rng: np.random.Generator, name: str) -> DropLeafTable:
    """Returns a table of random size."""
    height = between(rng, (0.5, 0.8))
    return DropLeafTable(
        name,
        between(rng, (0.35, 1.0)),
        between(rng, (0.5, 1.0)),
        height,
        between(rng, (0.016, 0.03)),
        between(rng, (0.25, 0.7)) * height,
        int(rng.integers(1, 3)),
        between(rng, (0.035, 0.06)),
        between(rng, (0.07, 0.13)),
        between(rng, (0.001, 0.003)),
    )


def drawn_supported_table(rng: np.random.Generator, name: str) -> DropLeafTable:
    """Returns a table of random size with supports of its leaves."""
    plain = drawn_drop_leaf_table(rng, name)
    depth, drop = between(rng, (0.7, 1.0)), between(rng, (0.3, 0.6)) * plain.height
    return replace(plain, depth=depth, drop=drop, overhang=0.035, supports=drawn_supports(rng, depth))


def make_drop_leaf_table(spec: DropLeafTable) -> Asset:
    """Returns the table with its leaves' true joints: from hanging to level."""
    sides = (-1.0, 1.0)[: spec.leaves]
    leaves = [_leaf(spec, side) for side in sides]
    if spec.supports is not None:
        leaves += [piece for side in sides for piece in supports_of(_frame(spec, side), spec.supports)]
    return assemble(spec.name, [*_stand(spec), *leaves])


def _stand(spec: DropLeafTable) -> Iterator[PieceDraft]:
    x, y, under = spec.width / 2, spec.depth / 2, spec.height - spec.top
    yield plank(PartLabel.TOP_PANEL, "top", spec.finish.front, ((-x, -y, under), (x, y, spec.height)))
    inset, wood, leg = spec.overhang, spec.finish.case, Leg(spec.leg_shape, spec.leg, spec.leg_foot)
    feet = x - inset - spec.leg / 2, y - inset - spec.leg / 2
    yield from table_legs(leg, feet, under, spec.apron, spec.finish)
    inner_x, low = x - inset - spec.leg, under - spec.apron
    for side in (-1.0, 1.0):
        ends = sorted((side * (y - inset - 0.005), side * (y - inset - 0.023)))
        yield plank(PartLabel.BAR, "apron", wood, ((-inner_x, ends[0], low), (inner_x, ends[1], under)))
        supports = spec.supports if side < 0 or spec.leaves > 1 else None
        frame = _frame(spec, side)
        yield plank(PartLabel.BAR, "apron", wood, *apron_of(frame, supports))
        yield from (plank(PartLabel.BAR, "stretcher", wood, bar) for bar in bars_of(frame, supports))


def _frame(spec: DropLeafTable, side: float) -> TableEnd:
    """Returns the frame at the left (`side` -1) or the right end: the apron stands back a little behind the legs."""
    face, free = spec.width / 2 - spec.overhang - 0.005, spec.depth / 2 - spec.overhang - spec.leg
    return TableEnd(side, face, 0.018, free, spec.height - spec.top, spec.apron, spec.drop, spec.finish.case)


def _leaf(spec: DropLeafTable, side: float) -> PieceDraft:
    """Returns a leaf that hangs at the left (`side` -1) or the right end of the top, and turns up about its edge."""
    near = side * (spec.width / 2 + spec.gap)
    ends = sorted((near, near + side * spec.top))
    span = ((ends[0], -spec.depth / 2, spec.height - spec.drop), (ends[1], spec.depth / 2, spec.height))
    axis = Axis(vec3(near, 0.0, spec.height), vec3(0.0, -side, 0.0))
    mesh = straight(*span)
    if spec.is_round:
        angles = np.linspace(pi, 2 * pi, ARC)
        rim = zip((spec.depth / 2 * np.cos(angles)).tolist(), (spec.drop * np.sin(angles)).tolist(), strict=True)
        mesh = prism_along_x([(y, spec.height + z) for y, z in rim], ends[0], ends[1])
    surfaces = (surface_of(mesh, spec.finish.front),)
    return PieceDraft(PartLabel.DOOR, "leaf", surfaces, PieceMotion(Hinge.joint_type, axis, pi / 2))
