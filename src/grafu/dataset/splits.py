"""Which split a model belongs to: decided by its geometric hash and the seed alone, so that a set can grow.

All near-duplicates of a group lie in one split: that of the least hash in the group.
"""

from dataclasses import dataclass
from hashlib import blake2b
from itertools import accumulate
from typing import Final, final

from grafu.dataset.layout import SPLITS
from grafu.errors import OptionError

_RANGE: Final = 2**64


@final
@dataclass(frozen=True)
class SplitRatio:
    """How many of a hundred models go to each of `SPLITS`.

    Raises:
        OptionError: if they do not add up to 100, or one is negative.
    """

    percents: tuple[float, ...] = (80.0, 10.0, 10.0)

    def __post_init__(self) -> None:
        if len(self.percents) != len(SPLITS) or min(self.percents) < 0 or round(sum(self.percents), 6) != 100:
            given = "/".join(f"{percent:g}" for percent in self.percents)
            raise OptionError(
                f"the splits must be percentages of {', '.join(SPLITS)} that add up to 100, as 80/10/10: got {given}"
            )

    def split_of(self, key: str, seed: int) -> str:
        """Returns the split that a key, such as a geometric hash, belongs to; another seed draws anew."""
        drawn = int.from_bytes(blake2b(f"{seed}:{key}".encode(), digest_size=8).digest()) / _RANGE * 100
        bounds = zip(SPLITS, accumulate(self.percents), strict=True)
        return next((name for name, bound in bounds if drawn < bound), SPLITS[-1])


def splits_of(groups: list[str], hashes: list[str], ratio: SplitRatio, seed: int) -> list[str]:
    """Returns the split of each model, from the name of its group and its geometric hash."""
    least: dict[str, str] = {}
    for group, one in zip(groups, hashes, strict=True):
        least[group] = min(least.get(group, one), one)
    return [ratio.split_of(least[group], seed) for group in groups]
