"""Searches for garbage: none while many modules are imported, and few in a process of our own."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

_SELDOM: Final = 100_000, 20, 20
"""Hardly a value is in a circle of references: 5 % of the time were spent to look for such."""


@contextmanager
def without_collecting() -> Iterator[None]:
    """Imports many modules at a go: what they hold stays, to look for garbage among it takes a tenth of the time.

    What is there afterwards counts as old: else the next search, right after this, would be through all of it.
    """
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if gc.get_freeze_count() == 0:  # what a program has frozen stays so
            gc.freeze()
            gc.unfreeze()
        if was_on:
            gc.enable()


def collect_seldom() -> None:
    """Has a process of our own look for garbage seldom."""
    gc.set_threshold(*_SELDOM)


def end_without_collecting() -> None:
    """Has a process of our own end without a search through all that it holds, which ends with it.

    Its files are closed by then, and what is to be called at its end is still called.
    """
    gc.freeze()
