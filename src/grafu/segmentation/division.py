"""Which objects of an input are cut, and into what: where an object hides fronts, or a front has a handle drawn in it.

It asks geometry alone.
"""

from collections.abc import Sequence
from dataclasses import field, replace
from typing import Literal, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices, Vec3, distinct
from grafu.geometry.mesh import TriangleMesh
from grafu.segmentation.candidates import candidates, framed, halves, merged
from grafu.segmentation.config import DivisionConfig, SegmentationConfig
from grafu.segmentation.fronts import FrontShells, fronts_among
from grafu.segmentation.hidden_fronts import (
    hides,
    is_flush,
    is_one_with_handles,
    is_panel_of_controls,
    outline,
    without_case,
)
from grafu.segmentation.low_fronts import with_low
from grafu.segmentation.lying import lying_on_fronts
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.segmentation.view import MaskOfShells, ShellsView
from grafu.shapes import Bool, Int

MaskOfObjects = Bool[np.ndarray, " objects"]
Faces = Int[np.ndarray, " _"]


@final
@dataclass(frozen=True, slots=True)
class FacePiece:
    """Faces of one object that become a part, and its role in that object.

    "front", "handle" and "lid" are new parts; "rest" is what is left of an object, "body" a door or drawer without the
    handles that were drawn in it, "on front" what lies on a front of another object. A front is seen when one looks
    against the unit direction `towards`; None: it is no front. It `is_sheet` where it was drawn on a surface.
    """

    role: Literal["front", "handle", "lid", "rest", "body", "on front"]
    faces: Indices
    towards: Vec3 | None = None
    is_sheet: bool = False


def divided(
    meshes: Sequence[TriangleMesh],
    open_to: Sequence[bool],
    whole: Sequence[bool],
    materials: Sequence[Indices] | None = None,
    lying: Sequence[bool] | None = None,
    config: SegmentationConfig = SegmentationConfig(),
    shells: MeshShells | None = None,
) -> dict[int, list[FacePiece]]:
    """Returns for each mesh that is cut what it is cut into.

    Args:
        meshes: the objects of an input, Z up, their front most likely at -Y; any unit.
        open_to: which of them may be cut.
        whole: which of them are said to be one door or drawer: they are cut where they hold several fronts.
        materials: for each mesh the number of each face's material: a handle welded to a front is known by it.
        lying: which of them may be handles, and are parted by the fronts that they lie on; None: all that may be cut.
        config: the thresholds.
        shells: those of the meshes, where they are known.
    """
    may = np.asarray(open_to, dtype=bool)
    shells = shells or MeshShells.of(meshes)
    loose = may if lying is None else np.asarray(lying, dtype=bool)

    found = _from_the_best_side(shells, (may, loose), whole, config)
    pieces = found.pieces(shells)
    if materials is not None:
        left = may & [k not in pieces and len(distinct(m)) > 1 for k, m in enumerate(materials)]
        parted = shells.parted(materials) if left.any() else shells
        single = _from_the_best_side(parted, (left, np.zeros_like(left)), whole, config).with_handles
        pieces |= FoundFronts({}, single).pieces(parted)
    return dict(sorted(pieces.items()))


@final
@dataclass(frozen=True, slots=True)
class FoundFronts:
    """What one side shows, by object: hidden fronts, a front with handles on it, shells that lie on others' fronts.

    `turn` is the number of the side (`axes_from`).
    """

    hidden: dict[int, tuple[FrontShells, ...]]
    with_handles: dict[int, FrontShells]
    on_fronts: dict[int, tuple[tuple[int, ...], ...]] = field(default_factory=dict)
    turn: int = 0

    def clear(self, config: DivisionConfig) -> dict[int, tuple[FrontShells, ...]]:
        """Returns the hidden fronts that are clear: several of one object, or one with a handle, and not with many."""
        found = self.hidden.items()
        return {o: f for o, f in found if len(f) > 1 or (f[0].is_held and len(f[0].handles) <= config.most_handles)}

    def is_held(self, config: DivisionConfig) -> bool:
        """Whether a handle stands on a hidden front that is clear."""
        return any(front.is_held for fronts in self.clear(config).values() for front in fronts)

    @property
    def serves_several(self) -> bool:
        """Whether one object lies on several fronts of others."""
        return any(len(groups) > 1 for groups in self.on_fronts.values())

    def pieces(self, shells: MeshShells) -> dict[int, list[FacePiece]]:
        """Returns what each object is cut into."""
        counts = np.bincount(shells.owner[shells.shell])
        starts = np.cumsum([0, *counts])
        pieces = {
            owner: _pieces(shells, owner, int(starts[owner]), fronts, axes_from(self.turn)[2])
            for owner, fronts in self.hidden.items()
        }
        apart = {o: _handles_apart(shells, o, int(starts[o]), front) for o, front in self.with_handles.items()}
        lying = {o: _lying_apart(shells, o, int(starts[o]), groups) for o, groups in self.on_fronts.items()}
        return pieces | apart | lying


def _from_the_best_side(
    shells: MeshShells,
    may_be: tuple[MaskOfObjects, MaskOfObjects],
    whole: Sequence[bool],
    config: SegmentationConfig,
) -> FoundFronts:
    """Returns the fronts as they are seen from -Y; from elsewhere only where they are clearer than there.

    `may_be` states which objects may be cut, and which may be parted by the fronts that they lie on.

    A side or the back is a plate that is alone and has no handle, so such a front is not clear. Where all is one
    object, two fronts with handles are clearer than fronts without: a back in two panels has none.
    """
    several = np.bincount(shells.owner, minlength=len(whole)) > 1
    may, loose = ((several & objects)[shells.owner] for objects in may_be)
    if not may.any():
        return FoundFronts({}, {})
    sides: list[FoundFronts] = []
    ranks: list[tuple[bool, bool, float]] = []
    for turn in range(4):
        view = shells.seen(axes_from(turn))
        found = replace(fronts_by_object(view, may, whole, config, loose), turn=turn)
        clear = [front for fronts in found.clear(config.division).values() for front in fronts]
        is_held = len(whole) > 1 or sum(front.is_held for front in clear) > 1
        if turn == 0 and clear and is_held:
            return found
        area = sum(outline(view, front) for front in clear)
        sides.append(found)
        ranks.append((bool(clear) and is_held, bool(clear) and turn == 0, area))
    best = max(range(4), key=lambda turn: ranks[turn])
    if sides[0].with_handles or (sides[0].serves_several and not sides[best].is_held(config.division)):
        best = 0  # an object there is a front with handles, or lies on several as these; a back in two panels has none
    ahead, handled = sides[0], next((side.with_handles for side in sides if side.with_handles), {})
    if best > 0 and ranks[best][2] > 0:
        return replace(sides[best], hidden=sides[best].clear(config.division))
    return ahead if ahead.hidden else FoundFronts({}, handled, ahead.on_fronts)


def fronts_by_object(
    view: ShellsView,
    may: MaskOfShells,
    whole: Sequence[bool],
    config: SegmentationConfig,
    loose: MaskOfShells | None = None,
) -> FoundFronts:
    """Returns the fronts of each object that hides some, and of each that is one with handles.

    `loose` are the shells of objects that may be handles, and are parted by the fronts that they lie on, also where
    these are objects of their own; None: of those that may be cut.
    """
    view, members = _with_whole_fronts(view, config)
    first = [shells[0] for shells in members]
    may, loose = may[first], (may if loose is None else loose)[first]
    found: dict[int, list[FrontShells]] = {}
    fronts = with_low(view, may, fronts_among(view, candidates(view, may, config.candidates), config), config)
    fronts = tuple(front for front in fronts if not is_panel_of_controls(view, front, config.division))
    for front in without_case(view, fronts, config):
        found.setdefault(int(view.owner[front.shells[0]]), []).append(front)
    flush = {owner: tuple(f for f in fronts if is_flush(view, f, config.division)) for owner, fronts in found.items()}
    hidden = {o: fronts for o, fronts in flush.items() if fronts and hides(view, o, fronts, whole[o], config)}
    others = {o: fronts for o, fronts in flush.items() if o not in hidden}
    single = {o: f[0] for o, f in others.items() if is_one_with_handles(view, o, f, config.division)}
    left = ~np.isin(view.owner, [*hidden, *single])
    lying: dict[int, tuple[tuple[int, ...], ...]] = {}
    if hidden or (loose & left).any():
        alone = candidates(view, np.bincount(view.owner)[view.owner] == 1, config.candidates)
        alone = np.append(alone, np.array([f[0].shells[0] for f in others.values() if len(f) == 1], dtype=np.int64))
        lying = lying_on_fronts(view, ((may | loose) & left, loose & left), (hidden, alone), config)
    return FoundFronts(
        {o: tuple(front.made_of(members) for front in fronts) for o, fronts in hidden.items()},
        {o: front.made_of(members) for o, front in single.items()},
        {o: tuple(tuple(m for k in group for m in members[k]) for group in groups) for o, groups in lying.items()},
    )


def _with_whole_fronts(view: ShellsView, config: SegmentationConfig) -> tuple[ShellsView, list[tuple[int, ...]]]:
    """Returns the view with framed and mirrored fronts as one shell each, and what each shell is made of."""
    known: tuple[ShellsView, list[tuple[int, ...]]] | None = view.remembered.get((merged, config))
    if known is None:
        known = view.remembered[merged, config] = merged(view, [*framed(view, config), *halves(view, config)])
    return known


def _pieces(
    shells: MeshShells, owner: int, start: int, fronts: tuple[FrontShells, ...], towards: Vec3
) -> list[FacePiece]:
    """Returns what is left of an object, its fronts, which look `towards`, and their handles."""
    plates = [front.shells for front in fronts]
    handles = [handle for front in fronts for handle in front.handles]
    rest, found = split(shells, owner, start, [*plates, *handles])
    new = [FacePiece("front", faces, towards) for faces in found[: len(plates)]]
    new += [FacePiece("handle", faces) for faces in found[len(plates) :]]
    return [*([FacePiece("rest", rest)] if len(rest) else []), *new]


def _handles_apart(shells: MeshShells, owner: int, start: int, front: FrontShells) -> list[FacePiece]:
    """Returns a front without its handles, and these."""
    body, found = split(shells, owner, start, front.handles)
    return [FacePiece("body", body), *(FacePiece("handle", faces) for faces in found)]


def _lying_apart(shells: MeshShells, owner: int, start: int, groups: Sequence[tuple[int, ...]]) -> list[FacePiece]:
    """Returns what of an object lies on each front, and what lies on none."""
    rest, found = split(shells, owner, start, groups)
    lying = [FacePiece("on front", faces) for faces in found]
    return [*([FacePiece("rest", rest)] if len(rest) else []), *lying]


def split(shells: MeshShells, owner: int, start: int, groups: Sequence[tuple[int, ...]]) -> tuple[Faces, list[Faces]]:
    """Returns the faces of an object that are in none of some groups of shells, and those of each group."""
    faces = np.flatnonzero(shells.owner[shells.shell] == owner)
    of = shells.shell[faces]
    taken = [shell for group in groups for shell in group]
    return faces[~np.isin(of, taken)] - start, [faces[np.isin(of, group)] - start for group in groups]
