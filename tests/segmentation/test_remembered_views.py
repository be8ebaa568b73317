"""What a view of shells shows is worked out once, and is what a new view shows: of other objects, sizes, thresholds."""

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np
import pytest

from grafu.geometry.box import Box
from grafu.geometry.mesh import TriangleMesh, merge_meshes
from grafu.geometry.remembered import RememberedByContent
from grafu.segmentation import candidates, view
from grafu.segmentation.config import SegmentationConfig
from grafu.segmentation.division import FoundFronts, divided, fronts_by_object
from grafu.segmentation.mesh_shells import MeshShells, axes_from
from small_assets import CABINET, mesh_of

USUAL = SegmentationConfig()
NARROW = replace(USUAL, candidates=replace(USUAL.candidates, room=0.9))
LOW = replace(USUAL, division=replace(USUAL.division, lowest=0.2))


def scene() -> list[TriangleMesh]:
    """A cabinet with its boards welded, and beside it another as objects."""
    beside = np.eye(4)
    beside[0, 3] = 2.0
    boards = [mesh_of(name) for name in CABINET]
    return [merge_meshes(boards), *(mesh.transformed(beside) for mesh in boards)]


def asked(meshes: Sequence[TriangleMesh]) -> Iterator[tuple[np.ndarray, SegmentationConfig, int]]:
    """Yields which objects may be cut, the thresholds, and the side, in an order in which each repeats."""
    some = np.arange(len(meshes)) % 2 == 0
    for config in (USUAL, NARROW, LOW, USUAL):
        for may in (np.ones(len(meshes), bool), some, ~some):
            yield from ((may, config, turn) for turn in range(4))


def found_in(shells: MeshShells, may: np.ndarray, config: SegmentationConfig, turn: int) -> FoundFronts:
    """Returns the fronts that one side shows."""
    return fronts_by_object(shells.seen(axes_from(turn)), may[shells.owner], [False] * len(may), config)


def test_fronts_are_those_of_a_new_view_whatever_was_asked_before() -> None:
    meshes = scene()
    shells = MeshShells.of(meshes)

    found = [found_in(shells, *question) for question in asked(meshes)]

    assert found == [found_in(MeshShells.of(meshes), *question) for question in asked(meshes)]
    assert any(one.hidden for one in found)
    assert len({str(one) for one in found}) > 2


def test_a_shell_is_judged_once_for_all_objects_and_sizes(monkeypatch: pytest.MonkeyPatch) -> None:
    meshes, judged = scene(), list[tuple[int, bool]]()
    judge = candidates._stands_as_front

    def counted(seen: view.ShellsView, k: int, *others: object) -> bool:
        judged.append((id(seen), k))
        return judge(seen, k, *others)  # type: ignore[arg-type]

    monkeypatch.setattr(candidates, "_stands_as_front", counted)
    shells = MeshShells.of(meshes)
    for _ in range(2):
        found_in(shells, np.ones(len(meshes), bool), USUAL, 0)

    assert judged
    assert len(set(judged)) == len(judged)


def test_materials_that_part_no_shell_leave_the_shells_as_they_are() -> None:
    meshes = scene()
    shells = MeshShells.of(meshes)
    by_shell = [shells.shell[shells.owner[shells.shell] == k] for k in range(len(meshes))]
    halved = [np.arange(len(mesh.faces)) % 2 for mesh in meshes]

    assert shells.parted(by_shell) is shells
    assert shells.parted([np.zeros(len(mesh.faces), np.int64) for mesh in meshes]) is shells
    assert len(shells.parted(halved).owner) == 2 * len(shells.owner)


def test_rays_are_traced_once_for_equal_meshes_and_again_for_others(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(view, "_by_content", RememberedByContent(view._ROOM))
    meshes = scene()
    moved = [TriangleMesh.box_mesh(Box(mesh.box.low, mesh.box.high)) for mesh in meshes]

    first, again, other = MeshShells.of(meshes), MeshShells.of(scene()), MeshShells.of(moved)

    assert first.rays is again.rays
    assert first.rays is not other.rays
    assert not np.array_equal(first.seen(axes_from(1)).depth, other.seen(axes_from(1)).depth)


def test_cuts_are_the_same_when_they_are_asked_for_again() -> None:
    meshes = scene()
    shells = MeshShells.of(meshes)
    open_to = [True] * len(meshes)

    first, again = (divided(meshes, open_to, [False] * len(meshes), shells=shells) for _ in range(2))

    assert [[(p.role, p.faces.tolist()) for p in found] for found in first.values()] == [
        [(p.role, p.faces.tolist()) for p in found] for found in again.values()
    ]
    assert first
