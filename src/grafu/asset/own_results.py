"""How a folder that grafu wrote is distinguished from an input: by the marker in it. It reads no input."""

from pathlib import Path
from typing import Final

MARKER: Final = ".grafu.json"


def is_own_result(folder: Path) -> bool:
    """Whether grafu wrote this folder; readers pass it over where they look for an input around it."""
    return (folder / MARKER).is_file()
