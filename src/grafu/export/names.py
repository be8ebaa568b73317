"""Names that are unique and fit into formats, and numbers as XML attributes hold them.

Numbers are short, without minus zero or rounding noise.
"""

from collections.abc import Iterable
from typing import final


def number(value: float) -> str:
    """Returns a number in ten digits; what is smaller than 1e-12 is zero."""
    return f"{value if abs(value) > 1e-12 else 0.0:.10g}"


def numbers(values: Iterable[float]) -> str:
    """Returns numbers apart by spaces."""
    return " ".join(number(float(value)) for value in values)


@final
class NameBook:
    """Hands out names that differ from one another, and in more than case unless case counts."""

    def __init__(self, case_counts: bool = False) -> None:
        self._taken: set[str] = set()
        self._case_counts = case_counts

    def unique(self, wish: str) -> str:
        """Returns the wished name, or the first of `wish_2`, `wish_3`, ... that is free, and takes it."""
        name, count = wish, 1
        while self._key(name) in self._taken:
            count += 1
            name = f"{wish}_{count}"
        self._taken.add(self._key(name))
        return name

    def _key(self, name: str) -> str:
        return name if self._case_counts else name.lower()


def printable(name: str) -> str:
    """Returns a name that XML can hold: it has no control characters."""
    return "".join(c if c.isprintable() else "_" for c in name)
