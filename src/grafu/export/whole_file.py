"""Single files that nobody ever sees half of: each is written beside its place and put there by one rename."""

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from grafu.errors import ExportError
from grafu.export.remains import hidden_name


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
