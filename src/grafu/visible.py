"""Text that others wrote, as it may reach a terminal or a file: what would steer or break these becomes an escape.

File names and names in models can hold any character. Control characters (C0, DEL, C1) move the cursor, set colours
and titles; bidirectional controls show letters in another order than they stand in; line separators fake lines;
surrogates (bytes of a file name that are no UTF-8) can be neither printed nor written. All else stays as it is.
"""

import re
from typing import Final

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
