"""A parser of arguments that states what is wrong in one line, and what may have been meant.

What was typed wrong is named before what is missing: `--outt x` is an unknown argument, not a missing `--out`.
"""

import argparse
import os
import re
from collections.abc import Sequence
from typing import Final, NoReturn, final

from grafu.cli.verb import one_line
from grafu.errors import did_you_mean
from grafu.geometry.lengths import METRES_PER_UNIT
from grafu.visible import visible

_CHOICE: Final = re.compile(r"invalid choice: '(?P<given>.*)' \(choose from (?P<known>.*)\)", re.S)
_ONE_OF: Final = re.compile(r"\bone of (?P<known>.*): got '(?P<given>.*)'$", re.S)
_MISSING: Final = "the following arguments are required"


@final
class ArgumentParser(argparse.ArgumentParser):
    """States what is wrong with the arguments in one line, with nothing in it that steers a terminal."""

    words: Sequence[str] = ()
    """The arguments that are parsed: those of a verb come after its name."""

    def error(self, message: str) -> NoReturn:
        """Prints the message, what may have been meant and where all options are listed; ends with exit code 2."""
        unknown = self._unknown_options() if message.startswith(_MISSING) else []
        if unknown:
            self.refuse(unknown)
        near = self._near(message)
        self.exit(2, f"{self.prog}: {visible(one_line(message + (near or f' (`{self.prog} --help` lists all)')))}\n")

    def refuse(self, unknown: Sequence[str]) -> NoReturn:
        """Ends as `error`, because of arguments that no option and no input takes."""
        given = next((word for word in unknown if word.startswith("-")), unknown[0])
        near = did_you_mean(given.partition("=")[0], self._option_string_actions)
        if os.path.lexists(given):
            near = f"; write ./{given} for the file of this name"
        elif given.lower() in METRES_PER_UNIT:
            near = f"; a length and its unit are one word, such as 72{given}"
        self.error(f"unknown argument: {given}{near}")

    def _near(self, message: str) -> str:
        """Returns what may have been meant where a message names what was given and all that is known."""
        found = _CHOICE.search(message) or _ONE_OF.search(message)
        if found is None:
            return ""
        if message.startswith("argument VERB:") and os.path.exists(found["given"]):
            return f"; for a model: {self.prog} functionalize {found['given']} --out results"
        known = found["known"].replace("'", "").split(", ")
        return did_you_mean(found["given"].partition("=")[0], known)

    def _unknown_options(self) -> list[str]:
        """Returns the words that look like options and are none, up to `--`."""
        known = self._option_string_actions
        ended = list(self.words).index("--") if "--" in self.words else len(self.words)
        return [
            word
            for word in self.words[:ended]
            if len(word) > 1
            and word[0] == "-"
            and not re.fullmatch(r"-\.?\d.*", word)
            and not any(option.startswith(word.partition("=")[0]) for option in known)
            and (word.startswith("--") or word[:2] not in known)
        ]
