"""The file of rows: one line for each task that is done. A line is whole or ignored; the last of a key counts."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from pydantic import ValidationError

from grafu.errors import ExportError
from grafu.evaluation.records import Row

NAME = "rows.jsonl"
_BEGINNING = b'{"key":'  # of every line, whatever the version


def read_rows(path: Path) -> dict[str, Row]:
    """Returns the rows of a file by key; broken lines and those of another form are left out.

    Raises:
        ExportError: if there is a file that cannot be read.
    """
    try:
        lines = path.read_bytes().split(b"\n") if path.exists() else []
    except OSError as error:
        raise ExportError(f"`{path}` cannot be read ({error.strerror}): choose another --out") from None
    found: dict[str, Row] = {}
    for line in lines:
        try:
            row = Row.model_validate_json(line)
        except ValidationError:
            continue
        found[row.key] = row
    return found


def begin_rows(path: Path, anew: bool = False) -> dict[str, Row]:
    """Returns the rows of a run that goes on, none of one that begins `anew`; its folder is there then.

    Raises:
        ExportError: if the folder cannot be made, or the file is none of ours, or cannot be read or taken away.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        held = path.read_bytes().split(b"\n") if path.exists() else []
        if any(held) and not any(line.startswith(_BEGINNING[: len(line)]) for line in held if line):
            raise ExportError(f"`{path}` holds no rows of grafu's, so it is kept: choose another --out")
        if anew:
            path.unlink(missing_ok=True)
    except OSError as error:
        raise ExportError(f"cannot write into `{path.parent}` ({error.strerror}): choose another --out") from None
    return read_rows(path)


def append_rows(path: Path, rows: Iterable[Row]) -> None:
    """Adds rows at the end of a file, each with its line break, after whatever half a line a killed run left.

    Raises:
        ExportError: if it cannot be written.
    """
    text = "".join(f"{row.model_dump_json()}\n" for row in rows)
    try:
        with path.open("a+b") as file:
            if file.seek(0, 2) > 0:
                file.seek(-1, 2)
                if file.read(1) != b"\n":
                    text = "\n" + text
            file.write(text.encode())
            file.flush()
    except OSError as error:
        raise ExportError(f"`{path}` cannot be written ({error.strerror or type(error).__name__})") from error


def done(rows: Mapping[str, Row], key: str) -> bool:
    """Whether a task needs no more work; one that failed is tried again."""
    return key in rows and not rows[key].error
