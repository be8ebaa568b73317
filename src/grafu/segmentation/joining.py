"""Which objects without a name are one door, drawer or handle: plate, panes, mouldings and boards, bar and posts.

It asks geometry alone. A case stands behind its doors as a box behind a drawer's front; but its boards touch what lies
above them, or hardly each other, and so are not joined. What hangs on a front and touches nothing else belongs to it.
"""

from collections.abc import Sequence
from typing import Final, final

import numpy as np

from grafu.dataclass import dataclass
from grafu.geometry.arrays import Indices
from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.shells import shell_numbers
from grafu.geometry.touching import TouchingMeshes
from grafu.segmentation.candidates import candidates, framed, merged
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.fronts import fronts_among
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from grafu.segmentation.surface_config import JoiningConfig
from grafu.shapes import Bool, Int

MaskOfObjects = Bool[np.ndarray, " objects"]
ObjectOfFaces = Int[np.ndarray, " _"]
Group = tuple[int, ...]


def joined_objects(
    meshes: Sequence[TriangleMesh],
    open_to: Sequence[bool],
    config: SegmentationConfig = SegmentationConfig(),
    has_name: bool = False,
    handles: Sequence[bool] | None = None,
) -> list[Group]:
    """Returns the objects that are one front with what belongs to it, or one handle; two at least each.

    The plate comes first. Only objects that belong to it whole are joined, and never all that `open_to` names, nor all
    but its handles.
    Where their names tell that they are doors or drawers, all may be one, and the pieces of handles stay apart.

    Args:
        meshes: the objects of an input, Z up, their front at -Y; any unit.
        open_to: which of them may be joined.
        config: the thresholds.
        has_name: whether the names of the objects that may be joined tell that they are doors or drawers.
        handles: which of the other objects are known as handles; None: none of them.
    """
    may = np.asarray(open_to, dtype=bool)
    owner = np.repeat(np.arange(len(meshes)), [len(mesh.faces) for mesh in meshes])
    shells = MeshShells.of(meshes)
    apart = shells.shell
    contacts: Final = _Contacts(meshes, config.joining)
    across = _across(shells.mesh, owner, apart, may)
    numberings = [across] if across.max(initial=0) < apart.max(initial=0) else []
    numberings += [apart, owner] if len(meshes) <= apart.max(initial=0) else [apart]
    known = np.zeros(len(may), dtype=bool) if handles is None else np.asarray(handles, dtype=bool)
    fronts = [front for shell in numberings for front in _front_objects(shells, shell, owner, (may, known), config)]
    single = [front for front in fronts if contacts.count_apart(front.handles_within(fronts)) < 2]
    taken: set[int] = set()
    found: list[Group] = []
    for front in single:
        grips = () if has_name else front.handles
        if not has_name and len({*contacts.hanging_together(front, may), *_all(front.handles)}) >= int(may.sum()):
            continue  # nothing would be left that carries it
        for group in (contacts.hanging_together(front, may), *(contacts.handle_of(h, front) for h in grips)):
            if len(group) > 1 and not taken & {*group}:
                found.append(group)
                taken |= {*group}
    return found


def _all(groups: Sequence[Group]) -> set[int]:
    return {one for group in groups for one in group}


@final
@dataclass(frozen=True, slots=True)
class _Front:
    """The objects of a front: those of its plate, which may be several that share corners, and what belongs to it."""

    plates: Group
    members: Group
    handles: tuple[Group, ...]
    carriers: Group
    """The objects of its plate, also where they are more than the front: then there are no plates."""
    others: tuple[Group, ...]
    """The objects of the handles on it that are known as such, and so may not be joined."""

    @property
    def objects(self) -> frozenset[int]:
        """All but the handles."""
        return frozenset((*self.plates, *self.members))

    def handles_within(self, fronts: "Sequence[_Front]") -> list[Group]:
        """Returns the objects of the handles of each smaller front in it; a face frame holds several such.

        So does the apron of a table with its top and its drawers.
        """
        inner = (front for front in fronts if front.plates and front.objects < self.objects)
        held = (tuple(k for handle in (*front.handles, *front.others) for k in handle) for front in inner)
        return [objects for objects in held if objects]


class _Contacts:
    """Which objects touch which; looked up for the members of groups alone."""

    def __init__(self, meshes: Sequence[TriangleMesh], config: JoiningConfig) -> None:
        size = float(Box.enclosing([mesh.box for mesh in meshes]).size.max())
        self._meshes, self._reach, self._config = meshes, config.touch * size, config
        self._low = np.array([mesh.box.low for mesh in meshes])
        self._high = np.array([mesh.box.high for mesh in meshes])
        self._touching = TouchingMeshes(meshes, self._reach)
        self._touched: dict[int, set[int]] = {}

    def hanging_together(self, front: _Front, may: MaskOfObjects) -> Group:
        """Returns the objects of a front, those left out that hang together with others; with what hangs on it alone.

        Its plates stay. Of the others that touch something else, boards behind them stay if they touch enough of the
        group and nothing from above, and are no edging of what it closes; what lies beside or on them stays if it
        touches enough. How many that is, `JoiningConfig` states.
        """
        if not front.plates:
            return ()
        ahead = Box.enclosing([self._meshes[k].box for k in front.plates])
        kept = self._without_static(front.plates, front.members, ahead, front.objects)
        return self._with_hanging(kept, ahead, may)

    def count_apart(self, groups: Sequence[Group]) -> int:
        """Returns how many groups there are where those that touch are one: the bar and the posts of one handle."""
        parted: list[set[int]] = []
        for group in groups:
            reached = {*group}.union(*(self._of(k) for k in group))
            near = [other for other in parted if other & reached]
            parted = [other for other in parted if other not in near] + [{*group}.union(*near)]
        return len(parted)

    def handle_of(self, handle: Group, front: _Front) -> Group:
        """Returns the objects of a handle, those left out that hang together with something else than it."""
        if not handle:
            return ()
        inside = front.objects | {*handle, *front.carriers}
        return self._without_static(handle[:1], handle[1:], self._meshes[handle[0]].box, inside)

    def _without_static(self, fixed: Group, others: Group, ahead: Box, inside: frozenset[int]) -> Group:
        kept, within = list(others), set(inside)
        while lost := {k for k in kept if self._is_static(k, ahead, within)}:
            kept, within = [k for k in kept if k not in lost], within - lost
        return (*fixed, *kept)

    def _is_static(self, k: int, ahead: Box, inside: set[int]) -> bool:
        touched = self._of(k)
        others = touched - inside
        if not others:
            return False
        box, reach = self._meshes[k].box, self._reach
        if float(box.low[1]) < float(ahead.high[1]) - reach:
            return len(touched & inside) < self._config.beside
        is_covered = any(float(self._meshes[other].box.low[2]) >= float(box.high[2]) - reach for other in others)
        is_edging = float(box.high[1] - ahead.high[1]) <= self._config.edging * float(ahead.size.max())
        return is_covered or is_edging or len(touched & inside) < self._config.boards

    def _with_hanging(self, front: Group, ahead: Box, may: MaskOfObjects) -> Group:
        """Returns a front with what hangs on nothing but it: a box of any form, in an outline and a rest around it."""
        found = [*front]
        for start in sorted(set().union(*(self._of(k) for k in front)) - {*front}):
            if start not in found and may[start]:
                found += self._hanging(start, {*found}, ahead, may)
        return tuple(found)

    def _hanging(self, start: int, known: set[int], ahead: Box, may: MaskOfObjects) -> list[int]:
        """Returns an object and all that hangs together with it behind a front; none where something else holds it."""
        found, reached = [start], [start]
        while reached:
            k = reached.pop()
            if not may[k] or not _is_behind(self._meshes[k].box, ahead, self._reach):
                return []
            new = sorted(self._of(k) - known - {*found})
            found += new
            reached += new
        inner = Box.enclosing([self._meshes[k].box for k in found])
        rest = [mesh.box for k, mesh in enumerate(self._meshes) if k not in known and k not in found]
        return found if rest and _surrounds(Box.enclosing(rest), inner, self._reach) else []

    def _of(self, k: int) -> set[int]:
        if k not in self._touched:
            gaps = np.maximum(self._low - self._high[k], self._low[k] - self._high).max(axis=1)
            near = {other for other in np.flatnonzero(gaps <= self._reach).tolist() if other != k}
            known = {other for other in near if other in self._touched}
            found = self._touching.among([(k, other) for other in sorted(near - known)])
            self._touched[k] = {other for _, other in found} | {o for o in known if k in self._touched[o]}
        return self._touched[k]


def _is_behind(box: Box, front: Box, reach: float) -> bool:
    """Whether a box lies in the outline of a front, and not before it."""
    inside = (box.low[[0, 2]] >= front.low[[0, 2]] - reach) & (box.high[[0, 2]] <= front.high[[0, 2]] + reach)
    return bool(inside.all() and box.low[1] >= front.low[1] - reach)


def _surrounds(rest: Box, box: Box, reach: float) -> bool:
    """Whether a box lies between the sides of what is left of the furniture, and ends before its back."""
    between = (rest.low[[0, 2]] <= box.low[[0, 2]] + reach) & (rest.high[[0, 2]] >= box.high[[0, 2]] - reach)
    return bool(between.all() and rest.high[1] >= box.high[1] - reach)


def _across(whole: TriangleMesh, owner: ObjectOfFaces, apart: Indices, may: MaskOfObjects) -> Indices:
    """Returns the shell of each face, where those of several objects that meet at corners are one shell.

    Those that only meet at corners of an object that may not be joined are not: doors before the openings of a case.
    """
    numbers: Indices = len(owner) + apart
    numbers[may[owner]] = shell_numbers(whole.with_faces(may[owner]))
    return np.unique(numbers, return_inverse=True)[1].reshape(-1).astype(np.int64)


def _front_objects(
    shells: MeshShells,
    shell: Indices,
    owner: ObjectOfFaces,
    masks: tuple[MaskOfObjects, MaskOfObjects],
    config: SegmentationConfig,
) -> list[_Front]:
    """Returns the objects of each front and of its handles; `masks` are what may be joined, and the known handles."""
    may, known = masks
    of = np.where(may, 0, np.arange(len(may)) + 1)
    first = np.unique(shell, return_index=True)[1]
    seen = shells.sorted(shell, of[owner[first]].astype(np.int64)).seen(axes_from(0))
    view, members = merged(seen, framed(seen, config))
    plates = candidates(view, view.owner == 0, config.candidates, (config.joining.least, config.candidates.most_narrow))
    found = [front.made_of(members) for front in fronts_among(view, plates, config)]
    objects: Final = _ObjectsOfShells(shell, owner)
    return [
        _Front(
            *objects.whole_in(front.shells),
            tuple(sum(objects.whole_in(handle), ()) for handle in front.handles),
            objects.of_shell(front.shells[0]),
            tuple(group for handle in front.others if known[[*(group := objects.of_shells(handle))]].all()),
        )
        for front in found
    ]


class _ObjectsOfShells:
    """How many faces of each object each shell has."""

    def __init__(self, shell: Indices, owner: ObjectOfFaces) -> None:
        self._all = np.bincount(owner)
        pairs, self._faces = np.unique(shell * len(self._all) + owner, return_counts=True)
        shells, self._object = np.divmod(pairs, len(self._all))
        self._starts = np.searchsorted(shells, np.arange(int(shell.max(initial=-1)) + 2))

    def whole_in(self, group: Group) -> tuple[Group, Group]:
        """Returns the objects of the first shell of a group, and the others that lie whole in it.

        There are none where an object of the first shell does not.
        """
        rows = np.concatenate([np.arange(self._starts[k], self._starts[k + 1]) for k in group])
        objects, place = np.unique(self._object[rows], return_inverse=True)
        inside = np.bincount(place.reshape(-1), weights=self._faces[rows])
        whole = {*objects[inside == self._all[objects]].tolist()}
        plates = self.of_shell(group[0])
        if not whole >= {*plates}:
            return (), ()
        return plates, tuple(sorted(whole - {*plates}))

    def of_shells(self, group: Group) -> Group:
        """Returns the objects that have faces in some shells."""
        return tuple(sorted({k for shell in group for k in self.of_shell(shell)}))

    def of_shell(self, shell: int) -> Group:
        """Returns the objects that have faces in a shell."""
        return tuple(self._object[self._starts[shell] : self._starts[shell + 1]].tolist())
