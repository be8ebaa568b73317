"""Streams: the same models in the same order for any number of processes; every model of a folder once an epoch."""

import multiprocessing
import os
from collections.abc import Callable
from concurrent.futures.process import BrokenProcessPool
from functools import partial
from itertools import islice
from pathlib import Path

import pytest

from grafu.data.pair import Record, record_of
from grafu.data.shards import write_shard
from grafu.data.stream import ordered_map, stream_shards, stream_specimens, stream_synth
from grafu.errors import UnreadableAsset
from remembered import specimen

pytestmark = pytest.mark.usefixtures("remembered")


def square(number: int) -> int:
    return number * number


def fail_at(bad: int, number: int) -> int:
    if number == bad:
        raise ZeroDivisionError(f"at {number}")
    return number


def die_at(bad: int, number: int) -> int:
    if number == bad:
        os._exit(11)
    return number


def ids(records: list[Record]) -> list[str]:
    return [record.model_id for record in records]


@pytest.fixture(scope="module")
def made() -> list[Record]:
    return [record_of(specimen(5, i, 8)) for i in range(25)]


@pytest.fixture(scope="module")
def folder(made: list[Record], tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("folder")
    for number, first in enumerate(range(0, 25, 10)):
        write_shard(made[first : first + 10], folder / f"shard_{number:06d}.npz")
    return folder


def test_processes_change_nothing(made: list[Record]) -> None:
    assert list(stream_synth(5, 3, jobs=2, points=8, stop=25)) == made[3:]
    assert list(stream_synth(5, 3, jobs=1, points=8, stop=25)) == made[3:]


def test_specimens_stream_with_their_meshes(made: list[Record]) -> None:
    assert [record_of(s) for s in islice(stream_specimens(5, points=8), 2)] == made[:2]


@pytest.mark.parametrize("stop", [5, 21, 22, 45])
def test_order_and_end_hold_for_any_length(stop: int) -> None:
    assert list(ordered_map(square, 5, stop, jobs=2, chunk=4)) == [i * i for i in range(5, stop)]


def test_an_endless_stream_ends_with_its_processes() -> None:
    endless = ordered_map(square, 0, None, jobs=2)
    assert list(islice(endless, 50)) == [i * i for i in range(50)]
    endless.close()
    assert multiprocessing.active_children() == []


def test_an_error_in_a_process_comes_out() -> None:
    with pytest.raises(ZeroDivisionError, match="at 13"):
        list(ordered_map(partial(fail_at, 13), 0, None, jobs=2))
    assert multiprocessing.active_children() == []


def test_a_dead_process_is_noticed() -> None:
    with pytest.raises(BrokenProcessPool):
        list(ordered_map(partial(die_at, 13), 0, 40, jobs=1 + 1))


def test_shards_stream_in_order(folder: Path, made: list[Record]) -> None:
    assert ids(list(stream_shards(folder))) == ids(made)


@pytest.mark.parametrize("buffer", [0, 1, 7, 1000])
@pytest.mark.parametrize("parts", [1, 2, 7])
def test_each_model_comes_once_to_one_reader(folder: Path, made: list[Record], buffer: int, parts: int) -> None:
    read = [record for k in range(parts) for record in stream_shards(folder, buffer, seed=4, part=(k, parts))]
    assert sorted(ids(read)) == ids(made)


def test_shuffling_follows_its_seed(folder: Path, made: list[Record]) -> None:
    def order(seed: int) -> list[str]:
        return ids(list(stream_shards(folder, 8, seed, points=False)))

    assert order(1) == order(1)
    assert order(1) != order(2)
    assert order(1) != ids(made)


def test_a_folder_without_shards_is_one_error(tmp_path: Path) -> None:
    with pytest.raises(UnreadableAsset, match="must hold shards"):
        stream_shards(tmp_path)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (partial(stream_shards, part=(2, 2)), r"must be \(k, n\)"),
        (partial(stream_shards, shuffle_buffer=-1), "must not be negative"),
    ],
)
def test_wrong_numbers_are_refused(folder: Path, call: Callable[[Path], object], said: str) -> None:
    with pytest.raises(ValueError, match=said):
        call(folder)
