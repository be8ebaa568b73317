"""Cores: those of the machine, shared among processes beside each other; threads make what one makes."""

import os
import sys
from threading import get_ident
from time import sleep

import pytest

from grafu.errors import TooComplex
from grafu.geometry.budget import Budget, require_time
from grafu.processes import cores
from grafu.processes.cores import made_of_each, own_cores, share_cores
from grafu.processes.worker import run_each

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the tests ask which cores they may use")


@pytest.fixture(autouse=True)
def shared_as_before(monkeypatch):
    monkeypatch.setattr(cores, "_sharing", 1)
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(4)))


def cores_of_a_worker(_: object) -> int:
    return own_cores()


@pytest.mark.parametrize(("processes", "found"), [(0, 4), (1, 4), (2, 2), (3, 1), (9, 1)])
def test_processes_beside_each_other_share_the_cores(processes, found):
    share_cores(processes)
    assert own_cores() == found


@pytest.mark.parametrize(("items", "workers", "found"), [(1, 4, 4), (2, 2, 2), (4, 4, 1), (2, 4, 2)])
def test_a_worker_has_the_cores_that_the_others_leave(items, workers, found):
    ended = run_each(range(items), workers, cores_of_a_worker, start="fork")
    assert [outcome.results for _, outcome in ended] == [(found,)] * items


@pytest.mark.parametrize("threads", [1, 2, 5])
def test_what_is_made_of_each_keeps_its_order(threads):
    def late_first(number: int) -> tuple[int, int]:
        sleep(0.02 * (4 - number))
        return number**2, get_ident()

    made = made_of_each(range(4), late_first, threads)
    assert [square for square, _ in made] == [0, 1, 4, 9]
    assert len({thread for _, thread in made}) == (1 if threads == 1 else min(threads, 4))
    assert made_of_each([], late_first, threads) == []


def test_the_budget_in_force_holds_in_threads_and_their_errors_are_raised():
    with Budget(deadline=-1.0).in_force(), pytest.raises(TooComplex):
        made_of_each([1, 2], lambda _: require_time(), 2)
    with pytest.raises(ZeroDivisionError):
        made_of_each([1, 0], lambda number: 1 / number, 2)
