"""What a repaired version holds beyond the furniture as it was drawn: a top on a case, a handle on every bare front.

Cases under one worktop are made without a top, and fronts that are pushed without a handle. Those are what a
completion is to add, so the whole has them. A front with a grip cut into it needs nothing, nor do lids and trays. Where
no front of a piece has a handle, nothing tells where its maker would have put them: they come where most are.
"""

from collections.abc import Sequence
from dataclasses import fields, is_dataclass, replace
from typing import Any

import numpy as np

from grafu.asset.edit import centred
from grafu.asset.part import Asset, Part, PartSource
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.synth.families.table import Blueprint, make_furniture
from grafu.synth.fronts.hold import HandleStyle, Hold
from grafu.synth.noise.modelling_styles import is_storage
from grafu.synth.noise.segmentation import fresh_ids
from grafu.synth.pieces.finish import surface_of
from grafu.synth.sampling.chance import between, chance, pick
from grafu.vocabulary import PartLabel

# What is screwed on afterwards: plain bars and knobs
AFTERWARDS: dict[HandleStyle, float] = {
    "bar-round": 0.3,
    "bar-square": 0.15,
    "bar-arched": 0.15,
    "knob-round": 0.25,
    "knob-flat": 0.15,
}
TOPS = (0.016, 0.04)  # metres thick
OVERHANG = (0.0, 0.025)  # metres
LEVEL = 0.03  # metres within which upper edges are one level
TALLER = 0.1  # metres: where still parts stand up beyond the sides by more, no top lies on the sides


def repaired(blueprint: Blueprint, made: Asset, rng: np.random.Generator) -> tuple[Asset, frozenset[str]]:
    """Returns the furniture with what it lacks, and the ids of the parts that were added."""
    whole, handles = _with_handles(blueprint, made, rng)
    whole, tops = _with_top(whole, rng)
    return whole, handles | tops


def with_bare_fronts_held(spec: Any, style: HandleStyle, hold: Hold | None = None) -> Any:
    """Returns a spec in which every front, trays left out, that has neither handle nor grip has a handle of this style.

    It is carried as `hold` states, or else as the front's maker does.
    """
    if isinstance(spec, tuple):
        return tuple(with_bare_fronts_held(item, style, hold) for item in spec)
    if not is_dataclass(spec) or isinstance(spec, type):
        return spec
    changes = {f.name: with_bare_fronts_held(getattr(spec, f.name), style, hold) for f in fields(spec) if f.init}
    changes = {name: value for name, value in changes.items() if value is not getattr(spec, name)}
    is_tray = getattr(spec, "box", None) == "tray"
    if getattr(spec, "handle", "") == "none" and getattr(spec, "grip", "none") == "none" and not is_tray:
        changes |= {"handle": style} | ({} if hold is None else {"hold": hold})
    return replace(spec, **changes) if changes else spec


def _with_handles(blueprint: Blueprint, made: Asset, rng: np.random.Generator) -> tuple[Asset, frozenset[str]]:
    held = _held(made)
    if all(joint.part in held for joint in made.joints):
        return made, frozenset()
    spec = with_bare_fronts_held(blueprint.spec, pick(rng, AFTERWARDS), None if held else Hold())
    whole = make_furniture(replace(blueprint, spec=spec))
    added = [p.id for p in whole.parts if p.label is PartLabel.HANDLE and p.carried_by not in held]
    return whole, frozenset(added)


def _held(asset: Asset) -> set[str | None]:
    return {p.carried_by for p in asset.parts if p.label is PartLabel.HANDLE}


def _with_top(asset: Asset, rng: np.random.Generator) -> tuple[Asset, frozenset[str]]:
    sides = [p.box for p in asset.parts if p.label is PartLabel.SIDE_PANEL and p.box.thin_axis == 0]
    level = max((float(b.high[2]) for b in sides), default=0.0)
    walls = [b for b in sides if b.high[2] > level - LEVEL]
    if len(walls) < 2 or not is_storage(asset) or _is_covered(asset.parts, level):
        return asset, frozenset()
    low, high = np.min([b.low for b in walls], axis=0), np.max([b.high for b in walls], axis=0)
    below = [p for p in asset.parts if p.box.high[2] > level - LEVEL]
    foot = max(level, *(float(p.box.high[2]) + (0.002 if p.label.is_movable else 0.0) for p in below))
    back = max(float(p.box.high[1]) for p in below)
    side, front = (between(rng, OVERHANG) if chance(rng, 0.6) else 0.0 for _ in range(2))
    box = Box(
        vec3(float(low[0]) - side, float(low[1]) - front, foot),
        vec3(float(high[0]) + side, max(float(high[1]), back), foot + between(rng, TOPS)),
    )
    name = fresh_ids(asset, "worktop", 1)[0]
    surface = surface_of(TriangleMesh.box_mesh(box), asset.parts[0].surfaces[0].material)
    top = Part(name, PartLabel.TOP_PANEL, (surface,), PartSource(name), "annotation")
    return centred(replace(asset, parts=(*asset.parts, top))), frozenset((name,))


def _is_covered(parts: Sequence[Part], level: float) -> bool:
    """Whether something lies on or stands above the walls of this level: a top, a lid, another case."""
    for part in parts:
        if part.box.high[2] > level + TALLER:
            return True
        flat = part.box.thin_axis == 2 and part.box.high[2] > level - 2 * LEVEL
        if flat and (part.label is PartLabel.TOP_PANEL or part.label.is_movable):
            return True
    return False
