"""What was asked for, as one value: the asset, the settings, and whose motions. Running it gives what was made.

Arguments of the Python functions are checked where they are given.
"""

import os
from collections.abc import Iterable
from dataclasses import field, replace
from pathlib import Path
from typing import Any, TypeVar, final

from grafu.asset.foreign.motions import ForeignMotions
from grafu.asset.part import Asset
from grafu.dataclass import dataclass
from grafu.errors import OptionError
from grafu.joints.motion_choice import MotionChoice, choice_in_words
from grafu.pipeline.functionalize import Functionalized, functionalize
from grafu.pipeline.pipeline_config import PipelineConfig
from grafu.pipeline.settings import Settings
from grafu.processes.cache import CACHED_VALUES, Cache
from grafu.templates.gallery import open_gallery, own_handles

T = TypeVar("T")


def as_path(value: Any, name: str) -> Path:
    """Returns a path of a str or a Path.

    Raises:
        TypeError: if it is neither.
    """
    if isinstance(value, bytes) or not isinstance(value, str | os.PathLike):
        raise TypeError(f"`{name}` must be a path, as str or Path: got {described(value)}")
    return Path(value)


def require(value: Any, kind: type[T], name: str, expected: str) -> T:
    """Returns the value where it is of this type; a bool is no number.

    Raises:
        TypeError: if it is of another type.
    """
    if not isinstance(value, kind) or (isinstance(value, bool) and kind is not bool):
        raise TypeError(f"`{name}` must be {expected}: got {described(value)}")
    return value


def require_bool_or_word(value: Any, name: str, expected: str) -> bool | str:
    """Returns the value where it is True, False or a str.

    Raises:
        TypeError: if it is of another type.
    """
    if not isinstance(value, bool | str):
        raise TypeError(f"`{name}` must be True, False or {expected}: got {described(value)}")
    return value


def require_word(value: Any, name: str, expected: str = "the id of a part, as str") -> str:
    """Returns the value where it is a str, as `require` does."""
    return require(value, str, name, expected)


def optional_number(value: Any, name: str) -> float | None:
    """Returns a number as float, or None.

    Raises:
        TypeError: if it is something else.
    """
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise TypeError(f"`{name}` must be a number or None: got {described(value)}")
    return float(value)


def as_words(value: Any, name: str) -> tuple[str, ...]:
    """Returns words, each once, in order; one str is one word, or several with commas between.

    Raises:
        TypeError: if it is no str and no series of str.
    """
    words = value.split(",") if isinstance(value, str) else value
    if not isinstance(words, Iterable) or isinstance(words, bytes):
        raise TypeError(f"`{name}` must be a list of names: got {described(value)}")
    found = [require(word, str, name, "a list of names").strip() for word in words]
    return tuple(dict.fromkeys(word for word in found if word))


def described(value: object) -> str:
    """Returns a value's type and a short form of it, for messages."""
    text = repr(value)
    return f"{type(value).__name__} {text if len(text) <= 60 else text[:57] + '...'}"


@final
@dataclass(frozen=True)
class Request:
    """One asset, what is chosen for it, and where motions and templates come from.

    `foreign` are the motions that another system predicted (None: those of `settings.motion`), `templates` a folder of
    the user's own templates. `cache` holds what earlier runs of this asset made; the result is the same without it.
    """

    asset: Asset
    settings: Settings
    foreign: ForeignMotions | None = None
    templates: Path | None = None
    cache: Cache = field(default_factory=lambda: Cache(CACHED_VALUES), compare=False, repr=False)

    def with_settings(self, settings: Settings) -> "Request":
        """Returns the request with other settings, and the same cache."""
        return replace(self, settings=settings)

    def run(self) -> Functionalized:
        """Returns what `grafu.pipeline.functionalize` makes of it.

        Raises:
            FunctionalizationError: if a setting names what there is not, or a template or the weights are at fault.
        """
        own = own_handles(self.templates)
        source = self.foreign or self.settings.motion
        config = PipelineConfig(self.settings, own)
        return functionalize(self.asset, source, open_gallery(self.templates), config, cache=self.cache)


def motion_in_words(part: str, word: str) -> MotionChoice:
    """Returns how a part moves, of one word.

    Raises:
        TypeError: if one of them is no str.
        OptionError: if it is another word than those of `Result.with_motion`.
    """
    require_word(part, "part")
    try:
        return choice_in_words(require_word(word, "how", "a word such as `left`"))
    except OptionError as error:
        raise OptionError(f"how `{part}` moves {error}") from None
