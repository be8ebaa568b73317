"""Fronts of a parted surface that were parted in two: two sheets that are one rectangle without a groove between them.

Between two fronts a surface has a groove, or each of them has a handle. What has neither there, and an edge or a groove
on its other sides, is one front.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations
from typing import final

import numpy as np

from grafu.asset.part import Part
from grafu.asset.straight_borders import SeenRectangle, StraightBordersConfig, seen_rectangle
from grafu.dataclass import dataclass
from grafu.geometry.arrays import Vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.shapes import Bool
from grafu.vocabulary import PartLabel


@final
@dataclass(frozen=True, slots=True)
class SplitFrontConfig:
    """When two sheets are one front; lengths in the largest side of the piece.

    Raises:
        ValueError: if a number is not above 0, or a fraction not between 0 and 1.
    """

    flat: float = 0.005
    """Where two sheets meet, half of their common border lies no deeper behind their planes than this: a groove that a
    scan shows is as deep, and its noise is less. Half of the rest of their borders lies deeper ..."""
    level: float = 0.006
    """... and their planes are no farther apart than this."""
    meeting: float = 0.6
    """Their common border has as many vertices as this of the longer one's at the same end (fraction of the side in
    teeth)."""
    whole: float = 0.02
    """Without grooves they are one where they are together as large as a third sheet, within this."""
    out: float = 0.01
    """What stands so far out of a sheet is a handle: where both have one they are two fronts."""
    alike: float = 0.04
    """Two of the same size, within this, are a pair of fronts, and what is as large as a third one is a front."""

    def __post_init__(self) -> None:
        require_positive(self, "flat", "level", "whole", "out", "alike")
        require_ratios(self, "meeting")


@final
@dataclass(frozen=True, eq=False)
class _Sheet:
    part: Part
    towards: Vec3
    seen: SeenRectangle

    @property
    def drop(self) -> np.ndarray:
        """How far each vertex of its border lies behind its plane."""
        return np.asarray(self.seen.plane - self.seen.border @ self.towards)


def with_joined_fronts(
    parts: Sequence[Part],
    facing: Sequence[Vec3 | None],
    thick: float,
    config: SplitFrontConfig = SplitFrontConfig(),
    rectangles: StraightBordersConfig = StraightBordersConfig(),
) -> tuple[tuple[Part, ...], tuple[Vec3 | None, ...]]:
    """Returns the pieces of one surface, two that are one front as one, and the direction that each faces.

    Args:
        parts: the pieces.
        facing: for each the direction along an axis that it faces, None for what is no sheet.
        thick: how thick the board of a sheet becomes, in the unit of the meshes.
        config: what is one front.
        rectangles: what is rectangular.
    """
    extent = float(Box.enclosing(part.box for part in parts).size.max())
    sheets: dict[str, _Sheet] = {}
    for part, towards in zip(parts, facing, strict=True):
        seen = None if towards is None else seen_rectangle(part.mesh, towards, thick, extent, rectangles)
        if towards is not None and seen is not None and part.label is PartLabel.UNKNOWN:
            sheets[part.id] = _Sheet(part, towards, seen)
    tooth = rectangles.tooth * extent
    joined: dict[str, Part] = {}
    gone: set[str] = set()
    for one, other in combinations(sheets.values(), 2):
        if {one.part.id, other.part.id} & (gone | set(joined)) or not _is_level(one, other, tooth, extent, config):
            continue
        others = [s for s in sheets.values() if s not in (one, other) and np.array_equal(s.towards, one.towards)]
        if not (_ends_in_grooves(one, other, extent, config) or _completes(one, other, others, extent, config)):
            continue
        if _are_fronts(one, other, others, parts, extent, config):
            continue
        larger, smaller = sorted((one, other), key=lambda sheet: -float(np.prod(sheet.seen.size)))
        joined[larger.part.id] = replace(larger.part, surfaces=(*larger.part.surfaces, *smaller.part.surfaces))
        gone.add(smaller.part.id)
    kept = [(joined.get(p.id, p), towards) for p, towards in zip(parts, facing, strict=True) if p.id not in gone]
    return tuple(part for part, _ in kept), tuple(towards for _, towards in kept)


def _is_level(one: _Sheet, other: _Sheet, tooth: float, extent: float, config: SplitFrontConfig) -> bool:
    """Whether two sheets lie in one plane, side by side between the same ends, and meet there without a groove."""
    if not np.array_equal(one.towards, other.towards):
        return False
    if abs(one.seen.plane - other.seen.plane) > config.level * extent:
        return False
    ends = np.abs(np.stack([one.seen.low - other.seen.low, one.seen.high - other.seen.high])).max(axis=0)
    beside = np.minimum(np.abs(one.seen.high - other.seen.low), np.abs(other.seen.high - one.seen.low))
    if not any(ends[k] <= tooth and beside[1 - k] <= tooth for k in range(2)):
        return False
    side = float(one.seen.size[int(np.argmin(ends))])
    common = _is_common(one, other, 1e-6 * extent)
    is_long = np.count_nonzero(common) >= config.meeting * side / tooth
    return bool(is_long and np.median(one.drop[common]) <= config.flat * extent)


def _ends_in_grooves(one: _Sheet, other: _Sheet, extent: float, config: SplitFrontConfig) -> bool:
    """Whether the borders of two sheets, but where these meet, lie behind their planes."""
    cell = 1e-6 * extent
    rest = [a.drop[~_is_common(a, b, cell)] for a, b in ((one, other), (other, one))]
    drop = np.concatenate(rest)
    return bool(len(drop) and np.median(drop) > config.flat * extent)


def _completes(one: _Sheet, other: _Sheet, others: Sequence[_Sheet], extent: float, config: SplitFrontConfig) -> bool:
    """Whether two sheets are together as large as a third one."""
    whole = np.maximum(one.seen.high, other.seen.high) - np.minimum(one.seen.low, other.seen.low)
    return any(bool((np.abs(s.seen.size - whole) <= config.whole * extent).all()) for s in others)


def _is_common(sheet: _Sheet, other: _Sheet, cell: float) -> Bool[np.ndarray, " _"]:
    """Returns which vertices of the border of a sheet are on that of another, too."""
    own, known = (np.round(s.seen.border / cell).astype(np.int64).tolist() for s in (sheet, other))
    places = set(map(tuple, known))
    return np.array([tuple(place) in places for place in own], dtype=bool)


def _are_fronts(
    one: _Sheet, other: _Sheet, others: Sequence[_Sheet], parts: Sequence[Part], extent: float, config: SplitFrontConfig
) -> bool:
    """Whether two sheets that meet are a front each: both have a handle, are alike, or as large as a third one."""
    if all(_has_handle(sheet, parts, config.out * extent) for sheet in (one, other)):
        return True
    alike = config.alike * extent
    if (np.abs(one.seen.size - other.seen.size) <= alike).all():
        return True
    return any(bool((np.abs(s.seen.size - two.seen.size) <= alike).all()) for s in others for two in (one, other))


def _has_handle(sheet: _Sheet, parts: Sequence[Part], out: float) -> bool:
    """Whether something stands out of a sheet: of the sheet itself, or a part whose middle lies before it."""
    across = sheet.towards == 0
    if float((sheet.part.mesh.vertices @ sheet.towards).max()) - sheet.seen.plane > out:
        return True

    def is_on(part: Part) -> bool:
        center = part.box.center[across]
        ahead = float((part.mesh.vertices @ sheet.towards).max()) - sheet.seen.plane
        return bool((center > sheet.seen.low).all() and (center < sheet.seen.high).all()) and ahead > out

    small = (p for p in parts if p is not sheet.part and (p.box.size[across] < sheet.seen.size).all())
    return any(is_on(part) for part in small)
