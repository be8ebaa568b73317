"""Where the models to learn from come from: made on the spot, read from shards, or a FurFun release.

A source answers for every number 0, 1, 2, ... with one natural pair; the same number gives the same pair in every
process. Synthetic furniture never repeats; a folder is gone through again and again, each time in another order.
"""

from functools import lru_cache
from pathlib import Path
from typing import Protocol, final, runtime_checkable

import numpy as np

from grafu.data.furfun.folder import FurFunFolder
from grafu.data.furfun.split import SplitName
from grafu.data.pair import GraphPair, record_of, record_pair
from grafu.data.shards import ShardReader
from grafu.data.stream import shard_paths
from grafu.data.write_plan import made_with
from grafu.dataclass import dataclass
from grafu.errors import AssetError, OptionError, UnreadableAsset
from grafu.synth.generate import make_specimen

VALIDATION_SEED = 990_001
"""The seed of the synthetic furniture that weights are chosen by; no training may use it."""
TEST_SEED = 990_002
"""The seed of the synthetic furniture that figures are reported on; no training and no choice may use it."""
RESERVED_SEEDS = (VALIDATION_SEED, TEST_SEED)
"""No model made with these is trained on, on the spot or out of a folder."""


@runtime_checkable
class Source(Protocol):
    """An endless stream of models, by number. It can be sent to other processes."""

    @property
    def name(self) -> str:
        """What it is, in words."""

    @property
    def maker_seed(self) -> int | None:
        """The seed that its furniture was made with; None where it was not made, or the seed is unknown."""

    def pair(self, number: int) -> GraphPair:
        """Returns the natural pair of model `number` (0, 1, ...)."""


@final
@dataclass(frozen=True)
class SynthSource:
    """Synthetic furniture of one seed, never the same twice; `points` on each part.

    Raises:
        ValueError: if a number is negative.
    """

    seed: int
    points: int = 512

    def __post_init__(self) -> None:
        if min(self.seed, self.points) < 0:
            raise ValueError(f"`seed` and `points` must not be negative: got {self.seed}, {self.points}")

    @property
    def name(self) -> str:
        """What it is, in words."""
        return f"furniture made with seed {self.seed}"

    @property
    def maker_seed(self) -> int:
        """The seed that the furniture is made with."""
        return self.seed

    def pair(self, number: int) -> GraphPair:
        """Returns the natural pair of model `number`."""
        return record_pair(record_of(make_specimen(self.seed, number, self.points)))


@final
@dataclass(frozen=True)
class ShardSource:
    """The models of a folder of shards (`grafu synth --out`), over and over, in an order drawn with `seed`.

    Raises:
        UnreadableAsset: if the folder holds no shard, or one is damaged.
    """

    folder: Path
    seed: int = 0

    def __post_init__(self) -> None:
        if not shard_paths(self.folder):
            raise UnreadableAsset(f"`{self.folder}` must hold shards (shard_*.npz): `grafu synth --out` makes them")

    @property
    def name(self) -> str:
        """What it is, in words."""
        return f"{_models_from(self.folder)[-1]} models in {self.folder}"

    @property
    def maker_seed(self) -> int | None:
        """The seed that the folder's manifest states; None where it has none."""
        return made_with(self.folder)

    def pair(self, number: int) -> GraphPair:
        """Returns the natural pair of model `number` of the endless sequence."""
        starts = _models_from(self.folder)
        place = _place(self.seed, number, starts[-1])
        shard = int(np.searchsorted(starts, place, side="right")) - 1
        return record_pair(_reader(shard_paths(self.folder)[shard])[place - starts[shard]])


FULL_SPLIT = "full_split"


@final
@dataclass(frozen=True)
class FurFunSource:
    """One part of a split of a FurFun release, over and over, in an order drawn with `seed`.

    `split` is the name of the split: `full_split`, or `subset_split` without models that are also in PartNet-Mobility.

    Raises:
        UnreadableAsset: if the folder is not laid out like a release, or has no pair in that part of its split.
    """

    folder: FurFunFolder
    part: SplitName
    seed: int = 0
    split: str = FULL_SPLIT

    def __post_init__(self) -> None:
        if not _paired(self.folder, self.part, self.split):
            raise UnreadableAsset(
                f"`{self.folder.path}` has no functional graph in the part `{self.part}` of its split"
            )

    @property
    def name(self) -> str:
        """What it is, in words."""
        return f"{len(self.models)} models of the part `{self.part}` of {self.folder.path}"

    @property
    def maker_seed(self) -> int | None:
        """The seed that the release was made with; None of one that was annotated."""
        return made_with(self.folder.path)

    @property
    def models(self) -> tuple[str, ...]:
        """The ids of the models that it goes through."""
        return _paired(self.folder, self.part, self.split)

    def pair(self, number: int) -> GraphPair:
        """Returns the natural pair of model `number` of the endless sequence."""
        return _kept_pair(self.folder, self.models[_place(self.seed, number, len(self.models))])


def source_to_train_on(data: str, seed: int, points: int, split: str = "") -> Source:
    """Returns furniture made with `seed` for the word `synth`, else what the folder of that name holds.

    Raises:
        AssetError: if the furniture judges the weights, the folder holds nothing to train on, or has no such split.
        OptionError: if a split is named of what has none.
    """
    if split and data == "synth":
        raise OptionError(f"only a FurFun release has splits: got `{split}` and furniture that is made on the spot")
    source = SynthSource(seed, points) if data == "synth" else source_in(Path(data), seed, points, split)
    if source.maker_seed in RESERVED_SEEDS:
        raise AssetError(
            f"it must not be trained on {source.name}: made with seed {source.maker_seed}, it judges the weights"
        )
    return source


def source_in(folder: Path, seed: int, points: int, split: str = "") -> Source:
    """Returns the models to train on in a folder of shards, or the training part of a split of a FurFun release.

    Raises:
        UnreadableAsset: if it is neither, or has no such split.
        OptionError: if a split is named of shards.
    """
    if not shard_paths(folder):
        return FurFunSource(FurFunFolder(folder, points), "train", seed, split or FULL_SPLIT)
    if split:
        raise OptionError(f"only a FurFun release has splits: got `{split}` and shards in {folder}")
    return ShardSource(folder, seed)


def _place(seed: int, number: int, count: int) -> int:
    """Returns which of `count` models comes as `number`: each once, in a drawn order, then all again in another."""
    return int(_order(seed, number // count, count)[number % count])


@lru_cache(maxsize=4)
def _order(seed: int, epoch: int, count: int) -> np.ndarray:
    return np.random.default_rng([seed, epoch]).permutation(count)


@lru_cache(maxsize=4)
def _models_from(folder: Path) -> tuple[int, ...]:
    """Returns the number of models before each shard, and of all."""
    return (0, *np.cumsum([len(_reader(path)) for path in shard_paths(folder)]).tolist())


@lru_cache(maxsize=256)  # their graphs are some megabytes each, their points stay on disk
def _reader(path: Path) -> ShardReader:
    return ShardReader(path, verify=False)


@lru_cache(maxsize=8)
def _paired(folder: FurFunFolder, part: SplitName, split: str) -> tuple[str, ...]:
    known = frozenset(folder.paired)
    chosen: tuple[str, ...] = getattr(folder.split(split), part)
    return tuple(model for model in chosen if model in known)


@lru_cache(maxsize=1024)  # a release is read once: 233 models with points are some hundred megabytes
def _kept_pair(folder: FurFunFolder, model_id: str) -> GraphPair:
    return folder.pair(model_id)
