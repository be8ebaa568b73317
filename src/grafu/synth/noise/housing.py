"""Boards let into what they end at: a rail's end within its leg, a back within the sides, as real models draw them.

A modeller who starts from boxes lets them run into one another: the joint is hidden. In the development models 0.73
pairs of boxes for each part cut into one another, in furniture of exact boards 0.35: legs and side panels, bars and
bars, backs and bottoms and sides.
"""

from dataclasses import replace
from typing import Final

import numpy as np

from grafu.asset.part import Asset, Part
from grafu.geometry.transform import from_rotation
from grafu.shapes import Float
from grafu.synth.noise.segmentation import is_board
from grafu.synth.pieces.riding import busy_in
from grafu.synth.sampling.chance import between, chance
from grafu.vocabulary import PartLabel

HOUSED: Final = 0.35  # of models
RATIO: Final = (0.3, 1.0)  # how deep, of the thickness of what a board is let into
DEEPEST: Final = 0.05  # metres
_REACH = 0.001  # metres between faces that abut
_COVERED = 0.6  # of an end's area lies against what it is let into

BoxRows = Float[np.ndarray, "n 3"]


def draw_housing(rng: np.random.Generator) -> float:
    """Returns how deep the boards of a model run into one another, as a fraction of a thickness; 0 for most models."""
    return between(rng, RATIO) if chance(rng, HOUSED) else 0.0


def with_housed_boards(asset: Asset, ratio: float) -> Asset:
    """Returns the asset with each still board grown, at ends that abut another, into that by `ratio` of its thickness.

    Nothing new is visible: what is grown lies within the other board, leg or bar.
    """
    busy = busy_in(asset)
    still = [k for k, p in enumerate(asset.parts) if p.id not in busy and p.carried_by is None and _takes(p)]
    low, high = (np.array([getattr(asset.parts[k].box, end) for k in still]).reshape(-1, 3) for end in ("low", "high"))
    parts = list(asset.parts)
    for row, k in enumerate(still):
        part, grown = parts[k], np.zeros((2, 3))
        for axis in (a for a in range(3) if a != part.box.thin_axis):
            for end in (0, 1):
                grown[end, axis] = ratio * _depth(row, axis, end, low, high)
        if grown.any():
            parts[k] = _grown(part, low[row] - grown[0], high[row] + grown[1])
    return replace(asset, parts=tuple(parts))


def _takes(part: Part) -> bool:
    return is_board(part) or part.label in (PartLabel.LEG, PartLabel.BAR)


def _depth(row: int, axis: int, end: int, low: BoxRows, high: BoxRows) -> float:
    """Returns the thickness of what a part's end abuts, metres, `DEEPEST` at most; 0 where it abuts nothing."""
    gaps = low[:, axis] - high[row, axis] if end else low[row, axis] - high[:, axis]
    across = [a for a in range(3) if a != axis]
    shared = np.minimum(high[:, across], high[row, across]) - np.maximum(low[:, across], low[row, across])
    covered = np.maximum(shared, 0.0).prod(axis=1) / max(float((high - low)[row, across].prod()), 1e-12)
    abuts = (np.abs(gaps) <= _REACH) & (covered >= _COVERED)
    abuts[row] = False
    if not abuts.any():
        return 0.0
    other = int(np.where(abuts, covered, -1.0).argmax())
    return min(float((high - low)[other, axis]), DEEPEST)


def _grown(part: Part, low: np.ndarray, high: np.ndarray) -> Part:
    """Returns a part stretched to fill a larger box."""
    old_low, old_size = part.box.low, np.maximum(part.box.size, 1e-9)
    factors = (high - low) / old_size
    T = from_rotation(np.diag(factors), low - factors * old_low)
    return replace(part, surfaces=tuple(s.transformed(T) for s in part.surfaces))
