"""Furniture that is made for one way to move, or that is drawn because it has it: what `judge_kinds.py` judges."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from math import radians
from typing import Literal

import numpy as np

from grafu.articulation.motion_kind import motion_kind
from grafu.asset.part import AnnotatedJoint, Asset
from grafu.synth.appliances.appliance import drawn_appliance, make_appliance
from grafu.synth.appliances.washing_machine import drawn_washing_machine, make_washing_machine
from grafu.synth.cabinets.folding import WARDROBE, FoldingDoors, make_folding_doors
from grafu.synth.cabinets.pull_out import drawn_pull_out, make_pull_out
from grafu.synth.cabinets.sliding import drawn_sliding_doors, make_sliding_doors
from grafu.synth.cabinets.tilting import NARROW, TiltingFronts, make_tilting_fronts
from grafu.synth.cabinets.waste import BASE_UNIT, WasteUnit, make_waste_unit
from grafu.synth.families.table import draw_made
from grafu.synth.fronts.setting import Mount
from grafu.synth.openings.door import drawn_door, make_building_door
from grafu.synth.openings.window import drawn_window, make_window
from grafu.synth.sampling.chance import between, chance
from grafu.synth.tables.drop_leaf import drawn_drop_leaf_table, drawn_supported_table, make_drop_leaf_table
from grafu.synth.tables.extending import ExtendingTable, make_extending_table
from grafu.synth.truth.check import faults_of
from grafu.vocabulary import PartLabel

Maker = Callable[[np.random.Generator, str], Asset]


def _mount(rng: np.random.Generator) -> Mount:
    return "overlay" if chance(rng, 0.5) else "inset"


def _folding(rng: np.random.Generator, name: str) -> Asset:
    case = replace(WARDROBE, width=between(rng, (0.8, 1.4)), height=between(rng, (1.6, 2.3)))
    side: Literal["left", "right"] = "left" if chance(rng, 0.5) else "right"
    return make_folding_doors(FoldingDoors(name, case, 2, side, _mount(rng)))


def _tilting(rng: np.random.Generator, name: str) -> Asset:
    rows, columns = int(rng.integers(1, 5)), int(rng.integers(1, 3))
    height = rows * between(rng, (0.32, 0.45)) + 0.08
    case = replace(NARROW, width=columns * between(rng, (0.45, 0.7)), height=height, depth=between(rng, (0.2, 0.36)))
    opening = radians(between(rng, (38.0, 48.0)))
    return make_tilting_fronts(TiltingFronts(name, case, rows, columns, _mount(rng), opening=opening))


def _bin(rng: np.random.Generator, name: str) -> Asset:
    size = between(rng, (0.35, 0.6)), between(rng, (0.6, 0.85)), between(rng, (0.45, 0.6))
    case = replace(BASE_UNIT, width=size[0], height=size[1], depth=size[2])
    room = between(rng, (0.45, 0.9)), between(rng, (0.6, 0.95))
    return make_waste_unit(WasteUnit(name, case, _mount(rng), *room, chance(rng, 0.5), between(rng, (0.6, 0.72))))


def _extending(rng: np.random.Generator, name: str) -> Asset:
    kind: Literal["halves", "draw leaves"] = "halves" if chance(rng, 0.5) else "draw leaves"
    size = between(rng, (1.0, 2.0)), between(rng, (0.7, 1.0)), between(rng, (0.7, 0.78))
    return make_extending_table(ExtendingTable(name, kind, *size, travel=between(rng, (0.4, 0.75))))


Wanted = Callable[[Asset, AnnotatedJoint], bool]


def _of_families(families: tuple[str, ...], wanted: Wanted) -> Maker:
    """Returns a maker that draws pieces of the generator's families until one has such a joint, and no fault."""

    def make(rng: np.random.Generator, name: str) -> Asset:
        while True:
            asset = draw_made(rng, families[int(rng.integers(len(families)))])[1]
            has_it = any(wanted(asset, joint) for joint in (*asset.joints, *asset.small_joints))
            if has_it and not faults_of(asset):
                return replace(asset, name=name)

    return make


def _drawn(words: str, families: tuple[str, ...]) -> Maker:
    """Returns a maker that draws pieces of families until the spec, or a part of one, is called so; without faults."""

    def make(rng: np.random.Generator, name: str) -> Asset:
        while True:
            made, asset = draw_made(rng, families[int(rng.integers(len(families)))])
            has_it = words in repr(made.spec) or any(part.id == words for part in asset.parts)
            if has_it and not faults_of(asset):
                return replace(asset, name=name)

    return make


def _is_flap(_: Asset, joint: AnnotatedJoint) -> bool:
    """Whether a front turns about a level line."""
    return motion_kind(joint.type).turns and abs(float(joint.axis.direction[2])) < LEVEL


def _is_tray(asset: Asset, joint: AnnotatedJoint) -> bool:
    """Whether a low drawer without a handle slides, as one for a keyboard."""
    part = asset.part(joint.part)
    is_grasped = any(other.carried_by == part.id for other in asset.parts)
    return part.label is PartLabel.DRAWER and float(part.box.size[2]) <= TRAY and not is_grasped


def _is_mirror(asset: Asset, joint: AnnotatedJoint) -> bool:
    return motion_kind(joint.type).turns and asset.part(joint.part).label is not PartLabel.DOOR


def _hangs_on_a_leaf(asset: Asset, joint: AnnotatedJoint) -> bool:
    return asset.part(joint.part).carried_by is not None and asset.part(joint.part).label is PartLabel.DOOR


LEVEL = 0.1  # the rise of a unit direction
TRAY = 0.08  # metres
OWN: Mapping[str, Wanted] = {
    "lid": _is_flap,
    "lift-up": _is_flap,
    "lift-parallel": lambda _, joint: motion_kind(joint.type).turns,
    "drop-front": _is_flap,
    "keyboard-tray": _is_tray,
    "refrigerator": lambda _, joint: motion_kind(joint.type).turns,
    "swivel-mirror": _is_mirror,
    "folding-corner": lambda _, joint: motion_kind(joint.type).turns,
    "pocket-door": lambda asset, joint: asset.part(joint.part).label is PartLabel.DOOR,
    "carousel": lambda _, joint: joint.part == "carousel",
}
"""The joints of the kind itself, where its furniture has others, too."""
KINDS: Mapping[str, Maker] = {
    "sliding": lambda rng, name: make_sliding_doors(drawn_sliding_doors(rng, name)),
    "folding": _folding,
    "tilting": _tilting,
    "drop-leaf": lambda rng, name: make_drop_leaf_table(drawn_drop_leaf_table(rng, name)),
    "drop-leaf-supports": lambda rng, name: make_drop_leaf_table(drawn_supported_table(rng, name)),
    "extending": _extending,
    "pull-out": lambda rng, name: make_pull_out(drawn_pull_out(rng, name)),
    "waste-bin": _bin,
    "dishwasher": lambda rng, name: make_appliance(drawn_appliance(rng, name, "dishwasher")),
    "oven": lambda rng, name: make_appliance(drawn_appliance(rng, name, "oven")),
    "microwave": lambda rng, name: make_appliance(drawn_appliance(rng, name, "microwave")),
    "washing-machine": lambda rng, name: make_washing_machine(drawn_washing_machine(rng, name)),
    "building-door": lambda rng, name: make_building_door(drawn_door(rng, name)),
    "casement": lambda rng, name: make_window(drawn_window(rng, name, "casement")),
    "two-leaf-window": lambda rng, name: make_window(drawn_window(rng, name, "pair")),
    "pocket-door": _drawn("Sliding(kind='pocket'", ("sideboard", "TV stand", "lowboard")),
    "shutter": _drawn("Sliding(kind='shutter'", ("wall cabinet", "filing cabinet")),
    "carousel": _drawn("carousel", ("corner cabinet",)),
    "lid": _of_families(("chest",), _is_flap),
    "lift-up": _of_families(("wall cabinet",), _is_flap),
    "lift-parallel": _of_families(("wall cabinet",), lambda _, joint: joint.part == "lift_arms"),
    "drop-front": _of_families(("bureau",), _is_flap),
    "keyboard-tray": _of_families(("desk", "writing desk"), _is_tray),
    "refrigerator": _of_families(("fridge",), lambda _, joint: motion_kind(joint.type).turns),
    "swivel-mirror": _of_families(("vanity",), _is_mirror),
    "folding-corner": _of_families(("corner cabinet",), _hangs_on_a_leaf),
    "sash": lambda rng, name: make_window(drawn_window(rng, name, "sash")),
}
