"""Folders of results as they come into a set: found, looked through, and read file by file. It changes nothing."""

import re
from collections.abc import Iterable, Iterator, Mapping
from hashlib import blake2b
from pathlib import Path
from typing import Final, final

from grafu.articulation.articulated_object import VisualRole
from grafu.asset.json_files import read_own
from grafu.asset.regular_files import MARKER
from grafu.asset.resources import reason_of
from grafu.dataclass import dataclass
from grafu.dataset.descriptor import Descriptor, describe
from grafu.errors import ExportError, FunctionalizationError, UnreadableAsset
from grafu.export.files import ExportFiles
from grafu.export.glb_object import read_glb_object
from grafu.export.marker import read_marker
from grafu.pipeline.report_schema import Report
from grafu.pipeline.result_folder import MODEL, REPORT, read_report

_FOR_PEOPLE: Final = (".html", ".gif")
_MOST_BYTES: Final = 2**32  # of one file: a set is read with as little care as its largest file allows


@final
@dataclass(frozen=True)
class StoredResult:
    """A whole result: its report, the files that come into a set, and the formats that these are of."""

    folder: Path
    report: Report
    files: tuple[str, ...]
    formats: Mapping[str, tuple[str, ...]]

    @property
    def bundled(self) -> tuple[str, ...]:
        """The files of formats that consist of several: they find each other by their paths."""
        several = [names for names in self.formats.values() if len(names) > 1]
        together = {name for names in several for name in names}
        return tuple(name for name in self.files if name in together or "/" in name)

    def read(self, name: str) -> bytes:
        """Returns the content of one of its files.

        Raises:
            AssetError: if it cannot be read, or has more than 4 GiB.
        """
        return read_own(self.folder / name, "a file of a result", _MOST_BYTES)


def results_in(given: Iterable[Path]) -> Iterator[Path | UnreadableAsset]:
    """Yields each folder of a result that is given or lies directly in one that is given, and what is neither.

    A folder is a result if it holds a report, or its marker states that it should.
    """
    for path in given:
        if not path.is_dir():
            yield UnreadableAsset(f"{path}: a result is a folder that `grafu functionalize` wrote; there is none")
            continue
        try:
            inside = [path] if _is_result(path) else sorted(p for p in path.iterdir() if p.is_dir() and _is_result(p))
        except OSError as error:
            yield UnreadableAsset(why_unusable(error, path))
            continue
        yield from inside
        if not inside:
            yield UnreadableAsset(f"{path}: it holds no result that `grafu functionalize` wrote")


def _is_result(folder: Path) -> bool:
    if (folder / REPORT).is_file():
        return True
    try:
        marker = read_marker(folder)
    except ExportError:
        return True  # damaged: it is reported when it is read
    return marker is not None and REPORT in marker.files


def open_result(folder: Path) -> StoredResult:
    """Returns a result of which every file is there.

    Raises:
        AssetError: if its report or a file is missing or damaged.
        ExportError: if its marker is damaged.
    """
    marker = read_marker(folder)
    if marker is None:
        raise UnreadableAsset(f"it holds no `{MARKER}`, by which grafu knows what it wrote: make it again")
    missing = [name for name in marker.files if not (folder / name).is_file()]
    if missing:
        more = f" and {len(missing) - 1} more" if len(missing) > 1 else ""
        raise UnreadableAsset(f"it is not whole, for `{missing[0]}`{more} is missing: make it again with --overwrite")
    if MODEL not in marker.files:
        raise UnreadableAsset(f"it has no {MODEL}: run again with --formats glb")
    files = tuple(name for name in marker.files if name != MARKER and not name.endswith(_FOR_PEOPLE))
    ExportFiles(dict.fromkeys(files, b""))  # refuses names that lead elsewhere
    formats = {name: names for name, names in marker.formats.items() if names and set(files) >= set(names)}
    return StoredResult(folder, read_report(folder), files, formats)


def shape_of(result: StoredResult) -> Descriptor:
    """Returns the descriptor of what the input drew: no hardware, no added parts, everything closed.

    Raises:
        AssetError: if the model cannot be read.
    """
    made = read_glb_object(result.folder / MODEL)
    if {joint.id for joint in made.moving_joints} != {joint.id for joint in result.report.joints}:
        raise UnreadableAsset(f"{MODEL} and {REPORT} are of different runs: their joints differ")
    visuals = (visual for link in made.links for visual in link.visuals)
    return describe([visual.mesh for visual in visuals if visual.role is VisualRole.PART and visual.surfaces])


def name_of(folder: Path) -> str:
    """Returns the name of a result: its folder's, where bytes that are no UTF-8 are written as escapes."""
    return folder.resolve().name.encode("utf-8", "backslashreplace").decode()


def key_of(name: str) -> str:
    """Returns the name of a model's files before the first dot; one with dots is mended, and stays unlike others."""
    plain = re.sub(r"[./\\]", "_", name)
    return plain if plain == name else f"{plain}~{blake2b(name.encode(), digest_size=4).hexdigest()}"


def why_unusable(error: FunctionalizationError | OSError, folder: Path) -> str:
    """Returns the line that names the folder and states why it is left out."""
    text = f"it cannot be read ({reason_of(error)})" if isinstance(error, OSError) else str(error)
    return text if str(folder) in text else f"{folder}: {text}"
