"""The network in torch and as an ONNX file: the same answers for any number of parts, and nothing left to look up."""

import json
from pathlib import Path

import numpy as np
import onnx
import pytest
import torch

from grafu.completion.session import onnx_runtime
from grafu.network.batch import one_graph
from grafu.network.config import GraFuConfig
from grafu.network.export import OUTPUTS, PAIR_OUTPUTS
from random_graphs import ANCHORS, NEIGHBOURS, POINTS, TINY, arrays, tiny_network

pytestmark = pytest.mark.slow  # for the export in `files`, once per process


def farthest(file: bytes, n: int) -> float:
    session = onnx_runtime().InferenceSession(file, providers=["CPUExecutionProvider"])
    with torch.no_grad():
        wanted = tiny_network()(one_graph(**arrays(n)))
    found = session.run(list(OUTPUTS), {name: array.numpy() for name, array in arrays(n).items()})
    pairs = zip(OUTPUTS, found, strict=True)
    expected = {name: getattr(wanted, name).numpy() for name in OUTPUTS}
    return max(float(np.abs(expected[k].reshape(v.shape) - v).max(initial=0.0)) for k, v in pairs)


@pytest.mark.parametrize(("half", "most"), [(False, 1e-4), (True, 5e-3)])  # 11 bits a weight, through six layers
def test_torch_and_onnx_agree(files: dict[bool, bytes], half: bool, most: float) -> None:
    assert {n: far for n in (0, 1, 2, 7, 40) if not (far := farthest(files[half], n)) < most} == {}


def test_weights_of_16_bits_take_half_the_space(files: dict[bool, bytes]) -> None:
    weights = {
        half: sum(len(w.raw_data) for w in onnx.load_from_string(f).graph.initializer) for half, f in files.items()
    }
    assert weights[True] < 0.6 * weights[False]


def test_the_file_says_what_it_holds(files: dict[bool, bytes]) -> None:
    facts = {p.key: json.loads(p.value) for p in onnx.load_from_string(files[True]).metadata_props}
    seen = {"points": POINTS, "anchors": ANCHORS, "neighbours": NEIGHBOURS, "kinds": "all", "radius": None}
    assert facts["features"] == seen
    assert GraFuConfig(**facts["config"]) == TINY
    assert facts["labels"][-1] == "unknown"


def test_the_file_names_no_place(files: dict[bool, bytes]) -> None:
    assert str(Path(__file__).parents[2]).encode() not in files[False]


def test_pairs_are_told_from_slots(files: dict[bool, bytes]) -> None:
    outputs = {o.name: len(o.type.tensor_type.shape.dim) for o in onnx.load_from_string(files[False]).graph.output}
    assert {name for name, rank in outputs.items() if rank >= 2} - {"category", "centre", "half"} == set(PAIR_OUTPUTS)
