"""Fronts with what belongs to them: panes, mouldings and liners, the boards of a drawer, handles. It asks no names."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices
from grafu.geometry.components import linked
from grafu.geometry.touching import near_ends
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.drawer_boxes import drawer_boards, drawer_tub
from grafu.segmentation.surroundings import Scale, overlaps, with_ring, within
from grafu.segmentation.view import MaskOfShells, ShellsView

SHEET = 1e-6  # of the gap across which pieces touch: what is no wider, seen from the front, is a sheet


@final
@dataclass(frozen=True, slots=True)
class FrontShells:
    """The shells of one door or drawer, the plate first, and those of each handle on it.

    `is_held` states whether a handle stands on it, its own or one that is another object; `others` are the latter.
    `has_box` states whether the box of a drawer was drawn behind it.
    """

    shells: tuple[int, ...]
    handles: tuple[tuple[int, ...], ...] = ()
    is_held: bool = False
    others: tuple[tuple[int, ...], ...] = ()
    has_box: bool = False

    @property
    def all_shells(self) -> frozenset[int]:
        """Every shell that moves with it."""
        return frozenset((*self.shells, *(shell for handle in self.handles for shell in handle)))

    def made_of(self, members: Sequence[tuple[int, ...]]) -> "FrontShells":
        """Returns the front with each shell replaced by those that it is made of."""
        parts = tuple(m for shell in self.shells for m in members[shell])
        handles = tuple(tuple(m for shell in handle for m in members[shell]) for handle in self.handles)
        others = tuple(tuple(m for shell in handle for m in members[shell]) for handle in self.others)
        return FrontShells(parts, handles, self.is_held, others, self.has_box)


def fronts_among(view: ShellsView, plates: Indices, config: SegmentationConfig) -> tuple[FrontShells, ...]:
    """Returns the fronts that candidates form, each shell in one at most.

    Args:
        view: what is seen.
        plates: the candidates, the largest first.
        config: the thresholds.
    """
    key = fronts_among, plates.tobytes(), config
    known: tuple[FrontShells, ...] | None = view.remembered.get(key)
    if known is None:
        known = view.remembered[key] = _fronts_of(view, plates, config)
    return known


def _fronts_of(view: ShellsView, plates: Indices, config: SegmentationConfig) -> tuple[FrontShells, ...]:
    finder: Final = _FrontFinder(view, config)
    chosen: list[int] = []
    for plate in _ranked(view, plates):
        covered = overlaps(view, plate)[chosen] >= config.members.nested
        if not covered.any() and not finder.is_fixed(plate, plates):
            chosen.append(plate)
    taken: set[int] = set(chosen)
    found = []
    inside = {plate: within(view, plate, 0.0) for plate in chosen}
    in_any = np.any([*inside.values()], axis=0) if chosen else np.zeros(0, bool)
    for plate in chosen:
        of_others = np.flatnonzero(in_any & ~inside[plate])  # such as a bottom close above this front
        front = finder.with_members(plate, {*taken, *of_others.tolist()})
        taken |= front.all_shells
        found.append(front)
    return _with_stiles(view, found, config)


def _with_stiles(view: ShellsView, found: Sequence[FrontShells], config: SegmentationConfig) -> tuple[FrontShells, ...]:
    """Returns the fronts, each with the stiles and rails that were drawn beside its plate without a gap.

    Such a strip has no handle, and the plate has one, or another strip at its opposite side.
    """
    fronts = list(found)
    for front in found:
        strips = [other for other in found if other is not front and not other.handles]
        beside = {k: side for k, strip in enumerate(strips) if (side := _strip_side(view, front, strip, config))}
        opposite = {side for side in beside.values() if (side[0], -side[1]) in beside.values()}
        own = [strips[k] for k, side in beside.items() if strips[k] in fronts and (front.handles or side in opposite)]
        if own and front in fronts:
            shells = (*front.shells, *(shell for strip in own for shell in strip.shells))
            fronts[fronts.index(front)] = replace(front, shells=shells)
            fronts = [other for other in fronts if other not in own]
    return tuple(fronts)


def _strip_side(
    view: ShellsView, front: FrontShells, strip: FrontShells, config: SegmentationConfig
) -> tuple[int, int] | None:
    """Returns the axis and the sense in which a strip lies right beside a front, along a whole side, or None."""
    low, high = view.low, view.high
    a, b, frames = front.shells[0], strip.shells[0], config.frames
    extent = float(Scale.of(view).extent[a])
    size = view.size[b, :2]
    if size.max() < frames.strip * size.min() or size.prod() > frames.strip_area * view.size[a, :2].prod():
        return None
    across = int(np.argmin(size))
    ends = np.abs([low[a, 1 - across] - low[b, 1 - across], high[a, 1 - across] - high[b, 1 - across]])
    is_level = abs(high[a, 2] - high[b, 2]) <= config.candidates.near * extent
    if not is_level or ends.max() > frames.same * extent:
        return None
    gaps = {1: abs(low[b, across] - high[a, across]), -1: abs(low[a, across] - high[b, across])}
    sense = min(gaps, key=lambda side: gaps[side])
    return (across, sense) if gaps[sense] <= frames.gap * extent else None


def _ranked(view: ShellsView, plates: Indices) -> list[int]:
    """Returns the candidates by outline, of equals the thicker first."""
    area = np.round(np.prod(view.size[:, :2], axis=1), 6)
    return sorted(plates.tolist(), key=lambda k: (-float(area[k]), -float(view.size[k, 2]), k))


@final
class _FrontFinder:
    """Finds the shells of fronts in a view; what it computes once for all fronts is kept."""

    def __init__(self, view: ShellsView, config: SegmentationConfig) -> None:
        self._view, self._scale, self._config = view, Scale.of(view), config.members
        self._near = config.candidates.near * self._scale.extent
        self._area = np.prod(view.size[:, :2], axis=1)
        self._cover = view.faced[:, 2] / np.maximum(self._area, 1e-300)

    def is_fixed(self, plate: int, plates: Indices) -> bool:
        """Whether a plate is the fixed front that others close or lie on, or a frame that nothing fills."""
        view, near, config = self._view, float(self._near[plate]), self._config
        inner = within(view, plate, near) & (self._area < config.smaller * self._area[plate])
        if self._is_pulled(plate, plates, inner):
            return False
        is_frame = self._cover[plate] < config.ring
        if is_frame:
            panes = inner & (self._cover >= config.ring) & (self._area >= config.pane_area * self._area[plate])
            flush = panes & (view.high[:, 2] <= view.high[plate, 2] + near)
            thin = view.size[:, 2] <= max(config.pane * view.size[plate, 2], config.thin * near)
            return not (flush & thin & (view.low[:, 2] >= view.low[plate, 2] - near)).any()
        on = np.zeros(len(self._area), dtype=bool)
        on[plates] = True
        on &= inner & (view.low[:, 2] >= view.high[plate, 2] - near) & (view.owner == view.owner[plate])
        if self._is_case(plate, plates, inner) or self._is_unit(plate, plates):
            return True
        outer = _outermost(view, np.flatnonzero(on), config.nested)
        covers = float(self._area[outer].sum())
        many = int(on.sum()) > 1 and covers >= config.half * self._area[plate]
        if many and bool(self._area[plate] >= config.whole * self._scale.outline[plate]):
            return True
        return len(outer) == 1 and self._is_apron(plate, outer[0])

    def _is_pulled(self, plate: int, plates: Indices, inner: MaskOfShells) -> bool:
        """Whether the feet of all handles on a thin plate are beside the plates in its outline: it moves as one."""
        view, config = self._view, self._config
        if view.size[plate, 2] > config.leaf * view.size[plate, :2].min():
            return False
        standing = np.flatnonzero(self._stands_on(plate) & (view.owner == view.owner[plate]))
        fronts = [k for k in plates.tolist() if inner[k] and k not in standing]
        feet = [min(handle, key=lambda shell: float(view.low[shell, 2])) for handle in self._grouped(standing)]
        on = [bool((overlaps(view, foot)[fronts] >= config.beside).any()) for foot in feet]
        return bool(fronts) and bool(feet) and not any(on)

    def _is_case(self, plate: int, plates: Indices, inner: MaskOfShells) -> bool:
        """Whether a body has several inset fronts, flush with its face: the pedestal of a desk."""
        view, near, config = self._view, float(self._near[plate]), self._config
        inset = np.zeros(len(inner), dtype=bool)
        inset[plates] = True
        inset &= inner & (view.owner == view.owner[plate])
        inset &= view.size[:, 2] <= config.inset * view.size[plate, 2]
        inset &= view.high[:, 2] >= view.high[plate, 2] - near
        outer = _outermost(view, np.flatnonzero(inset), config.nested)
        least = config.quarter if len(outer) >= config.many else config.half
        return len(outer) > 1 and float(self._area[outer].sum()) >= least * float(self._area[plate])

    def _is_unit(self, plate: int, plates: Indices) -> bool:
        """Whether a body is as high as wide and has a door on its face: a wall unit, and no drawer with its front."""
        view, near, config = self._view, float(self._near[plate]), self._config
        size = view.size[plate]
        if size[2] <= config.body * size[:2].min() or size[1] < size[0]:
            return False
        door = np.zeros(len(self._area), dtype=bool)
        door[plates] = True
        door &= within(view, plate, 0.0) & (view.owner == view.owner[plate])
        door &= (view.size[:, 2] <= config.inset * size[2]) & (self._area <= config.unit * self._area[plate])
        door &= np.abs(view.low[:, 2] - view.high[plate, 2]) <= near
        return bool((self._area[door] >= config.half * self._area[plate]).any())

    def _is_apron(self, plate: int, front: int) -> bool:
        """Whether a board is longer by far than the front on it, and hardly higher: the apron of a table."""
        ratio = self._view.size[front, :2] / self._view.size[plate, :2]
        return bool(ratio[0] <= self._config.apron_width and ratio[1] >= self._config.apron_height)

    def with_members(self, plate: int, taken: Iterable[int]) -> FrontShells:
        """Returns the front of a plate: shells of its object that no front has yet, as they belong to it."""
        view = self._view
        free = view.owner == view.owner[plate]
        free[[*taken]] = False
        standing = self._stands_on(plate)
        handles = self._grouped(np.flatnonzero(free & standing))
        others = self._grouped(np.flatnonzero(standing & (view.owner != view.owner[plate])))
        on = [shell for handle in handles for shell in handle]
        free[on] = False
        inside = free & within(view, plate, float(self._near[plate]))
        members = inside & self._lies_in(plate)
        near, cover = float(self._near[plate]), self._cover
        box = drawer_boards(view, plate, inside & ~members, near, self._config)
        box |= drawer_tub(view, plate, inside, cover, near, self._config)
        members |= box
        members |= free & self._stands_behind(plate) & bool(handles)
        shells = (plate, *np.flatnonzero(members).tolist())
        return FrontShells(shells, handles, bool(handles or others), others, bool(box.any()))

    def _stands_on(self, plate: int) -> MaskOfShells:
        """Whether each shell is small and stands out from the plate: a handle, or a piece of one."""
        view, config = self._view, self._config
        extent, near = float(self._scale.extent[plate]), float(self._near[plate])
        small = (view.size[:, :2].min(axis=1) <= config.handle_side * extent) & (
            self._area <= config.handle_area * self._area[plate]
        )
        shared = np.maximum(
            np.minimum(view.high[:, :2], view.high[plate, :2]) - np.maximum(view.low[:, :2], view.low[plate, :2]),
            0.0,
        ).prod(axis=1)
        on = shared >= config.on_front * self._area
        front = np.zeros(len(small))
        for k in np.flatnonzero(small & on).tolist():
            front[k] = self._level_near(k, plate)
        out = (view.high[:, 2] > front + config.handle_least_out * near) & (view.low[:, 2] >= view.low[plate, 2] - near)
        starts = view.low[:, 2] <= front + config.handle_gap * near
        starts &= view.high[:, 2] <= front + config.handle_out * extent
        mouldings = (view.size[:, :2] >= config.moulding * view.size[plate, :2]).any(axis=1)
        mouldings &= view.high[:, 2] <= front + near
        return np.asarray(small & on & out & starts & ~mouldings)

    def _stands_behind(self, plate: int) -> MaskOfShells:
        """Whether each shell stands on the far end of a drawer drawn as one body: the handle on its other side."""
        view, config, near = self._view, self._config, float(self._near[plate])
        is_body = view.size[plate, 2] >= view.size[plate, :2].min()
        small = within(view, plate, 0.0) & (self._area <= config.handle_area * self._area[plate])
        ends = (view.high[:, 2] <= view.low[plate, 2] + near) & (view.high[:, 2] >= view.low[plate, 2] - near)
        return np.asarray(small & ends & (view.size[:, 2] <= config.handle_out * self._scale.extent[plate]) & is_body)

    def _level_near(self, shell: int, plate: int) -> float:
        """Returns how far the plate comes forward around a shell: curved fronts come farther elsewhere."""
        view = self._view
        ring = with_ring(*view.window(shell))
        seen = view.depth[ring][view.seen[ring] == plate]
        return float(seen.max() if len(seen) else view.high[plate, 2])

    def _lies_in(self, plate: int) -> MaskOfShells:
        """Whether each shell within the outline is a pane, a moulding, a lock or a liner of the plate."""
        view, near, config = self._view, float(self._near[plate]), self._config
        thick = float(view.size[plate, 2])
        mounted = view.low[:, 2] >= view.low[plate, 2] - near
        liner = view.size[:, 2] <= config.liner * thick + near
        liner &= (view.low[:, 2] >= view.low[plate, 2] - config.liner * thick) & within(view, plate, config.seam * near)
        is_frame = (self._cover < config.ring) & (self._area >= config.whole * self._area[plate])
        plate_like = view.size[:, 2] <= config.liner_plate * view.size[:, :2].min(axis=1)
        return np.asarray(mounted | (liner & plate_like & ~is_frame))

    def _grouped(self, shells: Indices) -> tuple[tuple[int, ...], ...]:
        """Returns shells as groups of those that touch, bar and posts of one handle.

        What is flat is a printed mark, a sheet that is seen from its edge the seam of a mirrored half.
        """
        if not len(shells):
            return ()
        low, high = self._view.low[shells], self._view.high[shells]
        near = self._config.handle_touch * self._near[shells].max()
        label = linked(len(shells), *near_ends(low, high, near))
        groups = [label == k for k in range(int(label.max()) + 1)]
        sizes = [high[group].max(axis=0) - low[group].min(axis=0) for group in groups]
        least = np.array([SHEET, SHEET, self._config.thick_handle]) * near
        thick = [bool((size >= least).all()) for size in sizes]
        return tuple(tuple(shells[group].tolist()) for group, is_thick in zip(groups, thick, strict=True) if is_thick)


def _outermost(view: ShellsView, shells: Sequence[int] | Indices, nested: float) -> list[int]:
    """Returns the shells whose outlines lie in no other's, as `MemberConfig.nested` has it."""
    kept: list[int] = []
    for shell in _ranked(view, np.asarray(shells, dtype=np.int64)):
        if not any(overlaps(view, shell)[other] >= nested for other in kept):
            kept.append(shell)
    return kept
