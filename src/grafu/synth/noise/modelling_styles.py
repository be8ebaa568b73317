"""Modelling styles, and the drawing of one model's modelling noise: all rates stand here, each with its reason.

A modeller who draws panels as sheets does so all over the model, and one who exports merged meshes has no handles of
their own: so a style is drawn first and makes the rest likely or not. The fractions come from the seventeen development
models (numbers in brackets), which are few, widened towards what other sources of models are known for.
"""

from collections.abc import Collection, Sequence
from typing import Final, final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.dataclass import dataclass
from grafu.synth.noise.cutting import (
    BODY_MASKING,
    HANDLES_IN_PIECES,
    Masking,
    draw_bare_drawers,
    draw_body,
    draw_cuts,
    draw_joined,
)
from grafu.synth.noise.distortion import draw_factors, draw_yaw
from grafu.synth.noise.housing import draw_housing
from grafu.synth.noise.loose_objects import LOOSE_OBJECTS
from grafu.synth.noise.modelling_noise import Faces, Misfit, ModellingNoise
from grafu.synth.noise.naming import draw_wording
from grafu.synth.noise.part_names import MISNAMED, SCHEMES
from grafu.synth.noise.tessellation import Density
from grafu.synth.sampling.chance import between, chance, count, pick
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class ModellingStyle:
    """A modelling style: chances per model, but `sheets` per group of panels and `loose_objects` per kind."""

    ratio: float
    sheets: float
    cuts: float
    joined: float
    handles_joined: float
    loose_objects: float
    misfits: float
    faces: float
    bend: float
    masking: Masking


# Sheets for panels: 5 of 17 models (41003, 44781, 45463, 45940, 32052), so about one group of panels in five over all.
# Handles within doors: rare in segmented data (0 of 17), usual where meshes are merged.
# Labels lost: over all about 53 % of models keep all, 25 % lose a few, 12 % many, 10 % all (files without names).
STYLES: Final[dict[str, ModellingStyle]] = {
    "clean cad": ModellingStyle(0.38, 0.10, 0.20, 0.12, 0.02, 0.09, 0.15, 0.04, 0.0, (0.63, 0.25, 0.08, 0.04)),
    "sheets": ModellingStyle(0.22, 0.50, 0.20, 0.20, 0.03, 0.07, 0.25, 0.70, 0.0, (0.50, 0.26, 0.14, 0.10)),
    "exploded export": ModellingStyle(0.13, 0.10, 0.75, 0.02, 0.0, 0.25, 0.20, 0.10, 0.0, (0.59, 0.27, 0.09, 0.05)),
    "merged export": ModellingStyle(0.12, 0.15, 0.0, 1.0, 0.15, 0.05, 0.20, 0.20, 0.0, (0.42, 0.23, 0.17, 0.18)),
    "game asset": ModellingStyle(0.12, 0.50, 0.05, 0.50, 0.15, 0.05, 0.25, 0.25, 0.0, (0.39, 0.24, 0.18, 0.19)),
    "scan": ModellingStyle(0.03, 0.10, 0.05, 0.60, 0.20, 0.10, 0.30, 0.05, 1.0, (0.25, 0.17, 0.18, 0.40)),
}
# Fractions of labels for the four entries of a masking.
LOST: Final = ((0.0, 0.0), (0.04, 0.2), (0.25, 0.7), (1.0, 1.0))

# Parts that are not there. Tops: 48 % of PartNet-Mobility's storage furniture has none, mostly kitchen units (one
# worktop is drawn over several, or none); tables nearly always have theirs. No handles at all: 3 of 17 (22692, 26608,
# 46896; 32052 and 49182 have grips of other kinds), some of which are pushed to open; single ones are rarely forgotten.
# One blueprint in four is drawn without handles already, so that the rate here is small.
NO_TOP: Final[dict[str, float]] = {
    # below a worktop, or above what can be seen: most are modelled without
    "base cabinet": 0.75,
    "sink cabinet": 0.8,
    "washstand": 0.35,
    "corner cabinet": 0.7,
    "wall cabinet": 0.65,
    "oven": 0.6,
    "kitchen units": 0.6,
    "kitchen island": 0.4,
    "tall cabinet": 0.4,
    "fridge": 0.3,
    # things are put on it: hardly any
    "desk": 0.01,
    "writing desk": 0.01,
    "table with drawers": 0.01,
    "vanity": 0.01,
    "bureau": 0.01,
    # it is seen
    "wardrobe": 0.13,
    "dresser": 0.12,
    "TV stand": 0.12,
    "lowboard": 0.12,
    "sideboard": 0.12,
}
NO_CASE_TOP, NO_TABLE_TOP, NO_BACK, NO_BOTTOM, NO_SHELVES = 0.2, 0.01, 0.10, 0.08, 0.09
JOINED_TOP = 0.4  # of cases that are one part: a top is mostly of another material, and a table's always apart
NO_HANDLES, ONE_HANDLE_LOST, A_SHELF_LOST = 0.05, 0.03, 0.05

# How likely panels are sheets, relative to the habit: hidden ones before visible ones.
SHEETS: Final[dict[PartLabel, float]] = {
    PartLabel.BACK_PANEL: 1.0,
    PartLabel.BOTTOM_PANEL: 1.0,
    PartLabel.BAR: 0.7,
    PartLabel.FACE_FRAME: 0.5,
    PartLabel.SHELF: 0.4,
    PartLabel.DIVIDER: 0.3,
    PartLabel.SIDE_PANEL: 0.3,
    PartLabel.TOP_PANEL: 0.25,
    PartLabel.DOOR: 0.12,
}
THICKEST_SHEET = 0.023  # metres: a thicker panel's outer face alone would stand too far off for any hinge
# What else is done to the faces of some parts, or of all
FACES: Final[dict[Faces, float]] = {"doubled": 0.3, "inverted": 0.2, "loose": 0.2, "open back": 0.2, "shells": 0.1}
# All development models draw every face from both sides, as PartNet's exports do; artists' files and scans do not.
BOTH_SIDES = 0.4
# Faces of the median part: 16 to 1750 in the development models, all drawn from both sides; three of 17 lie above 280.
# Programs break edges with chamfers by default; fine rounding is exported for renderers (26608, 46896), both sides.
DENSITY: Final[dict[Density, float]] = {
    "plain": 0.825,
    "broken edges": 0.04,
    "rounded edges": 0.025,
    "finely rounded": 0.06,
    "split": 0.03,
    "split twice": 0.02,
}
FINE_BOTH_SIDES = 0.9
EDGE = (0.0005, 0.0025)  # metres: below, it is invisible; above, it is a profile
WIDEST_EDGE = 0.0015  # of the largest side: more, and boards set edge to edge would hardly touch
# Nailers behind or under backs stand in 8 of 17 models, corner plates in 6, edges as sheets in 2, runners in 2.
LOOSE_WEIGHT: Final[dict[str, float]] = {
    "nailers": 3.0,
    "corner plates": 2.5,
    "edge sheets": 2.0,
    "runners": 3.5,
    "posts": 0.8,
    "pads": 0.6,
    "plates": 1.0,
    "things on top": 0.4,
    "things on shelves": 0.5,
    "basket": 0.4,
    "hinges": 0.8,
}

STANDING = 0.002  # metres between a top and what stands on it
AJAR = 0.1  # of models: 22692 and 26608 have one drawer pulled out each, of seventeen picked for variety
MISFIT = (0.0005, 0.008)  # metres: below, no reader notices; above, no maker would have left it
GROWN = (0.0003, 0.003)
SEEN, NEARLY = 0.004, 0.85  # of the largest side: so little is not seen in the whole, and most stay below it
MISLABELLED = 0.01
BEND = (0.0005, 0.003)  # metres: what scanning leaves on furniture
SHUFFLED = 0.6  # part order: exporters sort by name, material or not at all


def draw_noise(rng: np.random.Generator, tidy: Asset, family: str = "", absent: Collection[str] = ()) -> ModellingNoise:
    """Returns what will be noisy about a tidy model with true labels, joints and attached parts.

    Args:
        rng: where all chance comes from.
        tidy: the model, complete.
        family: what it is, where that is known: some are sold without a top.
        absent: ids of parts that are missing in any case.
    """
    name = pick(rng, {key: style.ratio for key, style in STYLES.items()})
    style = STYLES[name]
    missing = tuple(dict.fromkeys((*_missing(rng, tidy, family), *(p.id for p in tidy.parts if p.id in absent))))
    kept = [p for p in tidy.parts if p.id not in missing]
    tops = JOINED_TOP if is_storage(tidy) and NO_TOP.get(family, 1.0) > NO_TABLE_TOP else 0.0
    body = draw_body(rng, tidy, kept)
    joined = body or draw_joined(rng, tidy, kept, style.joined, style.handles_joined, tops)
    masking = BODY_MASKING if body else style.masking
    free = [p for p in kept if not any(p.id in group.ids for group in joined)]
    density = pick(rng, DENSITY)
    return ModellingNoise(
        name,
        int(rng.integers(2**62)),
        loose_objects=_loose(rng, style, tidy, missing),
        joined=joined,
        cuts=(*draw_cuts(rng, tidy, free, style.cuts), *draw_bare_drawers(rng, tidy, bool(body))),
        faces=_faces(rng, style, kept),
        misfits=_misfits(rng, free, tidy.extent) if chance(rng, style.misfits) else (),
        ajar=_ajar(rng, tidy) if chance(rng, AJAR) else (),
        factors=draw_factors(rng),
        bend=between(rng, BEND) if chance(rng, style.bend) else 0.0,
        yaw=draw_yaw(rng),
        wording=draw_wording(rng),
        missing=missing,
        masked=between(rng, LOST[int(rng.choice(4, p=masking))]),
        mislabelled=chance(rng, MISLABELLED),
        shuffled=chance(rng, SHUFFLED),
        density=density,
        edge=min(between(rng, EDGE), WIDEST_EDGE * tidy.extent),
        both_sides=chance(rng, FINE_BOTH_SIDES if density == "finely rounded" else BOTH_SIDES),
        housed=draw_housing(rng),
        handles_in_pieces=chance(rng, HANDLES_IN_PIECES),
        naming=pick(rng, SCHEMES),
        misnamed=chance(rng, MISNAMED),
    )


def is_storage(asset: Asset) -> bool:
    """Whether a model is a case rather than a table: not one on long legs without a bottom panel."""
    labels = [p.label for p in asset.parts]
    if PartLabel.LEG in labels:
        legs = max(float(p.box.size[2]) for p in asset.parts if p.label is PartLabel.LEG)
        if legs > 0.6 * float(asset.box.size[2]) and PartLabel.BOTTOM_PANEL not in labels:
            return False
    return PartLabel.BOTTOM_PANEL in labels or PartLabel.BACK_PANEL in labels


def _loose(rng: np.random.Generator, style: ModellingStyle, tidy: Asset, missing: Collection[str]) -> tuple[str, ...]:
    """Returns the kinds of loose objects; nothing stands on a top or on shelves that are not there."""
    drawn = [k for k in LOOSE_OBJECTS if chance(rng, style.loose_objects * LOOSE_WEIGHT.get(k, 1.0))]
    gone = {tidy.part(i).label for i in missing}
    needs = {"things on top": PartLabel.TOP_PANEL, "things on shelves": PartLabel.SHELF, "basket": PartLabel.SHELF}
    return tuple(kind for kind in drawn if needs.get(kind) not in gone)


def _missing(rng: np.random.Generator, asset: Asset, family: str) -> tuple[str, ...]:
    no_top = NO_TOP.get(family, NO_CASE_TOP) if is_storage(asset) else NO_TABLE_TOP
    by = {label: [p for p in asset.parts if p.label is label] for label in PartLabel}
    groups = (
        (by[PartLabel.TOP_PANEL], 0.0 if _bears(asset, by[PartLabel.TOP_PANEL]) else no_top),
        (by[PartLabel.BACK_PANEL], NO_BACK),
        (by[PartLabel.BOTTOM_PANEL], NO_BOTTOM),
        (by[PartLabel.SHELF], NO_SHELVES),
        (by[PartLabel.HANDLE], NO_HANDLES),
        (_one(rng, by[PartLabel.HANDLE]), ONE_HANDLE_LOST),
        (_one(rng, by[PartLabel.SHELF]), A_SHELF_LOST),
    )
    gone = [part.id for parts, ratio in groups if chance(rng, ratio) for part in parts]
    return tuple(dict.fromkeys(gone))


def _bears(asset: Asset, tops: Sequence[Part]) -> bool:
    """Whether something stands on one of the tops, a gallery, a mirror, a hutch: what bears things is not left out."""
    if not tops:
        return False
    low, high = np.array([p.box.low for p in asset.parts]), np.array([p.box.high for p in asset.parts])
    for top in tops:
        box = top.box
        over = (low[:, :2] < box.high[:2]).all(axis=1) & (high[:, :2] > box.low[:2]).all(axis=1)
        if bool((over & (np.abs(low[:, 2] - box.high[2]) < STANDING)).any()):
            return True
    return False


def _one(rng: np.random.Generator, parts: Sequence[Part]) -> list[Part]:
    return [parts[int(rng.integers(len(parts)))]] if parts else []


def _faces(
    rng: np.random.Generator, style: ModellingStyle, parts: Sequence[Part]
) -> tuple[tuple[Faces, tuple[str, ...]], ...]:
    found: list[tuple[Faces, tuple[str, ...]]] = []
    for label, weight in SHEETS.items():
        ids = tuple(p.id for p in parts if p.label is label and p.box.size.min() < THICKEST_SHEET)
        if ids and chance(rng, style.sheets * weight):
            found.append(("sheet", ids if chance(rng, 0.8) else ids[:1]))
    if chance(rng, style.faces):
        everything = tuple(p.id for p in parts)
        some = tuple(i for i in everything if chance(rng, 0.3))
        found.append((pick(rng, FACES), everything if chance(rng, 0.5) else some))
    return tuple(found)


def _misfits(rng: np.random.Generator, parts: Sequence[Part], extent: float) -> tuple[Misfit, ...]:
    """Returns one to three parts out of place, fronts before panels: a gap in a case is seldom left open.

    `extent` is the object's largest side: what is shifted by much more than a fraction of it looks broken.
    """
    weights = np.array([3.0 if p.label.is_movable else 1.0 for p in parts])
    if not len(weights):
        return ()
    number = min(count(rng, 1, 3), len(weights))
    found = []
    for k in rng.choice(len(weights), number, replace=False, p=weights / weights.sum()):
        grown = chance(rng, 0.35)
        offset = np.zeros(3)
        amount = between(rng, GROWN if grown else MISFIT)
        if not grown and chance(rng, NEARLY):
            amount = min(amount, SEEN * extent)
        offset[int(rng.integers(3))] = amount if grown or chance(rng, 0.5) else -amount
        found.append(Misfit(parts[k].id, (float(offset[0]), float(offset[1]), float(offset[2])), grown))
    return tuple(found)


def _ajar(rng: np.random.Generator, asset: Asset) -> tuple[tuple[str, float], ...]:
    """Returns one front of those that nothing stands before, and how far it is open."""
    front = min((asset.part(j.part).box.low[1] for j in asset.joints), default=0.0)
    free = [j.part for j in asset.joints if j.coupling is None and asset.part(j.part).box.low[1] < front + 0.03]
    if not free:
        return ()
    part = free[int(rng.integers(len(free)))]
    drawer = asset.part(part).label is PartLabel.DRAWER
    return ((part, between(rng, (0.05, 0.5) if drawer else (0.03, 0.3))),)
