"""What judges find of additions, before and after, on pieces whose figures follow from their construction."""

from dataclasses import replace

import pytest
from measured_cabinets import DOOR, DRAWER, cabinet, made

from grafu.evaluation.completeness import completeness_of, random_choices
from grafu.evaluation.methods import Method, made_by
from grafu.evaluation.moving_parts import counted_parts
from grafu.vocabulary import PartLabel


def statics(asset, joints_alone: bool = False):
    result = made(asset) if joints_alone else made_by(Method("annotation"), asset, asset.name)
    return completeness_of(asset, counted_parts(asset), result)


def without(asset, *labels: PartLabel):
    return replace(asset, parts=tuple(part for part in asset.parts if part.label not in labels))


def test_a_whole_cabinet_lacks_a_handle_of_its_drawer_alone() -> None:
    found = statics(cabinet())
    assert found.top.covered[0] > 0.9
    assert found.top.added == 0
    assert {one.part: (one.before, one.after) for one in found.handles} == {DOOR: (True, True), DRAWER: (False, True)}
    assert (found.added_handles, found.blocked) == (2, 0)  # a drawer of 0.96 m gets two
    assert found.panels.compartments == found.panels.filled == 1
    assert found.panels.placed >= 1
    assert found.panels.faulty == 0


def test_a_top_that_is_lacking_is_seen_before_and_after() -> None:
    found = statics(without(cabinet(), PartLabel.TOP_PANEL))
    assert found.top.covered[0] < 0.6 <= found.top.covered[1]
    assert found.top.opened[0] > 0.5 > found.top.opened[1]
    assert found.top.added == 1


def test_what_is_not_added_is_not_counted() -> None:
    found = statics(without(cabinet(), PartLabel.HANDLE), joints_alone=True)
    assert {one.part: (one.before, one.after) for one in found.handles} == {DOOR: (False,) * 2, DRAWER: (False,) * 2}
    assert found.added_handles == 0


@pytest.mark.parametrize("name", ["a", "b", "c", "d"])
def test_random_panels_are_one_to_three_of_one_kind_and_the_same_for_a_name(name: str) -> None:
    choices = random_choices(name, 40)
    assert choices == random_choices(name, 40)
    counts = [(choice.shelves, choice.dividers) for choice in choices.values()]
    assert all(min(one) == 0 and 1 <= max(one) <= 3 for one in counts)
    assert {max(one) for one in counts} == {1, 2, 3}
    assert {one.index(0) for one in counts} == {0, 1}
    assert random_choices(name + "x", 40) != choices
