"""The verb `synth`: makes synthetic furniture with ground truth: a data set, pictures, or statistics."""

import argparse
import os
from collections.abc import Iterator
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING

from grafu.cli.input_options import positive_count
from grafu.cli.verb import complain, say
from grafu.errors import ExportError, UnreadableAsset

if TYPE_CHECKING:
    from grafu.data.write_plan import DatasetPlan, ModelSummary
    from grafu.evaluation.statistics import StatisticsTable
    from grafu.synth.specimen import Specimen

FORMATS = ("shards", "furfun")
_COUNTS = {"data set": 1000, "gallery": 24, "stats": 500}  # a gallery of 24 is one page, 500 models steady percentiles

_DESCRIPTION = """\
Generates synthetic furniture: labelled and articulated, with modelling noise as in real models, each with the graph
of its repaired version. It writes a data set to DIR; run again, it resumes where it was stopped. With --gallery it
writes DIR/gallery.html and DIR/gallery.png instead, with --stats it prints how synthetic furniture compares with a
folder of real models.

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
    parser = verbs.add_parser(
        "synth", help="generate synthetic furniture to train on", description=_DESCRIPTION, epilog=_EXAMPLES
    )
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
        return run_dataset(options)
    return print_statistics(options) if task == "stats" else write_gallery(options)


def whole_number(text: str) -> int:
    """Returns the number; raises argparse's error unless it is 0 or a whole number above."""
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f"must be a whole number, 0 or above: got {text!r}")
    return int(text)


EXIT_DONE, EXIT_FAILED, EXIT_INTERRUPTED = 0, 1, 130


def run_dataset(options: argparse.Namespace) -> int:
    """Makes the data set, or the rest of it, and prints a summary; returns the exit code, 1 where --check found faults.

    Raises:
        FunctionalizationError: if the folder cannot be gone on with, or not be written.
    """
    from grafu.cli.item_bar import with_progress
    from grafu.cli.synth_tally import SynthTally, print_tally
    from grafu.data.write import models_written
    from grafu.data.write_plan import DatasetPlan
    from grafu.processes.lifetime import END_REQUESTS

    plan = DatasetPlan(options.seed, options.count, options.points, options.models_per_shard, options.format)
    tally, started = SynthTally(), perf_counter()
    try:
        for summary in with_progress(_summaries(plan, options), plan.count, "models"):
            tally.add(summary)
    except KeyboardInterrupt:
        complain(f"interrupted; {_kept(options)}")
        return EXIT_INTERRUPTED
    except BrokenProcessPool:
        if END_REQUESTS.are_made:  # the same request ended the workers
            complain(f"interrupted; {_kept(options)}")
            return EXIT_INTERRUPTED
        complain(f"a process died (out of memory, or a crash in a native library): try fewer --jobs; {_kept(options)}")
        return EXIT_FAILED
    seconds = perf_counter() - started
    print_tally(tally, seconds, options.out, before=models_written(options.out) - tally.fresh)
    return EXIT_FAILED if tally.faulty else EXIT_DONE


def _summaries(plan: "DatasetPlan", options: argparse.Namespace) -> "Iterator[ModelSummary]":
    from grafu.data.write import write_dataset

    return write_dataset(plan, options.out, options.jobs, options.overwrite, options.check)


def _kept(options: argparse.Namespace) -> str:
    """Says what there is and how to go on."""
    from grafu.data.write import models_written

    count = models_written(options.out)
    return f"{count} models stand in whole files in {options.out}; the same command without --overwrite goes on"


_OUTLIERS = 3  # names in a row of the table; the rest is counted


def write_gallery(options: argparse.Namespace) -> int:
    """Writes the page and the sheet of pictures; returns 0.

    Raises:
        ExportError: if the folder is taken or cannot be written.
    """
    from grafu.data.gallery import gallery_page
    from grafu.export.files import write_files

    if not options.overwrite and options.out.is_dir() and any(options.out.iterdir()):
        raise ExportError(f"the output `{options.out}` exists already: choose another --out, or give --overwrite")
    write_files(gallery_page(_specimens(options)), options.out, options.overwrite)
    say(f"written to {options.out}")
    return 0


def print_statistics(options: argparse.Namespace) -> int:
    """Prints the statistics of synthetic furniture, beside those of a folder of real models if one is given; returns 0.

    Raises:
        UnreadableAsset: if the folder is none.
    """
    from grafu.evaluation.statistics import compare

    real = Path(options.stats) if options.stats else None
    if real is not None and not real.is_dir():
        raise UnreadableAsset(f"`{real}` must be a folder of models: there is none")
    _print_comparison(compare(_specimens(options), real))
    return 0


def _specimens(options: argparse.Namespace) -> "Iterator[Specimen]":
    from grafu.cli.item_bar import with_progress
    from grafu.data.stream import stream_specimens

    made = stream_specimens(options.seed, jobs=options.jobs, points=options.points, stop=options.count)
    return with_progress(made, options.count, "models")


def _print_comparison(comparison: "StatisticsTable") -> None:
    from rich.markup import escape

    from grafu.cli.terminal import plain_table, wide_console
    from grafu.evaluation.statistics import number_text

    table = plain_table(
        "measure", "synthetic: 5 · 50 · 95 %", "real: 5 · 50 · 95 %", "real within", "verdict", "outside"
    )
    for row in comparison.rows:
        within = "" if row.within is None else f"{row.within:.0%}"
        names = [f"{name} {number_text(value, row.is_ratio)}" for name, value in row.outliers[:_OUTLIERS]]
        more = [f"and {len(row.outliers) - _OUTLIERS} more"] if len(row.outliers) > _OUTLIERS else []
        spreads = ("" if spread is None else spread.text(row.is_ratio) for spread in (row.synthetic, row.real))
        table.add_row(escape(row.measure), *spreads, within, row.verdict, escape(", ".join(names + more)))
    console = wide_console()
    console.print(table)
    for why in comparison.unread:
        console.print(f"not read: {why}", soft_wrap=True, markup=False, highlight=False)
    console.print(_sum(comparison), soft_wrap=True, markup=False, highlight=False)


def _sum(comparison: "StatisticsTable") -> str:
    made = f"{comparison.synthetic} synthetic models"
    if not comparison.real:
        return made
    inside = len(comparison.rows) - len(comparison.failing)
    return f"{made} and {comparison.real} real ones: in {inside} of {len(comparison.rows)} measures the real lie within"
