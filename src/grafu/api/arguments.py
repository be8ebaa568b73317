"""Checks the arguments of the Python functions where they are given. It reads nothing."""

import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any, TypeVar

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
