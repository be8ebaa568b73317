"""A word with sizes, as options state it: `oval,thickness=3cm,front=0`; which words there are, others know."""

from collections.abc import Collection, Mapping
from math import isfinite
from typing import final

from grafu.dataclass import dataclass
from grafu.errors import OptionError, did_you_mean
from grafu.geometry.lengths import metres_of


@final
@dataclass(frozen=True, slots=True)
class SizedWord:
    """A word, the lengths that go with it, metres, and the words that do."""

    word: str
    lengths: Mapping[str, float]
    words: Mapping[str, str]


def sized_word(
    text: str, option: str, lengths: Collection[str], words: Mapping[str, Collection[str]] | None = None
) -> SizedWord:
    """Returns the word before the first comma, and what is stated as NAME=VALUE behind it.

    Args:
        text: what the user gave.
        option: the name of the option, for messages.
        lengths: the names whose values are lengths: numbers of metres, or with a unit.
        words: the names whose values are words, with those that there are.

    Raises:
        OptionError: if a name is unknown or occurs twice, or a value is no length of at least 0 or no such word.
    """
    word, *items = (item.strip() for item in text.split(","))
    known = {**dict.fromkeys(lengths, None), **(words or {})}
    sizes, others = dict[str, float](), dict[str, str]()
    for item in items:
        name, equals, value = (found.strip() for found in item.partition("="))
        if not equals or name not in known or name in sizes or name in others:
            wanted = ", ".join(f"{each}=" for each in known) or "no size"
            raise OptionError(
                f"`{option}` takes {wanted} after `{word}`, each once: got {item!r}{did_you_mean(name, known)}"
            )
        choices = known[name]
        if choices is None:
            sizes[name] = _length(value, option, name)
        elif value in choices:
            others[name] = value
        else:
            raise OptionError(f"`{name}` of `{option}` must be one of {', '.join(choices)}: got {value!r}")
    return SizedWord(word, sizes, others)


def _length(text: str, option: str, name: str) -> float:
    try:
        length = metres_of(text)
    except ValueError as error:
        raise OptionError(f"`{name}` of `{option}` {error}") from None
    if not (isfinite(length) and length >= 0):
        raise OptionError(f"`{name}` of `{option}` must be a length of at least 0: got {text!r}")
    return length
