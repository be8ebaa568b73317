"""The option --motion: a source of motions, or another system's file. It reads no files."""

import argparse
from pathlib import Path

from grafu.errors import OptionError
from grafu.pipeline.motion_source import FOREIGN, MotionChoice, MotionSource

_WORDS = {source.value: source for source in MotionSource}


def motion_choice(text: str) -> MotionChoice:
    """Returns the choice that `SOURCE` or `SOURCE:FILE` states; raises argparse's error where there is none."""
    word, _, file = text.partition(":")
    source = _WORDS.get(word.strip().lower())
    if source is None:
        words = [word if source not in FOREIGN else f"{word}:FILE" for word, source in _WORDS.items()]
        raise argparse.ArgumentTypeError(f"must be one of {', '.join(words)}: got {text!r}")
    try:
        return MotionChoice(source, Path(file) if file else None)
    except OptionError as error:
        raise argparse.ArgumentTypeError(str(error)) from None
