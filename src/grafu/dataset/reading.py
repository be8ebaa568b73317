"""Reads a set that `grafu dataset` wrote, model by model, whatever its size. It needs the standard library alone.

for sample in load_dataset("DIR", split="train"):
    sample.name, sample.report, sample.files["model.glb"]
"""

import json
import tarfile
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from io import BytesIO
from itertools import groupby
from pathlib import Path, PurePath
from types import MappingProxyType
from typing import Any, final

from grafu.dataset.layout import BUNDLE, FIGURES, INDEX, METADATA, SPLITS
from grafu.errors import OptionError, UnreadableAsset, did_you_mean


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
        try:
            return dict(json.loads(self.files["report.json"]))
        except (KeyError, ValueError, TypeError):
            raise UnreadableAsset(
                f"the report of {self.name} in the set is missing or damaged: make it again"
            ) from None

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
        with tarfile.open(path, "r|") as shard:
            for key, members in groupby(_members(shard), lambda member: member[0].partition(".")[0]):
                held = {name[len(key) + 1 :]: data for name, data in members}
                bundle = held.pop(BUNDLE, None)
                figures = json.loads(held.pop(FIGURES))
                yield ModelSample(figures, MappingProxyType({**held, **(_unpacked(bundle) if bundle else {})}))
    except (tarfile.TarError, EOFError, OSError, KeyError, ValueError) as error:
        why = " ".join(str(error).split()) or type(error).__name__
        raise UnreadableAsset(f"{path} is damaged or no shard of a set ({why}): write the set again") from None


def _unpacked(bundle: bytes) -> dict[str, bytes]:
    with tarfile.open(fileobj=BytesIO(bundle)) as held:
        return dict(_members(held))


def _members(shard: tarfile.TarFile) -> Iterator[tuple[str, bytes]]:
    """Yields the names and contents of the regular files in a tar, in order."""
    for member in shard:
        content = shard.extractfile(member) if member.isreg() else None
        if content is not None:
            yield member.name, content.read()
        shard.members = []  # type: ignore[attr-defined]  # else it remembers each of a large shard


def _samples_of_folder(folder: Path) -> Iterator[ModelSample]:
    with (folder / METADATA).open("rb") as rows:
        for number, line in enumerate(rows, 1):
            try:
                row = json.loads(line)
                files = FilesOfModel(folder / PurePath(row["key"]).name, tuple(map(str, row["files"])))
            except (KeyError, ValueError, TypeError):
                raise UnreadableAsset(f"{folder / METADATA} is damaged in line {number}: write the set again") from None
            yield ModelSample(row, files)


@final
class FilesOfModel(Mapping[str, bytes]):
    """The files of a model in a folder, each read when it is asked for."""

    def __init__(self, folder: Path, names: tuple[str, ...]) -> None:
        self._folder, self._names = folder, names

    def __getitem__(self, name: str) -> bytes:
        if name not in self._names:
            raise KeyError(name)
        if PurePath(name).is_absolute() or ".." in PurePath(name).parts:
            raise UnreadableAsset(f"{self._folder} cannot hold a file {name!r}: write the set again")
        try:
            return (self._folder / name).read_bytes()
        except OSError as error:
            why = error.strerror or type(error).__name__
            raise UnreadableAsset(f"{self._folder / name} cannot be read ({why}): write the set again") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._names)

    def __len__(self) -> int:
        return len(self._names)
