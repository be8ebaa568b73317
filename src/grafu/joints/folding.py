"""Folding doors: which two leaves fold together, about which axes, and the requests that build them.

Of a pair in one plane the outer leaf turns about its outer edge, and the inner one is hinged to it behind their seam
and turns back by twice as much: the point of the inner leaf that mirrors the outer leaf's pivot stays in the plane of
the opening. Of two leaves in an inner corner the first hangs on the case, the second on the first, before their seam;
each moves by itself. Left and right are as seen from in front. Of two leaves above each other the upper one is outer.
"""

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import final

import numpy as np

from grafu.articulation.articulated_object import Coupling
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import OptionError
from grafu.geometry.arrays import Vec3
from grafu.geometry.axis import Axis
from grafu.graph.edges import Hinge
from grafu.joints.fold_config import FoldConfig
from grafu.joints.leaves import UP, Leaf, in_corner, is_as_wide, is_beside, leaf_of
from grafu.joints.motion_choice import DIRECTIONS, FOLD_SIDES, MotionChoice, Moves, Side, side_towards
from grafu.joints.plan import JointRequest, MotionRole, RealizationPlan
from grafu.vocabulary import PartLabel

_TWICE = 2.0  # the inner leaf turns back by twice what the outer one opens, so that it ends in the opening's plane


@final
@dataclass(frozen=True, eq=False)
class Fold:
    """Two leaves that fold to a side: the outer one hangs on the case, the inner one on it; of a corner, uncoupled.

    `outer_edge` is the side of the outer leaf that its axis lies at. Positive motion opens.

    Raises:
        ValueError: if both leaves are one, or the side is neither left nor right nor the top.
    """

    outer: str
    inner: str
    side: Side
    outer_axis: Axis
    inner_axis: Axis
    outer_edge: Side
    inner_edge: Side
    is_corner: bool = False

    def __post_init__(self) -> None:
        if self.outer == self.inner:
            raise ValueError(f"`Fold` needs two leaves: got {self.outer} twice")
        if self.side not in FOLD_SIDES:
            raise ValueError(f"`Fold.side` must be left, right or top: got {self.side}")

    @property
    def leaves(self) -> tuple[str, str]:
        """Both leaves, the outer one first."""
        return self.outer, self.inner

    @property
    def has_track(self) -> bool:
        """Whether a track above the leaves guides them: they stand beside one another in one plane."""
        return not self.is_corner and self.side is not Side.TOP

    @property
    def as_turning(self) -> dict[str, MotionChoice]:
        """Both leaves as doors that turn about the borders at which their axes lie."""
        edges = zip(self.leaves, (self.outer_edge, self.inner_edge), strict=True)
        return {leaf: MotionChoice(Moves.TURNS, edge) for leaf, edge in edges}


def fold_of(
    part: str,
    side: Side,
    asset: Asset,
    config: FoldConfig,
    taken: Collection[str] = (),
    stated: Collection[str] = (),
) -> Fold:
    """Returns how a leaf folds to a side with the leaf beside it, or with the one in the corner; `taken` are no leaves.

    In a corner only what is labelled a door, or is `stated` to fold, is a leaf: sides of cases stand so, too.

    Raises:
        OptionError: if it is no leaf, or no leaf that suits it stands beside it.
    """
    leaf = leaf_of(asset.part(part), asset.box, config)
    if leaf is None:
        raise OptionError(f"`{part}` cannot fold: it is no upright board; turn it about a border or let it slide")
    others = [other for other in _leaves(asset, {part, *taken}, config) if _is_near(leaf, other, config)]
    outwards = _outwards(leaf, side)
    pairs = [(leaf, other) for other in others if is_beside(leaf, other, -outwards, config)]
    pairs += [(other, leaf) for other in others if is_beside(leaf, other, outwards, config)]
    alike = [pair for pair in pairs if is_as_wide(*pair, outwards, config)]
    if alike:
        every = _leaves(asset, (), config)
        return _pair(*min(alike, key=lambda pair: _has_neighbour(pair[0], every, outwards, config)), side, outwards)
    is_door = {p.id for p in asset.parts if p.label is PartLabel.DOOR} | {*stated}
    corners = (in_corner(leaf, other, asset, config) for other in others if other.part in is_door)
    corner = next((found for found in corners if found is not None), None)
    if corner is not None and side is not Side.TOP:
        return _corner(*corner, side)
    raise OptionError(_why_not(leaf, pairs, side, config))


def _why_not(leaf: Leaf, pairs: Sequence[tuple[Leaf, Leaf]], side: Side, config: FoldConfig) -> str:
    """Returns why a leaf does not fold: the leaf beside it is wider or narrower, or there is none."""
    instead = f"use --move {leaf.part}={side} for a door by itself"
    if pairs:
        first, second = pairs[0]
        direction, size = DIRECTIONS[side], "high" if side is Side.TOP else "wide"
        sizes = f"{first.across(direction):.3f} m and {second.across(direction):.3f} m"
        return f"`{first.part}` and `{second.part}` must be about equally {size} to fold: got {sizes}; {instead}"
    within = f"within {config.seam:g} m, as high and in its plane, or at a right angle in an inner corner"
    where = f"above or below it within {config.seam:g} m" if side is Side.TOP else f"beside it {within}"
    return f"`{leaf.part}` needs a second leaf to fold with: none stands {where}; {instead}"


def _leaves(asset: Asset, without: Collection[str], config: FoldConfig) -> list[Leaf]:
    whole = asset.box
    parts = (p for p in asset.parts if p.id not in without and p.label not in (PartLabel.HANDLE, PartLabel.DRAWER))
    found = (leaf_of(part, whole, config) for part in parts if part.label is PartLabel.DOOR or not part.carried_by)
    return [leaf for leaf in found if leaf is not None]


def _is_near(leaf: Leaf, other: Leaf, config: FoldConfig) -> bool:
    return leaf.mesh.box.overlaps(other.mesh.box, max(config.corner, config.seam))


def _outwards(leaf: Leaf, side: Side) -> Vec3:
    """Returns the direction along a leaf to a side: up, or of the object, else as seen from before the leaf."""
    if side is Side.TOP:
        return UP
    along = float(leaf.right @ DIRECTIONS[side])
    if abs(along) > abs(float(leaf.front @ DIRECTIONS[side])):
        return leaf.right * np.sign(along)
    return leaf.right if side is Side.RIGHT else -leaf.right


def _has_neighbour(leaf: Leaf, leaves: Sequence[Leaf], outwards: Vec3, config: FoldConfig) -> bool:
    """Whether another leaf stands beside a leaf where its pivot would be."""
    return any(other.part != leaf.part and is_beside(leaf, other, outwards, config) for other in leaves)


def _pair(outer: Leaf, inner: Leaf, side: Side, outwards: Vec3) -> Fold:
    """Returns the fold of two leaves in one plane; `outwards` is the direction to the outer leaf's outer edge."""
    opens = np.cross(-outwards, outer.front)
    seam = (outer.span(-outwards)[1] + inner.span(-outwards)[0]) / 2
    behind = inner.at(outwards, inner.back)
    behind = behind - outwards * (seam + float(behind @ outwards))
    outer_axis = Axis(outer.at(outwards, outer.span(outer.front)[1]), opens)
    edge = side_towards(outwards)
    return Fold(outer.part, inner.part, side, outer_axis, Axis(behind, -opens), edge, edge)


def _corner(a: Leaf, b: Leaf, side: Side) -> Fold:
    """Returns the fold of two leaves in an inner corner: the left one, or the right one, hangs on the case."""
    left, right = (a, b) if float(a.right @ b.front) < 0 else (b, a)
    outer, inner = (left, right) if side is Side.LEFT else (right, left)
    outwards, to_corner = np.asarray(inner.front), -outer.front
    outer_axis = Axis(outer.at(outwards, outer.span(outer.front)[1]), np.cross(-outwards, outer.front))
    inner_axis = Axis(inner.at(to_corner, inner.span(inner.front)[1]), np.cross(-to_corner, inner.front))
    edges = side_towards(outwards), side_towards(to_corner)
    return Fold(outer.part, inner.part, side, outer_axis, inner_axis, *edges, is_corner=True)


def folds_in(motions: Mapping[str, MotionChoice], asset: Asset, config: FoldConfig) -> tuple[Fold, ...]:
    """Returns the folds that are stated for either or both of their leaves.

    Raises:
        OptionError: if a leaf cannot fold, or what is stated for the two contradicts.
    """
    found: dict[str, Fold] = {}
    known = {part.id for part in asset.parts}
    for part, choice in motions.items():
        if choice.moves is not Moves.FOLDS or choice.side is None or part not in known:
            continue
        if part in found:
            _require_one_side(part, choice.side, found[part])
            continue
        stated = {other for other, its in motions.items() if its.moves is Moves.FOLDS}
        fold = fold_of(part, choice.side, asset, config, {*found, *(motions.keys() - stated)}, stated)
        found |= dict.fromkeys(fold.leaves, fold)
    return tuple({id(fold): fold for fold in found.values()}.values())


def _require_one_side(part: str, side: Side, fold: Fold) -> None:
    if side is not fold.side:
        other = next(leaf for leaf in fold.leaves if leaf != part)
        raise OptionError(f"`{part}` folds with `{other}` to the {fold.side}: got {side}; state one side for both")


def as_turning(motions: Mapping[str, MotionChoice], folds: Sequence[Fold]) -> dict[str, MotionChoice]:
    """Returns the motions in which leaves that fold turn about the borders at which their axes lie."""
    return {**motions, **{leaf: choice for fold in folds for leaf, choice in fold.as_turning.items()}}


def with_folds(plan: RealizationPlan, folds: Sequence[Fold], config: FoldConfig) -> RealizationPlan:
    """Returns the plan in which the leaves fold instead of turning by themselves; each must have a request."""
    made = {request.moving: request for request in plan.joints}
    for fold in folds:
        made |= {request.moving: request for request in _requests(made[fold.outer], made[fold.inner], fold, config)}
    return replace(plan, joints=tuple(made[request.moving] for request in plan.joints))


def _requests(outer: JointRequest, inner: JointRequest, fold: Fold, config: FoldConfig) -> Iterator[JointRequest]:
    """Yields the requests of both leaves; the outer one takes along the inner one, and what this carries."""
    own = tuple(part for part in inner.attached if part != fold.outer)
    attached = (*(part for part in outer.attached if part not in (fold.inner, *own)), fold.inner, *own)
    opening = None if fold.is_corner else config.opening
    yield replace(
        _plain(outer),
        axis=fold.outer_axis,
        reference=opening,
        attached=attached,
        role=MotionRole.NONE if fold.is_corner else MotionRole.OUTER,
    )
    coupling = None if fold.is_corner else Coupling(fold.outer, _TWICE)
    yield replace(
        _plain(inner),
        axis=fold.inner_axis,
        reference=config.corner_opening if opening is None else _TWICE * opening,
        mounts=(),
        attached=own,
        parent=fold.outer,
        coupling=coupling,
        role=MotionRole.CORNER if fold.is_corner else MotionRole.INNER if fold.has_track else MotionRole.LOWER,
    )


def _plain(request: JointRequest) -> JointRequest:
    return replace(request, type=Hinge.joint_type, parent="", coupling=None, drawn_at=0.0)
