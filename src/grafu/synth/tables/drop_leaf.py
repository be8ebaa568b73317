"""Tables with leaves that hang from hinges at the top's edges, straight or half round."""

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import final

import numpy as np

from grafu.asset.part import Asset
from grafu.geometry.arrays import vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Hinge
from grafu.synth.case.legs import Leg, LegShape
from grafu.synth.pieces.assembly import PieceDraft, PieceMotion, assemble, plank, straight
from grafu.synth.pieces.finish import PLAIN, Finish, surface_of
from grafu.synth.pieces.shapes import prism_along_x
from grafu.synth.sampling.chance import between
from grafu.synth.tables.table_parts import table_legs
from grafu.vocabulary import PartLabel

ARC = 17  # points along a round leaf's edge


@final
@dataclass(frozen=True, slots=True)
class DropLeafTable:
    """A table, metres: a fixed top of `width` by `depth` and, at its ends, `leaves` that hang and are `drop` long.

    Legs are `leg` wide and of any shape. Leaves are boards, or half round with `is_round`.

    Raises:
        ValueError: if there are neither one nor two leaves, or they reach the floor.
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
    finish: Finish = PLAIN
    leg_shape: LegShape = "square"
    leg_foot: float = 0.6
    is_round: bool = False

    def __post_init__(self) -> None:
        if self.leaves not in (1, 2) or self.drop > self.height - self.top:
            got = f"{self.leaves} of {self.drop} m"
            raise ValueError(f"`DropLeafTable` needs one or two leaves that end above the floor: got {got}")


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


def make_drop_leaf_table(spec: DropLeafTable) -> Asset:
    """Returns the table with its leaves' true joints: from hanging to level."""
    return assemble(spec.name, [*_stand(spec), *(_leaf(spec, side) for side in (-1.0, 1.0)[: spec.leaves])])


def _stand(spec: DropLeafTable) -> Iterator[PieceDraft]:
    x, y, under = spec.width / 2, spec.depth / 2, spec.height - spec.top
    yield plank(PartLabel.TOP_PANEL, "top", spec.finish.front, ((-x, -y, under), (x, y, spec.height)))
    inset, wood, leg = 0.02, spec.finish.case, Leg(spec.leg_shape, spec.leg, spec.leg_foot)
    feet = x - inset - spec.leg / 2, y - inset - spec.leg / 2
    yield from table_legs(leg, feet, under, spec.apron, spec.finish)
    inner_x, inner_y, low = x - inset - spec.leg, y - inset - spec.leg, under - spec.apron
    for side in (-1.0, 1.0):
        ends = sorted((side * (y - inset - 0.005), side * (y - inset - 0.023)))
        yield plank(PartLabel.BAR, "apron", wood, ((-inner_x, ends[0], low), (inner_x, ends[1], under)))
        ends = sorted((side * (x - inset - 0.005), side * (x - inset - 0.023)))
        yield plank(PartLabel.BAR, "apron", wood, ((ends[0], -inner_y, low), (ends[1], inner_y, under)))


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
