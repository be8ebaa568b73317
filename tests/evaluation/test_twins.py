"""Models of one geometry are found whatever their parts, turn, size and noise; others are not."""

from dataclasses import replace

import numpy as np
import pytest
from measured_cabinets import DOOR, DRAWER, cabinet

from grafu.asset.edit import mirrored, scaled, yawed
from grafu.asset.part import Asset
from grafu.evaluation.moving_parts import counted_parts
from grafu.evaluation.twins import alike_pairs, compare_twins, fingerprint
from grafu.geometry.mesh import TriangleMesh
from grafu.metrics.motion import compare_motions


def shuffled(asset: Asset) -> Asset:
    return replace(asset, name="shuffled", parts=tuple(reversed(asset.parts)))


def noisy(asset: Asset, size: float) -> Asset:
    rng = np.random.default_rng(3)

    def shaken(mesh: TriangleMesh) -> TriangleMesh:
        return TriangleMesh(mesh.vertices + rng.normal(0.0, size, mesh.vertices.shape), mesh.faces)

    parts = tuple(replace(p, surfaces=tuple(replace(s, mesh=shaken(s.mesh)) for s in p.surfaces)) for p in asset.parts)
    return replace(asset, parts=parts)


def alike(a: Asset, b: Asset) -> bool:
    return bool(alike_pairs({"a": fingerprint(a), "b": fingerprint(b)}))


@pytest.mark.parametrize(
    "change",
    [shuffled, lambda a: yawed(a, np.pi / 2), lambda a: scaled(a, 7.0), lambda a: noisy(a, 2e-4)],
    ids=["another order", "a quarter turn", "another size", "noise"],
)
def test_one_geometry_is_found(change) -> None:
    first, second = cabinet("left"), change(cabinet("right", handle_at=0.42))
    assert alike(first, second)
    found = compare_twins(first, second)
    assert found.same
    assert set(found.for_first) == {DOOR, DRAWER}
    # the other annotation's door turns at the other border, its drawer as ours
    truth = {part.id: part.motion for part in counted_parts(first)}
    agreed = {a.part: a.whole for a in compare_motions(found.for_first, truth)}
    assert agreed == {DOOR: False, DRAWER: True}
    own = {part.id: part.motion for part in counted_parts(cabinet("right"))}
    assert all(a.whole for a in compare_motions(found.for_first, own))


def test_motions_come_back_in_the_other_models_own_frame() -> None:
    first, second = cabinet("left"), yawed(scaled(cabinet("left"), 2.0), np.pi / 2)
    found = compare_twins(first, second)
    truth = {part.id: part.motion for part in counted_parts(second)}
    assert all(a.whole for a in compare_motions(found.for_second, truth))
    door = found.for_second[DOOR]
    assert door.axis.distance_to(truth[DOOR].axis.point) < 1e-6


def test_other_furniture_is_not_a_twin() -> None:
    first = cabinet()
    longer = replace(first, parts=tuple(p for p in first.parts if p.id != "shelf"))
    assert not alike(first, longer)
    assert not compare_twins(first, longer).same


def test_a_moved_shelf_is_another_geometry() -> None:
    first = cabinet()
    shift = np.array([0.0, 0.0, -0.2])
    parts = tuple(
        replace(p, surfaces=tuple(replace(s, mesh=s.mesh.translated(shift)) for s in p.surfaces))
        if p.id == "shelf"
        else p
        for p in first.parts
    )
    assert not compare_twins(first, replace(first, parts=parts)).same


def test_a_mirror_image_is_not_a_twin() -> None:
    assert not compare_twins(cabinet(), mirrored(cabinet())).same
