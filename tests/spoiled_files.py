"""Files that are not what they should be, in place of good ones: for every reader of files that grafu wrote itself."""

import os
from collections.abc import Callable
from pathlib import Path


def _pipe(path: Path) -> None:
    path.unlink()
    os.mkfifo(path)


def _link(path: Path) -> None:
    elsewhere = path.resolve().parent.with_name(f"{path.resolve().parent.name}_elsewhere") / path.name
    elsewhere.parent.mkdir(exist_ok=True)
    path.rename(elsewhere)
    path.symlink_to(elsewhere)


def _huge(path: Path) -> None:
    with path.open("r+b") as file:
        file.truncate(2**40)  # of zeros that take no room


def _folder(path: Path) -> None:
    path.unlink()
    path.mkdir()


SPOILS: dict[str, Callable[[Path], None]] = {
    **({"named pipe": _pipe} if hasattr(os, "mkfifo") else {}),
    "link that leads out": _link,
    "more than": _huge,
    "folder": _folder,
}
"""What happens to a file, by words that the refusal holds."""

DAMAGED = {
    "nested": b"[" * 100_000,
    "no text": b"\xff\xfe\x00",
    "cut": b'{"schema": "gr',
    "nothing": b"",
    "list": b"[1]",
}
"""What may stand in a JSON file instead."""
