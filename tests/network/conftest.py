"""One thread for all tests of the network, and one file of a tiny one."""

import pytest


@pytest.fixture(autouse=True)
def _alone(one_thread: None) -> None: ...


@pytest.fixture(scope="session")
def files() -> dict[bool, bytes]:
    """ONNX files of `tiny_network()` by whether their weights have 16 bits: tracing it takes seconds."""
    import torch

    from grafu.network.export import onnx_bytes, with_half_weights
    from random_graphs import ANCHORS, NEIGHBOURS, POINTS, tiny_network

    network = tiny_network().train()  # the file is of the network at work, whatever it does now
    before = torch.get_rng_state()
    file = onnx_bytes(network, points=POINTS, anchors=ANCHORS, neighbours=NEIGHBOURS, half_weights=False)
    assert network.training
    assert torch.equal(torch.get_rng_state(), before)
    return {False: file, True: with_half_weights(file)}
