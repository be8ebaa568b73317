"""All families of furniture: a table from name to weight and drawing function; and a drawn piece before it is made.

The weights follow what PartNet-Mobility's StorageFurniture and Table hold: kitchen base and wall units about a third,
sideboards, dressers and nightstands a quarter, wardrobes and tall units one in eight, TV furniture and shelves one in
twelve each; tables and desks with drawers one in eight; the rest is there for variety, and so that each way to move is
seen: appliances are one in twenty, doors and windows of buildings one in thirty. All chance lies in the drawing
(`draw_blueprint`); a second table, from spec type to maker, makes what was drawn, deterministically.
"""

from collections.abc import Callable, Mapping
from typing import Any, final

import numpy as np

from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.synth.appliances.appliance import Appliance, make_appliance
from grafu.synth.appliances.washing_machine import WashingMachine, make_washing_machine
from grafu.synth.cabinets.bureau import Bureau, make_bureau
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.cabinets.corner import CornerCabinet, InnerCorner, make_corner_cabinet, make_inner_corner
from grafu.synth.cabinets.ensemble import Ensemble, make_ensemble
from grafu.synth.cabinets.folding import FoldingCorner, make_folding_corner
from grafu.synth.cabinets.rack import Rack, make_rack
from grafu.synth.families import bedroom, beds, built_in, composed, kitchen, living, office, tables
from grafu.synth.openings.door import DoorSpec, make_building_door
from grafu.synth.openings.window import WindowSpec, make_window_with_labels
from grafu.synth.sampling.chance import pick
from grafu.synth.tables.desk import Desk, make_desk
from grafu.synth.tables.drop_leaf import DropLeafTable, make_drop_leaf_table
from grafu.synth.tables.extending import ExtendingTable, make_extending_table
from grafu.synth.tables.table import DrawerTable, make_table
from grafu.vocabulary import PieceKind

Storage = Cabinet | Chest | CornerCabinet | InnerCorner | FoldingCorner | Rack | Ensemble | Bureau
Spec = (
    Storage | DrawerTable | Desk | DropLeafTable | ExtendingTable | Appliance | WashingMachine | DoorSpec | WindowSpec
)
Draw = Callable[[np.random.Generator], Spec]

FAMILIES: Mapping[str, tuple[float, Draw]] = {
    "base cabinet": (14.5, kitchen.base_cabinet),
    "wall cabinet": (12.5, kitchen.wall_cabinet),
    "sink cabinet": (3.0, kitchen.sink_cabinet),
    "corner cabinet": (1.8, kitchen.corner_cabinet),
    "washstand": (5.5, kitchen.washstand),
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
    "rack": (1.8, living.rack),
    "free form": (3.5, living.free_form),
    "filing cabinet": (1.5, office.filing_cabinet),
    "plan chest": (4.2, office.plan_chest),
    "desk": (4.0, tables.desk),
    "writing desk": (3.5, tables.writing_desk),
    "table with drawers": (8.5, tables.drawer_table),
    "bureau": (1.0, office.bureau),
    "vanity": (1.2, tables.vanity),
    "drop-leaf table": (1.1, tables.drop_leaf_table),
    "extending table": (1.1, tables.extending_table),
    "fridge": (2.2, office.fridge),
    "oven": (1.2, office.oven),
    "appliance": (7.5, built_in.appliance),
    "building door": (2.1, built_in.building_door),
    "window": (2.1, built_in.building_window),
    "bed": (1.5, beds.bed),
}


KINDS: Mapping[str, PieceKind] = {
    **dict.fromkeys(("base cabinet", "corner cabinet", "sideboard", "TV stand", "lowboard"), PieceKind.CABINET),
    **dict.fromkeys(("display cabinet", "hutch", "shoe cabinet", "free form"), PieceKind.CABINET),
    **dict.fromkeys(("dresser", "nightstand", "apothecary chest"), PieceKind.CHEST_OF_DRAWERS),
    **dict.fromkeys(("filing cabinet", "plan chest"), PieceKind.CHEST_OF_DRAWERS),
    **dict.fromkeys(("bookcase", "open shelf", "rack"), PieceKind.SHELF),
    **dict.fromkeys(("tall cabinet", "wardrobe"), PieceKind.WARDROBE),
    **dict.fromkeys(("sink cabinet", "washstand"), PieceKind.SINK_UNIT),
    **dict.fromkeys(("kitchen island", "kitchen units"), PieceKind.KITCHEN),
    **dict.fromkeys(("table with drawers", "drop-leaf table", "extending table"), PieceKind.TABLE),
    **dict.fromkeys(("desk", "writing desk", "bureau", "vanity"), PieceKind.DESK),
    "wall cabinet": PieceKind.WALL_CABINET,
    "chest": PieceKind.CHEST,
    "bed": PieceKind.BED,
    "fridge": PieceKind.REFRIGERATOR,
    "oven": PieceKind.OVEN,
    "building door": PieceKind.BUILDING_DOOR,
    "window": PieceKind.WINDOW,
}
"""What a piece of each family is; an appliance's blueprint states it itself."""


def kind_of_piece(blueprint: "Blueprint") -> PieceKind:
    """Returns what a piece is."""
    spec = blueprint.spec
    if isinstance(spec, WashingMachine):
        return PieceKind.WASHING_MACHINE
    return PieceKind(spec.kind) if isinstance(spec, Appliance) else KINDS[blueprint.family]


ATTEMPTS = 50  # draws of one family before giving up: at a rejection rate of 20 % this never happens

MAKERS: dict[type, Callable[[Any], Asset]] = {
    Cabinet: make_cabinet,
    DrawerTable: make_table,
    Desk: make_desk,
    Chest: make_chest,
    CornerCabinet: make_corner_cabinet,
    InnerCorner: make_inner_corner,
    Rack: make_rack,
    Ensemble: make_ensemble,
    Bureau: make_bureau,
    FoldingCorner: make_folding_corner,
    DropLeafTable: make_drop_leaf_table,
    ExtendingTable: make_extending_table,
    Appliance: make_appliance,
    WashingMachine: make_washing_machine,
    DoorSpec: make_building_door,
    WindowSpec: make_window_with_labels,
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
