"""An export is a table from relative names to bytes; this module alone writes it, whole or not at all.

It knows no format. A folder appears by one rename from a temporary folder beside it, so nobody ever sees half of it.
"""

import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path, PurePosixPath
from types import MappingProxyType
from typing import final

from grafu.errors import ExportError
from grafu.export.remains import hidden_name


@final
@dataclass(frozen=True)
class ExportFiles:
    """Relative names (with `/`) and the bytes of each file.

    Raises:
        ExportError: if a name is not a plain relative path, or two names differ only in case or nest in one another.
    """

    contents: Mapping[str, bytes]

    def __post_init__(self) -> None:
        seen: set[str] = set()
        for name in self.contents:
            _require_relative(name)
            if name.lower() in seen:
                raise ExportError(f"file names must differ in more than case: `{name}` appears twice")
            seen.add(name.lower())
        nested = sorted(n for n in seen if any(str(parent) in seen for parent in PurePosixPath(n).parents))
        if nested:
            raise ExportError(f"a file cannot also be a folder: got {nested}")
        object.__setattr__(self, "contents", MappingProxyType(dict(self.contents)))

    def __getitem__(self, name: str) -> bytes:
        return self.contents[name]

    @property
    def names(self) -> tuple[str, ...]:
        """The file names, in the order in which they were given."""
        return tuple(self.contents)

    def joined(self, other: "ExportFiles") -> "ExportFiles":
        """Returns the files of both.

        Raises:
            ExportError: if both hold a file of one name with different contents.
        """
        clash = [n for n in other.names if n in self.contents and self.contents[n] != other.contents[n]]
        if clash:
            raise ExportError(f"two exports must not write different files of one name: got {clash}")
        return ExportFiles({**self.contents, **other.contents})


def write_files(files: ExportFiles, folder: Path, overwrite: bool = False) -> None:
    """Writes the files so that `folder` appears whole or not at all; missing parent folders are made.

    With `overwrite` an earlier output is replaced as a whole. A folder that holds none of the files' names at its top
    is no earlier output and is never replaced.

    Raises:
        ExportError: if the folder exists (and may not be replaced), cannot be written, or the disk is full; then
            nothing has changed.
    """
    folder = Path(os.path.abspath(folder)).resolve()
    _require_free(files, folder, overwrite)
    fresh, old = hidden_name(folder, "new"), hidden_name(folder, "old")
    with _said_plainly(folder), _parents_made(folder.parent):
        try:
            _write_all(files, fresh)
            _swap(fresh, folder, old)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
            shutil.rmtree(old, ignore_errors=True)


def _require_relative(name: str) -> None:
    path = PurePosixPath(name)
    plain = name and "\\" not in name and "\0" not in name and str(path) == name
    if not plain or path.is_absolute() or ".." in path.parts or name == ".":
        raise ExportError(f"a file name must be a plain relative path: got `{name}`")


def _require_free(files: ExportFiles, folder: Path, overwrite: bool) -> None:
    if not os.path.lexists(folder):
        return
    if not folder.is_dir():
        raise ExportError(f"the output must be a folder: `{folder}` is a file; choose another --out")
    try:
        held = sorted(os.listdir(folder))
    except OSError as error:
        raise ExportError(f"cannot look into the output folder `{folder}`: {error.strerror}") from error
    if not held:
        return
    if not overwrite:
        raise ExportError(f"the output `{folder}` exists already: choose another --out, or give --overwrite")
    if not {PurePosixPath(name).parts[0] for name in files.names} & set(held):
        raise ExportError(f"`{folder}` holds `{held[0]}` and no earlier output, so it is kept: choose another --out")


def _write_all(files: ExportFiles, fresh: Path) -> None:
    fresh.mkdir()
    for name, data in files.contents.items():
        path = fresh / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def _swap(fresh: Path, folder: Path, old: Path) -> None:
    """Puts `fresh` where `folder` is; where that fails, `folder` is back as it was."""
    if folder.exists():
        folder.rename(old)
    try:
        fresh.rename(folder)
    except BaseException:
        if old.exists():
            old.rename(folder)
        raise


@contextmanager
def _parents_made(parent: Path) -> Iterator[None]:
    """Makes the missing parents, and takes the empty ones away again when the body fails."""
    missing = [p for p in (parent, *parent.parents) if not p.exists()]
    try:
        parent.mkdir(parents=True, exist_ok=True)
        yield
    except BaseException:
        for made in missing:
            with suppress(OSError):
                made.rmdir()
        raise


@contextmanager
def _said_plainly(folder: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise ExportError(f"cannot write the output `{folder}`: {reason}; nothing was written") from error
