"""The option `--limit NAME=NUMBER`: how large an input may be. It reads nothing itself."""

import argparse
from dataclasses import replace

from grafu.asset.options import Limits, LoadOptions


def add_limit_option(parser: argparse.ArgumentParser) -> None:
    """Adds --limit, which may be given once for each limit."""
    names = ", ".join(Limits().by_name())
    parser.add_argument(
        "--limit",
        action="append",
        type=_limit,
        default=[],
        metavar="NAME=NUMBER",
        help=f"raise or lower a limit on what is read of one input; NAME is one of {names}",
    )


def with_limits(load: LoadOptions, options: argparse.Namespace) -> LoadOptions:
    """Returns the reader's options with the limits that the arguments state.

    Raises:
        AssetError: if there is no such limit, or it is not a whole number above 0.
    """
    limits = load.limits
    for name, value in options.limit:
        limits = limits.with_limit(name, value)
    return replace(load, limits=limits)


def _limit(text: str) -> tuple[str, int]:
    name, _, number = text.partition("=")
    if name not in Limits().by_name() or not (number.isascii() and number.isdigit() and int(number[:18]) > 0):
        known = ", ".join(Limits().by_name())
        raise argparse.ArgumentTypeError(f"must be NAME=NUMBER, NAME one of {known}: got {text[:60]!r}")
    return name, int(number[:18])
