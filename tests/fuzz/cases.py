"""Cases without end: each follows from its seed and index alone."""

import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from random import Random

from fuzz import array_changes, bombs, byte_changes, json_changes, place_changes, text_changes, xml_changes
from fuzz.case import Case
from fuzz.entries import Files, read_files
from fuzz.readers import READERS
from fuzz.starting_files import STARTS

Change = Callable[[Files, Random], "Files | None"]

# How often each family is tried; one that finds nothing to change gives way to the next draw.
FAMILIES: dict[str, tuple[int, tuple[Change, ...]]] = {
    "bytes": (20, byte_changes.CHANGES),
    "json": (25, json_changes.CHANGES),
    "xml": (25, xml_changes.CHANGES),
    "text": (20, text_changes.CHANGES),
    "arrays": (25, array_changes.CHANGES),
    "places": (25, place_changes.CHANGES),
    "bombs": (15, bombs.CHANGES),
}
NAMES = tuple(STARTS)
COMMAND_RATIO = 0.1
_TRIES = 30


def make_case(seed: int, index: int) -> Case:
    """Returns the case of a seed with this index: the kinds of starting files take turns."""
    rng = Random(f"{seed}/{index}")
    start = NAMES[index % len(NAMES)]
    files, entry = start_of(start)
    by_command = READERS[start].arguments is not None and rng.random() < COMMAND_RATIO
    changes: list[str] = []
    for _ in range(rng.choices((1, 2, 3), (70, 20, 10))[0]):
        name, files = _changed(files, rng)
        changes.append(name)
    return Case(seed, index, start, tuple(changes), files, entry, by_command)


def unchanged_case(start: str, index: int, by_command: bool) -> Case:
    """Returns a case whose files are as they were made."""
    files, entry = start_of(start)
    return Case(0, index, start, (), files, entry, by_command)


@cache
def start_of(name: str) -> tuple[Files, str]:
    """Returns the starting files of a kind and the entry among them."""
    with tempfile.TemporaryDirectory() as folder:
        entry = STARTS[name](Path(folder))
        return read_files(Path(folder)), entry


def _changed(files: Files, rng: Random) -> tuple[str, Files]:
    for _ in range(_TRIES):
        [family] = rng.choices(list(FAMILIES), [weight for weight, _ in FAMILIES.values()])
        change = rng.choice(FAMILIES[family][1])
        try:
            changed = change(files, rng)
        except (OverflowError, RecursionError):  # numbers and depths of an earlier change that Python cannot handle
            continue
        if changed:
            return change.__name__, changed
    return "nothing", files
