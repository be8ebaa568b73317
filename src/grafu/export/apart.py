"""Results and inputs stay apart: a folder that is replaced as a whole never is an input, and never holds one."""

import os
from collections.abc import Iterable
from pathlib import Path


def why_not_apart(result: Path, inputs: Iterable[Path]) -> str:
    """Returns why results cannot go to a folder, in a line; empty where it neither is nor holds one of the inputs.

    Places are compared as the disk knows them: links, the case of letters and other ways to the same place count.
    A result inside an input's folder is fine: readers pass it over.
    """
    for given in inputs:
        if _is_same(result, given):
            return f"the results would go to `{result}`, and so replace the input `{given}`: choose another --out"
        if holds(result, given):
            return f"the results would go to `{result}`, which holds the input `{given}`: choose another --out"
    return ""


def holds(folder: Path, path: Path) -> bool:
    """Whether a path, by its name or by what it leads to, is the folder or lies in it."""
    return any(_is_same(folder, place) for place in _places(path))


def _places(path: Path) -> Iterable[Path]:
    """Yields the path and what is above it: as it is written, and with every link followed."""
    written = Path(os.path.abspath(path))
    for start in (written, Path(os.path.realpath(written.parent)) / written.name, Path(os.path.realpath(path))):
        yield from (start, *start.parents)


def _is_same(first: Path, second: Path) -> bool:
    try:
        return os.path.samefile(first, second)
    except OSError:  # what is not there is nothing, and holds nothing
        return False
