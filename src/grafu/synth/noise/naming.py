"""What people call parts: styles that hold for input and truth alike, labels that are lost, and the rare wrong one.

A style is a rule of wording, not an error: where one data set calls inner uprights side panels, that is what they are
there. Lids stay doors in every wording.
"""

from collections.abc import Callable, Collection
from typing import Final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.synth.noise.edits import with_labels_lost
from grafu.synth.sampling.chance import chance
from grafu.vocabulary import PartLabel

LOW = 0.18  # fraction of the height below which a board is part of the base


def _inner_uprights(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: PartLabel.SIDE_PANEL for p in asset.parts if p.label is PartLabel.DIVIDER}


def _odd_dividers(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: PartLabel.MISC for p in asset.parts if p.label is PartLabel.DIVIDER}


def _inner_levels(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: PartLabel.BOTTOM_PANEL for p in asset.parts if p.label is PartLabel.SHELF}


def _toe_kicks(asset: Asset) -> dict[str, PartLabel]:
    bottom, height = asset.box.low[2], asset.box.size[2]
    boards = (p for p in asset.parts if p.label is PartLabel.BAR and p.box.size[2] > 0.03)
    return {p.id: PartLabel.SIDE_PANEL for p in boards if p.box.high[2] < bottom + LOW * height}


def _frame_members(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: PartLabel.BAR for p in asset.parts if p.label is PartLabel.FACE_FRAME and not _is_false_front(p)}


def _odd_false_fronts(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: PartLabel.MISC for p in asset.parts if p.label is PartLabel.FACE_FRAME and _is_false_front(p)}


def _frame_bars(asset: Asset) -> dict[str, PartLabel]:
    """Returns upright bars in front of the case as face frame: the converse of the style above."""
    front = asset.box.low[1] + 0.25 * asset.box.size[1]
    bars = (p for p in asset.parts if p.label is PartLabel.BAR and p.box.center[1] < front)
    return {p.id: PartLabel.FACE_FRAME for p in bars if p.box.low[2] > asset.box.low[2] + LOW * asset.box.size[2]}


def _shelf_between_legs(asset: Asset) -> dict[str, PartLabel]:
    legs = [p for p in asset.parts if p.label is PartLabel.LEG]
    low = asset.box.low[2] + 0.35 * asset.box.size[2]
    shelves = (p for p in asset.parts if p.label is PartLabel.SHELF and p.box.high[2] < low)
    return {p.id: PartLabel.BOTTOM_PANEL for p in shelves} if legs else {}


def _posts(asset: Asset) -> dict[str, PartLabel]:
    return {p.id: PartLabel.BAR for p in asset.parts if p.label is PartLabel.LEG}


def _is_false_front(part: Part) -> bool:
    """Whether a still part is a plate in the fronts' plane: a false front is no bar in any wording."""
    width, depth, height = part.box.size.tolist()
    return depth < 0.03 and min(width, height) > 0.09 and len(part.surfaces) < 3


Rule = Callable[[Asset], dict[str, PartLabel]]

# A rule and the fraction of models whose maker words it so. From the development models: toe kicks are side panels in
# all of them (`base_side_panel`) and frame members bars (`frame_vertical_bar`); 23372 calls inner uprights side panels
# and inner levels bottom panels, and the shelf between its legs too; 26608 has its dividers as connectors; 45001's
# false fronts are face frame. Other makers (the authors' vocabulary has divider and face frame) do otherwise, so no
# rule is certain.
STYLES: Final[dict[str, tuple[Rule, float]]] = {
    "inner uprights are side panels": (_inner_uprights, 0.35),
    "dividers are odds and ends": (_odd_dividers, 0.04),
    "inner levels are bottom panels": (_inner_levels, 0.06),
    "toe kicks are side panels": (_toe_kicks, 0.8),
    "frame members are bars": (_frame_members, 0.42),
    "false fronts are odds and ends": (_odd_false_fronts, 0.15),
    "bars in front are face frame": (_frame_bars, 0.08),
    "a shelf between legs is a bottom panel": (_shelf_between_legs, 0.4),
    "legs are bars": (_posts, 0.03),
}

# What a part may be taken for by mistake: things that look alike. Doors and drawers are never mistaken for each other.
MISTAKES: Final[dict[PartLabel, tuple[PartLabel, ...]]] = {
    PartLabel.SHELF: (PartLabel.BOTTOM_PANEL, PartLabel.TOP_PANEL),
    PartLabel.DIVIDER: (PartLabel.SHELF, PartLabel.BACK_PANEL),
    PartLabel.SIDE_PANEL: (PartLabel.BACK_PANEL, PartLabel.LEG),
    PartLabel.BACK_PANEL: (PartLabel.SIDE_PANEL,),
    PartLabel.BOTTOM_PANEL: (PartLabel.SHELF,),
    PartLabel.TOP_PANEL: (PartLabel.SHELF,),
    PartLabel.BAR: (PartLabel.LEG, PartLabel.HANDLE),
    PartLabel.LEG: (PartLabel.BAR, PartLabel.SIDE_PANEL),
    PartLabel.HANDLE: (PartLabel.MISC, PartLabel.BAR),
}


def draw_wording(rng: np.random.Generator) -> tuple[str, ...]:
    """Returns the styles of one maker, drawn by their rates."""
    return tuple(name for name, (_, ratio) in STYLES.items() if chance(rng, ratio))


def worded(asset: Asset, wording: Collection[str]) -> Asset:
    """Returns the asset with the labels that a maker of these styles gives."""
    for name in wording:
        changes = STYLES[name][0](asset)
        if changes:
            asset = asset.with_labels(changes)
    return asset


def with_labels_masked(asset: Asset, ids: Collection[str]) -> Asset:
    """Returns the asset with these parts unlabelled, and named as modelling programs name things."""
    return with_labels_lost(asset, ids) if ids else asset


def mistaken(part: Part, rng: np.random.Generator) -> PartLabel:
    """Returns a wrong label for a part, of something that looks like it; its own where nothing does."""
    choices = MISTAKES.get(part.label, ())
    return choices[int(rng.integers(len(choices)))] if choices else part.label
