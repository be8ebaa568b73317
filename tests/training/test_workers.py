"""Several processes train one network: they agree on weights, gradients, and when to stop."""

import os
import socket
import subprocess
import sys
from pathlib import Path

import pytest
import torch

from grafu.training.workers import Workers, joined_workers

TESTS = Path(__file__).parent

SCRIPT = """
import sys, torch
from dataclasses import replace
from pathlib import Path
from grafu.training.loop import RunOptions, train
from grafu.training.workers import joined_workers
from little_runs import FewModels, little

torch.set_num_threads(1)
with joined_workers("cpu") as workers:
    assert workers.count == 2
    layer = torch.nn.Linear(1, 1)
    layer.weight.grad = torch.full_like(layer.weight, float(workers.rank))
    assert workers.average_gradients(layer.parameters(), workers.rank == 1)
    assert float(layer.weight.grad) == 0.5 and float(layer.bias.grad) == 0.0
    for report in train(little(2), FewModels(), Path(sys.argv[1]), workers, RunOptions(log_every=1)):
        pass
    assert report.step == 2
    print("agreed", workers.rank)
"""


def free_port() -> int:
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return int(found.getsockname()[1])


def test_two_processes_train_one_network(tmp_path: Path) -> None:
    paths = os.pathsep.join([str(TESTS), str(TESTS.parent)])
    common = os.environ | {"MASTER_ADDR": "127.0.0.1", "MASTER_PORT": str(free_port()), "WORLD_SIZE": "2"}
    common["PYTHONPATH"] = paths
    command = [sys.executable, "-c", SCRIPT, str(tmp_path)]
    running = [
        subprocess.Popen(command, env=common | {"RANK": str(rank)}, stdout=subprocess.PIPE, text=True)
        for rank in range(2)
    ]
    said = [process.communicate(timeout=240)[0].strip() for process in running]
    assert said == ["agreed 0", "agreed 1"]
    assert len((tmp_path / "train.csv").read_text().splitlines()) == 3


def test_alone_nothing_is_shared() -> None:
    with joined_workers("cpu") as workers:
        assert workers == Workers(0, 1, torch.device("cpu"))
        assert workers.is_first
        layer = torch.nn.Linear(1, 1)
        assert workers.average_gradients(layer.parameters(), True)
        assert layer.weight.grad is None
        workers.share_weights(layer)
        workers.wait()


def test_auto_is_a_device_that_is_there() -> None:
    with joined_workers("auto") as workers:
        assert workers.device.type == ("cuda" if torch.cuda.is_available() else "cpu")
        assert "threads" in workers.name or "x" in workers.name


def test_an_unknown_device_is_refused() -> None:
    with pytest.raises(RuntimeError), joined_workers("abacus"):
        pass
