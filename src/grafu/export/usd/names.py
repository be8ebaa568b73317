"""Names of prims: what OpenUSD takes everywhere, and the name that was wished where it differs."""

import re
from typing import final

from grafu.export.names import NameBook


def identifier(name: str) -> str:
    """Returns a name of letters, digits and `_` that does not begin with a digit and is never empty."""
    safe = re.sub(r"[^A-Za-z0-9_]", "_", name) or "unnamed"
    return f"_{safe}" if safe[0].isdigit() else safe


@final
class Siblings:
    """Hands out the names of the children of one prim."""

    def __init__(self, *taken: str) -> None:
        self._book = NameBook(case_counts=True)
        for name in taken:
            self._book.unique(name)

    def unique(self, wish: str) -> str:
        """Returns the wished name where a prim can have it, else the nearest one that is free."""
        return self._book.unique(identifier(wish))
