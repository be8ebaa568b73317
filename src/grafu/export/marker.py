"""The marker of a folder that grafu wrote, `.grafu.json`: which files in it are grafu's, and which format each is of.

    {"schema": "grafu.output/1", "files": [NAME, ...], "formats": {FORMAT: [NAME, ...]}}

Names are relative, with `/`, sorted. A folder without a marker is not grafu's; nor is, in a folder with one, every
file that the marker does not list.
"""

import json
from collections.abc import Mapping
from dataclasses import field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, final

from grafu.asset.json_files import read_own_json
from grafu.asset.regular_files import MARKER
from grafu.dataclass import dataclass
from grafu.errors import AssetError, ExportError

SCHEMA: Final = "grafu.output/1"
_MOST_BYTES: Final = 16 * 2**20


@final
@dataclass(frozen=True)
class Marker:
    """Which files of a folder are grafu's; `formats`: those that each format consists of."""

    files: tuple[str, ...]
    formats: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        object.__setattr__(self, "files", tuple(sorted({*self.files, MARKER})))
        sorted_formats = {name: tuple(sorted(self.formats[name])) for name in sorted(self.formats)}
        object.__setattr__(self, "formats", MappingProxyType(sorted_formats))

    def to_bytes(self) -> bytes:
        """Returns the file's content; the same marker gives the same bytes."""
        files = [name for name in self.files if name != MARKER]
        formats = {name: list(names) for name, names in self.formats.items()}
        return (json.dumps({"schema": SCHEMA, "files": files, "formats": formats}, indent=1) + "\n").encode()

    def with_files(self, formats: Mapping[str, tuple[str, ...]], *files: str) -> "Marker":
        """Returns the marker with more files, and formats that consist of them."""
        return Marker((*self.files, *files), {**self.formats, **formats})

    def lacks(self, folder: Path, formats: tuple[str, ...]) -> tuple[str, ...]:
        """Returns those of the formats that the folder does not hold whole."""
        return tuple(name for name in formats if not self._holds(folder, name))

    def _holds(self, folder: Path, name: str) -> bool:
        return name in self.formats and all((folder / file).is_file() for file in self.formats[name])


def read_marker(folder: Path) -> Marker | None:
    """Returns the marker of a folder, None where grafu did not write it.

    Raises:
        ExportError: if the marker is damaged, or cannot be read.
    """
    path = folder / MARKER
    if not path.is_file():
        return None
    try:
        stated = read_own_json(path, "the marker of a folder that grafu wrote", _MOST_BYTES)
    except AssetError:
        stated = None
    if not _is_marker(stated):
        raise ExportError(f"`{path}` is damaged, so it is unknown which files are grafu's: move `{folder}` away")
    return Marker(tuple(stated["files"]), {name: tuple(names) for name, names in stated["formats"].items()})


def _is_marker(stated: Any) -> bool:
    if not isinstance(stated, dict) or stated.get("schema") != SCHEMA or not isinstance(stated.get("formats"), dict):
        return False
    return all(
        isinstance(names, list) and all(isinstance(name, str) for name in names)
        for names in (stated.get("files"), *stated["formats"].values())
    )
