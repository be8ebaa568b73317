"""Where what is printed goes: the options `--json`, `--quiet`, `--verbose` and `--log`, and the log file itself.

While a verb runs, stdout and stderr are copied into the log, a line each with its time, without colours. A progress
bar and lines of JSON are written past the copy, to the stream beneath.
"""

import argparse
import json
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from datetime import datetime
from io import TextIOWrapper
from pathlib import Path
from typing import Any, Final, TypeAlias, final

from grafu.errors import OptionError
from grafu.version import __version__
from grafu.visible import visible

_Shown: TypeAlias = Any  # a text stream, or what pytest, rich or a notebook has put in its place
_STEERING: Final = re.compile(r"\x1b(?:\[[0-9;?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\))")  # colours, links, titles


def add_telling_options(parser: argparse.ArgumentParser, each: str, stages: bool = False) -> None:
    """Adds --json (a line for `each`), --quiet and --log, and --verbose where a verb has `stages`."""
    group = parser.add_argument_group("what is printed")
    group.add_argument(
        "--json", dest="json_lines", action="store_true", help=f"print one line of JSON for {each} as it ends, no text"
    )
    loud = group.add_mutually_exclusive_group()
    loud.add_argument("--quiet", action="store_true", help="print errors alone")
    if stages:
        loud.add_argument("-v", "--verbose", action="store_true", help="print each stage with its seconds")
    group.add_argument(
        "--log", type=Path, metavar="FILE", help="append to FILE all that is printed, and each stage, with times"
    )


@final
class _Stream:
    """A stream in place of stdout or stderr: lines are copied into the log, and shown unless it is silenced."""

    def __init__(self, beneath: _Shown, log: TextIOWrapper | None, shown: bool) -> None:
        self.beneath = beneath
        self._log, self._shown = log, shown
        self._begun = ""  # of a line that has not ended

    def write(self, text: str) -> int:
        """Shows the text, and logs the lines that it ends; returns its length."""
        if self._shown:
            self.beneath.write(text)
        *lines, self._begun = (self._begun + text).split("\n")
        for line in lines:
            self.log(line)
        return len(text)

    def log(self, line: str) -> None:
        """Logs a line that is not shown."""
        plain = visible(_STEERING.sub("", line)).rstrip()
        if self._log is not None and plain:
            self._log.write(f"{datetime.now().astimezone().isoformat(timespec='milliseconds')} {plain}\n")

    def flush(self) -> None:
        """Writes what is held back."""
        self.beneath.flush()

    def __getattr__(self, name: str) -> Any:
        """Returns what the stream beneath has: its encoding, whether it is a terminal."""
        return getattr(self.beneath, name)


def beneath(stream: _Shown) -> _Shown:
    """Returns the stream that is written to past the log."""
    return stream.beneath if isinstance(stream, _Stream) else stream


def show_at_once(name: str) -> None:
    """Names what is begun in a line that `clear_line` takes away: a bar takes a second to import. Terminals alone."""
    stream = beneath(sys.stderr)
    if stream.isatty():
        stream.write(f"\x1b[2K{visible(name)}: starting\r")
        stream.flush()


def clear_line() -> None:
    """Takes that line away."""
    stream = beneath(sys.stderr)
    if stream.isatty():
        stream.write("\x1b[2K")
        stream.flush()


def note(line: str) -> None:
    """Logs a line, and prints nothing."""
    if isinstance(sys.stderr, _Stream):
        sys.stderr.log(line)


def print_json(values: Mapping[str, object]) -> None:
    """Prints one line of JSON on stdout, at once, also where text is silenced; no name in it steers a terminal."""
    stream = beneath(sys.stdout)
    stream.write(json.dumps(values) + "\n")
    stream.flush()


@contextmanager
def telling(options: argparse.Namespace) -> Iterator[None]:
    """Copies all that is printed into the log that the options name, and silences text where they ask for it.

    Raises:
        OptionError: if the log cannot be written.
    """
    path: Path | None = getattr(options, "log", None)
    silent = getattr(options, "quiet", False) or getattr(options, "json_lines", False)
    if isinstance(sys.stdout, _Stream) or not (path or silent):
        yield
        return
    with ExitStack() as stack:
        log = stack.enter_context(_opened(path)) if path else None
        before = sys.stdout, sys.stderr
        sys.stdout = _Stream(before[0], log, not silent)
        sys.stderr = _Stream(before[1], log, shown=True)
        try:
            yield
        finally:
            sys.stdout, sys.stderr = before


def _opened(path: Path) -> TextIOWrapper:
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        log = path.open("a", encoding="utf-8", buffering=1)
    except OSError as error:
        why = (error.strerror or "it cannot be written").lower()
        raise OptionError(f"`--log` must be a file that can be written: {path}: {why}") from None
    log.write(f"{datetime.now().astimezone().isoformat(timespec='milliseconds')} grafu {__version__}\n")
    return log
