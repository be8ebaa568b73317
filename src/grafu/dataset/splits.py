"""Which split a model belongs to: decided by its geometric hash and the seed alone, so that a set can grow.

All near-duplicates of a group lie in one split: that of the least hash in the group, or that of an earlier set.
"""

from collections import Counter
from collections.abc import Sequence
from hashlib import blake2b
from itertools import accumulate
from pathlib import Path
from typing import Final, final

from grafu.asset.json_files import parse_json, read_own
from grafu.dataclass import dataclass
from grafu.dataset.layout import INDEX, SPLITS
from grafu.errors import OptionError, UnreadableAsset

_RANGE: Final = 2**64
_MOST_BYTES: Final = 2**32  # of an index


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


def splits_of(
    groups: list[str], hashes: list[str], ratio: SplitRatio, seed: int, earlier: Sequence[str] = ()
) -> list[str]:
    """Returns the split of each model, from the name of its group and its geometric hash.

    `earlier` states in which split each was before, empty where it was in none: its group stays there; where two splits
    are stated in a group, it goes to the one of more of its models.
    """
    least: dict[str, str] = {}
    stated: dict[str, Counter[str]] = {}
    for group, one, before in zip(groups, hashes, earlier or [""] * len(groups), strict=True):
        least[group] = min(least.get(group, one), one)
        if before:
            stated.setdefault(group, Counter())[before] += 1
    drawn = {group: ratio.split_of(one, seed) for group, one in least.items()}
    kept = {group: max(SPLITS, key=lambda split: counts[split]) for group, counts in stated.items()}
    return [kept.get(group, drawn[group]) for group in groups]


def splits_in(folder: Path) -> dict[str, str]:
    """Returns the split of each model, by name, in an earlier set.

    Raises:
        UnreadableAsset: if the folder holds no index of a set.
    """
    expected = "the index of a set that `grafu dataset` wrote"
    found: dict[str, str] = {}
    for line in read_own(folder / INDEX, expected, _MOST_BYTES).splitlines():
        row = parse_json(line, folder / INDEX, expected)
        if not isinstance(row, dict) or not isinstance(row.get("name"), str) or row.get("split") not in SPLITS:
            raise UnreadableAsset(f"{folder / INDEX} is damaged: expected {expected}")
        found[row["name"]] = row["split"]
    return found
