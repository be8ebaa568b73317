"""The option `--move`: how single parts move, instead of what the motion source says. It moves nothing itself."""

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from grafu.pipeline.motion_source import SourceOption
    from grafu.pipeline.settings import Settings

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


def with_moves(
    settings: "Settings", moves: "Sequence[Move]", alone: bool, prediction: "SourceOption | None"
) -> "Settings":
    """Returns the settings in which these parts move so; `alone` says that there is one input only.

    Raises:
        OptionError: if there are several inputs, or the motions are another system's.
    """
    from grafu.errors import OptionError
    from grafu.realization.motion_choice import choice_in_words

    if not alone:
        raise OptionError("`--move` names parts of one model: give one input")
    if prediction is not None:
        raise OptionError(f"`--move` and `--motion {prediction.source}` exclude each other: leave one of them out")
    for part, word in moves:
        settings = settings.with_motion(part, choice_in_words(word))
    return settings
