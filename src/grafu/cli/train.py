"""The verb `train`: trains the network, goes on with a run that was cut, or writes its best weights as ONNX.

What the verbs that train have in common: where models come from, what computes, and the packages that it takes.
"""

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from grafu.cli.input_options import positive_count
from grafu.cli.synth import whole_number
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


CONFIGS = ("base", "paper", "small", "tiny")

_DESCRIPTION = """\
Trains the network that completes functional graphs, and keeps in DIR what it needs to go on, the weights that did best
on furniture that it never trained on, and a log (CSV and TensorBoard). Stopped by Ctrl-C or a signal, or killed, it
goes on with --resume. A GPU is used where there is one, several with `torchrun --nproc-per-node N -m grafu.cli.main`.

With --export it trains nothing and writes the best weights of the run in DIR as one ONNX file.
"""
_EXAMPLES = """\
examples:
  grafu train --config base --out runs/base --resume
  grafu train --config paper --data FurFun-233 --out runs/paper
  grafu train --out runs/base --export grafu.onnx
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "train", help="train the network (needs grafu[train])", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="the folder of the run")
    parser.add_argument(
        "--config",
        choices=CONFIGS,
        default="base",
        help="base: what is shipped; paper: the paper's numbers; small: what `ablate` compares by; "
        "tiny: to see that all works (default: base)",
    )
    parser.add_argument("--resume", action="store_true", help="go on where the run in DIR was cut, if there is one")
    add_training_options(parser)
    parser.add_argument(
        "--steps", type=positive_count, metavar="N", help="how many steps in all (default: the config's)"
    )
    parser.add_argument(
        "--seed", type=whole_number, metavar="S", help="which weights and models (default: the config's)"
    )
    parser.add_argument(
        "--jobs",
        type=positive_count,
        metavar="J",
        help="processes that make models (default: as many as cores, up to 8)",
    )
    parser.add_argument(
        "--threads", type=positive_count, metavar="T", help="threads that compute (default: one per core)"
    )
    parser.add_argument(
        "--export", type=Path, metavar="FILE", help="write the best weights of DIR as ONNX, train nothing"
    )
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Does what was asked for; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong, or files cannot be read or written.
    """
    with training_packages():
        from grafu.cli.train_run import export_weights, run_training
    return export_weights(options.out, options.export) if options.export else run_training(options)
