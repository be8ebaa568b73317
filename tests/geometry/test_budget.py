"""The budget: a deadline by a clock that tests turn themselves, fractions of what is left, and room asked for first."""

from math import inf

import pytest

from clocks import Clock
from grafu.errors import TooComplex
from grafu.geometry.budget import (
    UNLIMITED,
    Budget,
    WhileTimeLasts,
    fits,
    has_time,
    present_budget,
    require_room,
    require_time,
    within,
)


def test_without_a_budget_time_never_ends() -> None:
    assert present_budget() is UNLIMITED
    assert UNLIMITED.left == inf
    assert UNLIMITED.fraction(0.5) is UNLIMITED
    require_time()


def test_time_ends_at_the_deadline() -> None:
    clock = Clock()
    with Budget.lasting(10.0, clock=clock).in_force():
        clock.now = 9.9
        require_time()
        clock.now = 10.0
        with pytest.raises(TooComplex, match="more time than its part of the budget"):
            require_time()
    require_time()  # the budget was in force in the block alone


def test_a_fraction_is_of_what_is_left() -> None:
    clock = Clock()
    budget = Budget.lasting(10.0, clock=clock)
    clock.now = 4.0
    assert budget.fraction(0.5).deadline == pytest.approx(7.0)
    clock.now = 20.0
    assert budget.left == 0.0
    assert budget.fraction(0.5).left == 0.0


def test_a_busy_machine_changes_no_result_until_the_clock_on_the_wall_ends_the_work(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    processor, wall = Clock(), Clock()
    monkeypatch.setattr("grafu.geometry.budget.process_time", processor)
    monkeypatch.setattr("grafu.geometry.budget.monotonic", wall)
    budget = Budget.lasting(100.0)
    ratio = budget.fraction(0.1)
    wall.now = 39.0  # others had the processor
    assert ratio.left == pytest.approx(1.0)
    assert budget.left == pytest.approx(61.0)
    processor.now, wall.now = 10.0, 40.0
    assert ratio.left == 0.0
    assert budget.fraction(1.0).left == pytest.approx(0.9 * 60.0)  # something is left for what comes after
    wall.now = 100.0
    assert budget.left == 0.0


def test_the_processors_time_is_asked_for_once_in_a_few_milliseconds(monkeypatch: pytest.MonkeyPatch) -> None:
    processor, wall = Clock(), Clock(step=0.0001)
    monkeypatch.setattr("grafu.geometry.budget.process_time", processor)
    monkeypatch.setattr("grafu.geometry.budget.monotonic", wall)
    with Budget.lasting(1.0).in_force():
        for _ in range(1000):
            require_time()
        assert processor.asked < 100
        processor.now = 2.0
        wall.now += 0.01
        with pytest.raises(TooComplex):
            require_time()


def test_what_exceeds_its_fraction_is_replaced_and_the_rest_has_its_time() -> None:
    clock = Clock()

    def slow() -> str:
        clock.now = 6.0
        require_time()
        return "made"

    with Budget.lasting(10.0, clock=clock).in_force():
        assert within(0.5, slow, lambda why: f"instead: {why}").startswith("instead: it takes more time")
        assert within(1.0, slow, lambda why: f"instead: {why}") == "made"


def test_room_is_asked_for_before_anything_is_made() -> None:
    with Budget(room=1000).in_force():
        require_room(10, 100, "a list")
        assert fits(10, 100)
        assert not fits(11, 100)
        with pytest.raises(TooComplex, match="a list would take"):
            require_room(11, 100, "a list")


def test_work_that_finds_no_memory_is_replaced() -> None:
    def greedy() -> str:
        raise MemoryError

    assert within(1.0, greedy, lambda why: why) == "it takes more memory than there is"


@pytest.mark.parametrize("seconds", [0.0, -1.0, float("nan")])
def test_a_budget_lasts(seconds: float) -> None:
    with pytest.raises(ValueError, match="more than 0 seconds"):
        Budget.lasting(seconds)


def test_a_budget_has_room() -> None:
    with pytest.raises(ValueError, match="above 0 bytes"):
        Budget(room=0)


def test_nothing_is_begun_when_time_is_up() -> None:
    clock = Clock()
    begun: list[str] = []
    with Budget.lasting(10.0, clock=clock).in_force():
        clock.now = 11.0
        assert within(1.0, lambda: begun.append("work"), lambda why: why) == (
            "it takes more time than its part of the budget: simplify the meshes, or allow more time"
        )
    assert begun == []


def test_while_time_lasts_one_thing_after_another_is_done_well_and_the_rest_in_haste() -> None:
    clock = Clock()

    def slowly(name: str) -> str:
        clock.now += 2.0
        require_time()
        return f"{name} done well"

    with Budget.lasting(10.0, clock=clock).in_force():
        done = WhileTimeLasts(0.5, slowly, lambda name: f"{name} done")
        assert [done(name) for name in ("a", "b", "c", "d")] == ["a done well", "b done well", "c done", "d done"]
        assert done.spared == 2
        assert has_time()
        clock.now = 10.0
        assert not has_time()


def test_without_a_deadline_all_is_done_well() -> None:
    done = WhileTimeLasts(0.1, str.upper, str.lower)
    assert done("a") == "A"
    assert done.spared == 0
    assert has_time()
