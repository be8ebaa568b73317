"""Writes a small text file so that nobody ever sees half of it: by one rename."""

import os
from contextlib import suppress
from pathlib import Path
from uuid import uuid4

from grafu.errors import ExportError


def write_whole(text: str, path: Path) -> None:
    """Writes the text, and the folder where it is not there.

    Raises:
        ExportError: if that cannot be.
    """
    fresh = path.with_name(f".{path.name}.{uuid4().hex[:8]}.new")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        fresh.write_text(text, encoding="utf-8")
        os.replace(fresh, path)
    except OSError as error:
        raise ExportError(f"cannot write `{path}`: {error.strerror}") from error
    finally:
        with suppress(OSError):
            fresh.unlink()
