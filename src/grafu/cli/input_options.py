"""The options that say how an input is read, shared by every verb that reads one.

The option `--limit NAME=NUMBER`: how large an input may be.
"""

import argparse
from collections.abc import Sequence
from dataclasses import replace

from grafu.asset.options import Limits, LoadOptions
from grafu.geometry.lengths import metres_of


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


LABELS = ("input", "none")
DIVISIONS = ("auto", "input", "loose")
PIECES = ("together", "split")


def add_input_options(parser: argparse.ArgumentParser) -> None:
    """Adds --labels, --parts, --pieces, --piece, --up, --front, --scale and --height."""
    group = parser.add_argument_group("how the input is read (by default it is detected, and the report states how)")
    group.add_argument(
        "--labels",
        choices=LABELS,
        help="take part categories from the input's names, or ignore them (default: input)",
    )
    group.add_argument(
        "--parts",
        choices=DIVISIONS,
        help="take the input's objects as parts but cut those that hide doors or drawers, take them as they are, "
        "or take each connected shell of a mesh (default: auto)",
    )
    group.add_argument(
        "--pieces",
        choices=PIECES,
        help="of a file that holds several pieces of furniture (a row, a room): take all together as one model, or "
        "split them, a model for each (default: together)",
    )
    group.add_argument(
        "--piece", type=positive_count, metavar="N", help="with --pieces split: take the piece of this number alone"
    )
    group.add_argument("--up", metavar="AXIS", help="the input's axis that points up, say +Z")
    group.add_argument("--front", metavar="AXIS", help="the input's axis that points out of the front, say -Y")
    group.add_argument("--scale", type=_number, metavar="S", help="metres per unit of the input, say 0.01")
    group.add_argument(
        "--height",
        type=_length,
        metavar="M",
        help="the real height in metres, or with its unit: 0.72, 72cm, 720mm, 28.3in, 2.4ft (wins over --scale)",
    )


_READING = ("up", "front", "scale", "height", "labels", "parts", "pieces", "piece")


def load_options(options: argparse.Namespace, base: LoadOptions = LoadOptions()) -> LoadOptions:
    """Returns the reader's options that the arguments state; what they leave out is as in `base`.

    Raises:
        AssetError: if a direction is not an axis or a size is not positive.
    """
    given = {name: getattr(options, name) for name in _READING}
    stated = {name: value for name, value in given.items() if value is not None}
    if "scale" in stated:
        stated = {"height": None, **stated}  # the height of `base` would win over it
    if stated.get("pieces") == "together":
        stated = {"piece": None, **stated}  # that of `base` is none of this model
    return replace(base, **stated)


def join_directions(arguments: Sequence[str]) -> list[str]:
    """Returns the arguments with `--front -Y` written as `--front=-Y`: argparse takes a lone `-Y` for an option."""
    joined: list[str] = []
    for argument in arguments:
        if (
            joined
            and joined[-1] in ("--up", "--front")
            and argument[:1] == "-"
            and argument[1:].upper() in ("X", "Y", "Z")
        ):
            joined[-1] += f"={argument}"
        else:
            joined.append(argument)
    return joined


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise argparse.ArgumentTypeError(f"must be a number: got {text!r}") from None


def _length(text: str) -> float:
    """Returns a length in metres: a number of metres, or one with a unit behind it."""
    try:
        return metres_of(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def positive_count(text: str) -> int:
    """Returns the number; raises argparse's error unless it is a whole number above 0."""
    if not (text.isascii() and text.isdigit() and int(text) > 0):
        raise argparse.ArgumentTypeError(f"must be a whole number above 0: got {text!r}")
    return int(text)
