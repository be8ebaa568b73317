"""Work in processes: a result each, limits that hold for each, and an end that leaves nothing running."""

import os
import signal
import subprocess
import sys
import tempfile
from contextlib import closing
from pathlib import Path
from threading import Thread
from time import sleep

import pytest

from descendants import SOON, survivors
from grafu.processes.lifetime import scratch_folder
from grafu.processes.limits import Ending, ProcessLimits, descendants, resident_bytes
from grafu.processes.worker import run_each

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the tests ask /proc")

MEGABYTE = 10**6
MEMORY = 400 * MEGABYTE
KEPT: list[bytes] = []

_PARENT = """
import sys
sys.path[:0] = {paths!r}
from test_run_each import hang_with_a_child
from grafu.processes.worker import run_each
if __name__ == "__main__":
    list(run_each(["{folder}/a", "{folder}/b"], 2, hang_with_a_child))
"""


def square(number: int) -> int:
    return number * number


def own_process(_: object) -> int:
    return os.getpid()


def keep(_: object) -> int:
    KEPT.append(os.urandom(MEGABYTE) * int(0.6 * MEMORY / MEGABYTE))
    return os.getpid()


def do(what: str) -> str:
    """Stands in for work; the item states what happens."""
    eaten = []
    match what:
        case "exit":
            os._exit(11)
        case "crash":
            os.kill(os.getpid(), signal.SIGSEGV)
        case "hang":
            sleep(1000)
        case "eat":
            while True:
                eaten.append(os.urandom(MEGABYTE) * 10)
        case "gulp":
            try:
                bytes(100 * MEMORY)
            except MemoryError:
                return "refused"
    return what


def hang_with_a_child(path: str) -> None:
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(1000)"])
    with scratch_folder() as folder:
        Path(path).write_text(f"{child.pid}\n{os.getpid()}\n{folder}\n")
        sleep(1000)


def endings(items: list[str], limits: ProcessLimits) -> dict[str, Ending]:
    return {item: outcome.ending for item, outcome in run_each(items, 2, do, limits)}


def test_every_item_has_its_result() -> None:
    found = dict(run_each(range(7), 3, square))
    assert {item: outcome.results for item, outcome in found.items()} == {i: (i * i,) for i in range(7)}


def test_workers_serve_again() -> None:
    assert len({outcome.results for _, outcome in run_each(range(6), 2, own_process)}) <= 2


def test_a_death_is_of_one_item_alone() -> None:
    found = endings(["a", "exit", "b", "crash", "c"], ProcessLimits())
    assert {item for item, ending in found.items() if ending is Ending.DIED} == {"exit", "crash"}
    assert [found[item] for item in "abc"] == [Ending.DONE] * 3


def test_what_takes_too_long_is_stopped_alone() -> None:
    found = endings(["a", "hang", "b"], ProcessLimits(seconds=3.0))
    assert found == {"a": Ending.DONE, "hang": Ending.LATE, "b": Ending.DONE}


def test_what_needs_too_much_is_stopped_alone() -> None:
    found = endings(["a", "eat", "b"], ProcessLimits(memory=MEMORY))
    assert found == {"a": Ending.DONE, "eat": Ending.LARGE, "b": Ending.DONE}


def test_one_request_beyond_all_memory_is_refused_at_once() -> None:
    [(_, outcome)] = run_each(["gulp"], 1, do, ProcessLimits(memory=MEMORY))
    assert outcome.results == ("refused",)


def test_no_item_pays_for_the_memory_of_another() -> None:
    found = [outcome for _, outcome in run_each(range(3), 1, keep, ProcessLimits(memory=MEMORY))]
    assert [outcome.ending for outcome in found] == [Ending.DONE] * 3
    assert len({outcome.results for outcome in found}) == 3  # a process each


def test_with_a_process_goes_what_it_started(tmp_path: Path) -> None:
    report = tmp_path / "a"
    [(_, outcome)] = run_each([str(report)], 1, hang_with_a_child, ProcessLimits(seconds=3.0))
    child, process, folder = report.read_text().split()
    assert outcome.ending is Ending.LATE
    assert survivors([int(child), int(process)], 5.0) == []
    assert Path(folder).is_relative_to(tempfile.gettempdir())
    assert not Path(folder).exists()


def test_a_caller_that_stops_asking_leaves_nothing(tmp_path: Path) -> None:
    reports = [tmp_path / "a", tmp_path / "b"]
    with closing(run_each(["c", *map(str, reports)], 3, hang_with_a_child_or_not)) as ended:
        next(ended)
        wait_for(reports)
    processes = [int(word) for path in reports for word in path.read_text().split()[:2]]
    assert survivors(processes, 5.0) == []


def hang_with_a_child_or_not(path: str) -> None:
    if path != "c":
        hang_with_a_child(path)


def test_workers_outlive_the_thread_that_asked_for_them() -> None:
    ended = run_each(["a", "b", "c"], 1, do)
    first: list[object] = []
    thread = Thread(target=lambda: first.append(next(ended)))
    thread.start()
    thread.join()
    assert [outcome.ending for _, outcome in ended] == [Ending.DONE] * 2
    assert len(first) == 1


def test_workers_end_when_their_parent_is_killed(tmp_path: Path) -> None:
    paths = [str(Path(__file__).parent), str(Path(__file__).parents[1]), *sys.path]
    script, reports = tmp_path / "parent.py", [tmp_path / "a", tmp_path / "b"]
    script.write_text(_PARENT.format(paths=paths, folder=tmp_path))
    with subprocess.Popen([sys.executable, str(script)]) as parent:
        wait_for(reports)
        started = descendants(parent.pid)
        parent.kill()
    workers, children = ({int(path.read_text().split()[i]) for path in reports} for i in (1, 0))
    assert workers <= set(started)
    assert survivors(set(started) - children, 5.0) == []
    for child in children:  # the test's own, which no one ends
        os.kill(child, signal.SIGKILL)


def wait_for(paths: list[Path]) -> None:
    for _ in range(int(SOON / 0.02)):
        if all(path.exists() and path.read_text().count("\n") == 3 for path in paths):
            return
        sleep(0.02)
    raise AssertionError(f"no one wrote {paths}")


def test_memory_is_what_is_touched() -> None:
    before = resident_bytes(os.getpid())
    held = os.urandom(1) * (100 * MEGABYTE)
    assert resident_bytes(os.getpid()) - before > 90 * MEGABYTE
    assert len(held) == 100 * MEGABYTE


@pytest.mark.parametrize("limits", [{"seconds": 0.0}, {"memory": -1}])
def test_limits_are_above_nothing(limits: dict[str, float]) -> None:
    with pytest.raises(ValueError, match="above 0"):
        ProcessLimits(**limits)  # type: ignore[arg-type]


def test_each_item_is_named_as_it_begins_before_it_ends() -> None:
    heard: list[str] = []
    for item, _ in run_each(range(5), 2, square, on_begin=lambda item: heard.append(f"begins {item}")):
        heard.append(f"ends {item}")
    assert sorted(heard) == sorted(f"{what} {item}" for what in ("begins", "ends") for item in range(5))
    assert heard[:2] == ["begins 0", "begins 1"]
    assert all(heard.index(f"begins {item}") < heard.index(f"ends {item}") for item in range(5))
