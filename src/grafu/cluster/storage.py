"""What is read, listed and written at URLs, by fsspec; what goes wrong there is one line, without credentials."""

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal, TypeAlias
from uuid import uuid4

from grafu.cluster.config import FetchConfig
from grafu.cluster.urls import Url
from grafu.errors import AssetError, AssetTooLarge, ExportError, FunctionalizationError, OptionError, UnreadableAsset

_FileSystem: TypeAlias = Any  # of fsspec, which has no types
_SECRET = re.compile(r"KEY|TOKEN|SECRET|PASSW|CREDENTIAL", re.I)
_SHORTEST = 8  # characters of a secret; what is shorter is a word
_LONGEST = 200  # characters of another library's message
_EXTRAS: Mapping[str, str] = {"gs": "gcsfs", "gcs": "gcsfs", "hf": "huggingface_hub", "az": "adlfs", "abfs": "adlfs"}
ALONE = frozenset((".glb", ".stl", ".ply", ".3mf", ".3ds", ".usdz", ".usdc", ".blend", ".fbx"))
"""Endings of files that hold all that belongs to a model; with others all that is beside them is fetched."""


def matches(url: Url) -> tuple[Url, ...]:
    """Returns what a URL with `*`, `?` or `[...]` stands for, sorted; one without is itself.

    Raises:
        AssetError: if there is nothing of it, or it cannot be listed.
    """
    with _said_plainly(url, "read"):
        system, path = _opened(url)
        if url.has_pattern:
            found = tuple(sorted(Url(str(system.unstrip_protocol(one))) for one in system.glob(path)))
        else:
            found = (url,) if system.exists(path) else ()
    if not found:
        raise UnreadableAsset(f"there is no `{url}`: give a URL of models, and check the rights to list it")
    return found


def names_in(url: Url, doing: Literal["read", "write"] = "read") -> frozenset[str]:
    """Returns the names of what lies in a folder; none where it is not there.

    Raises:
        AssetError: if it cannot be listed (`read`); ExportError (`write`).
    """
    with _said_plainly(url, doing):
        system, path = _opened(url)
        try:
            listed = system.ls(path, detail=False)
        except FileNotFoundError:
            return frozenset()
        return frozenset(str(one).rstrip("/").rpartition("/")[2] for one in listed if str(one).strip("/") != path)


def require_writable(url: Url) -> None:
    """Makes sure, by a small file that is written and removed, that results can be written.

    Raises:
        ExportError: if they cannot.
    """
    with _said_plainly(url, "write"):
        system, path = _opened(url)
        probe = f"{path}/.grafu_probe_{uuid4().hex[:8]}"
        system.pipe_file(probe, b"grafu")
        system.rm_file(probe)


def fetch(url: Url, folder: Path, config: FetchConfig = FetchConfig()) -> Path:
    """Puts a model, a file or a folder with all that belongs to it, into a folder; returns its path there.

    Of a file whose form names others all that lies beside and below it is fetched.

    Raises:
        AssetError: if it is not there or cannot be read, is larger than the limits, or a name in it leads elsewhere.
    """
    with _said_plainly(url, "read"):
        system, path = _opened(url)
        is_file = bool(system.isfile(path))
        if is_file and Path(url.name).suffix.lower() in ALONE:
            found = {path: system.info(path)}
        else:
            found = system.find(path if not is_file else path.rpartition("/")[0], detail=True)
        if not found:
            raise UnreadableAsset(f"there is no `{url}`, or nothing in it")
        _require_small(url, found, config)
        root = path.rpartition("/")[0] if is_file else path
        target = folder if is_file else folder / url.name
        _get(system, {name: target / _relative(name, root, url) for name in found})
    return folder / url.name


def files_below(url: Url) -> tuple[str, ...]:
    """Returns the relative names of all files in a folder.

    Raises:
        AssetError: if it cannot be listed, or a name in it leads elsewhere.
    """
    with _said_plainly(url, "read"):
        system, path = _opened(url)
        return tuple(_relative(name, path, url) for name in system.find(path))


def read(url: Url) -> bytes:
    """Returns the content of a file; AssetError if it cannot be read."""
    with _said_plainly(url, "read"):
        system, path = _opened(url)
        return bytes(system.cat_file(path))


def write(url: Url, files: Mapping[str, Path | bytes]) -> None:
    """Writes files into a folder, by relative name; ExportError if one cannot be written."""
    with _said_plainly(url, "write"):
        system, path = _opened(url)
        local = {name: source for name, source in files.items() if isinstance(source, Path)}
        if local:
            system.put([str(source) for source in local.values()], [f"{path}/{name}" for name in local])
        for name, source in files.items():
            if isinstance(source, bytes):
                system.pipe_file(f"{path}/{name}", source)


def remove(url: Url, names: Sequence[str]) -> None:
    """Removes files of a folder, by relative name; those that are gone are no fault. ExportError if one stays."""
    with _said_plainly(url, "write"):
        system, path = _opened(url)
        for name in names:
            try:
                system.rm_file(f"{path}/{name}")
            except FileNotFoundError:
                continue


def _get(system: _FileSystem, places: Mapping[str, Path]) -> None:
    for place in places.values():
        place.parent.mkdir(parents=True, exist_ok=True)
    system.get(list(places), [str(place) for place in places.values()])


def _require_small(url: Url, found: Mapping[str, Any], config: FetchConfig) -> None:
    size = sum(int(state.get("size") or 0) for state in found.values())
    if len(found) > config.files or size > config.bytes:
        raise AssetTooLarge(
            f"`{url}` has {len(found)} files of {size / 1e6:.0f} MB in its folder, and at most {config.files} files of "
            f"{config.bytes / 1e6:.0f} MB are fetched for a model: give each model a folder of its own"
        )


def _relative(name: str, root: str, url: Url) -> str:
    """Returns the name of a file below a folder; one that would lead out of it on this machine is refused."""
    inside = name.removeprefix(root).lstrip("/")
    parts = inside.split("/")
    if not inside or any(part in ("", ".", "..") for part in parts) or "\\" in inside or "\0" in inside:
        raise UnreadableAsset(f"`{url}` holds a file with the name `{inside}`, which is no name on a disk: rename it")
    return inside


def _opened(url: Url) -> tuple[_FileSystem, str]:
    try:
        import fsspec.core
    except ImportError:
        raise OptionError(f"`{url}` needs fsspec: pip install 'grafu[cluster]'") from None
    try:
        system, path = fsspec.core.url_to_fs(str(url))
    except ImportError:
        package = _EXTRAS.get(url.scheme, "grafu[cluster]")
        raise OptionError(f"`{url.scheme}://` needs another package: pip install '{package}'") from None
    except ValueError as error:
        if "rotocol" not in str(error):
            raise
        raise OptionError(f"a URL must begin with s3://, gs://, hf:// or another of fsspec's: got `{url}`") from None
    system.invalidate_cache()  # others write there meanwhile
    return system, str(path).rstrip("/")


@contextmanager
def _said_plainly(url: Url, doing: Literal["read", "write"]) -> Iterator[None]:
    kind = AssetError if doing == "read" else ExportError
    try:
        yield
    except FunctionalizationError:
        raise
    except FileNotFoundError:
        raise kind(f"cannot {doing} `{url}`: there is no such bucket or file") from None
    except Exception as error:  # each storage has exceptions of its own
        if isinstance(error, PermissionError) or "Credential" in type(error).__name__:
            raise kind(
                f"cannot {doing} `{url}`: the right to {doing} it is missing; give credentials in the environment"
            ) from None
        raise kind(f"cannot {doing} `{url}`: {without_secrets(f'{type(error).__name__}: {error}')}") from None


def without_secrets(text: str) -> str:
    """Returns the beginning of a message in one line, with what the environment keeps as a secret left out."""
    for name, value in os.environ.items():
        if _SECRET.search(name) and len(value) >= _SHORTEST:
            text = text.replace(value, "***")
    return " ".join(text.split())[:_LONGEST]
