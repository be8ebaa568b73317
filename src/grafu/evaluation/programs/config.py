"""How an installed copy of another system is run on one model: its command line, its time, what it writes."""

from dataclasses import field
from pathlib import Path
from string import Formatter
from typing import ClassVar, Final, Literal, final

from pydantic import ConfigDict

from grafu.dataclass import dataclass
from grafu.geometry.config_checks import require_positive

WORDS: Final = ("mesh", "picture", "out", "id")
"""What `command` may hold in braces: files that are written for it, the folder that it writes to, the model's id."""


@final
@dataclass(frozen=True)
class ProgramConfig:
    """One run for each model.

    Raises:
        ValueError: if the command is empty, does not name `{out}` or holds another word in braces, or the time is not
            above 0.
    """

    __pydantic_config__: ClassVar = ConfigDict(extra="forbid")

    command: tuple[str, ...]
    """The program and its arguments, with `WORDS` in braces: `{mesh}` is one OBJ file, Z up, front -Y, in metres;
    `{picture}` a PNG of it; `{out}` an empty folder; `{id}` the model's id."""
    folder: Path | None = None
    """The folder that it runs in; None: the one in which grafu runs."""
    result: str = "."
    """What is read, from `{out}` on: a file or folder, or a pattern of which the first that matches is read."""
    timeout: float = 300.0
    """How long it may take for one model (seconds)."""
    environment: dict[str, str] = field(default_factory=dict)
    """Variables that are set for it, beside those of the user."""

    def __post_init__(self) -> None:
        require_positive(self, "timeout")
        if not self.command or not self.command[0]:
            raise ValueError("`command` must name a program: got none")
        named = [word for text in self.command for word in words_in(text)]
        unknown = next((word for word in named if word not in WORDS), None)
        if unknown is not None:
            raise ValueError(f"`command` may hold {{{'}, {'.join(WORDS)}}}: got {{{unknown}}}")
        if "out" not in named:
            raise ValueError("`command` must name {out}, the folder that the program writes to")
        if Path(self.result).is_absolute() or ".." in Path(self.result).parts:
            raise ValueError(f"`result` must be a path within {{out}}: got `{self.result}`")


def words_in(text: str) -> list[str]:
    """Returns the words in braces of an argument.

    Raises:
        ValueError: if a brace is open.
    """
    return [word for _, word, _, _ in Formatter().parse(text) if word is not None]


@final
@dataclass(frozen=True, slots=True)
class OutsideProgram:
    """The file that states how a program is run, what it states, and the folder in which its outputs are kept."""

    path: Path
    config: ProgramConfig
    outputs: Path
    system: Literal["particulate", "singapo"]
