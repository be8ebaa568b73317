"""The option `--move`: how single parts move, instead of what the motion source says. It moves nothing itself."""

import argparse
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grafu.cli.job import JobOptions

SIDES = ("left", "right", "top", "bottom")
WAYS = (*SIDES, "slides", "not")
Move = tuple[str, str]


def part_move(text: str) -> Move:
    """Returns a part's id and how it moves, of `PART=HOW`.

    Raises:
        argparse.ArgumentTypeError: if it is not of that form.
    """
    part, _, way = text.rpartition("=")
    if not part or way not in WAYS:
        raise argparse.ArgumentTypeError(f"must be PART=HOW, HOW one of {', '.join(WAYS)}: got {text!r}")
    return part, way


def with_moves(options: "JobOptions", moves: "Sequence[Move]") -> "JobOptions":
    """Returns the options as settings in which these parts move so.

    Raises:
        OptionError: if there are several inputs, or the motions are another system's.
    """
    from grafu.cli.job import settings_of
    from grafu.errors import OptionError
    from grafu.realization.motion_choice import choice_in_words

    if not options.alone:
        raise OptionError("`--move` names parts of one model: give one input")
    settings = settings_of(options)
    if settings is None:
        raise OptionError(f"`--move` and `--motion {options.motion.source}` exclude each other: leave one of them out")
    for part, word in moves:
        settings = settings.with_motion(part, choice_in_words(word))
    return replace(options, settings=settings)
