"""The option `--move`: how single parts move, instead of what the motion source states. It moves nothing itself.

The option --motion: a source of motions, or another system's file.
"""

import argparse
from typing import TYPE_CHECKING

from grafu.errors import OptionError
from grafu.pipeline.motion_source import SourceOption, parse_motion


def motion_choice(text: str) -> SourceOption:
    """Returns the choice that `SOURCE` or `SOURCE:FILE` states; raises argparse's error where there is none."""
    try:
        return parse_motion(text)
    except OptionError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


if TYPE_CHECKING:
    from collections.abc import Sequence

    from grafu.pipeline.motion_source import SourceOption
    from grafu.pipeline.settings import Settings

SIDES = ("left", "right", "top", "bottom")
MOTIONS = (*SIDES, "slides", "fixed")
OLD_FIXED = "not"  # the word of earlier versions for `fixed`
Move = tuple[str, str]


def part_move(text: str) -> Move:
    """Returns a part's id and how it moves, of `PART=HOW`.

    Raises:
        argparse.ArgumentTypeError: if it is not of that form.
    """
    part, _, motion = text.rpartition("=")
    if part and motion == OLD_FIXED:
        raise argparse.ArgumentTypeError(f"`not` is called `fixed` now: use --move {part}=fixed")
    if not part or motion not in MOTIONS:
        raise argparse.ArgumentTypeError(f"must be PART=HOW, HOW one of {', '.join(MOTIONS)}: got {text!r}")
    return part, motion


def with_moves(
    settings: "Settings", moves: "Sequence[Move]", alone: bool, prediction: "SourceOption | None"
) -> "Settings":
    """Returns the settings in which these parts move so; `alone` states that there is one input only.

    Raises:
        OptionError: if there are several inputs, or the motions are another system's.
    """
    from grafu.errors import OptionError
    from grafu.joints.motion_choice import choice_in_words

    if not alone:
        raise OptionError("`--move` names parts of one model: give one input")
    if prediction is not None:
        raise OptionError(f"`--move` and `--motion {prediction.source}` exclude each other: leave one of them out")
    for part, word in moves:
        settings = settings.with_motion(part, choice_in_words(word))
    return settings
