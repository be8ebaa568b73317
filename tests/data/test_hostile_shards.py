"""Shards that a user wrote to do harm, or by mistake: refused in one line, before memory is taken."""

import io
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest

from grafu.data.pair import record_of
from grafu.data.shards import ShardReader, write_shard
from grafu.data.shards_file import read_array_file, write_array_file
from grafu.errors import AssetError, AssetTooLarge, UnreadableAsset
from grafu.synth.generate import make_specimen


@pytest.fixture(scope="module")
def columns(tmp_path_factory):
    path = tmp_path_factory.mktemp("whole") / "shard.npz"
    write_shard([record_of(make_specimen(11, index, points=8)) for index in range(2)], path)
    arrays, texts = read_array_file(path, mapped="points")
    return {name: np.array(array) for name, array in arrays.items()}, texts


def filled(column, value):
    return np.full_like(column, value)


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("points", lambda c: c[:3]),
        ("label", lambda c: filled(c, 200)),
        ("given_label", lambda c: filled(c, 200)),
        ("node_id", lambda c: filled(c, 2**32 - 1)),
        ("source_name", lambda c: c.astype(np.float64)),
        ("box", lambda c: filled(c, np.nan)),
        ("box", lambda c: c[:, ::-1]),
        ("box", lambda c: c.reshape(-1)),
        ("transparent", lambda c: filled(c, 1.5)),
        ("transparent", lambda c: filled(c, np.nan)),
        ("edge", lambda c: filled(c, 60_000)),
        ("given_edge", lambda c: c[:, :3]),
        ("nodes_from", lambda c: c[::-1]),
        ("nodes_from", lambda c: c + 1),
        ("points_from", lambda c: filled(c, -1)),
        ("points_from", lambda c: c[:0]),
        ("model_id", lambda c: c[:1]),
        ("defect_kind", lambda c: np.array([200], np.uint8)),
        ("family", None),
    ],
)
def test_columns_that_do_not_fit_are_refused_when_the_shard_is_opened(name, change, columns, tmp_path):
    arrays, texts = columns
    changed = {key: array for key, array in arrays.items() if key != name or change}
    changed |= {name: change(arrays[name])} if change else {}
    write_array_file(changed, texts, tmp_path / "shard.npz")

    with pytest.raises(UnreadableAsset, match="damaged") as caught:
        ShardReader(tmp_path / "shard.npz")
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("names", [None, {"a": 1}, ["a", 1], []])
def test_names_that_are_no_words_are_refused(names, columns, tmp_path):
    arrays, texts = columns
    write_array_file(arrays, {**texts, "names": names}, tmp_path / "shard.npz")
    with pytest.raises(UnreadableAsset, match="words"):
        ShardReader(tmp_path / "shard.npz")


def lying_array(shape: str) -> bytes:
    head = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head + bytes(64)


@pytest.mark.parametrize("member", ["box.npy", "points.npy"])
@pytest.mark.parametrize("shape", ["(9999999999,)", "(-8,)", "(3, 3)", "(2**40,)", "'x'", "((", "(0,)"])
def test_an_array_that_claims_another_size_takes_no_memory(member, shape, tmp_path):
    with zipfile.ZipFile(tmp_path / "shard.npz", "w") as archive:
        archive.writestr(member, lying_array(shape))
    with pytest.raises(UnreadableAsset, match="no whole file"):
        read_array_file(tmp_path / "shard.npz", mapped="points")


def test_an_archive_that_unpacks_without_end_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("grafu.data.shards_file._MOST", 2**20)
    stored = io.BytesIO()
    with zipfile.ZipFile(stored, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("names.json", b" " * 2**21)
    (tmp_path / "shard.npz").write_bytes(stored.getvalue())
    with pytest.raises(AssetTooLarge, match="at most 1 are read"):
        read_array_file(tmp_path / "shard.npz", mapped="points")


@pytest.mark.parametrize("target", ["../secret.npz", "/dev/zero", ".", "shard.npz"])
def test_a_shard_that_is_a_link_out_of_its_folder_is_not_opened(target, columns, tmp_path: Path):
    arrays, texts = columns
    write_array_file(arrays, texts, tmp_path / "secret.npz")
    (tmp_path / "data").mkdir()
    (tmp_path / "data" / "shard.npz").symlink_to(target)
    with pytest.raises(AssetError, match=r"leads out of its folder|no regular file"):
        ShardReader(tmp_path / "data" / "shard.npz")
