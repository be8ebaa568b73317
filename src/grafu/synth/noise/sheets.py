"""Boards drawn as single sheets, as modellers do who look at the result: nothing comes loose by it.

A sheet has its place on the board's outer face; where that would tear the furniture apart, on the inner one. Whether
parts touch is judged by their boxes. It draws nothing at random.
"""

from collections.abc import Collection
from dataclasses import replace
from typing import Final

import numpy as np

from grafu.asset.part import Asset
from grafu.geometry.box import Box
from grafu.synth.noise.untidy import as_sheet

REACH: Final = 0.0045  # share of the object's largest side within which boxes touch: a little less than in graphs


def with_anchored_sheets(asset: Asset, where: Collection[str]) -> Asset:
    """Returns the named boards as sheets of their outer or inner face; where neither holds, they stay boards."""
    parts, middle, reach = list(asset.parts), asset.box.center, REACH * asset.unit
    low, high = np.array([p.box.low for p in parts]), np.array([p.box.high for p in parts])
    touching = np.array([_touched(Box(a, b), low, high, reach) for a, b in zip(low, high, strict=True)])
    groups = _groups(touching)
    for k, part in enumerate(asset.parts):
        if part.id not in where:
            continue
        for inner in (False, True):
            sheet = as_sheet(part, middle, inner)
            if sheet is None:
                continue
            tried = touching.copy()
            tried[k] = tried[:, k] = _touched(sheet.box, low, high, reach)
            tried[k, k] = True
            if _groups(tried) <= groups:
                parts[k], touching = sheet, tried
                low[k], high[k] = sheet.box.low, sheet.box.high
                break
    return replace(asset, parts=tuple(parts))


def _touched(box: Box, low: np.ndarray, high: np.ndarray, reach: float) -> np.ndarray:
    return np.asarray((np.maximum(box.low - high, low - box.high) <= reach).all(axis=1))


def _groups(touching: np.ndarray) -> int:
    """Returns how many groups of parts hang together."""
    left, found = np.ones(len(touching), dtype=bool), 0
    while left.any():
        group = np.zeros(len(touching), dtype=bool)
        edge = np.zeros(len(touching), dtype=bool)
        edge[int(left.argmax())] = True
        while edge.any():
            group |= edge
            edge = touching[edge].any(axis=0) & ~group
        left &= ~group
        found += 1
    return found
