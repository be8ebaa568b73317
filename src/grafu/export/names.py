"""Names that are unique and safe in files and formats. It knows nothing of what they name."""

import re
from typing import final


@final
class NameBook:
    """Hands out names that differ from one another in more than case."""

    def __init__(self) -> None:
        self._taken: set[str] = set()

    def unique(self, wish: str) -> str:
        """Returns the wished name, or the first of `wish_2`, `wish_3`, ... that is free, and takes it."""
        name, count = wish, 1
        while name.lower() in self._taken:
            count += 1
            name = f"{wish}_{count}"
        self._taken.add(name.lower())
        return name


def file_safe(name: str) -> str:
    """Returns a name of letters, digits, `_`, `-` and `.` that is no hidden file and never empty."""
    return re.sub(r"[^A-Za-z0-9_.-]+", "_", name).lstrip(".-") or "unnamed"
