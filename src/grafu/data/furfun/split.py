"""Which models are learned from, chosen by and judged on: always by model, never by pair.

And the split files of a release, in and out.
"""

from collections.abc import Iterable
from hashlib import blake2b
from pathlib import Path
from typing import Literal, final

import numpy as np

from grafu.asset.regular_files import is_within
from grafu.data.furfun.graph_files import load_graph_json
from grafu.dataclass import dataclass
from grafu.errors import AssetError, GraphError
from grafu.graph.json_values import Json, read_list
from grafu.graph.serialize import dump_json

SplitName = Literal["train", "val", "test"]
SEED = 42  # the authors'
_TRAIN, _VAL = 0.8, 0.1  # the authors'; the rest is for the test


@final
@dataclass(frozen=True, slots=True)
class Split:
    """Model ids for training, validation and test.

    Raises:
        ValueError: if an id stands twice.
    """

    train: tuple[str, ...]
    val: tuple[str, ...]
    test: tuple[str, ...]

    def __post_init__(self) -> None:
        ids = self.train + self.val + self.test
        if len(set(ids)) < len(ids):
            twice = next(i for k, i in enumerate(ids) if i in ids[:k])
            raise ValueError(f"a split must name each model once: got `{twice}` twice")

    def only(self, ids: Iterable[str]) -> "Split":
        """Returns the split without the models that are not among `ids`."""
        kept = frozenset(ids)
        train, val, test = (tuple(i for i in part if i in kept) for part in (self.train, self.val, self.test))
        return Split(train, val, test)


def split_models(ids: Iterable[str], seed: int = SEED) -> Split:
    """Returns the ids divided 80/10/10, shuffled by the seed, whatever order they came in."""
    known = sorted(set(ids))
    shuffled = [known[int(k)] for k in np.random.default_rng(seed).permutation(len(known))]
    first, second = round(_TRAIN * len(known)), round((_TRAIN + _VAL) * len(known))
    train, val, test = (tuple(sorted(part)) for part in (shuffled[:first], shuffled[first:second], shuffled[second:]))
    return Split(train, val, test)


def split_of(model_id: str, seed: int = SEED) -> SplitName:
    """Returns where one model of an endless stream belongs, 80/10/10 in the long run, whatever else it holds."""
    digest = blake2b(f"{seed}/{model_id}".encode(), digest_size=8).digest()
    place = int.from_bytes(digest, "little") / 2**64
    return "train" if place < _TRAIN else "val" if place < _TRAIN + _VAL else "test"


SPLIT_NAMES = ("full_split", "subset_split")
_KEYS = ("train_mids", "val_mids", "test_mids")


def read_split(folder: Path, name: str) -> Split:
    """Returns the split in `<name>.json`.

    Raises:
        AssetError: if there is none, or it names a model twice.
        GraphError: if it is no JSON object of lists.
    """
    path = folder / f"{name}.json"
    if Path(name).name != name or not path.is_file() or not is_within(path, folder):
        there = ", ".join(sorted(file.stem for file in folder.glob("*.json"))) or "none"
        raise AssetError(f"{folder} holds no split `{name}`: it has {there}")
    data = load_graph_json(path)
    try:
        return Split(*(_ids(data, key) for key in _KEYS))
    except (GraphError, ValueError) as error:
        raise AssetError(f"{path}: {error}") from error


def split_to_json(split: Split) -> str:
    """Returns the text of a split file."""
    return dump_json(dict(zip(_KEYS, (list(split.train), list(split.val), list(split.test)), strict=True)))


def _ids(data: Json, key: str) -> tuple[str, ...]:
    return tuple(str(model_id) for model_id in read_list(data, key, "a split"))
