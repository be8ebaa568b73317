"""The option --motion: a source of motions, or another system's file. It reads no files."""

import argparse

from grafu.errors import OptionError
from grafu.pipeline.motion_source import SourceOption, parse_motion


def motion_choice(text: str) -> SourceOption:
    """Returns the choice that `SOURCE` or `SOURCE:FILE` states; raises argparse's error where there is none."""
    try:
        return parse_motion(text)
    except OptionError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
