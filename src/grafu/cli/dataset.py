"""The verb `dataset`: results of many models as one set that others load, with splits, an index and a card."""

import argparse
import re
from collections import Counter
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from grafu.cli.input_options import positive_count
from grafu.cli.synth import whole_number
from grafu.cli.telling import add_telling_options, print_json
from grafu.cli.verb import EXIT_DONE, EXIT_FAILED, complain, say
from grafu.processes.lifetime import END_REQUESTS

if TYPE_CHECKING:
    from grafu.dataset.splits import SplitRatio
    from grafu.dataset.write import ModelOutcome

_DESCRIPTION = """\
Puts results of `grafu functionalize` into one set: WebDataset shards (DIR/train-000000.tar, ...) or a folder for each
model, an index with figures of each, splits in which near-duplicates stay together, and a card. It is read by
`grafu.dataset.load_dataset`, and by the packages webdataset and datasets.
"""
_EXAMPLES = """\
examples:
  grafu dataset results --out furniture
  grafu dataset results/* --only green --split 90/5/5 --out furniture
  grafu dataset results --format folder --license cc-by-4.0 --out furniture --overwrite
"""
_LEFT_OUT = "left out"
_UNITS = {"": 1, "KB": 10**3, "MB": 10**6, "GB": 10**9, "KIB": 2**10, "MIB": 2**20, "GIB": 2**30}


def add_parser(verbs: "argparse._SubParsersAction[argparse.ArgumentParser]") -> argparse.ArgumentParser:
    """Adds the verb and returns its parser."""
    parser = verbs.add_parser(
        "dataset", help="put results into one set that others load", description=_DESCRIPTION, epilog=_EXAMPLES
    )
    parser.add_argument(
        "results", nargs="+", type=Path, metavar="RESULTS", help="a folder of a result, or one that holds many"
    )
    parser.add_argument("--out", required=True, type=Path, metavar="DIR", help="where the set goes")
    parser.add_argument(
        "--format",
        choices=("tar", "folder"),
        default="tar",
        help="tar: shards in the form of WebDataset; folder: a folder for each model (default: tar)",
    )
    parser.add_argument(
        "--shard-size", type=byte_count, default="500MB", metavar="SIZE", help="most bytes of a shard (default: 500MB)"
    )
    parser.add_argument(
        "--split",
        type=split_ratio,
        default="80/10/10",
        metavar="A/B/C",
        help="percentages of train, validation and test (default: 80/10/10)",
    )
    parser.add_argument("--seed", type=whole_number, default=0, metavar="N", help="which splits (default: 0)")
    parser.add_argument(
        "--like", type=Path, metavar="SET", help="an earlier set: its models, by name, stay in their splits"
    )
    parser.add_argument(
        "--only",
        choices=("green", "yellow", "all"),
        default="all",
        help="the worst verdict that comes into the set: yellow leaves out red (default: all)",
    )
    parser.add_argument(
        "--license", default="unknown", metavar="NAME", help="the models' license, such as cc-by-4.0 (default: unknown)"
    )
    parser.add_argument("--jobs", type=positive_count, default=1, metavar="N", help="processes (default: 1)")
    parser.add_argument("--overwrite", action="store_true", help="replace the set that is there already")
    add_telling_options(parser, "each model")
    parser.set_defaults(run=run)
    return parser


def byte_count(text: str) -> int:
    """Returns a number of bytes, stated as `500MB` or `2GiB`; raises argparse's error where it is none."""
    found = re.fullmatch(r"(\d+(?:\.\d+)?) ?([KMG]i?B)?", text, re.IGNORECASE | re.ASCII)
    count = int(float(found[1]) * _UNITS[(found[2] or "").upper()]) if found else 0
    if count < 1:
        raise argparse.ArgumentTypeError(f"must be a size, such as 500MB or 2GB: got {text!r}")
    return count


def split_ratio(text: str) -> "SplitRatio":
    """Returns percentages, stated as `80/10/10`; raises argparse's error unless they are three that add up to 100."""
    from grafu.dataset.splits import SplitRatio
    from grafu.errors import OptionError

    try:
        return SplitRatio(tuple(float(one) for one in text.split("/")))
    except (ValueError, OptionError):
        raise argparse.ArgumentTypeError(
            f"must be percentages of train, validation and test that add up to 100, as 80/10/10: got {text!r}"
        ) from None


def run(options: argparse.Namespace) -> int:
    """Writes the set and prints a summary; returns 1 if some results could not be used, else 0.

    Raises:
        FunctionalizationError: if none can be used, or the set cannot be written.
    """
    from concurrent.futures.process import BrokenProcessPool

    try:
        return _written(options)
    except BrokenProcessPool:
        if END_REQUESTS.are_made:  # the same request ended the workers
            raise KeyboardInterrupt from None
        complain(
            "a process died (out of memory, or a crash in a native library): try fewer --jobs; nothing was written"
        )
        return EXIT_FAILED


def _written(options: argparse.Namespace) -> int:
    from grafu.dataset.index import writes_parquet
    from grafu.export.whole_file import clear_remains

    clear_remains(options.out.absolute().parent)  # of a run that was killed
    counts, errors = Counter[tuple[str, str]](), 0
    for outcome in _complained_of(_outcomes(options)):
        errors += bool(outcome.error)
        if not outcome.error:
            counts[outcome.row["split"] if outcome.row else _LEFT_OUT, outcome.verdict] += 1
        if options.json_lines:
            print_json(outcome_line(outcome))
    _print_counts(counts, options.out)
    if not writes_parquet():
        say("index.parquet was left out: pip install 'grafu[dataset]' (index.jsonl holds the same)")
    return EXIT_FAILED if errors else EXIT_DONE


def _complained_of(outcomes: "Iterator[ModelOutcome]") -> "Iterator[ModelOutcome]":
    """Yields the outcomes, and states each error when the next comes: that of a single result is raised again."""
    waiting, count = "", 0
    try:
        for outcome in outcomes:
            if waiting:
                complain(waiting)
            waiting, count = outcome.error, count + 1
            yield outcome
    finally:
        if waiting and count > 1:
            complain(waiting)


def _outcomes(options: argparse.Namespace) -> "Iterator[ModelOutcome]":
    from grafu.cli.item_bar import with_progress
    from grafu.dataset.write import ResultSetPlan, write_result_set

    plan = ResultSetPlan(
        options.format,
        options.shard_size,
        options.split,
        options.seed,
        options.only,
        options.license,
        options.jobs,
        options.like,
    )
    watch = partial(with_progress, shown=not (options.quiet or options.json_lines))
    return write_result_set(options.results, options.out, plan, options.overwrite, watch)


def outcome_line(outcome: "ModelOutcome") -> dict[str, object]:
    """Returns what `--json` prints of one result (docs/datasets.md); `split` is null for what is not in the set."""
    row = outcome.row or {}
    return {
        "name": outcome.folder.name,
        "folder": str(outcome.folder),
        **{name: row.get(name) for name in ("split", "shard")},
        "verdict": outcome.verdict or None,
        **{name: row.get(name) for name in ("geometric_hash", "group", "group_size")},
        "error": outcome.error or None,
    }


def _print_counts(counts: Counter[tuple[str, str]], out: Path) -> None:
    from grafu.cli.terminal import plain_table, wide_console
    from grafu.dataset.layout import SPLITS
    from grafu.pipeline.words import Colour

    table = plain_table("split", "models", *Colour)
    for split in (*SPLITS, _LEFT_OUT):
        held = [counts[split, colour] for colour in Colour]
        if any(held):
            table.add_row(split, str(sum(held)), *map(str, held))
    wide_console().print(table)
    say(f"written to {out}")
