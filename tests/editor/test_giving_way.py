"""Masses and shapes are found after a build is shown; whatever is chosen meanwhile comes first, then they are found."""

import asyncio
import signal
import threading
import time
from typing import Any

import pytest
from editing import DOOR, Inside

from grafu.editor.builder import Answer, BuildProcess, Turns
from grafu.editor.building import GaveWay, Interruptible, Order
from grafu.editor.session import Session
from grafu.editor.workspace import open_all
from grafu.pipeline.settings import Settings

LATE = 60.0


class Slow(Inside):
    """Judges until it is to give way, as long as `holds`; then at once."""

    def __init__(self, bench) -> None:
        super().__init__()
        self.bench = bench
        self.bench.say = lambda said: self.on_stage(said["stage"])
        self.at_work, self.to_end = threading.Event(), threading.Event()
        self.holds, self.stopped = True, 0

    def ask(self, order, on_stage):
        if order.do != "judge" or not self.holds:
            return super().ask(order, on_stage)
        self.asked.append(order)
        self.to_end.clear()
        self.at_work.set()
        assert self.to_end.wait(LATE)
        return Answer({}, 0.1)

    def give_way(self):
        self.holds = False
        self.to_end.set()

    def stop(self):
        self.stopped += 1


@pytest.fixture
def slow(inside):
    bench = inside.bench
    said = bench.say
    yield Slow(bench)
    bench.say = said


async def at_judging(session: Session, builder: Slow) -> None:
    session.build()
    assert await asyncio.to_thread(builder.at_work.wait, LATE)
    assert session.status()["stage"] == "judge"


@pytest.mark.parametrize("act", ["choose", "undo"])
def test_a_choice_comes_first_and_the_last_build_is_judged(slow, model, tmp_path, act):
    async def edit() -> Session:
        (workspace,) = open_all([model], tmp_path / "out")
        (tmp_path / "shown").mkdir()
        session = Session(workspace, slow, tmp_path / "shown")
        if act == "undo":
            slow.holds = False
            session.build()
            await session.finished()
            session.choose("motion", DOOR, "fixed")
            slow.holds = True
        await at_judging(session, slow)
        session.undo() if act == "undo" else session.choose("motion", DOOR, "fixed")
        await asyncio.wait_for(session.finished(), LATE)
        return session

    session = asyncio.run(edit())
    assert [order.do for order in slow.asked][-4:] == ["build", "judge", "build", "judge"]
    assert slow.asked[-1].settings == session.history.present.to_json() == session.built.settings.to_json()
    assert session.built.is_judged
    assert session.status()["stage"] == ""


def test_stop_and_another_look_do_not_end_the_judging(slow, model, tmp_path):
    async def edit() -> Session:
        (workspace,) = open_all([model], tmp_path / "out")
        (tmp_path / "shown").mkdir()
        session = Session(workspace, slow, tmp_path / "shown")
        await at_judging(session, slow)
        session.stop()
        session.build()
        assert (slow.stopped, slow.holds) == (0, True)
        slow.give_way()  # as for another model
        await asyncio.wait_for(session.finished(), LATE)
        return session

    assert asyncio.run(edit()).built.is_judged
    assert [order.do for order in slow.asked] == ["build", "judge", "judge"]


def test_work_is_interrupted_while_it_is_done_and_not_before_or_after():
    work = Interruptible()
    work.hear(signal.SIGINT, None)
    assert work.made(lambda: {"made": 1}) == {"made": 1}
    work.hear(signal.SIGINT, None)

    def interrupted():
        work.hear(signal.SIGINT, None)
        raise AssertionError

    assert work.made(interrupted) == {}
    with pytest.raises(GaveWay):
        Interruptible.hear(type("AtWork", (), {"_is_at_work": True})(), signal.SIGINT, None)


def test_what_can_wait_waits_for_all_others():
    turns, order = Turns(), []

    def go(name: str, can_wait: bool) -> threading.Thread:
        def take() -> None:
            with turns.taken(can_wait):
                order.append(name)

        thread = threading.Thread(target=take)
        thread.start()
        return thread

    with turns.taken(True):
        threads = [go("judge", True), go("build", False), go("export", False)]
        end = time.monotonic() + LATE
        while turns._waiting < 2:
            assert time.monotonic() < end
            time.sleep(0.01)
        assert turns.is_wanted
    for thread in threads:
        thread.join(LATE)
    assert order[-1] == "judge"
    assert not turns.is_wanted


@pytest.mark.slow
def test_the_process_lives_on_when_its_judging_gives_way(model, tmp_path):
    process = BuildProcess()
    build, judge = (Order(do, model, "cabinet", tmp_path, Settings().to_json()) for do in ("build", "judge"))

    def interrupted() -> dict[str, Any]:
        """Returns what a judging made that a build was asked for in the middle of."""
        told, answers = threading.Event(), list[Any]()
        judged = threading.Thread(target=lambda: answers.append(process.ask(judge, lambda stage: told.set())))
        judged.start()
        assert told.wait(LATE)
        assert process.ask(build, lambda stage: None).made
        judged.join(LATE)
        return answers[0].made

    try:
        process.ask(build, lambda stage: None)
        number = process._process.pid
        assert any(interrupted() == {} for _ in range(5))  # a judging may end before it hears of the build
        assert process._process.pid == number
        assert process.ask(judge, lambda stage: None).made["report"]
    finally:
        process.stop()
