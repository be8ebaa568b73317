"""Names the weights of a file that was exported before weights had names, so that training can start from it.

    python scripts/name_weights.py FILE --out NAMED

An exporter numbers what it multiplies by in the order of the network. The same network is exported once more; weights
of one shape belong together in their order. Both files must then answer the same about a graph of random numbers.
Needs torch.
"""

import argparse
import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import torch  # noqa: TID251  # the network whose names are given
from jaxtyping import Float32

from grafu.cli.train import exported
from grafu.completion.features import FeatureConfig
from grafu.completion.name_codes import NAME_BUCKETS, NAME_CODES
from grafu.completion.session import onnx_runtime
from grafu.export.whole_file import whole_file
from grafu.graph.arrays import LABELS, NULL
from grafu.network.config import OLDER, GraFuConfig
from grafu.network.encoder import VISIBILITY_NUMBERS
from grafu.network.grafu import GraFu
from grafu.network.stored import HALF, TRANSPOSED, stored_config, stored_weights

NEAR = 1e-3  # of answers: 16-bit weights, summed in another order
PARTS = 9
Matrix = Float32[np.ndarray, "n m"]


def main() -> int:
    """Names the weights, compares the answers, and writes the file."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", type=Path, help="an ONNX file of grafu")
    parser.add_argument("--out", type=Path, required=True, help="the same network, its weights named")
    options = parser.parse_args()
    content = options.file.read_bytes()
    config, features = facts_of(content)
    network = GraFu(config)
    torch.manual_seed(0)
    with torch.no_grad():
        for weight in network.parameters():
            weight.copy_(torch.randn(weight.shape))  # no two alike: the exporter would store them once
    fresh = exported(network, features)
    network.load_state_dict(
        {name: torch.from_numpy(value) for name, value in paired(content, fresh, set(network.state_dict())).items()}
    )
    named = exported(network.eval(), features)
    apart = farthest(content, named, features)
    if apart > NEAR:
        print(f"the order of weights is another: answers differ by {apart:.3g}", file=sys.stderr)
        return 1
    with whole_file(options.out) as target:
        target.write_bytes(named)
    print(f"{options.out}: {len(network.state_dict())} weights named; answers differ by {apart:.2g} at most")
    return 0


def facts_of(content: bytes) -> tuple[GraFuConfig, FeatureConfig]:
    """Returns what the file states about its network and what it sees."""
    facts = {p.key: json.loads(p.value) for p in onnx.load_from_string(content).metadata_props}
    return stored_config(content), FeatureConfig(**({"kinds": OLDER["kinds"]} | facts["features"]))


def paired(content: bytes, fresh: bytes, wanted: set[str]) -> dict[str, np.ndarray]:
    """Returns the weights of the nameless file by the names that the fresh file of the same network has."""
    theirs, known = matrices(content), stored_weights(content)
    mine = {
        name: value
        for name, value in matrices(fresh).items()
        if name not in theirs and name.removesuffix(TRANSPOSED) in wanted
    }
    left = {name: value for name, value in theirs.items() if name.startswith("val_")}
    found = {name: known[name].numpy() for name in wanted if name in known}
    for shape in {value.shape for value in mine.values()}:
        names = [name for name, value in mine.items() if value.shape == shape]
        values = [value for value in left.values() if value.shape == shape]
        for name, value in zip(names, values, strict=True):
            found[name.removesuffix(TRANSPOSED)] = value.T.copy() if name.endswith(TRANSPOSED) else value
    return found


def matrices(content: bytes) -> dict[str, Matrix]:
    """Returns the two-dimensional weights of a file by the names that they have there, in its order."""
    proto = onnx.load_from_string(content)
    arrays = ((w.name.removesuffix(HALF), onnx.numpy_helper.to_array(w)) for w in proto.graph.initializer)
    return {name: a.astype(np.float32) for name, a in arrays if a.ndim == 2 and np.issubdtype(a.dtype, np.floating)}


def farthest(first: bytes, second: bytes, features: FeatureConfig) -> float:
    """Returns how far the answers that both files give are from each other at most."""
    rng = np.random.default_rng(0)
    anchors, neighbours = features.anchors, features.neighbours
    given = {
        "labels": rng.integers(0, len(LABELS), PARTS),
        "boxes": (0.3 * rng.random((PARTS, 6))).astype(np.float32),
        "anchors": rng.random((PARTS, anchors, 3)).astype(np.float32),
        "groups": (0.05 * rng.random((PARTS, anchors, neighbours, 3))).astype(np.float32),
        "edges": np.full((PARTS, PARTS), NULL),
        "visibility": rng.random((PARTS, VISIBILITY_NUMBERS)).astype(np.float32),
        "names": rng.integers(0, NAME_BUCKETS + 1, (PARTS, NAME_CODES)),
    }
    sessions = [onnx_runtime().InferenceSession(one) for one in (first, second)]
    ours, theirs = (answers_of(session, given) for session in sessions)
    return max(float(np.abs(ours[name] - theirs[name]).max()) for name in ours.keys() & theirs.keys())


def answers_of(session: Any, given: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Returns what a network in a session of ONNX Runtime answers to what it takes, by the names of the outputs."""
    names = [output.name for output in session.get_outputs()]
    answers = session.run(names, {item.name: given[item.name] for item in session.get_inputs()})
    return dict(zip(names, answers, strict=True))


if __name__ == "__main__":
    sys.exit(main())
