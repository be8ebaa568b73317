"""Folders for what is passed between programs: gone when they are closed, and when their process is killed."""

import os
import shutil
import tempfile
from contextlib import suppress
from pathlib import Path


def scratch_folder() -> "tempfile.TemporaryDirectory[str]":
    """Returns a new folder in the system's temporary folder, to be used in a `with`; its name says whose it is."""
    return tempfile.TemporaryDirectory(prefix=_prefix(os.getpid()))


def clear_scratch(process: int) -> None:
    """Removes the folders of a process that was killed."""
    with suppress(OSError):
        for folder in Path(tempfile.gettempdir()).glob(f"{_prefix(process)}*"):
            shutil.rmtree(folder, ignore_errors=True)


def _prefix(process: int) -> str:
    return f"grafu_scratch_{process}_"
