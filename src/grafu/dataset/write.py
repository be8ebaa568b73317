"""Writes results as one set, whole or not at all. It reads every result twice and holds one at a time in memory.

    DIR/train-000000.tar, ...   shards (`--format tar`), or DIR/train/KEY/ with DIR/train/metadata.jsonl
    DIR/index.jsonl             a row for each model; DIR/index.parquet the same, where pyarrow is installed
    DIR/README.md               the card

First each result is looked through and described; then all are grouped, given their splits, and stored.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from functools import partial
from hashlib import blake2b
from itertools import chain
from pathlib import Path
from typing import Final, Literal, Protocol, TypeVar, final, runtime_checkable

import numpy as np

from grafu.data.stream import ordered_map
from grafu.dataclass import dataclass
from grafu.dataset.card import UNKNOWN_LICENSE, SplitTally, card, require_license
from grafu.dataset.descriptor import Descriptor, geometric_hash
from grafu.dataset.figures import Row, figures_of, in_order
from grafu.dataset.index import IndexWriter
from grafu.dataset.layout import CARD, INDEX
from grafu.dataset.near_duplicates import group_names, near_duplicates
from grafu.dataset.results import key_of, name_of, open_result, results_in, shape_of, why_unusable
from grafu.dataset.splits import SplitRatio, splits_in, splits_of
from grafu.dataset.storage import ModelContent, ModelFolders, TarShards
from grafu.errors import ExportError, FunctionalizationError, UnreadableAsset
from grafu.export.files import require_free, whole_folder
from grafu.export.marker import read_marker
from grafu.export.output_names import same_place, why_not_apart
from grafu.pipeline.verdict import verdict_of
from grafu.pipeline.words import Colour

SetFormat = Literal["tar", "folder"]
LEAST_COLOUR: Final = {"green": (Colour.GREEN,), "yellow": (Colour.GREEN, Colour.YELLOW), "all": tuple(Colour)}
_CHUNK: Final = 1000  # results that a process gets at once, at most
_CHUNKS_OF_EACH: Final = 4
T = TypeVar("T")


@runtime_checkable
class Watch(Protocol):
    """Shows how far the work is: yields the items as they come, `total` of what `word` names."""

    def __call__(self, items: Iterable[T], total: int, word: str, /) -> Iterable[T]:
        """Returns the items."""


def unwatched(items: Iterable[T], *_: object) -> Iterable[T]:
    """Shows nothing."""
    return items


@final
@dataclass(frozen=True)
class ResultSetPlan:
    """How a set is written: `only` is the worst verdict that comes in (`all`: any), `shard_bytes` the most of a shard.

    Models of the set in the folder `like` stay in their splits.

    Raises:
        OptionError: if the license is not spelled as on Hugging Face.
    """

    format: SetFormat = "tar"
    shard_bytes: int = 500_000_000
    ratio: SplitRatio = SplitRatio()
    seed: int = 0
    only: Literal["green", "yellow", "all"] = "all"
    license: str = UNKNOWN_LICENSE
    jobs: int = 1
    like: Path | None = None

    def __post_init__(self) -> None:
        require_license(self.license)


@final
@dataclass(frozen=True)
class ModelOutcome:
    """What became of a result: its row in the set; or None with an `error`; or None alone, where `only` leaves it out.

    `verdict` is its colour, empty with an error.
    """

    folder: Path
    row: Row | None = None
    error: str = ""
    verdict: str = ""


@final
@dataclass(frozen=True, eq=False)
class DescribedResult:
    """A result as it was looked through."""

    folder: Path
    verdict: Colour
    descriptor: Descriptor


@final
@dataclass(frozen=True)
class _Assigned:
    """Where a described result goes."""

    folder: Path
    split: str
    hash: str
    group: str
    group_size: int


def write_result_set(
    given: Sequence[Path], out: Path, plan: ResultSetPlan, overwrite: bool = False, watch: Watch = unwatched
) -> Iterator[ModelOutcome]:
    """Writes the set of all results that are given, or lie in folders that are given; yields what becomes of each.

    What cannot be used is left out. Stopping the iterator leaves nothing behind.

    Raises:
        ExportError: if the set cannot be written, or would replace one of the results, or something else than a set.
        UnreadableAsset: if `like` is no set, or there is no result that can be used (of a single one: the error that
            was yielded).
    """
    require_free(out, overwrite)
    found = list(results_in(given))
    folders = list(dict.fromkeys(one for one in found if isinstance(one, Path)))
    _require_place(out, (*given, *folders))
    earlier = splits_in(plan.like) if plan.like else {}
    described: list[DescribedResult] = []
    error = ""
    unreadable = (ModelOutcome(Path(), error=str(one)) for one in found if not isinstance(one, Path))
    looked = watch(_apart(_described(folders, plan.jobs)), len(folders), "looked through")
    for one in chain(unreadable, looked):
        if isinstance(one, ModelOutcome):
            error = one.error
            yield one
        elif one.verdict in LEAST_COLOUR[plan.only]:
            described.append(one)
        else:
            yield ModelOutcome(one.folder, verdict=one.verdict)
    if not described:
        none = f"no result of {len(found)} can come into the set: mend what is wrong, or change --only"
        raise UnreadableAsset(error if error and len(found) == 1 else none)
    with whole_folder(out, overwrite) as fresh:
        yield from _store(
            watch(_assigned(described, plan, earlier), len(described), "stored"), fresh, out.resolve().name, plan
        )


def _require_place(out: Path, results: Iterable[Path]) -> None:
    """Makes sure that the set replaces no result and nothing but an earlier set."""
    if why := why_not_apart(out, results):
        raise ExportError(why)
    marker = read_marker(out)
    if marker is not None and marker.files and INDEX not in marker.files:
        raise ExportError(f"`{out}` holds another output of grafu than a set of results: choose another --out")


def _described(folders: list[Path], jobs: int) -> Iterator[DescribedResult | ModelOutcome]:
    chunk = max(1, min(_CHUNK, len(folders) // (jobs * _CHUNKS_OF_EACH)))
    with closing(ordered_map(partial(_describe, folders), 0, len(folders), jobs, chunk)) as made:
        yield from made


def _describe(folders: list[Path], index: int) -> DescribedResult | ModelOutcome:
    folder = folders[index]
    try:
        result = open_result(folder)
        return DescribedResult(folder, verdict_of(result.report).colour, shape_of(result))
    except (FunctionalizationError, OSError) as error:
        return ModelOutcome(folder, error=why_unusable(error, folder))


def _apart(results: Iterable[DescribedResult | ModelOutcome]) -> Iterator[DescribedResult | ModelOutcome]:
    """Yields the results, and of two of one name a complaint of the second."""
    named: dict[str, Path] = {}
    for one in results:
        if isinstance(one, ModelOutcome):
            yield one
            continue
        first = named.setdefault(same_place(key_of(name_of(one.folder))), one.folder)
        why = f"{one.folder}: {first} has the same name, by which models are known in a set: rename one of the folders"
        yield one if first == one.folder else ModelOutcome(one.folder, error=why)


def _assigned(results: Sequence[DescribedResult], plan: ResultSetPlan, earlier: Mapping[str, str]) -> list[_Assigned]:
    """Returns where each goes, in the order in which they are stored: by a digest of the name, as if shuffled."""
    descriptors = np.stack([one.descriptor for one in results])
    groups = group_names(descriptors, near_duplicates(descriptors))
    sizes = dict(zip(*np.unique(groups, return_counts=True), strict=True))
    hashes = [geometric_hash(one) for one in descriptors]
    before = [earlier.get(name_of(one.folder), "") for one in results]
    splits = splits_of(groups, hashes, plan.ratio, plan.seed, before)
    made = [
        _Assigned(one.folder, split, word, group, int(sizes[group]))
        for one, split, word, group in zip(results, splits, hashes, groups, strict=True)
    ]
    return sorted(made, key=lambda one: _shuffled(one.folder, plan.seed))


def _shuffled(folder: Path, seed: int) -> bytes:
    return blake2b(f"{seed}:{name_of(folder)}".encode(), digest_size=16).digest()


def _store(results: Iterable[_Assigned], folder: Path, title: str, plan: ResultSetPlan) -> Iterator[ModelOutcome]:
    tallies: dict[str, SplitTally] = {}
    storage = TarShards(folder, plan.shard_bytes) if plan.format == "tar" else ModelFolders(folder)
    with storage, IndexWriter(folder) as index:
        for one in results:
            try:
                content, figures = _content(one)
            except (FunctionalizationError, OSError) as error:  # it was changed meanwhile
                yield ModelOutcome(one.folder, error=why_unusable(error, one.folder))
                continue
            row = in_order({**figures, "split": one.split, "shard": storage.place(one.split, content)})
            storage.add(one.split, content, row)
            index.add(row)
            tallies.setdefault(one.split, SplitTally()).add(row)
            yield ModelOutcome(one.folder, row, verdict=row["verdict"])
    if not tallies:
        raise UnreadableAsset("every result was changed while the set was written: run again when they are finished")
    text = card(title, tallies, plan.format == "tar", plan.license, plan.seed)
    (folder / CARD).write_text(text, encoding="utf-8")


def _content(one: _Assigned) -> tuple[ModelContent, Row]:
    """Returns the files of a model and its row, without where it will be."""
    result = open_result(one.folder)
    bundled = set(result.bundled)
    files = {name: result.read(name) for name in result.files}
    name = name_of(one.folder)
    content = ModelContent(
        key_of(name),
        {name: data for name, data in files.items() if name not in bundled},
        {name: data for name, data in files.items() if name in bundled},
        result.formats,
    )
    return content, {
        **figures_of(result.report),
        "name": name,
        "key": content.key,
        "files": list(result.files),
        "formats": list(result.formats),
        "bytes": content.size,
        "geometric_hash": one.hash,
        "group": one.group,
        "group_size": one.group_size,
    }
