"""Text that others wrote, as it may reach a terminal or a file: what would steer or break these becomes an escape.

Beside it, short reprs of values with many fields, for people at a Python prompt.

File names and names in models can hold any character. Control characters (C0, DEL, C1) move the cursor, set colours
and titles; bidirectional controls show letters in another order than they stand in; line separators fake lines;
surrogates (bytes of a file name that are no UTF-8) can be neither printed nor written. All else stays as it is.

Configurations show themselves in a line: `ShortRepr`.
"""

import re
from collections.abc import Iterable
from dataclasses import MISSING, Field
from typing import Any, ClassVar, Final

_LONGEST_REPR = 280  # characters of a repr before its last field
_LONGEST_VALUE = 60  # characters of a value

_HIDDEN: Final = re.compile(
    "["
    "\x00-\x1f\x7f-\x9f"  # C0, DEL and C1
    "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"  # bidirectional marks, embeddings, overrides and isolates
    "\u2028\u2029"  # line and paragraph separator
    "\ud800-\udfff"  # surrogates
    "]"
)


def writable(text: str) -> str:
    r"""Returns the text as UTF-8 can hold it: surrogates as escapes (`\udc9b`), all else as it is."""
    return text.encode("utf-8", "backslashreplace").decode("utf-8")


def visible(text: str) -> str:
    r"""Returns the text with each such character as an escape: `\x1b`, `\n`, `\u202e`; twice is as once."""
    return _HIDDEN.sub(lambda found: found[0].encode("unicode_escape").decode("ascii"), text)


class ShortRepr:
    """Abstract base of configurations: the repr lists only the fields that differ from their defaults."""

    __slots__ = ()
    __dataclass_fields__: ClassVar[dict[str, Any]]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        if "__repr__" not in cls.__dict__:
            cls.__repr__ = ShortRepr.__repr__  # type: ignore[method-assign]  # `dataclass` would write its own

    def __repr__(self) -> str:
        fields = ((name, getattr(self, name), _default(field)) for name, field in self.__dataclass_fields__.items())
        changed = ((name, value) for name, value, default in fields if default is MISSING or value != default)
        return short_repr(type(self).__name__, changed)


def _default(field: Field[Any]) -> Any:
    return field.default if field.default_factory is MISSING else field.default_factory()


def short_repr(name: str, fields: Iterable[tuple[str, object]]) -> str:
    """Returns `name(field=value, ...)`: a long value becomes `...`, and where the text grows long it ends so."""
    shown: list[str] = []
    room = _LONGEST_REPR - len(name)
    for field, value in fields:
        text = repr(value)
        shown.append(f"{field}={text if len(text) <= _LONGEST_VALUE else '...'}")
        room -= len(shown[-1]) + 2
        if room < 0:
            shown[-1] = "..."
            break
    return f"{name}({', '.join(shown)})"
