"""A drawn piece of furniture before it is made: its family and its spec, and a table from spec type to maker.

Making is deterministic: all chance lies in the drawing (`draw_blueprint`).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, final

import numpy as np

from grafu.asset.part import Asset
from grafu.synth.cabinets.bureau import Bureau, make_bureau
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.cabinets.corner import CornerCabinet, make_corner_cabinet
from grafu.synth.cabinets.ensemble import Ensemble, make_ensemble
from grafu.synth.cabinets.inner_corner import InnerCorner, make_inner_corner
from grafu.synth.cabinets.rack import Rack, make_rack
from grafu.synth.families.table import FAMILIES, Spec
from grafu.synth.sampling.chance import pick
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.table import Table, make_table

ATTEMPTS = 50  # draws of one family before giving up: at a rejection rate of 20 % this never happens

MAKERS: dict[type, Callable[[Any], Asset]] = {
    Cabinet: make_cabinet,
    Table: make_table,
    Desk: make_desk,
    Chest: make_chest,
    CornerCabinet: make_corner_cabinet,
    InnerCorner: make_inner_corner,
    Rack: make_rack,
    Ensemble: make_ensemble,
    Bureau: make_bureau,
}


@final
@dataclass(frozen=True, slots=True)
class Blueprint:
    """What one piece of furniture is to be."""

    family: str
    spec: Spec


def draw_blueprint(rng: np.random.Generator, family: str | None = None) -> Blueprint:
    """Returns a blueprint of a family drawn by its weight, or of the given one. Same generator state, same blueprint.

    Raises:
        ValueError: if there is no such family.
    """
    return draw_made(rng, family)[0]


def draw_made(rng: np.random.Generator, family: str | None = None) -> tuple[Blueprint, Asset]:
    """Returns a drawn blueprint and the asset made from it: draws that leave some part no room are drawn again."""
    if family is not None and family not in FAMILIES:
        raise ValueError(f"`family` must be one of {', '.join(FAMILIES)}: got {family!r}")
    name = family or pick(rng, {key: weight for key, (weight, _) in FAMILIES.items()})
    reason = ""
    for _ in range(ATTEMPTS):
        try:
            blueprint = Blueprint(name, FAMILIES[name][1](rng))
            return blueprint, make_furniture(blueprint)
        except ValueError as error:
            reason = str(error)
    raise ValueError(f"`{name}` found no room in {ATTEMPTS} draws: {reason}")


def make_furniture(blueprint: Blueprint) -> Asset:
    """Returns the furniture, tidy, with true labels and true joints.

    Raises:
        ValueError: if the spec leaves some part no room.
    """
    return MAKERS[type(blueprint.spec)](blueprint.spec)
