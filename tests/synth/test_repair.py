"""What a repaired version holds beyond what was drawn."""

import numpy as np
import pytest

from grafu.synth.cabinets.cabinet import Cabinet
from grafu.synth.cabinets.chest import Chest
from grafu.synth.case.case import Case
from grafu.synth.case.construction import Top
from grafu.synth.families.table import Blueprint, make_furniture
from grafu.synth.fronts.hold import Hold
from grafu.synth.fronts.layout import CellRow, Door, Drawer, Stack
from grafu.synth.repair import repaired, with_bare_fronts_held
from grafu.synth.truth.check import faults_of
from grafu.vocabulary import PartLabel

BARE = CellRow((Door(handle="none", behind=Stack((Drawer(handle="none"),) * 2)), Drawer(handle="none"), Drawer()))


def repair(spec: Cabinet | Chest, seed: int = 0) -> tuple[list[str], object]:
    blueprint = Blueprint("made", spec)
    whole, added = repaired(blueprint, make_furniture(blueprint), np.random.default_rng(seed))
    assert not faults_of(whole)
    return sorted(added), whole


def test_what_lacks_nothing_is_left_alone() -> None:
    added, whole = repair(Cabinet())

    assert added == []
    assert whole == make_furniture(Blueprint("made", Cabinet()))


@pytest.mark.parametrize("seed", range(4))
def test_bare_fronts_get_handles_that_fit(seed: int) -> None:
    added, whole = repair(Cabinet(case=Case(1.2), layout=BARE), seed)

    held = [p.carried_by for p in whole.parts if p.label is PartLabel.HANDLE]  # type: ignore[attr-defined]
    assert len(added) == 4
    assert sorted(map(str, held)) == ["door", "drawer_1", "drawer_2", "drawer_3", "drawer_4"]


def test_a_grip_is_handle_enough() -> None:
    added, _ = repair(Cabinet(layout=Door(handle="none", grip="scoop")))

    assert added == []


@pytest.mark.parametrize("kind", ["none", "stretchers"])
def test_a_case_without_a_top_gets_one_that_covers_it(kind: str) -> None:
    added, whole = repair(Cabinet(case=Case(top=Top(kind))))  # type: ignore[arg-type]

    assert added == ["worktop_1"]
    top = whole.part("worktop_1").box  # type: ignore[attr-defined]
    assert top.high[2] == whole.box.high[2]  # type: ignore[attr-defined]
    assert top.size[0] >= 0.8


def test_a_lid_is_top_enough() -> None:
    assert repair(Chest())[0] == []


def test_only_bare_fronts_are_changed() -> None:
    spec = with_bare_fronts_held(CellRow((Door(), Door(handle="none"), Door(handle="none", grip="lip"))), "knob-flat")

    assert [cell.handle for cell in spec.cells] == [Door().handle, "knob-flat", "none"]


def test_bare_fronts_carry_their_handles_where_they_are_told_to() -> None:
    hold = Hold(place="top edge")
    spec = with_bare_fronts_held(CellRow((Door(), Door(handle="none"))), "knob-flat", hold)

    assert [cell.hold for cell in spec.cells] == [Door().hold, hold]


def test_where_no_front_has_a_handle_they_come_where_most_are() -> None:
    odd = Hold(place="bottom edge", along=0.2)
    bare = CellRow((Door(handle="none", hold=odd), Door(handle="none", hold=odd)))
    _, whole = repair(Cabinet(layout=bare))
    _, usual = repair(Cabinet(layout=CellRow((Door(handle="none"), Door(handle="none")))))

    def places(asset: object) -> list[list[float]]:
        return [p.box.center.round(6).tolist() for p in asset.parts if p.label is PartLabel.HANDLE]  # type: ignore[attr-defined]

    assert len(places(whole)) == 2
    assert np.allclose(places(whole), places(usual), atol=0.03)
