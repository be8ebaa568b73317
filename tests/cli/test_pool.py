"""Jobs in processes: a result each, and a crash that takes no other job with it."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from time import sleep

import pytest
from obj_inputs import write_cabinet

from descendants import SOON, survivors
from grafu.cli.job import Failed, Job, JobOptions
from grafu.cli.limit_options import why_stopped
from grafu.cli.main import main
from grafu.cli.pool import run_jobs
from grafu.processes.limits import Ending, ProcessLimits, descendants


def fake_run(job: Job) -> Failed:
    """Stands in for `run_job`; in a worker of its own it dies at the input called `crash`."""
    if job.name == "crash":
        os._exit(11)
    return Failed(job, f"ran {job.name}", users_fault=True)


def jobs(*names: str) -> list[Job]:
    return [Job(Path(name), name, JobOptions(Path("out"))) for name in names]


def test_every_job_comes_back() -> None:
    found = {result.job.name: result.why for result in run_jobs(jobs("a", "b", "c"), 2, fake_run)}

    assert found == {"a": "ran a", "b": "ran b", "c": "ran c"}


def test_a_crash_fails_one_job_alone() -> None:
    found = {result.job.name: result for result in run_jobs(jobs("a", "crash", "b"), 1, fake_run)}

    assert (found["a"].why, found["b"].why) == ("ran a", "ran b")
    assert found["crash"].why == why_stopped(Ending.DIED, ProcessLimits())
    assert not found["crash"].users_fault


pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the tests ask /proc")

# Python imports it as it starts, in every process of a run: what happens at the moment when results take their place.
_AT_THE_END = """
import os, time
from grafu.export import files
swap = files._swap
def instead(fresh, folder, old):
    if "bad" in folder.name:
        {what}
    elif "eats" in folder.name:
        kept = []
        while True: kept.append(os.urandom(10**6) * 10)
    elif "gulps" in folder.name:
        bytes(10**13)
    swap(fresh, folder, old)
files._swap = instead
"""
HANG = "time.sleep(1000)"
CRASH = "os.abort()"
QUICK = ("--motion", "rule", "--formats", "urdf", "--no-page")


@pytest.fixture
def out(tmp_path: Path) -> Path:
    return tmp_path / "out"


def begin(tmp_path: Path, *arguments: object, what: str = "pass") -> "subprocess.Popen[str]":
    """Starts the command, whose results named `bad` meet their fate where they would take their place."""
    (tmp_path / "sitecustomize.py").write_text(_AT_THE_END.format(what=what))
    paths = os.pathsep.join([str(tmp_path), *(path for path in sys.path if path)])
    return subprocess.Popen(
        [sys.executable, "-m", "grafu.cli.main", *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )


def hidden(out: Path) -> list[str]:
    return [path.name for path in out.iterdir() if path.name.startswith(".")] if out.is_dir() else []


def wait_for_hidden(out: Path, count: int) -> None:
    wait_for(lambda: len(hidden(out)) == count)


def wait_for(happened: Callable[[], bool]) -> None:
    for _ in range(int(SOON / 0.02)):
        if happened():
            return
        sleep(0.02)
    raise AssertionError("it did not happen in time")


def models(tmp_path: Path, *names: str) -> list[Path]:
    return [write_cabinet(tmp_path, name) for name in names]


@pytest.mark.parametrize(
    ("names", "sent"),
    [(["bad"], signal.SIGTERM), (["bad", "bad_too"], signal.SIGTERM), (["bad", "bad_too"], signal.SIGKILL)],
)
def test_a_run_that_is_ended_leaves_nothing_running(
    tmp_path: Path, out: Path, names: list[str], sent: signal.Signals
) -> None:
    command = ("functionalize", *models(tmp_path, *names), "--out", out, "--jobs", 2, *QUICK)
    run = begin(tmp_path, *command, what=HANG)
    wait_for_hidden(out, len(names))
    started = descendants(run.pid)
    run.send_signal(sent)
    _, said = run.communicate(timeout=SOON)  # ends when the last that holds the pipes has ended

    assert len(started) >= len(names)
    assert survivors(started, 5.0) == []
    if sent is signal.SIGTERM:
        assert run.returncode == 143
        assert hidden(out) == []
        assert "no half-written output is left" in said
        assert ("--resume" in said) == (len(names) > 1)
        assert said.count("\n") == len(names)
        assert main([*map(str, command), "--jobs", "1", "--resume"]) == 0
        assert sorted(path.name for path in out.iterdir()) == names


def test_a_run_that_is_killed_twice_is_finished_by_resume(tmp_path: Path, out: Path) -> None:
    names = ["a", "bad", "b", "bad_too", "c"]
    command = ("functionalize", *models(tmp_path, *names), "--out", out, "--jobs", 2, "--resume", *QUICK)
    kept: dict[str, int] = {}
    for k in range(2):
        (begun := tmp_path / f"begun_{k}").mkdir()
        hang = f"open(f'{begun}/{{os.getpid()}}', 'w').close(); {HANG}"
        run = begin(tmp_path, *command, what=hang)
        wait_for(lambda begun=begun: len(list(begun.iterdir())) == 2)  # both workers are about to give results a place
        os.killpg(run.pid, signal.SIGKILL)
        run.communicate(timeout=SOON)
        assert hidden(out) != []
        assert written(out).items() >= kept.items()
        kept = written(out)
        assert set(kept) == {"a", "b"}

    assert main([*map(str, command)]) == 0
    assert written(out).items() > kept.items()
    assert sorted(path.name for path in out.iterdir()) == sorted(names)
    for name in names:
        assert json.loads((out / name / "report.json").read_text(encoding="utf-8"))["joints"]
        assert (out / name / "model.urdf").read_text(encoding="utf-8").rstrip().endswith("</robot>")


def written(out: Path) -> dict[str, int]:
    """Returns when each result that is there was written, in nanoseconds."""
    return {path.parent.name: path.stat().st_mtime_ns for path in out.glob("[!.]*/report.json")}


def test_ctrl_c_reaches_all_and_is_said_once(tmp_path: Path, out: Path) -> None:
    run = begin(tmp_path, "functionalize", *models(tmp_path, "bad"), "--out", out, *QUICK, what=HANG)
    wait_for_hidden(out, 1)
    os.killpg(run.pid, signal.SIGINT)  # as a terminal does it
    _, said = run.communicate(timeout=SOON)
    assert run.returncode == 130
    assert said == "grafu: interrupted; no half-written output is left\n"
    assert hidden(out) == []


def test_a_model_that_is_stopped_is_one_line(tmp_path: Path, out: Path) -> None:
    run = begin(tmp_path, "functionalize", *models(tmp_path, "bad"), "--out", out, "--timeout", 2, *QUICK, what=HANG)
    shown, said = run.communicate(timeout=SOON)
    assert (run.returncode, shown) == (2, "")
    assert "not done after 3 s, 1.5 times its --timeout" in said
    assert said.count("\n") == 1
    assert hidden(out) == []


def test_models_that_need_too_much_memory_are_a_line_each(tmp_path: Path, out: Path) -> None:
    inputs = models(tmp_path, "eats", "gulps")
    run = begin(tmp_path, "functionalize", *inputs, "--out", out, "--jobs", 1, "--memory", "700M", *QUICK)
    _, said = run.communicate(timeout=SOON)
    why = "needed more than 700 MB of memory and was stopped: give --memory more"
    assert run.returncode == 1
    complaints = [line for line in said.splitlines() if not line.startswith("[")]  # others: each as it ends
    assert (len(complaints), len(said.splitlines())) == (len(inputs), 2 * len(inputs))
    assert all(any(f"{path}: " in line and why in line for line in complaints) for path in inputs)
    assert list(out.iterdir() if out.is_dir() else []) == []


def test_of_several_the_others_are_done(tmp_path: Path, out: Path) -> None:
    inputs = models(tmp_path, "good", "bad", "better")
    run = begin(tmp_path, "functionalize", *inputs, "--out", out, "--jobs", 1, *QUICK, what=CRASH)
    _, said = run.communicate(timeout=SOON)
    assert run.returncode == 1
    *ended, why = said.splitlines()
    assert [line.partition(":")[0] for line in ended] == ["[1/3] good", "[2/3] bad", "[3/3] better"]
    assert why.startswith(f"grafu: {inputs[1]}: the process died")
    assert sorted(path.name for path in out.iterdir()) == ["better", "good"]


def test_what_is_wrong_with_one_input_is_said_as_ever(tmp_path: Path, out: Path) -> None:
    run = begin(tmp_path, "functionalize", tmp_path / "none.glb", "--out", out)
    shown, said = run.communicate(timeout=SOON)
    assert (run.returncode, shown, said.count("\n")) == (2, "", 1)
    assert "none.glb" in said


def test_inspection_has_limits_too(tmp_path: Path) -> None:
    large, *_ = [*models(tmp_path, "large"), *models(tmp_path, "good")]
    large.write_text(large.read_text() + "v 0.2 0.2 0.2\n" * 1_000_000)
    run = begin(tmp_path, "inspect", large, "--memory", "100M")
    _, said = run.communicate(timeout=SOON)
    assert run.returncode == 2
    assert "--memory" in said
    done = begin(tmp_path, "inspect", tmp_path / "good.obj")
    shown, said = done.communicate(timeout=SOON)
    assert (done.returncode, said) == (0, "")
    assert "door" in shown


@pytest.mark.parametrize(
    "limit", [("--timeout", "0"), ("--timeout", "soon"), ("--memory", "4 apples"), ("--memory", "4")]
)
def test_limits_that_mean_nothing_are_refused(tmp_path: Path, limit: tuple[str, str]) -> None:
    with pytest.raises(SystemExit) as end:
        main(["functionalize", "a.glb", "--out", str(tmp_path), *limit])
    assert end.value.code == 2


def test_limits_are_read_as_people_write_them() -> None:
    from grafu.cli.limit_options import limits_of
    from grafu.cli.main import build_parser
    from grafu.processes.limits import ProcessLimits

    def stated(*limits: str) -> ProcessLimits:
        return limits_of(build_parser().parse_args(["functionalize", "a.glb", "--out", "out", *limits]))

    assert stated() == ProcessLimits(120.0, 4 * 10**9)
    assert stated("--timeout", "7.5", "--memory", "1.5g") == ProcessLimits(7.5, 1_500_000_000)
    assert stated("--timeout", "none", "--memory", "800MB") == ProcessLimits(None, 800_000_000)
    assert stated("--timeout", "1", "--memory", "none") == ProcessLimits(1.0, None)


def test_a_model_is_delivered_with_what_its_time_holds(tmp_path: Path) -> None:
    from grafu.cli.job import Job, JobOptions, Succeeded, run_job
    from grafu.processes.limits import ProcessLimits

    options = JobOptions(tmp_path / "out", formats=("urdf",), page=False, limits=ProcessLimits(seconds=1e-6))
    result = run_job(Job(write_cabinet(tmp_path), "cabinet", options))
    assert isinstance(result, Succeeded)
    assert {skipped.reason.value for skipped in result.report.skipped} == {"too complex"}
    assert (tmp_path / "out" / "cabinet" / "model.urdf").is_file()
