"""A worker that is used again: one process for many items, another one after a death, none after an interruption."""

import os
from time import sleep

import pytest

from descendants import SOON, survivors
from grafu.processes.limits import Ending, ProcessLimits, descendants
from grafu.processes.worker import ReusedWorker


def work(item: str) -> int:
    if item == "die":
        os._exit(3)
    if item == "wait":
        sleep(SOON)
    return os.getpid()


@pytest.mark.skipif(os.name != "posix", reason="the test asks for processes")
def test_one_process_serves_until_it_ends() -> None:
    worker = ReusedWorker(work, ProcessLimits())
    first, second = worker.outcome_of("a").results, worker.outcome_of("b").results
    died = worker.outcome_of("die")
    third = worker.outcome_of("c").results
    worker.stop()

    assert first == second
    assert died.ending is Ending.DIED
    assert third != first
    assert survivors(third, SOON) == []


def test_what_takes_too_long_is_stopped_and_the_next_goes_on() -> None:
    worker = ReusedWorker(work, ProcessLimits(seconds=0.5))
    assert worker.outcome_of("wait").ending is Ending.LATE
    assert worker.outcome_of("a").ending is Ending.DONE
    worker.stop()


def test_an_interruption_ends_the_process(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    worker = ReusedWorker(work, ProcessLimits())
    before = {*descendants(os.getpid())}
    monkeypatch.setattr("grafu.processes.worker.wait", interrupted)
    with pytest.raises(KeyboardInterrupt):
        worker.outcome_of("wait")
    assert len({*descendants(os.getpid())} - before) <= 1  # the tracker of resources alone
