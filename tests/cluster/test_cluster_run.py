"""Three nodes of Ray on this machine: one is killed in the middle, a model kills its process; no model is lost."""

import json
import os
import signal
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import nullcontext, suppress
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread
from time import monotonic, sleep
from typing import Any

import pytest

pytest.importorskip("ray")
pytest.importorskip("s3fs")
pytest.importorskip("moto")

from cluster_work import Named, tries, work
from local_cluster import add_node, local_cluster
from local_s3 import SECRET, local_s3

from descendants import SOON
from grafu.cli.main import main
from grafu.cluster.config import ClusterConfig
from grafu.cluster.ray_tasks import Work, cluster_at, run_on_cluster
from grafu.errors import OptionError
from grafu.processes.limits import Ending, descendants

SAMPLES = Path(__file__).parents[2] / "samples"
pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore"),  # of Ray, its sockets and its processes
    pytest.mark.skipif(os.name != "posix", reason="a cluster of several nodes on one machine"),
]


@pytest.fixture(scope="module")
def storage() -> Iterator[Any]:
    with local_s3() as system:
        yield system


@pytest.fixture(scope="module")
def cluster(storage: Any) -> Iterator[Any]:
    with local_cluster(3) as made:  # its nodes inherit the address of the storage
        yield made


def wait_until(is_so: Callable[[], object]) -> None:
    end = monotonic() + SOON
    while not is_so():
        assert monotonic() < end
        sleep(0.05)


def raylet_of(node: Any) -> int:
    """Returns the process of a node, from which all of its tasks descend."""
    return int(node.all_processes["raylet"][0].process.pid)


def lose(cluster: Any, node: Any) -> None:
    """Ends a node as a power cut does: all of its processes, also those that would outlive it for a moment."""
    processes = descendants(raylet_of(node))
    cluster.remove_node(node, allow_graceful=False)
    for process in processes:
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


def beside(do: Callable[[], None]) -> Thread:
    thread = Thread(target=do, daemon=True)
    thread.start()
    return thread


def outcomes(cluster: Any, items: list[Named]) -> list[tuple[str, Ending]]:
    with cluster_at(cluster.address, 1) as ray:
        return [(item[1], outcome.ending) for item, outcome in run_on_cluster(ray, items, Work(work))]


def test_what_was_on_a_killed_node_is_done_elsewhere(cluster: Any, tmp_path: Path) -> None:
    victim = add_node(cluster)

    def kill_victim() -> None:
        try:
            wait_until(lambda: {*tries(tmp_path, "waits")} & {*descendants(raylet_of(victim))})
            lose(cluster, victim)
        finally:
            (tmp_path / "go").touch()

    killing = beside(kill_victim)
    ended = outcomes(cluster, [(str(tmp_path), "waits")] * 4 + [(str(tmp_path), f"item_{k}") for k in range(6)])
    killing.join()

    assert Counter(ended) == {("waits", Ending.DONE): 4, **{(f"item_{k}", Ending.DONE): 1 for k in range(6)}}
    assert len(tries(tmp_path, "waits")) >= 5


def test_what_kills_its_process_is_set_aside_after_two_tries(cluster: Any, tmp_path: Path) -> None:
    names = ["a", "crashes", "b", "kills", "c"]
    ended = outcomes(cluster, [(str(tmp_path), name) for name in names])

    set_aside = {"crashes": Ending.SET_ASIDE, "kills": Ending.SET_ASIDE}
    assert sorted(ended, key=str) == sorted([(n, set_aside.get(n, Ending.DONE)) for n in names], key=str)
    assert [len(tries(tmp_path, name)) for name in names] == [1, 2, 1, 2, 1]


def test_a_cluster_elsewhere_is_used_by_its_client_port(cluster: Any, tmp_path: Path) -> None:
    with cluster_at(cluster.client_address, 1) as ray:
        items = [(str(tmp_path), name) for name in ("a", "crashes", "b")]
        ended = {item[1]: outcome.ending for item, outcome in run_on_cluster(ray, items, Work(work))}
    assert ended == {"a": Ending.DONE, "crashes": Ending.SET_ASIDE, "b": Ending.DONE}


@pytest.mark.parametrize(("late", "asked"), [(0, 1), (2, 3), (5, 3)])
def test_a_server_that_is_late_with_a_session_is_asked_again(
    late: int, asked: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    tries: list[str] = []

    def init(address: str, **_: object) -> None:
        tries.append(address)
        if len(tries) <= late:
            raise ConnectionAbortedError("Initialization failure from server")

    monkeypatch.setattr("ray.init", init)
    monkeypatch.setattr("grafu.cluster.ray_tasks._require_answer", lambda address, seconds: None)
    refused = pytest.raises(OptionError, match="cannot be used") if late > 2 else nullcontext()
    with refused, cluster_at("ray://host:10001", 1):
        pass
    assert tries == ["ray://host:10001"] * asked


def test_no_more_than_the_stated_number_is_given_to_the_cluster(cluster: Any, tmp_path: Path) -> None:
    begun: list[Named] = []
    most = 0
    with cluster_at(cluster.address, 1) as ray:
        config = replace(ClusterConfig(), in_flight_per_cpu=1.0)
        items = [(str(tmp_path), f"item_{k}") for k in range(9)]
        cpus = int(ray.cluster_resources()["CPU"])
        ended = 0
        for _ in run_on_cluster(ray, items, Work(work), config, begun.append):
            most = max(most, len(begun) - ended)
            ended += 1
    assert ended == 9
    assert most <= cpus


def test_nodes_that_cannot_do_the_work_end_the_run_with_one_line(
    cluster: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("grafu.cluster.ray_tasks.__version__", "0.0.0")
    with pytest.raises(OptionError, match=r"cannot run grafu: .*0\.0\.0"):
        outcomes(cluster, [(str(tmp_path), "item")])


def test_models_of_a_bucket_are_made_though_a_node_is_killed(
    cluster: Any, storage: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    sources = [SAMPLES / name for name in ("chest.glb", "desk.glb")]
    for k in range(5):
        storage.put(str(sources[k % 2]), f"bucket/models/piece_{k}.glb")
    storage.pipe("bucket/models/damaged.glb", b"glTF")
    victim = sorted(cluster.worker_nodes, key=lambda node: node.node_id)[0]
    raylet = raylet_of(victim)

    def at_work() -> bool:
        found = [Path(f"/proc/{one}/cmdline") for one in descendants(raylet)]
        return any(b"spawn_main" in path.read_bytes() for path in found if path.exists())

    ended = Event()

    def kill_victim() -> None:
        wait_until(lambda: ended.is_set() or at_work())
        lose(cluster, victim)

    killing = beside(kill_victim)
    log = tmp_path / "log"
    words = ["functionalize", "s3://bucket/models/*", "--out", "s3://bucket/results", "--cluster", cluster.address]
    words += ["--formats", "mjcf", "--no-page", "--json", "--log", str(log)]
    code = main(words)
    ended.set()
    killing.join()
    printed = capsys.readouterr()
    lines = [json.loads(line) for line in printed.out.splitlines()]

    assert code == 1, printed.err  # of the damaged one
    names = [*(f"piece_{k}" for k in range(5)), "damaged"]
    assert sorted(line["name"] for line in lines) == sorted(names), printed.err
    assert [line["name"] for line in lines if line["error"]] == ["damaged"]
    for line in lines:
        if not line["error"]:
            assert line["folder"] == f"s3://bucket/results/{line['name']}"
            there = {name.partition(f"{line['name']}/")[2] for name in storage.find(line["folder"])}
            assert there == {*line["files"], ".grafu.json"}
    assert json.loads(storage.cat("bucket/results/piece_0/report.json"))["input"]["path"].startswith("s3://bucket/")
    written = b"".join(storage.cat(storage.find("bucket/results")).values()) + log.read_bytes()
    assert SECRET.encode() not in written

    code = main([*words, "--resume"])
    again = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert code == 1
    assert {line["name"]: line["seconds"] for line in again}.keys() == set(names)
