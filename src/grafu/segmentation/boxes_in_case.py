"""Boxes of drawers drawn in the object of the case, or as boards of their own, behind fronts of other objects.

It asks geometry alone. A drawer's box is open from above, ends at the back of its front, and stands in a case that
reaches past it on the left, on the right and behind it. So the boards of a case that one front closes are no such box.
"""

from collections.abc import Iterator, Sequence
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, distinct
from grafu.geometry.components import linked
from grafu.geometry.config_checks import require_positive, require_ratios
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.segmentation.view import MaskOfShells, PointsOfShells, ShellsView
from grafu.shapes import Bool

_TURNS: Final = 4


@final
@dataclass(frozen=True, slots=True)
class BoxInCaseConfig:
    """Which shells behind a front are the box of its drawer.

    Raises:
        ValueError: if a number is not above 0, or what must be a fraction is not between 0 and 1.
    """

    near: float = 0.008
    """How far a box lies behind its front at most, stands out of it, or has gaps between its boards (of the front's
    largest side)."""
    touch: float = 0.0003
    """Boards nearer than this are one first: a box may stand as close above a board of the case (the same)."""
    most: int = 600
    """Shells behind one front at most: what is more is a basket of wire or a load."""
    plate: float = 0.7
    """How thick a front is at most, without what stands before its largest shell: handles (of its shorter side)."""
    flattest: float = 16.0
    """How many times as wide as high a front is at most: what is flatter is an apron, with several drawers behind."""
    width: float = 0.5
    """How wide a box is at least (of the front's width) ..."""
    height: float = 0.25
    """... how high (of the front's height) ..."""
    depth: float = 0.9
    """... and how deep (of its own height): the bins of tilting fronts are less deep."""
    full: float = 0.96
    """A box is narrower or lower than this (of its front): boards that are neither are the case behind a door ..."""
    low: float = 0.6
    """... unless the front looks to -Y, is as low as this (of its width), and no more than one object is parted."""
    wall: float = 0.3
    """What the faces of a side cover at least (of the box as it is seen from there) ..."""
    bottom: float = 0.4
    """... those of the bottom or of the back, which some models leave out (of the box as seen from there) ..."""
    lid: float = 0.4
    """... and those near its top at most (the same)."""
    end: float = 0.2
    """How far from an end of the box its sides, bottom and lid lie (of its size)."""
    board: float = 0.1
    """How thick a lying board of the case is at most on which a box rests, or that it cuts into (of its depth)."""
    along: float = 0.5
    """How much of the height and depth of a box the sides of its case run along at least (fraction)."""

    def __post_init__(self) -> None:
        require_positive(self, "most", "depth", "flattest")
        require_ratios(self, *(name for name in self.__dataclass_fields__ if name not in ("most", "depth", "flattest")))


def boxes_in_cases(
    meshes: Sequence[TriangleMesh],
    fronts: Sequence[bool],
    cases: Sequence[bool],
    config: BoxInCaseConfig = BoxInCaseConfig(),
) -> dict[int, dict[int, Indices]]:
    """Returns for each front that has its box in other objects the faces of these that are the box, by object.

    Args:
        meshes: the objects of an input, Z up, their front most likely at -Y; any unit.
        fronts: which of them may be the front of a drawer, and have no box yet.
        cases: which of them may hold boxes, whole or in part.
        config: the thresholds.
    """
    if not (any(fronts) and any(cases)):
        return {}
    shells = MeshShells.of(meshes)
    starts = np.cumsum([0, *(len(mesh.faces) for mesh in meshes)])
    found: dict[int, dict[int, Indices]] = {}
    taken = np.zeros(len(shells.owner), dtype=bool)
    for turn in range(_TURNS):
        finder = _BoxFinder(shells, turn, np.asarray(cases, dtype=bool), config)
        for front in (k for k in np.flatnonzero(fronts).tolist() if k not in found):
            box = finder.box_of(front, taken)
            if box is not None:
                taken[box] = True
                faces = np.flatnonzero(np.isin(shells.shell, box))
                owner = shells.owner[shells.shell[faces]]
                found[front] = {k: faces[owner == k] - starts[k] for k in distinct(owner).tolist()}
    return found


@final
class _BoxFinder:
    """Finds boxes behind fronts as they are seen from one side; the viewer's axes are x right, y up, z towards it."""

    def __init__(
        self, shells: MeshShells, turn: int, cases: Bool[np.ndarray, " objects"], config: BoxInCaseConfig
    ) -> None:
        axes = axes_from(turn)
        self._view: ShellsView = shells.seen(axes)
        self._mesh, self._axes, self._is_ahead = shells.mesh, axes, turn == 0
        self._gives: MaskOfShells = cases[shells.owner]
        self._config = config

    def box_of(self, front: int, taken: MaskOfShells) -> Indices | None:
        """Returns the shells of the box of a front; None where there is none, or where there are several."""
        view, config = self._view, self._config
        own = view.owner == front
        low, high = view.low[own].min(axis=0), view.high[own].max(axis=0)
        size = high - low
        near = config.near * float(size[:2].max())
        main = np.flatnonzero(own)[np.argmax(np.prod(view.size[own, :2], axis=1))]
        is_thick = float(view.high[main, 2] - low[2]) > config.plate * size[:2].min()
        if is_thick or size[0] > config.flattest * size[1]:
            return None
        inside = (view.low[:, :2] >= low[:2] - near).all(axis=1) & (view.high[:, :2] <= high[:2] + near).all(axis=1)
        inside &= self._gives & ~taken & ~own & (view.high[:, 2] <= high[2] + near) & (view.low[:, 2] < low[2] - near)
        behind = np.flatnonzero(inside)
        if not 0 < len(behind) <= config.most:
            return None
        touch = config.touch * float(size[:2].max())
        for gap in (touch, near):
            found = [group for group in self._groups(behind, gap) if self._is_box(group, own, near)]
            if found:
                return found[0] if len(found) == 1 else None
        found = [group for group in self._resting(behind, touch) if self._is_box(group, own, near)]
        return found[0] if len(found) == 1 else None

    def _resting(self, shells: Indices, touch: float) -> Iterator[Indices]:
        """Yields what of each group rests on a board of the case, or cuts into one, without that board.

        Such a board reaches past the rest on both sides and lies at its foot. What is left has a bottom of its own:
        the sides of a case that stand on its bottom have none.
        """
        view, config = self._view, self._config
        for group in self._groups(shells, touch):
            low, high, size = view.low[group], view.high[group], view.size[group]
            lies = size[:, 1] <= config.board * size[:, 2]
            if lies.all():
                continue
            foot, top = low[~lies].min(axis=0), high[~lies].max(axis=0)
            at_foot = lies & (low[:, 1] < foot[1] + config.end * (top[1] - foot[1]))
            of_case = at_foot & (low[:, 0] < foot[0] - touch) & (high[:, 0] > top[0] + touch)
            if of_case.any() and (at_foot & ~of_case).any():
                yield group[~of_case]

    def _groups(self, shells: Indices, gap: float) -> Iterator[Indices]:
        """Yields the shells in groups of those that are no farther apart than a gap."""
        low, high = self._view.low[shells], self._view.high[shells]
        gaps = np.maximum(low[:, None] - high[None], low[None] - high[:, None]).max(axis=2)
        label = linked(len(shells), *np.nonzero(gaps <= gap))
        for k in range(int(label.max()) + 1):
            yield shells[label == k]

    def _is_box(self, group: Indices, front: MaskOfShells, near: float) -> bool:
        view, config = self._view, self._config
        low, high = view.low[group].min(axis=0), view.high[group].max(axis=0)
        size, front_low = high - low, view.low[front].min(axis=0)
        whole = view.high[front].max(axis=0) - front_low
        ratio = size[:2] / whole[:2]
        is_low = self._is_ahead and whole[1] <= config.low * whole[0] and self._is_of_one(group)
        is_smaller = ratio.min() <= config.full or is_low
        is_fitting = ratio[0] >= config.width and ratio[1] >= config.height and is_smaller
        is_right_behind = front_low[2] - near <= high[2]
        is_deep = size[2] >= config.depth * size[1] and size[2] > 2 * near
        if not (is_fitting and is_right_behind and is_deep and self._is_open_above(group, low, high)):
            return False
        rest = ~front
        rest[group] = False
        return self._stands_in_case(rest, low, high, near)

    def _is_of_one(self, group: Indices) -> bool:
        """Whether shells are of one object, or all that several consist of: a drawer, and no piece of its case."""
        owner = self._view.owner
        owners = distinct(owner[group])
        return len(owners) == 1 or int(np.isin(owner, owners).sum()) == len(group)

    def _stands_in_case(self, rest: MaskOfShells, low: np.ndarray, high: np.ndarray, near: float) -> bool:
        """Whether the rest reaches past a box on the left and on the right, and behind it or farther back."""
        view, config = self._view, self._config
        shared = np.minimum(view.high, high) - np.maximum(view.low, low)
        level = rest & (shared[:, 1:] >= config.along * (high - low)[1:]).all(axis=1)
        left = level & (view.low[:, 0] < low[0] - near / 4)
        right = level & (view.high[:, 0] > high[0] + near / 4)
        behind = rest & (shared[:, :2] >= config.along * (high - low)[:2]).all(axis=1)
        behind &= view.low[:, 2] < low[2] - near / 4
        ends: PointsOfShells = view.low[left | right]
        deeper = bool(len(ends)) and float(ends[:, 2].min()) < low[2] - 2 * near
        return bool(left.any() and right.any() and (behind.any() or deeper))

    def _is_open_above(self, group: Indices, low: np.ndarray, high: np.ndarray) -> bool:
        """Whether faces cover both sides and the bottom or the back of a box, and not its top."""
        config, size = self._config, high - low
        faces = np.isin(self._view.shell, group)
        triangles = self._mesh.vertices[self._mesh.faces[faces]] @ self._axes.T
        area = np.abs(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])) / 2
        place = (triangles.mean(axis=1) - low) / size
        first, last = place <= config.end, place >= 1 - config.end
        side, plan = size[1] * size[2], size[0] * size[2]
        has_sides = all(float(area[at[:, 0], 0].sum()) >= config.wall * side for at in (first, last))
        has_bottom = float(area[first[:, 1], 1].sum()) >= config.bottom * plan
        has_bottom |= float(area[first[:, 2], 2].sum()) >= config.bottom * size[0] * size[1]
        has_lid = float(area[last[:, 1], 1].sum()) > config.lid * plan
        return bool(has_sides and has_bottom and not has_lid)
