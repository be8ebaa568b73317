"""Averages weights of one network: exported files and checkpoints of runs that went on from each other.

    python scripts/average_weights.py SOURCE... --out FILE [--config tune] [--seed 1] [--only-new]

SOURCE is a file that `grafu train --export` wrote, or best.pt or last.pt of a run (of this, its running average). Where
a source knows fewer kinds of edges than the network of --config, what it lacks is taken from the last source that knows
them. With --only-new what the first source knows stays as it is, calibration too, and only what it lacks comes from the
last one: inputs that were added later. The score of each source and of the average in validation is printed; the
average is calibrated and written as ONNX. Weights that were trained on from the same start are near enough to each
other that their mean is often better than each (Wortsman et al., Model soups, 2022). Needs torch.
"""

import argparse
import sys
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import torch  # noqa: TID251  # reads checkpoints of training
from torch import Tensor  # noqa: TID251

from grafu.cli.train import CONFIGS as NAMES
from grafu.cli.train import exported
from grafu.export.whole_file import whole_file
from grafu.network.config import GraFuConfig
from grafu.network.grafu import GraFu
from grafu.network.stored import start_from, stored_weights
from grafu.training.calibration import calibrated, temperatures
from grafu.training.config import CONFIGS
from grafu.training.source import SynthSource
from grafu.training.validation import validate, validation_batches, validation_source

Weights = Mapping[str, Tensor]
_BOXES = "encoder.nodes.box.0.weight"
"""The layer that sees materials beside the boxes of parts."""


def main() -> int:
    """Averages, judges and writes."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sources", type=Path, nargs="+", help="exported files and checkpoints")
    parser.add_argument("--out", type=Path, required=True, help="the ONNX file to write")
    parser.add_argument("--config", choices=NAMES, default="tune", help="whose network and validation (default: tune)")
    parser.add_argument("--seed", type=int, default=1, help="of the run (default: 1)")
    parser.add_argument("--only-new", action="store_true", help="take no mean: add to the first source what it lacks")
    options = parser.parse_args()
    config = CONFIGS[options.config]
    stored = [read_weights(path) for path in options.sources]
    network_config, points = network_of(config.network, stored), config.features.points
    batches = validation_batches(validation_source(SynthSource(options.seed, points), points), config)
    for path, weights in zip(options.sources, stored, strict=True):
        print(
            f"{path}: score {validate(loaded(network_config, weights), batches, config.loss)['score']:.4f}", flush=True
        )
    shapes = GraFu(network_config).state_dict()
    weights = extended(stored[0], stored[-1], shapes) if options.only_new else averaged(stored, shapes)
    network = loaded(network_config, weights)
    by_head = {} if options.only_new else temperatures(network, batches, config.loss)
    figures = validate(network, batches, config.loss)
    with whole_file(options.out) as fresh:
        fresh.write_bytes(exported(calibrated(network, by_head), config.features))
    print(f"{options.out}: score {figures['score']:.4f}")
    if by_head:
        print("temperatures: " + ", ".join(f"{name} {value:.2f}" for name, value in by_head.items()))
    return 0


def read_weights(path: Path) -> Weights:
    """Returns the weights in an exported file or a checkpoint, by name."""
    if path.suffix == ".onnx":
        return stored_weights(path.read_bytes())
    state = torch.load(path, map_location="cpu", weights_only=True)
    weights: Weights = state["weights"] if "weights" in state else state["average"]["weights"]
    return weights


def network_of(config: GraFuConfig, stored: Sequence[Weights]) -> GraFuConfig:
    """Returns the network of a configuration, without materials where no source knows these."""
    whole = GraFu(config).state_dict()[_BOXES].shape
    return config if any(weights[_BOXES].shape == whole for weights in stored) else replace(config, materials=False)


def averaged(stored: Sequence[Weights], shapes: Weights) -> Weights:
    """Returns the mean of the weights; of a larger network, what some lack is that of the last that has it."""
    found: dict[str, Tensor] = {}
    for name, own in shapes.items():
        known = [weights[name].float() for weights in stored if name in weights]
        whole = next(value for value in reversed(known) if value.shape == own.shape).clone()
        common = tuple(slice(min(value.shape[axis] for value in known)) for axis in range(own.ndim))
        whole[common] = torch.stack([value[common] for value in known]).mean(dim=0)
        found[name] = whole
    return found


def extended(first: Weights, last: Weights, shapes: Weights) -> dict[str, Tensor]:
    """Returns the weights of `first`; of a larger network, what it lacks is that of `last`."""
    found: dict[str, Tensor] = {}
    for name, own in shapes.items():
        found[name] = (first if name in first and first[name].shape == own.shape else last)[name].float().clone()
        if name in first:
            found[name][tuple(slice(size) for size in first[name].shape)] = first[name].float()
    return found


def loaded(config: GraFuConfig, weights: Weights) -> GraFu:
    """Returns the network with these weights, ready for use."""
    network = GraFu(config)
    start_from(network, weights)
    return network.eval()


if __name__ == "__main__":
    sys.exit(main())
