"""Folders of processes that Blender left behind as it died: a lock states whose are in use; the rest is removed.

A folder is in use as long as Blender, or the process that works in it, lives: both hold its `output.txt` open.
"""

import shutil
import tempfile
from pathlib import Path
from time import time

PREFIX = "grafu_blender_"
_YOUNG = 60.0  # seconds in which a folder may not have its lock yet


def hold(output) -> None:
    """Marks the folder of an open file as in use, for as long as the file is open here or in a process that has it."""
    try:
        import fcntl
    except ImportError:  # on Windows what is open cannot be moved
        return
    fcntl.flock(output, fcntl.LOCK_EX | fcntl.LOCK_NB)


def clear() -> None:
    """Removes the folders that are no longer used."""
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        try:
            if time() - folder.stat().st_mtime > _YOUNG and not _is_held(folder):
                shutil.rmtree(folder, ignore_errors=True)
        except OSError:  # of another process, or gone meanwhile
            continue


def _is_held(folder) -> bool:
    try:
        import fcntl
    except ImportError:
        return _is_open(folder)
    output = folder / "output.txt"
    if not output.exists():
        return False
    with open(output, "rb") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            return True
    return False


def _is_open(folder) -> bool:
    moved = folder.with_name(f"{folder.name}_left")
    try:
        folder.rename(moved)
    except OSError:
        return True
    moved.rename(folder)
    return False
