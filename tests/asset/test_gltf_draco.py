import sys
from contextlib import suppress

import numpy as np
import pytest

from draco_scenes import draco_document, write_draco
from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset, UnsegmentedAsset
from small_assets import glb_bytes, gltf_document, write_glb

NAMES = ["vertical_side_panel-1", "shelf-6"]


@pytest.fixture(autouse=True)
def _with_library(request):
    if "without" not in request.node.name:
        pytest.importorskip("DracoPy")


def written(folder, document, binary):
    path = folder / "packed.glb"
    path.write_bytes(glb_bytes(document, binary))
    return path


@pytest.mark.parametrize("encoding", [{}, {"preserve_order": True}, {"create_metadata": True}], ids=str)
def test_compressed_and_plain_scenes_are_the_same_furniture(tmp_path, encoding):
    plain, packed = load_asset(write_glb(tmp_path / "plain.glb")), load_asset(write_draco(tmp_path, **encoding))

    assert {p.id: p.label for p in packed.parts} == {p.id: p.label for p in plain.parts}
    for part in packed.parts:
        np.testing.assert_allclose(part.box.low, plain.part(part.id).box.low, atol=1e-4)
        np.testing.assert_allclose(part.box.high, plain.part(part.id).box.high, atol=1e-4)
        assert part.mesh.to_trimesh().volume == pytest.approx(plain.part(part.id).mesh.to_trimesh().volume, rel=0.02)


def test_attributes_and_materials_reach_the_surfaces(tmp_path):
    surface = load_asset(write_draco(tmp_path)).part("shelf_6").surfaces[0]
    assert surface.material.base_color == pytest.approx((0.5, 0.3, 0.1, 1.0))
    assert surface.uv.shape == (8, 2)
    assert (surface.colors == 255).all()
    np.testing.assert_allclose(np.linalg.norm(surface.normals, axis=1), 1.0, atol=1e-2)


def test_plain_positions_beside_compressed_ones_are_used(tmp_path):
    document, binary = gltf_document(NAMES)
    for mesh in document["meshes"]:
        mesh["primitives"][0]["extensions"] = {"KHR_draco_mesh_compression": {"bufferView": 99, "attributes": {}}}
    assert len(load_asset(written(tmp_path, document, binary)).parts) == 2


def primitive(document):
    return document["meshes"][0]["primitives"][0]


def packed_view(document):
    return primitive(document)["extensions"]["KHR_draco_mesh_compression"]


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda d: d["accessors"][4].update(count=3), "declares more than its accessors"),
        (lambda d: d["accessors"][0].update(count=3), "declares more than its accessors"),
        (lambda d: d["bufferViews"][0].update(byteLength=8), "cut short"),
        (lambda d: d["bufferViews"][0].update(byteLength=100), "valid Draco meshes"),
        (lambda d: d["bufferViews"][0].update(byteOffset=1), "not Draco 2.2"),
        (lambda d: packed_view(d).update(attributes={}), "no positions"),
        (lambda d: packed_view(d).update(bufferView=99), "not there"),
        (lambda d: packed_view(d)["attributes"].update(POSITION="x"), "must be"),
    ],
    ids=["faces", "points", "header", "body", "magic", "attributes", "view", "id"],
)
def test_damaged_meshes_are_refused_in_one_line(tmp_path, change, said):
    document, binary = draco_document(NAMES)
    change(document)
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(written(tmp_path, document, binary))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("byte", range(0, 200, 7))
def test_changed_bytes_are_read_or_refused(tmp_path, byte):
    document, binary = draco_document(NAMES)
    changed = bytearray(binary)
    changed[byte] ^= 0xFF
    with suppress(UnreadableAsset, UnsegmentedAsset):
        load_asset(written(tmp_path, document, bytes(changed)))


def test_what_is_declared_counts_against_the_limits(tmp_path):
    with pytest.raises(AssetTooLarge, match="at most 20 are read"):
        load_asset(write_draco(tmp_path), LoadOptions(limits=Limits(max_faces=20)))


PACKED = {"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}


def test_without_the_library_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    document, binary = gltf_document(NAMES)
    del document["accessors"][0]["bufferView"]
    primitive(document)["extensions"] = PACKED
    header = b"DRACO\x02\x02\x01\x01\x00\x00\x00\x08\x0c"  # 8 points, 12 faces
    with pytest.raises(UnreadableAsset, match=r"grafu\[formats\]"):
        load_asset(written(tmp_path, document, header + binary[len(header) :]))
