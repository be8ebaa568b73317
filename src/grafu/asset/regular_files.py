"""Regular files opened with care: nothing else is opened, nothing is waited for, and no link is followed by surprise.

A named pipe would wait for ever, a device might never end or do something when it is opened, and `/proc` tells of the
process.

The folders in a model's folder that a reader may look into: none that grafu wrote.
"""

import os
import stat
from pathlib import Path
from typing import BinaryIO, Final

_FLAGS: Final = (
    os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_CLOEXEC", 0) | getattr(os, "O_NOCTTY", 0)
) | getattr(os, "O_BINARY", 0)
_NO_LINK: Final = getattr(os, "O_NOFOLLOW", 0)
_FOLDER: Final = getattr(os, "O_PATH", os.O_RDONLY) | getattr(os, "O_DIRECTORY", 0) | getattr(os, "O_CLOEXEC", 0)
_STEPWISE: Final = os.open in os.supports_dir_fd and bool(_NO_LINK)
_KINDS: Final = (
    (stat.S_ISDIR, "it is a folder"),
    (stat.S_ISFIFO, "it is a named pipe"),
    (stat.S_ISSOCK, "it is a socket"),
    (stat.S_ISCHR, "it is a device"),
    (stat.S_ISBLK, "it is a device"),
)
_CHUNK: Final = 16 * 2**20


class NotRegular(OSError):
    """What is at a path is no regular file; `strerror` states in words what it is."""


class TooManyBytes(Exception):
    """A file holds more bytes than were asked for; `size` is how many, as far as that is known."""

    def __init__(self, size: int) -> None:
        super().__init__(size)
        self.size = size


def read_regular(path: Path, most: int, root: Path | None = None) -> bytes:
    """Returns the content of a regular file of at most `most` bytes.

    Args:
        path: the file. With a `root` it must be a real path, without links, and the root one, too: a link that another
        user
            puts there meanwhile is not followed. Without, links are followed.
        most: the largest number of bytes.
        root: a folder above it.

    Raises:
        OSError: if it cannot be opened; NotRegular if it is no regular file.
        ValueError: if the path cannot be a name of a file (it holds a NUL or half a character).
        TooManyBytes: if it is larger, whatever size it claims.
    """
    descriptor = _opened(path) if root is None or not _STEPWISE else _opened_below(root, path)
    with os.fdopen(descriptor, "rb") as file:
        state = os.fstat(file.fileno())
        _require_regular(state.st_mode, path)
        if state.st_size > most:
            raise TooManyBytes(state.st_size)
        return _content(file, most)


def read_head(path: Path, count: int) -> bytes:
    """Returns the first bytes of a regular file that the user named. Raises OSError or ValueError as `read_regular`."""
    with os.fdopen(_opened(path), "rb") as file:
        _require_regular(os.fstat(file.fileno()).st_mode, path)
        return file.read(count)


def _content(file: BinaryIO, most: int) -> bytes:
    """Returns all bytes to the end; a file that grows, or claims to be empty as those of `/proc` do, is cut short."""
    chunks: list[bytes] = []
    size = 0
    while chunk := file.read(min(_CHUNK, most + 1 - size)):
        chunks.append(chunk)
        size += len(chunk)
        if size > most:
            raise TooManyBytes(size)
    return chunks[0] if len(chunks) == 1 else b"".join(chunks)


def _opened(path: Path) -> int:
    _require_regular(os.stat(path).st_mode, path)  # before it is opened: to open a device may already do something
    return os.open(path, _FLAGS)


def _opened_below(root: Path, path: Path) -> int:
    """Returns the descriptor of a file, opened folder by folder from the root, no link followed."""
    *folders, name = path.relative_to(root).parts
    folder = os.open(root, _FOLDER)
    try:
        for step in folders:
            below = os.open(step, _FOLDER | _NO_LINK, dir_fd=folder)
            os.close(folder)
            folder = below
        _require_regular(os.stat(name, dir_fd=folder, follow_symlinks=False).st_mode, path)
        return os.open(name, _FLAGS | _NO_LINK, dir_fd=folder)
    finally:
        os.close(folder)


def _require_regular(mode: int, path: Path) -> None:
    if not stat.S_ISREG(mode):
        kind = next((words for test, words in _KINDS if test(mode)), "it is no regular file")
        raise NotRegular(0, kind, str(path))


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
