"""A case, which is files and how they are read, and a reader of them; neither knows any format."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any, final

from fuzz.entries import Files

Reads = Callable[[Path, Random], Any]
Arguments = Callable[[Path, Path, Random], list[str]]


@final
@dataclass(frozen=True)
class Reader:
    """`reads` an entry as a library would; `arguments` are those of a command on it."""

    reads: Reads
    arguments: Arguments | None = None


@final
@dataclass(frozen=True)
class Case:
    """One case: `entry` is what is read of `files`, `by_command` states whether the whole command does it."""

    seed: int
    index: int
    start: str
    changes: tuple[str, ...]
    files: Files
    entry: str
    by_command: bool

    def chance(self) -> Random:
        """Returns what decides on options: the same for the same case."""
        return Random(f"{self.seed}/{self.index}/options")

    def __str__(self) -> str:
        how = "command" if self.by_command else "library"
        return f"{self.start}, {how}: {', '.join(self.changes) or 'unchanged'}"
