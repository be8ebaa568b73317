"""What a model holds, added up as it is found and before anything is built of it. It reads nothing."""

from typing import final

from grafu.asset.options import Limits


@final
class Tally:
    """The counts of one model so far, each checked against its limit as it grows."""

    def __init__(self, limits: Limits) -> None:
        self._limits = limits
        self._counts: dict[str, int] = {}

    def require(self, where: object, **counts: int) -> None:
        """Refuses what is too much by itself, beside what was counted, and counts nothing.

        Raises:
            AssetTooLarge: if there is more of something than is read.
        """
        for name, count in counts.items():
            self._limits.require(name, self._counts.get(name, 0) + count, where)

    def left(self, name: str) -> int:
        """Returns how much more of something may be read."""
        return self._limits.by_name()[name] - self._counts.get(name, 0)

    def add(self, where: object, **counts: int) -> None:
        """Adds to what was counted; `where` names the input.

        Raises:
            AssetTooLarge: if there is more of something than is read.
        """
        for name, count in counts.items():
            total = self._counts.get(name, 0) + count
            self._limits.require(name, total, where)
            self._counts[name] = total
