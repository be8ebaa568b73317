"""Whether an object hides fronts: it is a case, or several fronts in one, and no single door or drawer."""

from dataclasses import replace

import numpy as np

from grafu.geometry.arrays import Indices, median, without
from grafu.segmentation.config import DivisionConfig, SegmentationConfig
from grafu.segmentation.fronts import FrontShells
from grafu.segmentation.surroundings import Scale, is_behind, is_leaf_in_frame, overlaps
from grafu.segmentation.view import ShellsView


def outline(view: ShellsView, front: FrontShells) -> float:
    """Returns the area of a front's bounding box as it is seen."""
    shells = [*front.shells]
    size = view.high[shells].max(axis=0) - view.low[shells].min(axis=0)
    return float(size[0] * size[1])


def without_case(
    view: ShellsView, fronts: tuple[FrontShells, ...], config: SegmentationConfig
) -> tuple[FrontShells, ...]:
    """Returns the fronts; of the only one, which takes all shells of an input, what is not behind its plate."""
    if len(fronts) != 1 or len(fronts[0].all_shells) < len(view.owner):
        return fronts
    plate = fronts[0].shells[0]
    least = view.low[plate, 2] - config.candidates.near * Scale.of(view).extent[plate]
    return (replace(fronts[0], shells=tuple(k for k in fronts[0].shells if view.low[k, 2] >= least)),)


def is_panel_of_controls(view: ShellsView, front: FrontShells, config: DivisionConfig) -> bool:
    """Whether a low strip has more handles in a row than a drawer has: the knobs of a stove."""
    size = view.size[front.shells[0]]
    count = len(front.handles) + len(front.others)
    return count >= config.knobs and bool(size[0] >= config.strip * size[1])


def is_one_with_handles(view: ShellsView, owner: int, fronts: tuple[FrontShells, ...], config: DivisionConfig) -> bool:
    """Whether an object is one front, or a drawer behind one, with a handle or two."""
    if len(fronts) != 1 or not 0 < len(fronts[0].handles) <= config.most_handles:
        return False
    own = view.owner == owner
    size = view.high[own].max(axis=0) - view.low[own].min(axis=0)
    return outline(view, fronts[0]) >= config.single * float(size[0] * size[1])


def is_flush(view: ShellsView, front: FrontShells, config: DivisionConfig) -> bool:
    """Whether a front lies near the front of its object, its handles left out, and is no trifle.

    The drawer of one object of a wide row is low beside the whole: one with a handle is compared with its object alone.
    """
    plate = front.shells[0]
    handles = [shell for handle in front.handles for shell in handle]
    own = without(np.flatnonzero(view.owner == view.owner[plate]), handles)
    depth = float(view.high[own, 2].max() - view.low[own, 2].min())
    extent = float((view.high.max(axis=0) - view.low.min(axis=0)).max())
    inside = float(view.high[own, 2].max() - view.high[plate, 2])
    shorter, thick = float(view.size[plate, :2].min()), float(view.size[plate, 2])
    flush = config.flush_held if front.is_held else config.flush
    low = config.low * float(Scale.of(view).extent[plate]) if front.is_held else np.inf
    is_ahead = inside <= flush * depth + thick or not is_behind(view, plate, config.around)
    return is_ahead and shorter >= min(config.small * extent, low)


def hides(
    view: ShellsView, owner: int, fronts: tuple[FrontShells, ...], is_whole: bool, config: SegmentationConfig
) -> bool:
    """Whether an object is more than the fronts in it are: a case, or several fronts in one.

    What is said to be one door or drawer, and a plate, holds several where they fill its outline, as an open niche
    among them does not, or where it is nothing but fronts in one plane; those of a plate without a name are of about
    one size then, or a handle stands on each. The only object of an input is a case, also where it looks
    like a drawer: open above, and as wide as its front. So is the frame that the leaf of a door hangs in.
    """
    own = view.owner == owner
    low, high = view.low[own].min(axis=0), view.high[own].max(axis=0)
    size = high - low
    major = _major(view, fronts, config.division.alike)
    if not is_whole and len(major) > 1 and _is_boarded(view, major, config):
        return False
    plate = fronts[0].shells[0] if len(fronts) == 1 and own.all() else None
    if plate is not None and is_leaf_in_frame(view, plate, Scale.of(view), config.candidates):
        return True
    filled = sum(outline(view, front) for front in major) / float(size[0] * size[1])
    is_plate = size[2] <= config.division.plate * size[:2].min()
    if (is_whole or is_plate) and len(major) > 1 and _are_battened(view, np.flatnonzero(own), major, config):
        return False
    if is_whole or (is_plate and not _is_shallow_case(view, np.flatnonzero(own), fronts, config.division)):
        several = len(major) > 1 and filled >= config.division.filled
        covered = sum(outline(view, front) for front in fronts) / float(size[0] * size[1])
        clear = len(major) == len(fronts) or all(front.is_held for front in fronts)
        clear = is_whole or (clear and covered >= config.division.apart)
        several |= clear and len(fronts) > 1 and _is_nothing_else(view, np.flatnonzero(own), fronts)
        return several or (not is_whole and _is_beside_panel(view, np.flatnonzero(own), major, config.division))
    if len(fronts) == 1 and not own.all() and _is_plinth(view, fronts[0], float(size[1]), config.division):
        return False
    rest = own.copy()
    rest[[shell for front in fronts for shell in front.all_shells]] = False
    if len(major) > 1 or not rest.any():
        return len(major) > 1
    return bool(own.all()) or _is_case(view, np.flatnonzero(rest), major, config)


def _is_nothing_else(view: ShellsView, own: Indices, fronts: tuple[FrontShells, ...]) -> bool:
    """Whether an object consists of fronts and their handles, and the plates overlap in depth."""
    plates = [front.shells[0] for front in fronts]
    in_one_plane = view.low[plates, 2].max() < view.high[plates, 2].min()
    return bool(in_one_plane) and {k for front in fronts for k in front.all_shells} >= set(own.tolist())


def _is_plinth(view: ShellsView, front: FrontShells, height: float, config: DivisionConfig) -> bool:
    """Whether a front without a handle is a low board at the floor; `height` is that of its object."""
    low, high = (ends[[*front.shells], 1] for ends in (view.low, view.high))
    at_floor = float(low.min() - view.low[:, 1].min()) <= config.floor * height
    return not front.is_held and at_floor and float(high.max() - low.min()) <= config.plinth * height


def _major(view: ShellsView, fronts: tuple[FrontShells, ...], alike: float) -> tuple[FrontShells, ...]:
    """Returns the fronts of some size, `alike` of the largest: rails and stiles are far smaller than their panel."""
    areas = [outline(view, front) for front in fronts]
    return tuple(front for front, area in zip(fronts, areas, strict=True) if area >= alike * max(areas))


def _is_boarded(view: ShellsView, major: tuple[FrontShells, ...], config: SegmentationConfig) -> bool:
    """Whether plates without handles are the boards of one panel: upright, narrow and side by side without a gap."""
    plates = np.array([front.shells[0] for front in major])
    plates = plates[np.argsort(view.low[plates, 0], kind="stable")]
    low, high, size = view.low[plates], view.high[plates], view.size[plates]
    are_narrow = bool((size[:, 1] >= config.division.board * size[:, 0]).all())
    gap = config.frames.gap * float(Scale.of(view).extent[plates[0]])
    meet = bool((np.abs(low[1:, 0] - high[:-1, 0]) <= gap).all())
    return are_narrow and meet and not any(front.is_held for front in major)


def _are_battened(view: ShellsView, own: Indices, major: tuple[FrontShells, ...], config: SegmentationConfig) -> bool:
    """Whether the plates are the boards of one leaf, which battens hold together: two strips that lie on all of them.

    Leaves beside each other have none: each could move no more. The side of a case behind fronts is far deeper.
    """
    plates = [front.shells[0] for front in major]
    near = config.candidates.near * float(Scale.of(view).extent[plates[0]])
    low, high = view.low[plates], view.high[plates]
    thick = config.division.batten_thick * median(view.size[plates, 2])
    found = 0
    for k in without(own, plates).tolist():
        touch = (view.low[k, 2] <= high[:, 2] + near) & (view.high[k, 2] >= low[:, 2] - near)
        shared = np.minimum(high, view.high[k])[:, :2] - np.maximum(low, view.low[k])[:, :2]
        along = int(np.argmax(view.size[k, :2]))
        across = bool((shared[:, along] >= config.division.batten * (high - low)[:, along]).all())
        is_strip = view.size[k, 1 - along] <= config.division.batten_wide * (high - low)[:, 1 - along].min()
        within = bool((shared[:, 1 - along] >= view.size[k, 1 - along] - near).all())
        found += bool(touch.all()) and across and bool(is_strip) and within and bool(view.size[k, 2] <= thick)
    return found > 1


def _is_beside_panel(view: ShellsView, own: Indices, major: tuple[FrontShells, ...], config: DivisionConfig) -> bool:
    """Whether a plate is one front beside a plate that is none: a control panel. A frame around it is none."""
    area = np.prod(view.size[:, :2], axis=1)
    size = view.high[own].max(axis=0) - view.low[own].min(axis=0)
    outline, plate = float(size[0] * size[1]), major[0].shells[0]
    beside = [k for k in own.tolist() if k != plate and overlaps(view, k)[plate] < config.beside]
    has_panel = len(major) == 1 and any(area[k] >= config.panel * outline for k in beside)
    if has_panel and _is_around(view, own, plate):
        return False
    return has_panel and bool(area[[plate, *beside]].sum() >= config.filled * outline)


def _is_shallow_case(view: ShellsView, own: Indices, fronts: tuple[FrontShells, ...], config: DivisionConfig) -> bool:
    """Whether an object is far deeper than the fronts before it: a bookcase, and no door with panels."""
    handles = [shell for front in fronts for handle in front.handles for shell in handle]
    body, plates = without(own, handles), [front.shells[0] for front in fronts]
    size = view.high[body].max(axis=0) - view.low[body].min(axis=0)
    thick = median(view.size[plates, 2])  # one may be a drawer drawn as one body
    return bool(size[2] >= config.shallow * size[:2].min() and size[2] >= config.deeper * thick)


def _is_around(view: ShellsView, shells: Indices, plate: int) -> bool:
    """Whether shells lie on all four sides of a plate."""
    middle = (view.low[shells, :2] + view.high[shells, :2]) / 2
    return bool((middle < view.low[plate, :2]).any(axis=0).all() and (middle > view.high[plate, :2]).any(axis=0).all())


def _is_case(view: ShellsView, rest: Indices, fronts: tuple[FrontShells, ...], config: SegmentationConfig) -> bool:
    """Whether shells are more than a box behind fronts: they stand out of these, or are closed from above.

    What ends below the middle of the fronts is the bottom of a box with its runners, and closes nothing.
    """
    plates = [front.shells[0] for front in fronts]
    reach = config.division.case_reach
    near = reach * (config.candidates.near * float(Scale.of(view).extent[plates[0]]))
    low, high = view.low[rest].min(axis=0), view.high[rest].max(axis=0)
    left, right = view.low[plates].min(axis=0) - near, view.high[plates].max(axis=0) + near
    if (low[:2] < left[:2]).any() or (high[:2] > right[:2]).any():
        return bool(view.low[plates, 2].max() - low[2] > near / reach)
    if high[1] < (left[1] + right[1]) / 2:
        return False
    above = view.high[rest, 1] >= high[1] - near
    lid = float(view.faced[rest[above], 1].sum())
    return lid >= config.division.lid * float((high - low)[0] * (high - low)[2])
