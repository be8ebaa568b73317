"""The verb `synth`: makes synthetic furniture with ground truth: a data set, pictures, or statistics."""

import argparse
import os
from pathlib import Path

from grafu.cli.input_options import positive_count
from grafu.errors import ExportError

FORMATS = ("shards", "furfun")
_COUNTS = {"data set": 1000, "gallery": 24, "stats": 500}  # a gallery of 24 is one page, 500 models steady percentiles

_DESCRIPTION = """\
Makes furniture: labelled, articulated, untidy as real models are, each with the graph of its repaired version. It
writes a data set to DIR; run again, it goes on where it was stopped. With --gallery it writes DIR/gallery.html and
DIR/gallery.png instead, with --stats it prints how made furniture compares with a folder of real models.

The same seed makes the same models, whatever the number of --jobs.
"""
_EXAMPLES = """\
examples:
  grafu synth --count 10000 --out data
  grafu synth --count 200 --seed 7 --format furfun --out furfun_like
  grafu synth --gallery --out pictures
  grafu synth --stats models --count 500
"""


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser("synth", help="make furniture to learn from", description=_DESCRIPTION, epilog=_EXAMPLES)
    parser.add_argument(
        "--count",
        type=positive_count,
        metavar="N",
        help="how many models (default: 1000; of a gallery 24, of statistics 500)",
    )
    parser.add_argument("--seed", type=whole_number, default=0, metavar="S", help="which furniture (default: 0)")
    parser.add_argument("--out", type=Path, metavar="DIR", help="where the data set or the gallery goes")
    parser.add_argument("--jobs", type=positive_count, metavar="J", help="processes (default: one per core)")
    parser.add_argument(
        "--format",
        choices=FORMATS,
        default="shards",
        help="shards: ours, a thousand models in each file; furfun: folders laid out as FurFun-233 (default: shards)",
    )
    parser.add_argument(
        "--points", type=whole_number, default=512, metavar="P", help="surface points on each part (default: 512)"
    )
    parser.add_argument(
        "--models-per-shard", type=positive_count, default=1000, metavar="N", help="models in a file (default: 1000)"
    )
    parser.add_argument(
        "--check",
        action="store_true",
        help="judge each new model: joints, collisions, labels, graph; exit 1 on faults",
    )
    parser.add_argument("--overwrite", action="store_true", help="start again where a data set or gallery is there")
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--gallery", action="store_true", help="write pictures of the models instead of a data set")
    instead.add_argument(
        "--stats",
        nargs="?",
        const="",
        metavar="MODELS",
        help="print statistics instead, beside those of the real models in this folder",
    )
    parser.set_defaults(run=run)
    return parser


def run(options: argparse.Namespace) -> int:
    """Makes what was asked for; returns the exit code.

    Raises:
        FunctionalizationError: if the options are wrong or the output cannot be written.
    """
    options.jobs = options.jobs or os.cpu_count() or 1
    task = "stats" if options.stats is not None else "gallery" if options.gallery else "data set"
    options.count = options.count or _COUNTS[task]
    if task != "stats" and options.out is None:
        raise ExportError(f"a {task} goes into a folder: give --out DIR")
    if task == "data set":
        from grafu.cli.synth_run import run_dataset

        return run_dataset(options)
    from grafu.cli.synth_show import print_statistics, write_gallery

    return print_statistics(options) if task == "stats" else write_gallery(options)


def whole_number(text: str) -> int:
    """Returns the number; raises argparse's error unless it is 0 or a whole number above."""
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f"must be a whole number, 0 or above: got {text!r}")
    return int(text)
