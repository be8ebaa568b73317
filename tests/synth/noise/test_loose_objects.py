"""What stands and is screwed on besides: of each kind something is found, and nothing blocks a path."""

import numpy as np
import pytest

from grafu.asset.part import Asset
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.cabinets.chest import Chest, make_chest
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Base
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Stack
from grafu.synth.noise.loose_objects import LOOSE_OBJECTS, with_loose_objects
from grafu.synth.truth.check import faults_of
from grafu.synth.truth.clashes import articulated_of
from grafu.vocabulary import PartLabel

TIDY = make_cabinet(
    Cabinet(case=Case(0.9, 0.9, base=Base("plinth")), layout=CellRow((Door(shelves=2), Stack((Drawer(), Drawer())))))
)


def added(asset: Asset, tidy: Asset = TIDY) -> list[str]:
    return [p.id for p in asset.parts if p.id not in {q.id for q in tidy.parts}]


@pytest.mark.parametrize("kind", sorted(LOOSE_OBJECTS))
def test_every_kind_adds_parts_that_obstruct_nothing(kind: str) -> None:
    found = []
    for seed in range(5):
        asset = with_loose_objects(TIDY, kind, np.random.default_rng(seed))
        assert asset.joints == TIDY.joints
        assert asset.parts[: len(TIDY.parts)] == TIDY.parts
        assert not faults_of(asset, articulated_of(asset)), (kind, seed)
        found += added(asset)
    assert found


@pytest.mark.parametrize("kind", ["things on top", "things on shelves"])
def test_things_stand_on_something(kind: str) -> None:
    asset = with_loose_objects(TIDY, kind, np.random.default_rng(1))

    for name in added(asset):
        foot = asset.part(name).box.low[2]
        assert any(foot == pytest.approx(p.box.high[2]) for p in TIDY.parts)


def test_nothing_stands_on_a_lid() -> None:
    chest = make_chest(Chest())

    assert not added(with_loose_objects(chest, "things on top", np.random.default_rng(0)), chest)


def test_runners_lie_beside_their_drawers_within_the_gap() -> None:
    for seed in range(6):
        asset = with_loose_objects(TIDY, "runners", np.random.default_rng(seed))
        runners = [asset.part(name) for name in added(asset)]
        assert len(runners) >= 4
        assert {p.label for p in runners} == {PartLabel.MISC}
        assert all(p.box.size[0] < 0.0125 for p in runners)  # the gap that slides need
        assert {p.carried_by for p in runners} <= {None, "drawer_1", "drawer_2"}


def test_an_unknown_kind_is_a_mistake() -> None:
    with pytest.raises(KeyError):
        with_loose_objects(TIDY, "fairy lights", np.random.default_rng(0))
