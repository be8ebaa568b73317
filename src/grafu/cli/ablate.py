"""The verb `ablate`: trains one network per experiment on a small budget, and puts their figures into one table."""

import argparse
from pathlib import Path

from grafu.cli.input_options import positive_count
from grafu.cli.synth import whole_number
from grafu.cli.train import CONFIGS, add_training_options, training_packages

KINDS = ("losses", "folds")

_DESCRIPTION = """\
Trains one network for each experiment, all for the same number of steps, and writes their figures to DIR/table.md and
DIR/table.csv, anew after each that is finished. Stopped or killed, the same command goes on; what is finished is not
trained again, so that another seed may be asked for later.

losses: the paper's six hold-outs of loss terms; then the choices in which paper, authors' code and `base` differ
folds:  0, 5, 10, 17, 20 corrupted copies of each of 200 made models, and new copies every time

The default, config `small` for 2000 steps, takes about an hour on two cores for `losses`, and shows which way things
go; for the last figure train longer: --config base --steps 20000.
"""
_EXAMPLES = """\
examples:
  grafu ablate losses --out runs/losses
  grafu ablate losses --seeds 1 2 3 --out runs/losses
  grafu ablate folds --config paper --data FurFun-233 --out runs/folds
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "ablate", help="see what each loss and copy is good for", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument("kind", choices=KINDS, metavar="{losses,folds}", help="what is varied")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="the folder of all runs and tables")
    parser.add_argument("--config", choices=CONFIGS, default="small", help="what is varied from (default: small)")
    parser.add_argument("--steps", type=positive_count, metavar="N", help="steps of each run (default: the config's)")
    parser.add_argument(
        "--seeds",
        type=whole_number,
        nargs="+",
        default=[1],
        metavar="S",
        help="every experiment once with each: which weights and models (default: 1)",
    )
    add_training_options(parser)
    parser.add_argument(
        "--jobs", type=positive_count, metavar="J", help="runs at once (default: as many as cores, up to 8)"
    )
    parser.add_argument(
        "--threads", type=positive_count, default=1, metavar="T", help="threads that each run computes on (default: 1)"
    )
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Trains what is not finished and prints the table; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong, or files cannot be read or written.
    """
    with training_packages():
        from grafu.cli.ablate_run import run_ablation
    return run_ablation(options)
