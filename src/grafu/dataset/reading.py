"""Reads a set that `grafu dataset` wrote, model by model, whatever its size. It needs the standard library alone.

for sample in load_dataset("DIR", split="train"):
    sample.name, sample.report, sample.files["model.glb"]
"""

import json
import os
import tarfile
from collections.abc import Iterator, Mapping
from functools import cached_property
from io import BytesIO
from itertools import groupby
from pathlib import Path, PurePath
from types import MappingProxyType
from typing import Any, Final, final

from grafu.asset.regular_files import TooManyBytes, is_within, read_regular
from grafu.dataclass import dataclass
from grafu.dataset.layout import BUNDLE, FIGURES, INDEX, METADATA, SPLITS
from grafu.errors import OptionError, UnreadableAsset, did_you_mean

_MOST_BYTES: Final = 2**32  # of one file


@final
@dataclass(frozen=True, eq=False)
class ModelSample:
    """One model of a set.

    `figures` is its row in the index (metres, radians, kilograms); `files` holds the content of each file by its name
    in the result, such as `model.glb` or `meshes/door.obj`. Of a set of folders a file is read when it is asked for.
    """

    figures: Mapping[str, Any]
    files: Mapping[str, bytes]

    def __repr__(self) -> str:
        return f"<ModelSample {self.name}: {len(self.files)} files>"

    @property
    def name(self) -> str:
        """The name of the result."""
        return str(self.figures["name"])

    @cached_property
    def report(self) -> Mapping[str, Any]:
        """What `report.json` holds (docs/report.md).

        Raises:
            UnreadableAsset: if it is missing or damaged.
        """
        return _object(self.files.get("report.json", b""), f"the report of {self.name}")

    def save(self, folder: str | Path, overwrite: bool = False) -> None:
        """Writes the files into a folder, whole or not at all: then it is a result again, which simulators load.

        Raises:
            ExportError: if the folder exists (and may not be replaced), or cannot be written.
        """
        from grafu.export.files import ExportFiles, write_files  # more than the standard library

        write_files(ExportFiles(dict(self.files)), Path(folder), overwrite)


def load_dataset(folder: str | Path, split: str | None = None) -> Iterator[ModelSample]:
    """Yields the models of a split, or of all splits (None), in the order in which they are stored.

    One model is held in memory at a time.

    Raises:
        UnreadableAsset: if the folder holds no set, or something in it is damaged.
        OptionError: if there is no such split.
    """
    path = Path(folder)
    if not (path / INDEX).is_file():
        raise UnreadableAsset(f"`{path}` must be a folder that `grafu dataset` wrote: it holds no {INDEX}")
    if split is not None and split not in SPLITS:
        raise OptionError(f"the split must be one of {', '.join(SPLITS)}: got {split}{did_you_mean(split, SPLITS)}")
    return _samples(path, SPLITS if split is None else (split,))


def _samples(folder: Path, splits: tuple[str, ...]) -> Iterator[ModelSample]:
    for split in splits:
        for shard in sorted(folder.glob(f"{split}-*.tar")):
            yield from _samples_of_shard(shard)
        if (folder / split / METADATA).is_file():
            yield from _samples_of_folder(folder / split)


def _samples_of_shard(path: Path) -> Iterator[ModelSample]:
    try:
        if not path.is_file():
            raise tarfile.ReadError("it is no regular file")
        with tarfile.open(path, "r|") as shard:
            for key, members in groupby(_members(shard), lambda member: member[0].partition(".")[0]):
                held = {name[len(key) + 1 :]: data for name, data in members}
                bundle, figures = held.pop(BUNDLE, b""), held.pop(FIGURES, b"")
                files = {**held, **(_unpacked(bundle) if bundle else {})}
                yield ModelSample(_figures(figures, f"the row of {key} in {path}"), MappingProxyType(files))
    except (tarfile.TarError, EOFError, OSError, ValueError) as error:
        why = " ".join(str(error).split()) or type(error).__name__
        raise UnreadableAsset(f"{path} is damaged or no shard of a set ({why}): write the set again") from None


def _unpacked(bundle: bytes) -> dict[str, bytes]:
    with tarfile.open(fileobj=BytesIO(bundle)) as held:
        return dict(_members(held))


def _members(shard: tarfile.TarFile) -> Iterator[tuple[str, bytes]]:
    """Yields the names and contents of the regular files in a tar, in order."""
    for member in shard:
        if member.issparse() or member.size > _MOST_BYTES:
            raise tarfile.ReadError(f"{member.name} has more than 4 GiB, or holes")
        content = shard.extractfile(member) if member.isreg() else None
        if content is not None:
            yield member.name, content.read()
        shard.members = []  # type: ignore[attr-defined]  # else it remembers each of a large shard


def _samples_of_folder(folder: Path) -> Iterator[ModelSample]:
    with (folder / METADATA).open("rb") as rows:
        for number, line in enumerate(rows, 1):
            figures = _figures(line, f"line {number} of {folder / METADATA}")
            yield ModelSample(figures, FilesOfModel(folder / PurePath(figures["key"]).name, tuple(figures["files"])))


def _figures(data: bytes, where: str) -> Mapping[str, Any]:
    """Returns a row of the index, in which at least the names are what they should be."""
    row = _object(data, where)
    names = row.get("files")
    is_list = isinstance(names, list) and all(isinstance(name, str) for name in names)
    is_named = all(isinstance(row.get(name), str) for name in ("name", "key")) and row["key"] not in ("", ".", "..")
    if not is_list or not is_named:
        raise UnreadableAsset(f"{where} is damaged, for it names no model or no files: write the set again")
    return row


def _object(data: bytes, where: str) -> Mapping[str, Any]:
    try:
        found = json.loads(data)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise UnreadableAsset(f"{where} is missing or damaged, for it is no JSON object: write the set again")
    return found


@final
class FilesOfModel(Mapping[str, bytes]):
    """The files of a model in a folder, each read when it is asked for."""

    def __init__(self, folder: Path, names: tuple[str, ...]) -> None:
        self._folder, self._names = folder, names

    def __getitem__(self, name: str) -> bytes:
        if name not in self._names:
            raise KeyError(name)
        path = Path(os.path.realpath(self._folder / name))
        if not is_within(path, self._folder.parent):
            raise UnreadableAsset(f"{self._folder / name} leads out of the set: write the set again")
        try:
            return read_regular(path, _MOST_BYTES, Path(os.path.realpath(self._folder.parent)))
        except TooManyBytes:
            raise UnreadableAsset(f"{self._folder / name} has more than 4 GiB: write the set again") from None
        except (OSError, ValueError) as error:
            why = getattr(error, "strerror", None) or type(error).__name__
            raise UnreadableAsset(f"{self._folder / name} cannot be read ({why}): write the set again") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)
