"""All families of furniture: a table from name to weight and drawing function.

The weights follow what PartNet-Mobility's StorageFurniture and Table hold: kitchen base and wall units about a third,
sideboards, dressers and nightstands a quarter, wardrobes and tall units one in eight, TV furniture and shelves one in
twelve each; tables and desks with drawers one in eight; the rest is there for variety.
"""

from collections.abc import Callable, Mapping

import numpy as np

from grafu.synth.cabinets.bureau import Bureau
from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.chest import Chest
from grafu.synth.cabinets.corner import CornerCabinet
from grafu.synth.cabinets.ensemble import Ensemble
from grafu.synth.cabinets.inner_corner import InnerCorner
from grafu.synth.cabinets.rack import Rack
from grafu.synth.families import bath, bedroom, bureaus, composed, corners, kitchen, living, office, racks, tables
from grafu.synth.tables.desk import Desk
from grafu.synth.tables.table import Table

Spec = Cabinet | Table | Desk | Chest | CornerCabinet | InnerCorner | Rack | Ensemble | Bureau
Draw = Callable[[np.random.Generator], Spec]

FAMILIES: Mapping[str, tuple[float, Draw]] = {
    "base cabinet": (14.5, kitchen.base_cabinet),
    "wall cabinet": (12.5, kitchen.wall_cabinet),
    "sink cabinet": (3.0, kitchen.sink_cabinet),
    "corner cabinet": (1.8, corners.corner_cabinet),
    "washstand": (5.5, bath.washstand),
    "kitchen island": (1.0, composed.island),
    "kitchen units": (1.5, composed.kitchen_units),
    "tall cabinet": (8.3, kitchen.tall_cabinet),
    "wardrobe": (7.0, bedroom.wardrobe),
    "sideboard": (7.5, living.sideboard),
    "dresser": (8.5, bedroom.dresser),
    "nightstand": (6.0, bedroom.nightstand),
    "shoe cabinet": (1.0, bedroom.shoe_cabinet),
    "apothecary chest": (3.6, bedroom.apothecary),
    "chest": (1.5, bedroom.chest),
    "TV stand": (4.5, living.tv_stand),
    "lowboard": (4.0, living.lowboard),
    "bookcase": (3.5, living.bookcase),
    "display cabinet": (2.5, living.display_cabinet),
    "hutch": (1.5, composed.hutch),
    "open shelf": (1.5, living.open_shelf),
    "rack": (1.8, racks.rack),
    "free form": (3.5, living.free_form),
    "filing cabinet": (1.5, office.filing_cabinet),
    "plan chest": (4.2, office.plan_chest),
    "desk": (4.0, tables.desk),
    "writing desk": (3.5, tables.writing_desk),
    "table with drawers": (8.5, tables.drawer_table),
    "bureau": (1.0, bureaus.bureau),
    "vanity": (1.2, tables.vanity),
    "fridge": (0.6, office.fridge),
    "oven": (0.8, office.oven),
}
