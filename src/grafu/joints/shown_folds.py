"""Folding doors that names or drawn hinges show, without annotation: two or four leaves of one opening.

Nothing else is taken for one: a pair of doors that is taken for a folding one would be worse than a pair that turns.
"""

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise, product
from typing import final

import numpy as np

from grafu.asset.names import spoken
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import OptionError
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.config_checks import at_scale
from grafu.joints.config import RealizationConfig
from grafu.joints.drawn_hinges import barrels_at
from grafu.joints.fold_config import FoldConfig
from grafu.joints.folding import Fold, fold_of
from grafu.joints.leaves import UP, Leaf, in_corner, is_as_wide, is_beside, leaf_of
from grafu.joints.motion_choice import Side
from grafu.joints.nesting import bodies_of
from grafu.joints.plan import JointRequest, RealizationPlan
from grafu.scene.border import border_frame
from grafu.scene.scale import metre_on
from grafu.scene.scene import Scene

_WORDS = frozenset({"bifold", "folding", "falttur", "pliante", "plegable"})
_TWO_WORDS = ("bi", "fold")
_PAIRS: dict[int, tuple[tuple[int, int, Side], ...]] = {
    2: ((0, 1, Side.LEFT),),
    4: ((0, 1, Side.LEFT), (2, 3, Side.RIGHT)),
}
"""By the number of leaves in a row, from the left: the left and the right leaf of each pair, and where it folds to."""


@final
@dataclass(frozen=True, eq=False)
class _Doors:
    """What moves by itself in a plan and is an upright board; `config` is in the model's scale."""

    plan: RealizationPlan
    asset: Asset
    leaves: tuple[Leaf, ...]
    config: RealizationConfig

    @property
    def fold(self) -> FoldConfig:
        return self.config.fold

    def request(self, leaf: Leaf) -> JointRequest:
        return next(request for request in self.plan.joints if request.moving == leaf.part)


def shown_folds(
    plan: RealizationPlan,
    asset: Asset,
    config: RealizationConfig = RealizationConfig(),
    settled: Collection[str] = (),
) -> list[Fold]:
    """Returns the folding doors of a predicted plan that names show, or hinges drawn behind the seam of two leaves.

    Parts that are `settled` move as the user states.
    """
    config, whole = at_scale(config, metre_on(asset.extent)), asset.box
    free = (r for r in plan.joints if r.moving not in settled)
    alone = (r for r in free if not (r.parent or r.coupling or str(r.choice) or r.drawn_at))
    found = (leaf_of(asset.part(request.moving), whole, config.fold) for request in alone)
    doors = _Doors(plan, asset, tuple(leaf for leaf in found if leaf is not None), config)
    if len(doors.leaves) < 2:
        return []
    is_named = is_called_folding(asset.name, "bifold")
    named = [leaf for leaf in doors.leaves if is_named or is_called_folding(asset.part(leaf.part).source.name)]
    folds = [*_named(named, doors)]
    taken = {leaf for fold in folds for leaf in fold.leaves}
    left = (leaf for leaf in doors.leaves if leaf.part not in taken)
    return [*folds, *_drawn([leaf for leaf in left if doors.request(leaf).kind.turns], doors)]


def is_called_folding(name: str, *words: str) -> bool:
    """Whether a name has a word for folding doors, or one of `words` where any are given."""
    found = spoken(name)
    return bool({*(words or _WORDS)} & {*found}) or _TWO_WORDS in list(pairwise(found))


def _named(leaves: Sequence[Leaf], doors: _Doors) -> Iterator[Fold]:
    """Yields the folds of leaves that are called folding: in rows of two or four, or two in a corner."""
    rows = [*_rows(leaves, doors.fold)]
    for row in rows:
        if all(is_as_wide(row[0], leaf, leaf.right, doors.fold) for leaf in row):
            for left, right, side in _PAIRS.get(len(row), ()):
                yield from _folded(row[left], row[right], side if len(row) > 2 else None, doors)
    single = [row[0] for row in rows if len(row) == 1]
    for upper, lower in product(single, single):
        if is_beside(upper, lower, -UP, doors.fold) and is_as_wide(upper, lower, UP, doors.fold):
            yield from _folded(upper, lower, Side.TOP, doors)
            single = [leaf for leaf in single if leaf not in (upper, lower)]
    corners = [
        (one, other)
        for k, one in enumerate(single)
        for other in single[k + 1 :]
        if in_corner(one, other, doors.asset, doors.fold)
    ]
    if len(corners) == 1:
        yield from _folded(*corners[0], None, doors)


def _rows(leaves: Sequence[Leaf], config: FoldConfig) -> Iterator[list[Leaf]]:
    """Yields the leaves that stand side by side in one plane, from left to right."""
    after = {
        leaf.part: [o for o in leaves if o is not leaf and is_beside(leaf, o, leaf.right, config)] for leaf in leaves
    }
    followers = {other.part for found in after.values() for other in found}
    for first in (leaf for leaf in leaves if leaf.part not in followers):
        row = [first]
        while len(after[row[-1].part]) == 1 and after[row[-1].part][0] not in row:
            row.append(after[row[-1].part][0])
        yield row


def _drawn(leaves: Sequence[Leaf], doors: _Doors) -> Iterator[Fold]:
    """Yields the folds of leaves that have hinges behind the seam between them, and no post there."""
    joined = [(a, b) for a in leaves for b in leaves if a is not b and _is_hinged(a, b, doors)]
    for left, right in joined:
        if sum(leaf in pair for pair in joined for leaf in (left, right)) == 2:
            alone = [
                not any(is_beside(leaf, o, outwards, doors.fold) for o in leaves)
                for leaf, outwards in _outer(left, right)
            ]
            side = {(True, False): Side.LEFT, (False, True): Side.RIGHT}.get((alone[0], alone[1]))
            yield from _folded(left, right, side, doors)


def _outer(left: Leaf, right: Leaf) -> tuple[tuple[Leaf, np.ndarray], tuple[Leaf, np.ndarray]]:
    return (left, -left.right), (right, right.right)


def _is_hinged(left: Leaf, right: Leaf, doors: _Doors) -> bool:
    """Whether hinges are drawn behind the seam of a leaf and the one at its right, in the rear half of their boards."""
    asset, fold = doors.asset, doors.fold
    if not (is_beside(left, right, left.right, fold) and is_as_wide(left, right, left.right, fold)):
        return False
    request = doors.request(right)
    axis = fold_of(left.part, Side.LEFT, asset, fold).inner_axis
    scene = Scene({p.id: p for p in asset.parts if len(p.mesh.faces)}, bodies_of(doors.plan.joints), asset.extent)
    frame = border_frame(right.mesh, axis)
    barrels = barrels_at(frame, request, scene, doors.config)
    behind = [b for b in barrels if abs(b.x) <= fold.seam and b.y >= -frame.thickness / 2]
    return len(behind) > 1 and not _has_post(left, scene, {b.part for b in behind}, fold)


def _has_post(left: Leaf, scene: Scene, hinges: set[str], config: FoldConfig) -> bool:
    """Whether a static part other than the hinges stands behind a seam along half of its height or more."""
    low, high = left.height
    seam = left.at(left.right, left.back)
    half = vec3(config.corner, config.corner, (high - low) / 2)
    near = Box(seam - half, seam + half)
    return any(
        part.id not in hinges
        and part.box.overlaps(near)
        and min(float(part.box.high[2]), high) - max(float(part.box.low[2]), low) > (high - low) / 2
        for part in scene.static_parts
    )


def _folded(left: Leaf, right: Leaf, side: Side | None, doors: _Doors) -> Iterator[Fold]:
    """Yields the fold of two leaves; where the side is open, the leaf that alone is pulled is the inner one."""
    pulled = [bool(doors.request(leaf).attached) for leaf in (left, right)]
    side = side or (Side.RIGHT if pulled == [True, False] else Side.LEFT)
    pair = {left.part, right.part}
    try:
        yield fold_of(left.part, side, doors.asset, doors.fold, {leaf.part for leaf in doors.leaves} - pair, pair)
    except OptionError:
        return  # what cannot fold turns
