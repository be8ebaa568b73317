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

    path = tiny_path(tmp_path_factory)
    with FileLock(f"{path}.lock"):
        if not path.is_file():
            export_tiny(path)
        file = path.read_bytes()
    return {False: file, True: with_half_weights(file)}


@pytest.fixture(scope="session")
def new_file(files: dict[bool, bytes], tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """The ONNX file of a network as it starts, many of whose weights are alike."""
    return (tiny_path(tmp_path_factory).with_name("new_network.onnx")).read_bytes()


def tiny_path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.getbasetemp()
    return (folder.parent if "PYTEST_XDIST_WORKER" in os.environ else folder) / "tiny_network.onnx"


def export_tiny(path: Path) -> None:
    import torch

    from grafu.network.export import onnx_bytes
    from grafu.network.grafu import GraFu
    from random_graphs import ANCHORS, NEIGHBOURS, POINTS, TINY, tiny_network

    sizes = {"points": POINTS, "anchors": ANCHORS, "neighbours": NEIGHBOURS}

    network = tiny_network().train()  # the file is of the network at work, whatever it does now
    before = torch.get_rng_state()
    file = onnx_bytes(network, **sizes, half_weights=False)
    assert network.training
    assert torch.equal(torch.get_rng_state(), before)
    path.with_name("new_network.onnx").write_bytes(onnx_bytes(GraFu(TINY), **sizes, half_weights=False))
    path.write_bytes(file)
