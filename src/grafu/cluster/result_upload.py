"""A folder of results at a URL: complete when its marker is there, which is written last. It decides nothing.

While files are written, `.grafu.partial` is there, with the content that the marker will have: by it is known what a
killed run left.
"""

import json
from enum import Enum
from pathlib import Path
from typing import Final

from grafu.asset.regular_files import MARKER
from grafu.cluster.storage import files_below, names_in, read, remove, write
from grafu.cluster.urls import Url

PARTIAL: Final = ".grafu.partial"
_RESUMED: Final = (MARKER, "report.json", "settings.json")


class Upload(Enum):
    """What is at the place of a result: nothing, a result, what a killed run left, or files that are not grafu's."""

    FREE = "free"
    COMPLETE = "complete"
    UNFINISHED = "unfinished"
    FOREIGN = "foreign"


def upload_at(place: Url) -> Upload:
    """Returns what is at the place of a result.

    Raises:
        AssetError: if it cannot be listed.
    """
    names = names_in(place)
    if MARKER in names:
        return Upload.COMPLETE
    if PARTIAL in names:
        return Upload.UNFINISHED
    return Upload.FOREIGN if names else Upload.FREE


def upload_result(folder: Path, place: Url) -> None:
    """Writes a folder of results: all its files, then its marker; an earlier result at the place is replaced.

    Until the marker is there, no reader takes the place for a result. Files that are not grafu's stay.

    Raises:
        ExportError: if it cannot be written; the place then counts as unfinished, or holds the earlier result.
    """
    files = {path.relative_to(folder).as_posix(): path for path in sorted(folder.rglob("*")) if path.is_file()}
    marker = files.pop(MARKER)
    earlier = set(_files_of(place, MARKER))
    write(place, {PARTIAL: marker.read_bytes()})
    remove(place, [MARKER])
    write(place, files)
    remove(place, sorted(earlier - set(files) - {MARKER}))
    write(place, {MARKER: marker})
    remove(place, [PARTIAL])


def fetch_result(place: Url, folder: Path) -> None:
    """Puts a complete result into a folder, as far as a run that goes on from it reads it: other files are empty there.

    Raises:
        AssetError: if it cannot be read.
    """
    for name in files_below(place):
        if name == PARTIAL:
            continue
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(read(place / name) if name in _RESUMED else b"")


def remove_unfinished(place: Url) -> None:
    """Removes what an interrupted upload left at the place of a result, and nothing else.

    Raises:
        FunctionalizationError: if it cannot be listed or removed.
    """
    if upload_at(place) is Upload.UNFINISHED:
        remove(place, [*_files_of(place, PARTIAL), PARTIAL])


def _files_of(place: Url, marker: str) -> list[str]:
    """Returns the files that a marker at a place lists; none without one, or of a damaged one."""
    if marker not in names_in(place, "write"):
        return []
    try:
        listed = json.loads(read(place / marker))["files"]
    except (ValueError, KeyError, TypeError):
        return []
    return [name for name in listed if isinstance(name, str) and ".." not in name.split("/")]
