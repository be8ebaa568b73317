"""An export is a table from relative names to bytes; this module alone writes it, whole or not at all.

A folder appears by one rename from a temporary folder beside it, so that no half-written folder is ever visible. In it
stands a marker (`grafu.export.marker`): a folder without one is never replaced, and of one that is replaced whatever
the marker does not list stays in it.
"""

import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import field
from pathlib import Path, PurePosixPath
from types import MappingProxyType
from typing import final

from grafu.articulation.articulated_object import ArticulatedObject
from grafu.asset.regular_files import MARKER
from grafu.dataclass import dataclass
from grafu.errors import ExportError
from grafu.export.marker import Marker, read_marker
from grafu.export.output_names import same_place
from grafu.export.whole_file import hidden_name, whole_file


def not_coupled(articulated: ArticulatedObject, file: str) -> tuple[str, ...]:
    """Returns the note of a format that cannot say that joints follow others; none where none does."""
    said = [f"{j.id} follows {j.coupling.leader}" for j in articulated.moving_joints if j.coupling is not None]
    return (f"{file} cannot say that {', '.join(said)}: its joints move by themselves there",) if said else ()


@final
@dataclass(frozen=True)
class ExportFiles:
    """Relative names (with `/`) and the bytes of each file; `formats` states which files a format consists of.

    `notes` state what was written in a simpler form or left out: because there was no time for more, or because the
    format cannot say it.

    Raises:
        ExportError: if a name is not a plain relative path or the marker's, or two names differ only in case or nest
            in one another.
    """

    contents: Mapping[str, bytes]
    formats: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

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
        object.__setattr__(self, "formats", MappingProxyType(dict(self.formats)))

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
        notes = tuple(dict.fromkeys((*self.notes, *other.notes)))
        return ExportFiles({**self.contents, **other.contents}, {**self.formats, **other.formats}, notes)


def write_files(files: ExportFiles, folder: Path, overwrite: bool = False) -> None:
    """Writes the files and a marker so that `folder` appears whole or not at all; missing parent folders are made.

    With `overwrite` an earlier output is replaced as a whole, and what its marker does not list stays in it.

    Raises:
        ExportError: if the folder exists (and may not be replaced), cannot be written, or the disk is full; then
            nothing has changed.
    """
    folder = Path(os.path.abspath(folder)).resolve()
    require_free(folder, overwrite)
    kept = _kept(folder)
    _require_room(kept, files.names, folder)
    fresh, old = hidden_name(folder, "new"), hidden_name(folder, "old")
    with _said_plainly(folder), _parents_made(folder.parent):
        try:
            _write_all(files, fresh)
            _carry(kept, folder, fresh)
            _swap(fresh, folder, old)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
            shutil.rmtree(old, ignore_errors=True)


@contextmanager
def whole_folder(folder: Path, overwrite: bool = False) -> Iterator[Path]:
    """Yields an empty folder to fill with more than memory holds; then it is put at `folder`, with a marker.

    Folders in it that have a marker of their own are listed by that. If the body fails, nothing of it is left.

    Raises:
        ExportError: as by `write_files`.
    """
    folder = Path(os.path.abspath(folder)).resolve()
    require_free(folder, overwrite)
    fresh, old = hidden_name(folder, "new"), hidden_name(folder, "old")
    with _said_plainly(folder), _parents_made(folder.parent):
        try:
            fresh.mkdir()
            yield fresh
            names, kept = tuple(_names_below(fresh)), _kept(folder)
            _require_room(kept, (*names, *(name for name in kept if (fresh / name).is_file())), folder)
            (fresh / MARKER).write_bytes(Marker(names).to_bytes())
            _carry(kept, folder, fresh)
            _swap(fresh, folder, old)
        finally:
            shutil.rmtree(fresh, ignore_errors=True)
            shutil.rmtree(old, ignore_errors=True)


def _names_below(folder: Path) -> Iterator[str]:
    """Yields the relative names of all files; of a folder in it that has a marker, that of the marker."""
    for place, folders, names in os.walk(folder):
        inside = Path(place).relative_to(folder)
        if MARKER in names and place != str(folder):
            folders.clear()
            names = [MARKER]
        yield from ((inside / name).as_posix() for name in names)


def require_free(folder: Path, overwrite: bool = False) -> None:
    """Makes sure that `write_files` may write a folder, before there is anything to write.

    Raises:
        ExportError: if the folder is a file, or holds files that grafu did not write, or may not be replaced.
    """
    if not os.path.lexists(folder):
        return
    if not folder.is_dir():
        raise ExportError(f"the output must be a folder: `{folder}` is a file; choose another --out")
    try:
        held = sorted(os.listdir(folder))
    except OSError as error:
        raise ExportError(f"cannot look into the output folder `{folder}`: {error.strerror}") from error
    if held and read_marker(folder) is None:
        raise ExportError(
            f"`{folder}` holds `{held[0]}` and no `{MARKER}`, by which grafu knows what it wrote, so it is kept: "
            "choose another --out, or move it away"
        )
    if held and not overwrite:
        raise ExportError(f"the output `{folder}` exists already: choose another --out, or give --overwrite")


def add_files(folder: Path, added: Mapping[str, Path], formats: Mapping[str, tuple[str, ...]] | None = None) -> None:
    """Copies files into a folder that `write_files` wrote, each whole, and lists them in its marker as grafu's.

    `added`: from where, by relative name. Files of these names that grafu wrote are replaced.

    Raises:
        ExportError: if grafu did not write the folder, or a file of a name is not grafu's, or one cannot be written.
    """
    marker = read_marker(folder)
    if marker is None:
        raise ExportError(f"`{folder}` holds no `{MARKER}`: files go only to a folder that grafu wrote")
    _require_room(_kept(folder), ExportFiles(dict.fromkeys(added, b"")).names, folder)
    with whole_file(folder / MARKER) as fresh:
        fresh.write_bytes(marker.with_files(formats or {}, *added).to_bytes())
    for name, source in added.items():
        with whole_file(folder / name) as fresh:
            shutil.copyfile(source, fresh)


def _require_relative(name: str) -> None:
    path = PurePosixPath(name)
    plain = name and "\\" not in name and "\0" not in name and str(path) == name
    if not plain or path.is_absolute() or ".." in path.parts or same_place(name) in (".", MARKER):
        raise ExportError(f"a file name must be a plain relative path: got `{name}`")


def _kept(folder: Path) -> list[str]:
    """Returns what in a folder of ours is not ours: relative names of files, links, and folders that hold none of ours.

    Where the marker lists that of a folder within, this one states what is ours in it.

    Raises:
        ExportError: if the folder cannot be read.
    """
    marker = read_marker(folder)
    if marker is None:
        return []
    ours = {*marker.files, *(str(parent) for name in marker.files for parent in PurePosixPath(name).parents)}
    found: list[str] = []
    with _said_plainly(folder):
        for place, folders, names in os.walk(folder, onerror=_raised):
            inside = Path(place).relative_to(folder)
            links = {name for name in folders if (Path(place) / name).is_symlink()}
            listed = {name for name in folders if (inside / name / MARKER).as_posix() in ours}
            marked = [name for name in listed - links if read_marker(folder / inside / name)]
            found += [(inside / name / one).as_posix() for name in marked for one in _kept(folder / inside / name)]
            folders[:] = [name for name in folders if name not in marked]
            held = ((inside / name).as_posix() for name in (*folders, *names))
            linked = {(inside / name).as_posix() for name in links}
            found += [name for name in held if name in linked or name not in ours]
    return found


def _raised(error: OSError) -> None:
    raise error


def _require_room(kept: Iterable[str], names: Iterable[str], folder: Path) -> None:
    """Refuses to replace what is not ours: where it has the name of a file or folder of ours, nothing is written."""
    places = {same_place(name) for name in (*names, MARKER)}
    above = {str(parent) for place in places for parent in PurePosixPath(place).parents}
    for name in kept:
        is_folder = (folder / name).is_dir() and not (folder / name).is_symlink()
        around = {str(parent) for parent in PurePosixPath(same_place(name)).parents}
        if same_place(name) in places or around & places or (not is_folder and same_place(name) in above):
            raise ExportError(
                f"`{folder / name}` is none of grafu's files, so it is kept: move it away, or choose another --out"
            )


def _carry(kept: Iterable[str], folder: Path, fresh: Path) -> None:
    """Puts what is kept into the fresh folder, too; where it was it stays as it is."""
    for name in kept:
        source, target = folder / name, fresh / name
        if source.is_dir() and not source.is_symlink():
            target.mkdir(parents=True, exist_ok=True)
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        _link_or_copy(source, target)


def _link_or_copy(source: Path, target: Path) -> None:
    """Makes `target` the same file as `source`, or its copy where the disk has no hard links; a symlink is copied."""
    if not source.is_symlink():
        with suppress(OSError):
            os.link(source, target)
            return
    shutil.copy2(source, target, follow_symlinks=False)


def _write_all(files: ExportFiles, fresh: Path) -> None:
    fresh.mkdir()
    marker = Marker(files.names, files.formats).to_bytes()
    for name, data in {**files.contents, MARKER: marker}.items():
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
