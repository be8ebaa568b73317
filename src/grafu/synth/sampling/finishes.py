"""Colours of made furniture: woods, paints, metals, drawn together. It knows no shapes."""

import numpy as np

from grafu.geometry.appearance import Material
from grafu.synth.pieces.finish import BEECH, BIRCH, GLASS, OAK, STEEL, Finish
from grafu.synth.sampling.chance import chance, pick

WOODS = (
    BEECH,
    OAK,
    BIRCH,
    Material("walnut", (0.30, 0.19, 0.12, 1.0), roughness=0.6),
    Material("mahogany", (0.36, 0.14, 0.09, 1.0), roughness=0.5),
    Material("pine", (0.78, 0.60, 0.38, 1.0), roughness=0.75),
)
PAINTS = (
    Material("white paint", (0.90, 0.90, 0.88, 1.0), roughness=0.5),
    Material("grey paint", (0.55, 0.57, 0.58, 1.0), roughness=0.5),
    Material("black paint", (0.10, 0.10, 0.11, 1.0), roughness=0.5),
    Material("blue paint", (0.24, 0.34, 0.44, 1.0), roughness=0.5),
    Material("green paint", (0.38, 0.46, 0.38, 1.0), roughness=0.5),
)
METALS = (
    STEEL,
    Material("brass", (0.71, 0.58, 0.30, 1.0), metallic=1.0, roughness=0.4),
    Material("black metal", (0.08, 0.08, 0.08, 1.0), metallic=0.5, roughness=0.5),
)


def draw_finish(rng: np.random.Generator) -> Finish:
    """Returns a finish: the case in one material, the fronts in the same (two in three) or another."""
    materials = dict.fromkeys(WOODS + PAINTS, 1.0)
    case = pick(rng, materials)
    front = case if chance(rng, 0.65) else pick(rng, materials)
    return Finish(case, front, case if chance(rng, 0.5) else BIRCH, pick(rng, dict.fromkeys(METALS, 1.0)), GLASS)
