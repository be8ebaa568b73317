"""Names of results' folders and of the files within: names that every system can hold, or a refusal.

A name that Windows cannot hold is refused on every system: results are passed on. One that is longer than most tools
and disks bear, or no Unicode, is mended, and ends in `~` and eight digits of its digest: two such names stay apart.
Results and inputs stay apart, too: a folder that is replaced as a whole never is an input, and never holds one.
"""

import os
import re
import unicodedata
from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from hashlib import blake2b
from itertools import chain
from pathlib import Path
from typing import Final, final

from grafu.asset.regular_files import MARKER
from grafu.errors import AssetError
from grafu.export.whole_file import is_hidden_name
from grafu.visible import visible


def why_not_apart(result: Path, inputs: Iterable[Path]) -> str:
    """Returns why results cannot go to a folder, in a line; empty where it neither is nor holds one of the inputs.

    Places are compared as the disk knows them: links, the case of letters and other paths to the same place count.
    A result inside an input's folder is fine: readers pass it over.
    """
    return InputPlaces(inputs).why_not_apart(result)


@final
class InputPlaces:
    """Where inputs lie: each is looked at once, however many results are compared with it. Not a value."""

    def __init__(self, inputs: Iterable[Path]) -> None:
        self._known: dict[Path, _Id | None] = {}
        self._held: dict[_Id, tuple[Path, bool]] = {}
        """The first input that lies in each place, and whether it is that place itself."""
        for given in inputs:
            for is_itself, path in chain([(True, given)], ((False, place) for place in _places(given))):
                if (at := self._at(path)) is not None:
                    self._held.setdefault(at, (given, is_itself))

    def why_not_apart(self, result: Path) -> str:
        """Returns why results cannot go to a folder, as the function of this name does."""
        at = _id_of(result)
        if at is None or at not in self._held:
            return ""
        given, is_itself = self._held[at]
        what = "and so replace" if is_itself else "which holds"
        return f"the results would go to `{result}`, {what} the input `{given}`: choose another --out"

    def _at(self, path: Path) -> "_Id | None":
        if path not in self._known:
            self._known[path] = _id_of(path)
        return self._known[path]


_Id = tuple[int, int]  # of a file or folder: its device and its number there


def _id_of(path: Path) -> _Id | None:
    """Returns what the disk knows a place by; None of what is not there, which is nothing and holds nothing."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _places(path: Path) -> Iterable[Path]:
    """Yields the path and what is above it: as it is written, and with every link followed."""
    written = Path(os.path.abspath(path))
    for start in (written, Path(os.path.realpath(written.parent)) / written.name, Path(os.path.realpath(path))):
        yield from (start, *start.parents)


MOST_BYTES: Final = 120
"""Of a name in UTF-8; beside it a folder has room for what is written at the same time (255 on most disks)."""

_RESERVED: Final = re.compile(
    r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³]|conin\$|conout\$|clock\$) *(\..*)?", re.I | re.S
)
_ENDING: Final = re.compile("[A-Za-z0-9_]+")
_FORBIDDEN: Final = '<>:"/\\|?*'
_SURROGATES: Final = re.compile("[\ud800-\udfff]")


GENERIC_STEMS: Final = frozenset({"model", "mobility", "robot", "scene", "object"})
"""Names of files that state nothing of the model, in lower case: the folder that holds such a file names it."""


def output_name(path: Path) -> str:
    """Returns the name that an input's results carry: the folder's name, or the file's stem.

    A file with a generic name, such as `model.glb` or `mobility.urdf`, is named by the folder that holds it.

    Raises:
        AssetError: if it cannot be the name of a folder on every system.
    """
    resolved = Path(os.path.realpath(path))
    return name_that_is_safe(resolved.name if os.path.isdir(resolved) else telling_name(resolved), str(path))


def telling_name(file: Path) -> str:
    """Returns what names the model in a file: its stem, or its folder's name where the stem is a generic one."""
    return file.stem if _names_itself(file) else file.parent.name


def _names_itself(file: Path) -> bool:
    return file.stem.lower() not in GENERIC_STEMS or bool(_why_refused(file.parent.name))


def name_that_is_safe(name: str, given: str) -> str:
    """Returns a name of results as every system can hold it; `given` is the input, for what is stated of a refusal.

    Raises:
        AssetError: if it cannot be the name of a folder on every system.
    """
    if why := _why_refused(name):
        raise AssetError(f"the results of `{visible(given)}` would go to `{visible(name)}`, {why}: rename the input")
    return _mended(name)


def told_apart(paths: Sequence[Path], names: Sequence[str]) -> tuple[str, ...]:
    """Returns the names of inputs' results: what several share gives way to what names them otherwise.

    These are the stems of the files, or else the names of the folders that hold them, or else both and as many of the
    folders above as it takes (`a_same_cabinet` of `a/same/cabinet.glb`). Where none tells them apart, or one is that
    of another input, nothing is changed.
    """
    alike: dict[str, list[int]] = defaultdict(list)
    for k, name in enumerate(names):
        alike[same_place(name)].append(k)
    found = list(names)
    for shared, places in ((name, places) for name, places in alike.items() if len(places) > 1):
        files = [Path(os.path.realpath(paths[k])) for k in places]
        for others, taken in (
            ([_own_name(file) for file in files], alike.keys() - {shared}),
            ([_folder_of(file).name for file in files], alike.keys()),
            *((names_above, alike.keys()) for names_above in _with_folders(files)),
        ):
            fresh = {same_place(other) for other in others}
            if len(fresh) == len(places) and not fresh & taken and not any(map(_why_refused, others)):
                for k, other in zip(places, others, strict=True):
                    found[k] = _mended(other)
                break
    return tuple(found)


def _with_folders(files: Sequence[Path]) -> Iterator[list[str]]:
    """Yields the names of inputs behind the names of the folders that hold them: of one, of two, and so on.

    Of inputs that hold one another it yields none: they are one model, given twice.
    """
    if {folder for file in files for folder in file.parents} & set(files):
        return
    above = [[file.stem if not os.path.isdir(file) else file.name, *(at.name for at in file.parents)] for file in files]
    for count in range(2, min(map(len, above))):
        yield ["_".join(reversed(names[:count])) for names in above]


def _own_name(path: Path) -> str:
    return path.name if os.path.isdir(path) else path.stem


def _folder_of(path: Path) -> Path:
    """Returns the folder that holds an input; of a file that its folder names, the one that holds this folder."""
    return path.parent if os.path.isdir(path) or _names_itself(path) else path.parent.parent


def with_ending(name: str, ending: str) -> str:
    """Returns the name of results with `_` and an ending of letters, digits and `_`; itself without one."""
    return _mended(f"{name}_{ending}") if ending else name


def name_of_model(path: Path, model: str) -> str:
    """Returns the name of the results of a model that was read from a path: of a piece, with its ending.

    Raises:
        AssetError: as by `output_name`.
    """
    _, found, ending = model.partition(f"{path.stem}_")
    return with_ending(output_name(path), ending if found and _ENDING.fullmatch(ending) else "")


def file_safe(name: str) -> str:
    """Returns a name for a file within results, before its ending: letters, digits, `_`, `-` and `.`, on any system.

    It is no hidden file and never empty. One that Windows keeps for a device begins with `_`; one that is too long is
    cut as those of results are.
    """
    plain = re.sub(r"[^A-Za-z0-9_.-]+", "_", name).lstrip(".-") or "unnamed"
    return _mended(f"_{plain}" if _RESERVED.fullmatch(plain) else plain)


def same_place(name: str) -> str:
    """Returns the same for two names that some disk takes for one: upper and lower case, composed or not."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())


def _why_refused(name: str) -> str:
    """Returns why a folder cannot be called so, empty where it can."""
    if name in ("", ".", ".."):
        return "which names no folder of its own"
    if any(unicodedata.category(one) == "Cc" for one in name):
        return "a name with control characters"
    held = sorted(set(name) & set(_FORBIDDEN))
    if held:
        return f"and `{held[0]}` cannot be in a folder's name on Windows"
    if name[-1] in ". ":
        return "and no folder's name can end in a dot or a space on Windows"
    if _RESERVED.fullmatch(name):
        return "a name that Windows keeps for a device"
    if same_place(name) == MARKER or is_hidden_name(name):
        return "a name that grafu keeps for itself"
    return ""


def _mended(name: str) -> str:
    written = _SURROGATES.sub("_", name)
    if written == name and len(name.encode()) <= MOST_BYTES:
        return name
    digest = blake2b(name.encode("utf-8", "surrogatepass"), digest_size=4).hexdigest()
    kept = written.encode()[: MOST_BYTES - len(digest) - 1].decode("utf-8", "ignore")
    return f"{kept}~{digest}"
