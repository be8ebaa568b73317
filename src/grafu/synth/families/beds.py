"""Beds with drawers, doors or open bays below the mattress, on their long side."""

from collections.abc import Mapping

import numpy as np

from grafu.synth.cabinets.ensemble import Ensemble, Placed, Slab
from grafu.synth.families.built import build_cabinet
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Layout, OpenCell
from grafu.synth.sampling.carpentry import PieceSite
from grafu.synth.sampling.casework import Build
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.synth.sampling.style import draw_style
from grafu.synth.sampling.traditions import TraditionName
from grafu.vocabulary import PartLabel

BEDROOM: Mapping[TraditionName, float] = {
    "flat-pack": 0.35, "minimal": 0.25, "shaker": 0.2, "mid-century": 0.1, "ornate": 0.1
}  # fmt: skip
WIDTHS: Mapping[float, float] = {0.8: 1.0, 0.9: 2.0, 1.2: 1.0, 1.4: 2.0, 1.6: 2.0, 1.8: 1.0}  # metres: of mattresses
BELOW = Build(
    bases=("none", "plinth", "legs"), tops=("between", "none"), moulded=False, framed=False, legs=(0.04, 0.15)
)
FOOTBOARD = 0.45  # of beds
DOUBLE = 1.1  # metres: a wider bed has drawers on both sides, none deeper than half of it


def bed(rng: np.random.Generator) -> Ensemble:
    """Returns a bed along x: a low case with fronts to -Y, a mattress, a headboard, a footboard now and then.

    A wide one is two cases back to back.
    """
    style = draw_style(rng, BEDROOM)
    length, width, height = between(rng, (1.9, 2.1)), pick(rng, WIDTHS), between(rng, (0.22, 0.42))
    deep = width if width < DOUBLE else width / 2
    case = build_cabinet(rng, "bed", style, (length, deep, height), _fronts(rng), BELOW, PieceSite(hand=0.9))
    cases: tuple[Placed, ...] = (Placed(case),)
    if deep < width:
        cases = (Placed(case, (0.0, -deep / 2, 0.0)), Placed(case, (0.0, deep / 2, 0.0), turned=True))
    x, y = length / 2, width / 2
    inset, thick, soft = between(rng, (0.0, 0.03)), between(rng, (0.02, 0.08)), between(rng, (0.12, 0.28))
    boards = [Slab(PartLabel.MISC, "mattress", (inset - x, inset - y, height), (x - inset, y - inset, height + soft))]
    head, foot = height + between(rng, (0.35, 0.9)), height + between(rng, (0.05, 0.35))
    boards.append(Slab(PartLabel.SIDE_PANEL, "headboard", (-x - thick, -y, 0.0), (-x, y, head)))
    if chance(rng, FOOTBOARD):
        boards.append(Slab(PartLabel.SIDE_PANEL, "footboard", (x, -y, 0.0), (x + thick, y, foot)))
    return Ensemble("bed", cases, tuple(boards))


def _fronts(rng: np.random.Generator) -> Layout:
    """Returns drawers, open bays or flaps side by side, one at least a drawer or a flap."""
    number = count(rng, 1, 4)
    kinds: Mapping[Layout, float] = {Drawer(): 0.75, OpenCell(): 0.15, Door("bottom"): 0.1}
    same = pick(rng, kinds)
    cells = [same if chance(rng, 0.85) else pick(rng, kinds) for _ in range(number)]
    if all(isinstance(cell, OpenCell) for cell in cells):
        cells[0] = Drawer()
    return CellRow(tuple(cells)) if number > 1 else cells[0]
