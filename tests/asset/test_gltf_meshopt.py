"""glTF with meshopt compression: what the library packed is unpacked, sizes are checked first, damage is a line."""

from base64 import b64decode
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.gltf_meshopt import MeshoptError, unpack
from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset
from meshopt_scenes import (
    EXTENSION,
    meshopt_document,
    packed_attributes,
    packed_indices,
    packed_triangles,
    write_meshopt,
)
from small_assets import write_glb

# What meshoptimizer 0.23 makes of the arrays in the test below.
WAVES = (
    "oB8AAgYKDhIWGh4imyouMos6PkJ7SnNSVmdeX2ZXU3JLev//AABDP4Y3My+WJwAAAB8A4+Hh4eHh4ePh4eHh4eHj4eHh4eHh4+Hh4eHh4ePh4f//"
    "AADh4eHh4+Hh4RUIiKIiKIiKIiKIAAAAABoACgCgCgCgCgCgCgCgCgCgMMMAAAoKCgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
)
FAN = "4fAAAAAAAAAAAAAA/xr/KR7/KAIC9yVKAHaHVmd4qYZliWiYAWkAAA=="
SEQUENCE = "0QAEBAYIBAoMBA4QBBIUBBYYBBocBB4gBCIkBCYoBCosBCAEBAACPgahARgBFhQAEgUAAAAA"


def test_streams_of_the_library_are_unpacked() -> None:
    k = np.arange(40)
    waves = np.column_stack([k * k % 97, (k * 1000) // 7, 5 * (k // 3)]).astype("<i4")
    assert unpack(b64decode(WAVES), "ATTRIBUTES", 40, 12) == waves.tobytes()
    fan = [[0, i, i + 1] for i in range(1, 12)] + [[20, 21, 22], [22, 21, 5], [3, 40, 9], [40, 3, 8], [8, 3, 41]]
    found = np.frombuffer(unpack(b64decode(FAN), "TRIANGLES", 48, 4), "<u4").reshape(-1, 3)
    assert [min(tuple(np.roll(t, n)) for n in range(3)) for t in found] == [
        min(tuple(np.roll(t, n)) for n in range(3)) for t in np.array(fan)
    ]
    assert unpack(b64decode(SEQUENCE), "INDICES", 48, 4) == np.array(fan, "<u4").tobytes()


@given(st.integers(1, 600), st.sampled_from([4, 8, 12, 64, 256]), st.integers(0, 2**32 - 1))
def test_attributes_come_back(count: int, stride: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = rng.integers(0, 256, (count, stride)).astype(np.uint8) * rng.integers(0, 2, stride).astype(np.uint8)
    assert unpack(packed_attributes(rows), "ATTRIBUTES", count, stride) == rows.tobytes()


@given(st.lists(st.integers(0, 2**29), min_size=1, max_size=50), st.sampled_from(["TRIANGLES", "INDICES"]))
def test_indices_come_back(values: list[int], mode: str) -> None:
    corners = np.array(values * 3, np.int64)
    stream = packed_triangles(corners) if mode == "TRIANGLES" else packed_indices(corners)
    assert unpack(stream, mode, len(corners), 4) == corners.astype("<u4").tobytes()


@given(st.binary(max_size=200), st.sampled_from(["ATTRIBUTES", "TRIANGLES", "INDICES"]), st.integers(0, 100))
def test_any_bytes_are_unpacked_or_refused(data: bytes, mode: str, count: int) -> None:
    first = {"ATTRIBUTES": b"\xa0", "TRIANGLES": b"\xe1", "INDICES": b"\xd1"}[mode]
    with suppress(MeshoptError):
        assert len(unpack(first + data, mode, count, 4)) == 4 * count


@pytest.mark.parametrize(("kind", "bits"), [("<i1", 8), ("<i2", 16), ("<i2", 11)])
def test_unit_vectors_come_back(kind: str, bits: int) -> None:
    rng = np.random.default_rng(3)
    vectors = rng.normal(size=(200, 3))
    vectors /= np.linalg.norm(vectors, axis=1, keepdims=True)
    flat = vectors / np.abs(vectors).sum(axis=1, keepdims=True)
    folded = (1 - np.abs(flat[:, [1, 0]])) * np.where(flat[:, :2] < 0, -1, 1)
    places = np.where(flat[:, 2:] < 0, folded, flat[:, :2])
    one = 2 ** (bits - 1) - 1
    rows = np.column_stack([np.round(places * one), np.full(200, one), np.arange(200) % 100]).astype(kind)
    data = packed_attributes(rows.view(np.uint8).reshape(200, -1))
    found = np.frombuffer(unpack(data, "ATTRIBUTES", 200, rows.itemsize * 4, "OCTAHEDRAL"), kind).reshape(-1, 4)
    np.testing.assert_allclose(found[:, :3] / np.iinfo(kind).max, vectors, atol=4 / one)
    assert (found[:, 3] == rows[:, 3]).all()


def test_exponents_and_mantissas_are_floats() -> None:
    words = np.array([(-3 << 24) | 5, (2 << 24) | (0xFFFFFF & -7), 0], np.int64).astype("<i4")
    data = packed_attributes(words.view(np.uint8).reshape(-1, 4))
    assert np.frombuffer(unpack(data, "ATTRIBUTES", 3, 4, "EXPONENTIAL"), "<f4").tolist() == [0.625, -28.0, 0.0]


@pytest.mark.parametrize("mode", ["TRIANGLES", "INDICES"])
def test_a_compressed_scene_is_the_same_scene(tmp_path, mode: str) -> None:
    packed = load_asset(write_meshopt(tmp_path, *meshopt_document(mode)))
    plain = load_asset(write_glb(tmp_path / "plain.glb"))
    assert [p.id for p in packed.parts] == [p.id for p in plain.parts]
    for part, same in zip(packed.parts, plain.parts, strict=True):
        assert np.array_equal(part.mesh.vertices, same.mesh.vertices)
        assert np.array_equal(part.mesh.faces, same.mesh.faces)


def changed(**values) -> tuple[dict, bytes]:
    document, binary = meshopt_document()
    document["bufferViews"][0]["extensions"][EXTENSION].update(values)
    return document, binary


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"byteLength": 40}, "cut short"),
        ({"byteOffset": 10**9}, "reaches beyond its buffer"),
        ({"buffer": 7}, "buffer 7 is not there"),
        ({"buffer": 1}, "reaches beyond its buffer"),
        ({"count": 9}, "has 96 bytes for 9 elements of 12"),
        ({"mode": "PARTS"}, "compression PARTS"),
        ({"mode": "TRIANGLES"}, "compression TRIANGLES"),
        ({"filter": "QUATERNION"}, "filter QUATERNION"),
        ({"filter": "OCTAHEDRAL"}, "vectors of another size"),
        ({"byteStride": 0}, "has 96 bytes for"),
    ],
)
def test_damage_is_a_line(tmp_path, values: dict, said: str) -> None:
    with pytest.raises(UnreadableAsset, match=said) as raised:
        load_asset(write_meshopt(tmp_path, *changed(**values)))
    assert "\n" not in str(raised.value)


def test_sizes_are_checked_before_memory_is_taken(tmp_path) -> None:
    document, binary = changed(count=10**6, byteStride=256)
    document["bufferViews"][0]["byteLength"] = 256 * 10**6
    with pytest.raises(UnreadableAsset, match="cut short"):
        load_asset(write_meshopt(tmp_path, document, binary))
    document["bufferViews"][0]["extensions"][EXTENSION]["count"] = 10**7
    document["bufferViews"][0]["byteLength"] = 256 * 10**7
    with pytest.raises(AssetTooLarge, match="bytes"):
        load_asset(write_meshopt(tmp_path, document, binary))
    with pytest.raises(AssetTooLarge, match="bytes"):
        load_asset(write_meshopt(tmp_path), LoadOptions(limits=Limits(max_bytes=9_500)))


def test_a_view_of_a_placeholder_alone_is_damage(tmp_path) -> None:
    document, binary = meshopt_document()
    del document["bufferViews"][0]["extensions"]
    with pytest.raises(UnreadableAsset, match="reaches beyond its buffer"):
        load_asset(write_meshopt(tmp_path, document, binary))
