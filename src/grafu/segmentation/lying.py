"""What lies on fronts of other objects is parted by them: one object that holds the handles of several. No names."""

from collections.abc import Mapping

import numpy as np

from grafu.geometry.arrays import Indices, distinct
from grafu.geometry.components import linked
from grafu.geometry.touching import near_ends
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.fronts import SHEET, FrontShells
from grafu.segmentation.surroundings import Scale
from grafu.segmentation.view import MaskOfShells, PointsOfShells, ScalarsOfShells, ShellsView
from grafu.shapes import Bool


def lying_on_fronts(
    view: ShellsView,
    may: tuple[MaskOfShells, MaskOfShells],
    fronts: tuple[Mapping[int, tuple[FrontShells, ...]], Indices],
    config: SegmentationConfig,
) -> dict[int, tuple[tuple[int, ...], ...]]:
    """Returns for each object the shells that lie on fronts in others, a group for each, where that parts it.

    The first of `fronts` are hidden in objects, the second are plates that are objects of their own: on such, handles
    count alone, on a single one those that stand before it. `may` are the shells that may be parted by the first, and
    those that may by either. What is as small as a handle may be inset: it reaches the face of its front from behind.
    What is large, or hangs together with more behind its front, is a front itself before a single hidden one.
    The handle on the other side of a door, behind that on its face, lies on it as well. What reaches a border of its
    front, as hinges do, is a group of its own.
    """
    hidden, alone = fronts
    plates = np.array([front.shells[0] for fronts in hidden.values() for front in fronts], dtype=np.int64)
    is_hidden = np.arange(len(plates) + len(alone)) < len(plates)
    plates = np.concatenate([plates, alone])
    extent = Scale.of(view).extent[plates]
    near, gap = config.candidates.near * extent, config.members.handle_gap
    deep = config.members.handle_side * extent
    thin = float(SHEET * near.max(initial=0.0))
    area = np.prod(view.size[:, :2], axis=1)
    found: dict[int, tuple[tuple[int, ...], ...]] = {}
    for owner in distinct(view.owner[may[0] | may[1]]).tolist() if len(plates) else ():
        own = np.flatnonzero(view.owner == owner)
        low, high = view.low[own, None], view.high[own, None]
        grown = low[..., :2] - thin, high[..., :2] + thin  # a sheet seen from its edge has an outline, too
        shared = np.minimum(grown[1], view.high[plates, :2]) - np.maximum(grown[0], view.low[plates, :2])
        in_outline = np.maximum(shared, 0.0).prod(axis=2) >= config.members.on_front * (grown[1] - grown[0]).prod(
            axis=2
        )
        is_small = area[own, None] <= config.members.handle_area * area[plates]
        is_inset = is_small & (high[..., 2] >= view.high[plates, 2]) & ((high - low)[..., 2] <= deep)
        on = in_outline & (is_hidden | (is_small & may[1][own, None])) & (view.owner[plates] != owner)
        on &= is_inset | (low[..., 2] >= view.low[plates, 2] - near)
        on &= low[..., 2] <= view.high[plates, 2] + gap * near
        on |= _behind(view, own, on & is_small, (view.low[plates, 2], near, gap), config.members.on_front)
        lies, front = on.any(axis=1), on.argmax(axis=1)
        served = distinct(front[lies]).tolist()
        in_others = bool(served) and is_hidden[served].any()
        if in_others and len(served) == 1:
            behind = ~lies & (high[:, 0, 2] <= view.high[plates[served[0]], 2]) & in_outline[:, served[0]]
            behind &= _hang_together(low[:, 0], high[:, 0], lies, float(near[served[0]]))
            if behind.any() or not is_small[:, served[0]].all():
                continue  # a drawer of its own, before the apron of another object
        is_ahead = view.low[own][:, 2] >= (view.high[plates, 2] - near)[front]
        if len(served) > 1 or ((in_others or (lies & is_ahead).any()) and not lies.all()):
            found[owner] = tuple(
                group
                for k in served
                for group in _by_place(view, own[lies & (front == k)], int(plates[k]), float(near[k]), config)
            )
    return found


def _hang_together(
    low: PointsOfShells, high: PointsOfShells, lies: Bool[np.ndarray, " own"], near: float
) -> Bool[np.ndarray, " own"]:
    """Whether each of some shells touches one that lies on a front, or others that do."""
    label = linked(len(low), *near_ends(low, high, near))
    return np.isin(label, label[lies])


def _by_place(
    view: ShellsView, lying: Indices, plate: int, near: float, config: SegmentationConfig
) -> tuple[tuple[int, ...], ...]:
    """Returns what lies on a front as one group, or as two: what keeps clear of its borders, and what reaches one.

    A handle does the former, with its posts; hinges do the latter, with their screws.
    """
    low, high = view.low[lying], view.high[lying]
    label = linked(len(lying), *near_ends(low, high, config.members.handle_touch * near))
    reaches = (low[:, :2] < view.low[plate, :2] + near).any(axis=1)
    reaches |= (high[:, :2] > view.high[plate, :2] - near).any(axis=1)
    at_border = np.isin(label, label[reaches])
    return tuple(tuple(lying[group].tolist()) for group in (~at_border, at_border) if group.any())


def _behind(
    view: ShellsView,
    own: Indices,
    on: Bool[np.ndarray, "own plates"],
    back: tuple[ScalarsOfShells, ScalarsOfShells, float],
    least: float,
) -> Bool[np.ndarray, "own plates"]:
    """Returns which shells stand right behind the back of a front, in the outline of what lies on its face.

    `back` is where the back of each front is (z), what is near there, and how many times that a handle may stand off.
    """
    level, near, gap = back
    found = np.zeros_like(on)
    low, high = view.low[own], view.high[own]
    area = np.prod(high[:, :2] - low[:, :2], axis=1)
    for k in np.flatnonzero(on.any(axis=0)).tolist():
        before = on[:, k]
        begins = (high[:, 2] <= level[k] + near[k]) & (high[:, 2] >= level[k] - gap * near[k])
        shared = np.minimum(high[:, None, :2], high[None, before, :2]) - np.maximum(
            low[:, None, :2], low[None, before, :2]
        )
        covered = np.maximum(shared, 0.0).prod(axis=2).max(axis=1) >= least * area
        found[:, k] = begins & covered & (area > 0) & ~on.any(axis=1)
    return found
