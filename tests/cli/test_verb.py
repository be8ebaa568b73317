"""Ctrl-C: what swallows it, and what is said of a run of several."""

import os
import signal
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from grafu.cli.job import Failed, Job, JobOptions, JobResult
from grafu.cli.main import main
from grafu.cli.verb import EXIT_INTERRUPTED, INTERRUPTED, interruption_held


def swallow_an_interruption() -> None:
    with suppress(BaseException):
        os.kill(os.getpid(), signal.SIGINT)
        signal.sigtimedwait([], 0.01)  # Python calls handlers between two of its own steps


def hold(done: list[str]) -> None:
    with interruption_held():
        swallow_an_interruption()
        done.append("the body")


def test_what_swallows_an_interruption_only_delays_it() -> None:
    done: list[str] = []
    with pytest.raises(KeyboardInterrupt):
        hold(done)

    assert done == ["the body"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_ignored_interruption_stays_ignored() -> None:
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        with interruption_held():
            os.kill(os.getpid(), signal.SIGINT)
    finally:
        signal.signal(signal.SIGINT, before)


def test_a_run_that_is_cut_says_how_it_goes_on(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def cut(jobs: list[Job], _: int, **__: object) -> Iterator[JobResult]:
        yield Failed(Job(Path("a"), "a", JobOptions(tmp_path)), "bad", users_fault=True)
        raise KeyboardInterrupt

    monkeypatch.setattr("grafu.cli.pool.run_jobs", cut)
    assert main(["functionalize", "a.glb", "b.glb", "--out", str(tmp_path / "out")]) == EXIT_INTERRUPTED
    said = capsys.readouterr().err
    assert "1 of 2 inputs" in said
    assert "--resume" in said
    assert INTERRUPTED in said
