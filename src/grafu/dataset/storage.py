"""Where the files of models go in a set: shards in the form of WebDataset, or a folder for each model.

A shard is a tar file with nothing in it of when and by whom it was made: the same models give the same bytes.
"""

import tarfile
from collections.abc import Iterable, Mapping
from contextlib import ExitStack
from io import BytesIO
from pathlib import Path
from typing import Final, final

from grafu.asset.regular_files import MARKER
from grafu.dataclass import dataclass
from grafu.dataset.figures import Row
from grafu.dataset.layout import BUNDLE, FIGURES, METADATA, json_line
from grafu.export.marker import Marker

_MODE: Final = 0o644
_MOST_AROUND: Final = (
    8 * tarfile.BLOCKSIZE
)  # of a file: its head, a second one for a long name, padding, its name in the row


@final
@dataclass(frozen=True)
class ModelContent:
    """All that is stored of a model: `apart` are files that stand alone, `bundled` those that find each other by path.

    `formats` states which of them each format consists of.
    """

    key: str
    apart: dict[str, bytes]
    bundled: dict[str, bytes]
    formats: Mapping[str, tuple[str, ...]]

    @property
    def size(self) -> int:
        """The bytes of all files."""
        return sum(len(data) for files in (self.apart, self.bundled) for data in files.values())

    @property
    def most_stored(self) -> int:
        """The most bytes that a shard needs for it, with its row, heads and padding."""
        return self.size + _MOST_AROUND * (1 + len(self.apart) + len(self.bundled)) + 2 * tarfile.RECORDSIZE


@final
class TarShards:
    """Shards `SPLIT-000000.tar` of at most so many bytes each; a model that needs more has one for itself."""

    def __init__(self, folder: Path, most_bytes: int) -> None:
        self._folder, self._most = folder, most_bytes
        self._open: dict[str, tarfile.TarFile] = {}
        self._number: dict[str, int] = {}

    def __enter__(self) -> "TarShards":
        return self

    def __exit__(self, *_: object) -> None:
        with ExitStack() as all_closed:
            for shard in self._open.values():
                all_closed.callback(shard.close)

    def place(self, split: str, content: ModelContent) -> str:
        """Returns the shard that the model will be in: the one that is open, or a new one where that is full."""
        if split in self._open and self._open[split].offset + content.most_stored > self._most:
            self._open.pop(split).close()
            self._number[split] += 1
        name = f"{split}-{self._number.setdefault(split, 0):06d}.tar"
        if split not in self._open:
            self._open[split] = tarfile.open(self._folder / name, "w", format=tarfile.PAX_FORMAT)  # noqa: SIM115
        return name

    def add(self, split: str, content: ModelContent, row: Row) -> None:
        """Writes the members of the model, its figures first."""
        members = {FIGURES: json_line(row), **content.apart}
        if content.bundled:
            members[BUNDLE] = _tar_bytes(content.bundled.items())
        for name, data in members.items():
            _add_member(self._open[split], f"{content.key}.{name}", data)


@final
class ModelFolders:
    """A folder `SPLIT/KEY` for each model, with its files as they were, and their rows in `SPLIT/metadata.jsonl`."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def __enter__(self) -> "ModelFolders":
        return self

    def __exit__(self, *_: object) -> None:
        """Leaves nothing open."""

    def place(self, split: str, content: ModelContent) -> str:
        """Returns the folder that the model will be in."""
        return f"{split}/{content.key}"

    def add(self, split: str, content: ModelContent, row: Row) -> None:
        """Writes the files of the model with a marker, so that it is a result again."""
        folder = self._folder / split / content.key
        files = {**content.apart, **content.bundled}
        for name, data in {**files, MARKER: Marker(tuple(files), content.formats).to_bytes()}.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_bytes(data)
        with (self._folder / split / METADATA).open("ab") as rows:
            rows.write(json_line(row))


def _tar_bytes(files: Iterable[tuple[str, bytes]]) -> bytes:
    held = BytesIO()
    with tarfile.open(fileobj=held, mode="w", format=tarfile.PAX_FORMAT) as bundle:
        for name, data in files:
            _add_member(bundle, name, data)
    return held.getvalue()


def _add_member(shard: tarfile.TarFile, name: str, data: bytes) -> None:
    info = tarfile.TarInfo(name)
    info.size, info.mode = len(data), _MODE
    shard.addfile(info, BytesIO(data))
