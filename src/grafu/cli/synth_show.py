"""Runs `synth` for looking at what it makes: a gallery of pictures, or statistics beside real models."""

import argparse
from collections.abc import Iterator
from pathlib import Path

from rich.markup import escape

from grafu.cli.messages import say
from grafu.cli.progress import with_progress
from grafu.cli.tables import plain_table, wide_console
from grafu.data.gallery import gallery_page
from grafu.data.stream import stream_specimens
from grafu.errors import ExportError, UnreadableAsset
from grafu.evaluation.statistics import Comparison, compare, number_text
from grafu.export.files import write_files
from grafu.synth.specimen import Specimen

_OUTLIERS = 3  # names in a row of the table; the rest is counted


def write_gallery(options: argparse.Namespace) -> int:
    """Writes the page and the sheet of pictures; returns 0.

    Raises:
        ExportError: if the folder is taken or cannot be written.
    """
    if not options.overwrite and options.out.is_dir() and any(options.out.iterdir()):
        raise ExportError(f"the output `{options.out}` exists already: choose another --out, or give --overwrite")
    write_files(gallery_page(_specimens(options)), options.out, options.overwrite)
    say(f"written to {options.out}")
    return 0


def print_statistics(options: argparse.Namespace) -> int:
    """Prints the statistics of made furniture, beside those of a folder of real models where one is given; returns 0.

    Raises:
        UnreadableAsset: if the folder is none.
    """
    real = Path(options.stats) if options.stats else None
    if real is not None and not real.is_dir():
        raise UnreadableAsset(f"`{real}` must be a folder of models: there is none")
    _print_comparison(compare(_specimens(options), real))
    return 0


def _specimens(options: argparse.Namespace) -> Iterator[Specimen]:
    made = stream_specimens(options.seed, jobs=options.jobs, points=options.points, stop=options.count)
    return with_progress(made, options.count, "models")


def _print_comparison(comparison: Comparison) -> None:
    table = plain_table("measure", "made: 5 · 50 · 95 %", "real: 5 · 50 · 95 %", "real within", "verdict", "outside")
    for row in comparison.rows:
        within = "" if row.within is None else f"{row.within:.0%}"
        names = [f"{name} {number_text(value, row.is_share)}" for name, value in row.outliers[:_OUTLIERS]]
        more = [f"and {len(row.outliers) - _OUTLIERS} more"] if len(row.outliers) > _OUTLIERS else []
        spreads = ("" if spread is None else spread.text(row.is_share) for spread in (row.synthetic, row.real))
        table.add_row(escape(row.measure), *spreads, within, row.verdict, escape(", ".join(names + more)))
    console = wide_console()
    console.print(table)
    for why in comparison.unread:
        console.print(f"not read: {why}", soft_wrap=True, markup=False, highlight=False)
    console.print(_sum(comparison), soft_wrap=True, markup=False, highlight=False)


def _sum(comparison: Comparison) -> str:
    made = f"{comparison.synthetic} made models"
    if not comparison.real:
        return made
    inside = len(comparison.rows) - len(comparison.failing)
    return f"{made} and {comparison.real} real ones: in {inside} of {len(comparison.rows)} measures the real lie within"
