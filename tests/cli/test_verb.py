"""Ctrl-C: what swallows it, and what is said of a run of several. A reader of the output that ends before it."""

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import pytest
from obj_inputs import write_cabinet

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


@pytest.mark.slow
@pytest.mark.parametrize(
    "words",
    [
        ["functionalize", "--formats"],
        ["completion", "fish"],
        ["inspect", "CABINET", "--json"],
        ["inspect", "CABINET"],
        ["functionalize", "CABINET", "--no-page", "--formats", "urdf", "--out", "OUT"],
        ["functionalize", "CABINET", "OTHER", "--no-page", "--formats", "urdf", "--json", "--out", "OUT"],
    ],
    ids=lambda words: " ".join(words[:3]),
)
def test_where_the_reader_of_the_output_ends_the_command_ends_without_a_word(words: list[str], tmp_path: Path) -> None:
    places = {"CABINET": write_cabinet(tmp_path), "OTHER": write_cabinet(tmp_path, "other"), "OUT": tmp_path / "out"}
    command = [sys.executable, "-m", "grafu", *(str(places.get(word, word)) for word in words)]
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run(command, stdout=writer, stderr=subprocess.PIPE, text=True, check=False)
    finally:
        os.close(writer)
    assert done.returncode == 141
    assert [line for line in done.stderr.splitlines() if not line.startswith("[")] == []
    assert not [path for path in places["OUT"].glob(".*") if path.name.endswith("new")]
