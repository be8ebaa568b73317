"""What lies in a folder as one value: bytes by relative path, and things that are no plain files."""

import os
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, final

Kind = Literal["link", "fifo", "folder", "sparse"]


@final
@dataclass(frozen=True)
class Odd:
    """No plain file: a link to `target`, a FIFO, an empty folder, or `size` bytes that take no place on the disk."""

    kind: Kind
    target: str = ""
    size: int = 0


Files = Mapping[str, "bytes | Odd"]


def read_files(folder: Path) -> dict[str, bytes | Odd]:
    """Returns every plain file below a folder by its path within."""
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def write_entries(files: Files, folder: Path) -> None:
    """Writes what can be written; names that the file system refuses are left out, so that the rest is still read."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, entry in files.items():
        path = folder / name
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            _write(path, entry)
        except (OSError, ValueError):
            continue


def _write(path: Path, entry: bytes | Odd) -> None:
    if isinstance(entry, bytes):
        path.write_bytes(entry)
    elif entry.kind == "link":
        path.symlink_to(entry.target)
    elif entry.kind == "fifo":
        os.mkfifo(path)
    elif entry.kind == "folder":
        path.mkdir()
    else:
        with path.open("wb") as stream:
            stream.truncate(entry.size)


def plain(files: Files, *suffixes: str) -> list[str]:
    """Returns the names of plain files, only those with one of the suffixes where some are given."""
    return [n for n, e in files.items() if isinstance(e, bytes) and (not suffixes or n.lower().endswith(suffixes))]


def data_of(files: Files, name: str) -> bytes:
    """Returns the bytes of a plain file."""
    entry = files[name]
    assert isinstance(entry, bytes)
    return entry
