"""The folders in a model's folder that a reader may look into: none that grafu wrote. It opens no file."""

import os
from pathlib import Path
from typing import Final

MARKER: Final = ".grafu.json"


def is_own_result(folder: Path) -> bool:
    """Whether grafu wrote this folder; readers pass it over where they look for an input around it."""
    return (folder / MARKER).is_file()


def folders_within(folder: Path) -> list[Path]:
    """Returns the folders directly in a folder, sorted: none that grafu wrote, no link that leads out.

    Raises:
        OSError: if the folder cannot be looked into.
    """
    found = sorted(path for path in folder.iterdir() if path.is_dir() and not is_own_result(path))
    return [path for path in found if is_within(path, folder)]


def is_within(path: Path, folder: Path) -> bool:
    """Whether a path lies in a folder, links of both followed."""
    return Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder))


def files_below(folder: Path, suffixes: tuple[str, ...]) -> list[Path]:
    """Returns the files of these kinds in the folder, or else those in the folders directly in it, sorted.

    Raises:
        OSError: if one of them cannot be looked into.
    """
    here = _files(folder, suffixes)
    return here or sorted(path for below in folders_within(folder) for path in _files(below, suffixes))


def _files(folder: Path, suffixes: tuple[str, ...]) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.suffix.lower() in suffixes and path.is_file())
