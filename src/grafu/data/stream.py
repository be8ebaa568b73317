"""An endless stream of models for training: made on the spot by several processes, or read from shards.

What is made for an index does not depend on the number of processes, and comes in the order of the indices.
"""

import multiprocessing
from collections import deque
from collections.abc import Callable, Generator, Iterator
from concurrent.futures import Future, ProcessPoolExecutor
from functools import partial
from itertools import count, islice
from pathlib import Path
from typing import TypeVar

import numpy as np

from grafu.data.pair import Record, record_of
from grafu.data.shards import ShardReader
from grafu.errors import UnreadableAsset
from grafu.processes.lifetime import (
    end_with_parent,
    interrupts_later,
    leave_interrupts_to_parent,
    started_by_main_thread,
)
from grafu.synth.generate import make_specimen
from grafu.synth.specimen import Specimen

T = TypeVar("T")

_CHUNK = 8  # models that a process makes at a go: half a second of work, so that sending them costs little
_AHEAD = 3  # chunks for each process that are made before they are asked for


def stream_synth(
    seed: int, start: int = 0, jobs: int = 1, points: int = 512, stop: int | None = None
) -> Iterator[Record]:
    """Yields the synthetic models of `seed` from index `start` on: an endless stream, or up to `stop` (not included).

    With `jobs` above 1 so many processes make them; a script must then start under `if __name__ == "__main__"`, as with
    every use of multiprocessing. They end with the iterator (close it, or let go of it).
    """
    return ordered_map(partial(_make_record, seed, points), start, stop, jobs)


def stream_specimens(
    seed: int, start: int = 0, jobs: int = 1, points: int = 512, stop: int | None = None
) -> Iterator[Specimen]:
    """Yields the same models as `stream_synth`, with their meshes."""
    return ordered_map(partial(_make_specimen, seed, points), start, stop, jobs)


def stream_shards(
    folder: Path,
    shuffle_buffer: int = 0,
    seed: int = 0,
    part: tuple[int, int] = (0, 1),
    points: bool = True,
    verify: bool = True,
) -> Iterator[Record]:
    """Yields each model of a folder of shards once: one epoch; a new `seed` for each gives each its own order.

    With `shuffle_buffer` 0 they come in the order of the files. Else the files come in a drawn order, and each model is
    drawn out of so many that wait; waiting costs no memory, for a model is decoded when it is drawn. `part` (k, n)
    yields every n-th model, from the k-th (0..n-1) on: n readers with one seed share the folder without a gap or a
    double.

    Raises:
        UnreadableAsset: if the folder holds no shard, or one is damaged.
        ValueError: if `part` or `shuffle_buffer` is out of range.
    """
    if not 0 <= part[0] < part[1]:
        raise ValueError(f"`part` must be (k, n) with k in 0..n-1: got {part}")
    if shuffle_buffer < 0:
        raise ValueError(f"`shuffle_buffer` must not be negative: got {shuffle_buffer}")
    paths = shard_paths(folder)
    if not paths:
        raise UnreadableAsset(f"`{folder}` must hold shards (shard_*.npz): got none; `grafu synth --out` makes them")
    if shuffle_buffer:
        paths = [paths[i] for i in np.random.default_rng([seed, 0]).permutation(len(paths))]
    places = islice(_places(paths, points, verify), part[0], None, part[1])
    drawn = _shuffled(places, shuffle_buffer, np.random.default_rng([seed, 1, *part])) if shuffle_buffer else places
    return (reader[place] for reader, place in drawn)


def shard_paths(folder: Path) -> list[Path]:
    """Returns the shards in a folder, in order."""
    return sorted(folder.glob("shard_*.npz"))


def ordered_map(
    make: Callable[[int], T], start: int, stop: int | None, jobs: int = 1, chunk: int = _CHUNK
) -> Generator[T, None, None]:
    """Yields `make(i)` for i = start, start + 1, ... in order, made by `jobs` processes (1: by this one).

    `make` must be a function of a module, a value's method, or a `partial` of one. What it raises comes out here.

    Raises:
        BrokenProcessPool: if a process dies.
    """
    if jobs <= 1:
        yield from map(make, count(start) if stop is None else range(start, stop))
        return
    context = multiprocessing.get_context("spawn")  # fork would copy locks that native libraries hold
    pool = ProcessPoolExecutor(jobs, context, initializer=_begin_worker, initargs=(started_by_main_thread(),))
    waiting: deque[Future[list[T]]] = deque()
    try:
        for first in count(start, chunk):
            last = first + chunk if stop is None else min(first + chunk, stop)
            if first < last:
                with interrupts_later():  # this may start a process
                    waiting.append(pool.submit(_make_chunk, make, first, last))
            elif not waiting:
                return
            if len(waiting) > jobs * _AHEAD or first >= last:
                yield from waiting.popleft().result()
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _make_chunk(make: Callable[[int], T], first: int, last: int) -> list[T]:
    return [make(i) for i in range(first, last)]


def _make_specimen(seed: int, points: int, index: int) -> Specimen:
    return make_specimen(seed, index, points)


def _make_record(seed: int, points: int, index: int) -> Record:
    return record_of(make_specimen(seed, index, points))


def _begin_worker(started_by_main_thread: bool) -> None:
    """Leaves Ctrl-C to the parent, which ends the workers, and ends this one when the parent is killed."""
    leave_interrupts_to_parent()
    end_with_parent(started_by_main_thread)


def _places(paths: list[Path], points: bool, verify: bool) -> Iterator[tuple[ShardReader, int]]:
    for path in paths:
        reader = ShardReader(path, points, verify)
        for place in range(len(reader)):
            yield reader, place


def _shuffled(items: Iterator[T], size: int, rng: np.random.Generator) -> Iterator[T]:
    """Yields the items, each drawn out of the next `size`."""
    waiting = list(islice(items, size))
    for item in items:
        drawn = int(rng.integers(len(waiting)))
        waiting[drawn], item = item, waiting[drawn]
        yield item
    yield from (waiting[i] for i in rng.permutation(len(waiting)))
