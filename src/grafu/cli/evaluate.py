"""The verb `evaluate`: the paper's tables on any data, for any method."""

import argparse
from pathlib import Path

from grafu.cli.input_options import positive_count
from grafu.cli.limit_options import add_limit_options

# As in `grafu.evaluation.tasks`; spelled again, so that `grafu --help` answers at once.
_TABLES = "motion,masking,static,models,ood"
_METHODS = "annotation,rule,network"
_SECONDS = 900.0  # for a task: to make a model and to measure it

_DESCRIPTION = """\
Has each method make each model, measures every part that counts, and writes tables to DIR/tables as Markdown, CSV,
JSON and LaTeX, with index.md that says how each figure was measured, and DIR/index.html to sort and look at. What is
done stands in DIR/rows.jsonl: stopped or
killed, the same command goes on.

data:    a folder of models whose joints are annotated (PartNet-Mobility, HSSD with S2O annotations, URDF, the authors'
         releases), or synth:SEED:COUNT for made furniture
methods: annotation, rule, network, and what others predicted: particulate:DIR, singapo:DIR, grafu-pred:DIR, urdf:DIR,
         where DIR holds one entry per model id
tables:  motion, masking (labels hidden), static (tops, grasps, interiors), models (worst first), ood (farthest from
         what the network was trained on)
"""
_EXAMPLES = """\
examples:
  grafu evaluate --data models --out results
  grafu evaluate --data models --methods network,particulate:predictions --tables motion,models --out results
  grafu evaluate --data synth:990002:100 --methods rule,network --out results
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "evaluate", help="measure methods on annotated models: the paper's tables", description=_DESCRIPTION,
        epilog=_EXAMPLES,
    )  # fmt: skip
    parser.add_argument("--data", required=True, metavar="DATA", help="the models: a folder, or synth:SEED:COUNT")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="where rows and tables go")
    parser.add_argument("--methods", default=_METHODS, metavar="LIST", help=f"what is compared (default: {_METHODS})")
    parser.add_argument("--tables", default=_TABLES, metavar="LIST", help=f"what is written (default: {_TABLES})")
    parser.add_argument(
        "--seeds", type=positive_count, default=5, metavar="N", help="draws of hidden labels at each rate (default: 5)"
    )
    parser.add_argument("--jobs", type=positive_count, metavar="J", help="processes (default: one per core)")
    parser.add_argument("--overwrite", action="store_true", help="measure everything anew")
    add_limit_options(parser, _SECONDS)
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Measures what is not measured yet and writes the tables; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong, or there is nothing to measure.
    """
    from grafu.cli.evaluate_run import run_evaluation

    return run_evaluation(options)
