"""One thread for all tests of the network, and one file of a tiny one."""

import os
from pathlib import Path

import pytest


@pytest.fixture(autouse=True)
def _alone(one_thread: None) -> None: ...


@pytest.fixture(scope="session")
def files(tmp_path_factory: pytest.TempPathFactory) -> dict[bool, bytes]:
    """ONNX files of `tiny_network()`, by whether weights have 16 bits; tracing takes long: one worker does it."""
    from filelock import FileLock  # comes with torch

    from grafu.network.export import with_half_weights

    folder = tmp_path_factory.getbasetemp()
    path = (folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder) / "tiny_network.onnx"
    with FileLock(f"{path}.lock"):
        if not path.is_file():
            export_tiny(path)
        file = path.read_bytes()
    return {False: file, True: with_half_weights(file)}


def export_tiny(path: Path) -> None:
    import torch

    from grafu.network.export import onnx_bytes
    from random_graphs import ANCHORS, NEIGHBOURS, POINTS, tiny_network

    network = tiny_network().train()  # the file is of the network at work, whatever it does now
    before = torch.get_rng_state()
    file = onnx_bytes(network, points=POINTS, anchors=ANCHORS, neighbours=NEIGHBOURS, half_weights=False)
    assert network.training
    assert torch.equal(torch.get_rng_state(), before)
    path.write_bytes(file)
