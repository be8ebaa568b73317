"""What the verbs that train have in common: where models come from, what computes, and the packages that it takes."""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager

from grafu.errors import FunctionalizationError

_PACKAGES = ("torch", "onnx")  # of the extra `train`; those of the rest are always there


def add_training_options(parser: argparse.ArgumentParser) -> None:
    """Adds `--data` and `--device`."""
    parser.add_argument(
        "--data",
        default="synth",
        metavar="DIR",
        help="models to train on: `synth`, made on the spot; or a folder of shards or of a FurFun release "
        "(default: synth)",
    )
    parser.add_argument(
        "--device", choices=("auto", "cpu", "cuda"), default="auto", help="what computes (default: auto)"
    )


@contextmanager
def training_packages() -> Iterator[None]:
    """Says in one line which package is missing, where the body imports what trains.

    Raises:
        FunctionalizationError: if one is.
    """
    try:
        yield
    except ModuleNotFoundError as error:
        if (error.name or "").split(".")[0] not in _PACKAGES:
            raise
        said = f"training needs `{error.name}`, which is not installed: pip install 'grafu[train]'"
        raise FunctionalizationError(said) from error
