"""The weights of an exported file can be started from: their names, larger networks, other networks, damaged files."""

from dataclasses import replace

import onnx
import pytest
import torch

from grafu.errors import WeightsError
from grafu.graph.arrays import NULL, SLIDE
from grafu.network.grafu import GraFu
from grafu.network.stored import start_from, stored_weights
from random_graphs import TINY, graph, tiny_network

pytestmark = pytest.mark.slow  # beside test_onnx, whose file it shares


@pytest.mark.parametrize(("half", "precision"), [(False, 0.0), (True, 2e-3)])
def test_every_weight_is_found_by_its_name(files: dict[bool, bytes], half: bool, precision: float) -> None:
    stored, own = stored_weights(files[half]), tiny_network().state_dict()
    assert own.keys() <= stored.keys()
    assert all(torch.allclose(stored[name], value, atol=precision) for name, value in own.items())


def test_every_weight_of_a_new_network_is_there_though_many_are_alike(new_file: bytes) -> None:
    own = GraFu(TINY).state_dict()
    zeros = [name for name, value in own.items() if value.ndim == 1 and not value.any()]
    assert len(zeros) > 2
    assert own.keys() <= stored_weights(new_file).keys()


def test_a_network_that_starts_from_a_file_answers_as_it_does(files: dict[bool, bytes]) -> None:
    network = GraFu(TINY).eval()
    assert start_from(network, stored_weights(files[False])) == ()
    assert torch.allclose(network(graph(7)).edge, tiny_network()(graph(7)).edge, atol=1e-6)


def test_materials_count_nothing_at_first_where_the_file_does_not_know_them() -> None:
    first = GraFu(replace(TINY, materials=False)).eval()
    wider = GraFu(TINY).eval()
    assert start_from(wider, first.state_dict()) == ()
    assert torch.allclose(wider(graph(7)).category, first(graph(7)).category, atol=1e-6)


def test_kinds_of_edges_that_the_file_does_not_know_start_unlikely(files: dict[bool, bytes]) -> None:
    known = replace(TINY, kinds="paper")
    first = GraFu(known).eval()
    wider = GraFu(TINY).eval()
    assert start_from(wider, first.state_dict()) == ()
    shown = replace(graph(7), edges=torch.full((1, 7, 7), NULL))
    before, after = first(shown), wider(shown)
    assert torch.allclose(after.edge[..., : NULL + 1], before.edge, atol=1e-6)
    assert (after.edge[..., SLIDE:].mean() < -2.0).item()
    assert torch.allclose(after.border, before.border, atol=1e-6)


def test_what_the_file_lacks_is_named_and_another_network_is_refused(files: dict[bool, bytes]) -> None:
    stored = stored_weights(files[False])
    del stored["decoder.free"]
    assert start_from(GraFu(TINY), stored) == ("decoder.free",)
    with pytest.raises(WeightsError, match="of another network: "):
        start_from(GraFu(replace(TINY, hidden=8, edge=8)), stored)


def test_what_is_no_network_is_refused(files: dict[bool, bytes]) -> None:
    with pytest.raises(WeightsError, match="must be a network in ONNX form"):
        stored_weights(files[False][:-200])
    nameless = onnx.load_from_string(files[False])
    for weight in nameless.graph.initializer:
        weight.name = f"val_{id(weight)}"
    with pytest.raises(WeightsError, match="of another network"):
        start_from(GraFu(TINY), stored_weights(nameless.SerializeToString()))
