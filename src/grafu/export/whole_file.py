"""Single files, never half-written: each is written beside its place and put there by one rename.

Until then it has a hidden name, which states which process of which machine makes it: what is left when a process dies
is found by it, and what others are still making is never touched.
"""

import os
import platform
import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Literal
from uuid import uuid4
from zlib import crc32

from grafu.errors import ExportError

_NAME = re.compile(r"\.(?P<name>.+)\.(?P<machine>[0-9a-f]{8})-(?P<process>\d+)-[0-9a-f]{8}\.(?P<ending>new|old)", re.S)


def hidden_name(path: Path, ending: Literal["new", "old"]) -> Path:
    """Returns a name beside `path`, free for this process, for what takes its place (`new`) or gives it up (`old`)."""
    return path.with_name(f".{path.name}.{_machine()}-{os.getpid()}-{uuid4().hex[:8]}.{ending}")


def is_hidden_name(name: str) -> bool:
    """Whether a name has the form of those that `hidden_name` gives."""
    return _NAME.fullmatch(name) is not None


def clear_remains(folder: Path) -> None:
    """Removes from a folder what dead processes of this machine were making there.

    An output that one had put aside and not replaced yet is put back. What cannot be removed stays, without a word.
    """
    with suppress(OSError):
        for path in sorted(folder.iterdir()):
            found = _NAME.fullmatch(path.name)
            if found and found["machine"] == _machine() and not _is_alive(int(found["process"])):
                with suppress(OSError):
                    _clear(path, folder / found["name"], found["ending"])


def _clear(path: Path, place: Path, ending: str) -> None:
    if ending == "old" and not os.path.lexists(place):
        path.rename(place)
    elif path.is_dir() and not path.is_symlink():
        shutil.rmtree(path)
    else:
        path.unlink()


def _machine() -> str:
    return f"{crc32(platform.node().encode()):08x}"


def _is_alive(process: int) -> bool:
    """Whether a process of this machine runs; where this cannot be asked without harm (Windows), yes."""
    if os.name != "posix":
        return True
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):
        return False
    except OSError:  # it belongs to another user
        return True
    return not _is_ended(process)


def _is_ended(process: int) -> bool:
    """Whether a process has ended and was not waited for yet, as it may be right after a kill; Linux alone tells."""
    try:
        _, _, values = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace").rpartition(")")
    except OSError:
        return False
    return values.split()[:1] in (["Z"], ["X"])


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Yields where to write a file that is then put at `path`; missing parent folders are made.

    If it cannot be written, nothing of it is left, and what stood at `path` stays.

    Raises:
        ExportError: if it cannot be written.
    """
    fresh = hidden_name(path, "new")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield fresh
        os.replace(fresh, path)
    except OSError as error:
        reason = error.strerror or type(error).__name__
        raise ExportError(f"cannot write the output `{path}`: {reason}; nothing of it was written") from error
    finally:
        with suppress(OSError):  # it has its place by now, or never was
            fresh.unlink()


def write_whole(text: str, path: Path) -> None:
    """Writes a text in UTF-8 as `whole_file` does.

    Raises:
        ExportError: if it cannot be written.
    """
    with whole_file(path) as fresh:
        fresh.write_text(text, encoding="utf-8")
