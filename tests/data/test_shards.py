"""Shards: what is written comes back, from any place in the file; what is damaged states so in one line."""

import json
from dataclasses import replace
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from record_strategies import records

from grafu.data.pair import Record, record_of, record_pair
from grafu.data.shards import SCHEMA, ShardReader, write_shard
from grafu.data.shards_arrays import LARGEST_ERROR, arrays_to_record, codes_to_points, points_to_codes, record_to_arrays
from grafu.errors import ExportError, GraphError, UnreadableAsset
from grafu.geometry.arrays import vec3
from grafu.geometry.box import Box
from grafu.geometry.sampling import PointCloud
from grafu.graph.functional_graph import FunctionalGraph, PartNode
from grafu.synth.generate import make_specimen
from grafu.vocabulary import PartLabel


@pytest.fixture(scope="module")
def specimens() -> list[Record]:
    return [record_of(make_specimen(11, i, points=64)) for i in range(20)]


@pytest.fixture(scope="module")
def shard(specimens: list[Record], tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("shards") / "shard_000000.npz"
    write_shard(specimens, path)
    return path


def pointless(record: Record) -> Record:
    """The record without its points."""
    given, truth = (
        replace(g, nodes=tuple(replace(n, points=None) for n in g.nodes)) for g in (record.given, record.truth)
    )
    return replace(record, given=given, truth=truth)


def assert_same(found: Record, meant: Record) -> None:
    """All but the points is the same, and these are where they were, up to the stated error."""
    assert pointless(found) == pointless(meant)
    for a, b in zip(found.truth.nodes, meant.truth.nodes, strict=True):
        assert (a.points is None) == (b.points is None)
        if a.points is not None and b.points is not None:
            error = np.abs(a.points.points - b.points.points).max(axis=0)
            assert np.all(error <= b.box.size * LARGEST_ERROR * 1.001 + 1e-12)
            assert a.box.contains(a.points.points).all()


def test_specimens_come_back(shard: Path, specimens: list[Record]) -> None:
    reader = ShardReader(shard)
    assert len(reader) == len(specimens)
    assert reader.model_ids == tuple(r.model_id for r in specimens)
    for found, meant in zip(reader, specimens, strict=True):
        assert_same(found, meant)
        assert found.missing == meant.missing


@settings(max_examples=60)
@given(st.lists(records(), max_size=3))
def test_any_records_come_back(tmp_path_factory: pytest.TempPathFactory, drawn: list[Record]) -> None:
    path = tmp_path_factory.mktemp("drawn") / "shard.npz"
    write_shard(drawn, path)
    for found, meant in zip(ShardReader(path), drawn, strict=True):
        assert_same(found, meant)


@given(records())
def test_writing_what_was_read_changes_nothing(record: Record) -> None:
    once = arrays_to_record(record_to_arrays(record))
    assert arrays_to_record(record_to_arrays(once)) == once


def test_a_model_is_read_from_any_place(shard: Path, specimens: list[Record]) -> None:
    reader = ShardReader(shard, verify=False)
    for place in (19, 0, 7):
        assert_same(reader[place], specimens[place])
    with pytest.raises(IndexError, match=r"must be 0\.\.19: got 20"):
        reader[20]


def test_a_record_is_a_pair_to_learn_from(specimens: list[Record]) -> None:
    pair = record_pair(specimens[0])
    assert (pair.input, pair.target) == (specimens[0].given, specimens[0].truth)
    assert pair.missing == specimens[0].missing


def test_points_can_be_left_out(shard: Path, specimens: list[Record]) -> None:
    assert ShardReader(shard, points=False)[7] == pointless(specimens[7])


def test_the_same_records_give_the_same_bytes(shard: Path, specimens: list[Record], tmp_path: Path) -> None:
    write_shard(specimens, tmp_path / "again.npz")
    assert (tmp_path / "again.npz").read_bytes() == shard.read_bytes()


def test_numpy_opens_a_shard(shard: Path, specimens: list[Record]) -> None:
    with np.load(shard) as arrays:
        assert len(arrays["label"]) == sum(len(r.truth.nodes) for r in specimens)
        assert json.loads(arrays["shard.json"])["schema"] == SCHEMA


def test_a_part_of_a_model_takes_little_room(tmp_path: Path) -> None:
    made = [record_of(make_specimen(3, i)) for i in range(20)]
    write_shard(made, tmp_path / "s.npz")
    parts = sum(len(r.truth.nodes) for r in made)
    assert (tmp_path / "s.npz").stat().st_size < 25_000 + parts * 60_000 / 25


def test_points_on_a_face_stay_on_it() -> None:
    boxes = np.array([[[0.1, 0.2, 0.3], [0.7, 0.2, 1.9]]])
    points = np.array([[0.1, 0.2, 0.3], [0.7, 0.2, 1.9], [0.1, 0.2, 1.9]])
    counts = np.array([3])
    assert np.array_equal(codes_to_points(points_to_codes(points, boxes, counts), boxes, counts), points)


def test_points_outside_their_box_are_refused() -> None:
    box = Box(vec3(0.0, 0.0, 0.0), vec3(1.0, 1.0, 1.0))
    node = PartNode("a", PartLabel.MISC, box, PointCloud(np.full((1, 3), 1.5)))
    graph = FunctionalGraph("m", (node,))
    with pytest.raises(GraphError, match=r"must lie in its box: one lies 0\.5 m outside"):
        record_to_arrays(Record("m", "f", graph, graph))


def test_a_record_holds_graphs_of_one_model(specimens: list[Record]) -> None:
    a, b = specimens[0], specimens[1]
    with pytest.raises(GraphError, match="must be named"):
        replace(a, given=b.given)
    with pytest.raises(GraphError, match="nodes of `truth` in its order"):
        replace(a, given=replace(a.given, nodes=a.given.nodes[::-1]))
    with pytest.raises(GraphError, match="must name nodes"):
        replace(a, removable=frozenset(["nothing"]))


@pytest.mark.parametrize("kept", [0, 10, 1000, -1])
def test_a_shard_cut_short_is_one_error(shard: Path, tmp_path: Path, kept: int) -> None:
    cut = tmp_path / "cut.npz"
    cut.write_bytes(shard.read_bytes()[:kept])
    with pytest.raises(UnreadableAsset, match=r"cut\.npz` is no whole file of arrays"):
        ShardReader(cut)


@pytest.mark.parametrize(("offset", "value"), [(8, 1), (10, 97)])  # encrypted; packed in a way that no one knows
def test_what_no_reader_opens_is_one_error(shard: Path, tmp_path: Path, offset: int, value: int) -> None:
    data = bytearray(shard.read_bytes())
    for start in (data.index(b"PK\x03\x04") + offset - 2, data.index(b"PK\x01\x02") + offset):
        data[start] = value
    strange = tmp_path / "strange.npz"
    strange.write_bytes(data)
    with pytest.raises(UnreadableAsset, match="no whole file of arrays"):
        ShardReader(strange)


def test_a_changed_byte_is_one_error(shard: Path, tmp_path: Path) -> None:
    bad = tmp_path / "bad.npz"
    whole = shard.read_bytes()
    with ZipFile(shard) as archive:
        starts = [info.header_offset + 30 + len(info.filename) + 20 for info in archive.infolist()]
    for place in [start + 90 for start in starts] + [len(whole) // 2]:
        data = bytearray(whole)
        data[place] ^= 0x55
        bad.write_bytes(bytes(data))
        with pytest.raises(UnreadableAsset, match=r"bad\.npz"):
            ShardReader(bad)


def test_other_files_are_one_error(tmp_path: Path) -> None:
    np.savez(tmp_path / "other.npz", a=np.zeros(3))
    (tmp_path / "text.npz").write_text("no arrays")
    with pytest.raises(UnreadableAsset, match=r"must be a shard of the form `grafu.shard/2`: got 'another file'"):
        ShardReader(tmp_path / "other.npz")
    with pytest.raises(UnreadableAsset, match="no whole file"):
        ShardReader(tmp_path / "text.npz")
    with pytest.raises(UnreadableAsset, match="No such file"):
        ShardReader(tmp_path / "none.npz")
    with pytest.raises(UnreadableAsset, match="cannot read"):
        ShardReader(tmp_path)


def test_a_shard_that_cannot_be_written_leaves_nothing(tmp_path: Path, specimens: list[Record]) -> None:
    (tmp_path / "s.npz").mkdir()
    with pytest.raises(ExportError, match="nothing of it was written"):
        write_shard(specimens[:1], tmp_path / "s.npz")
    assert [p.name for p in tmp_path.iterdir()] == ["s.npz"]
