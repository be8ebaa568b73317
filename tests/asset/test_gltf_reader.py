import base64
import json
import struct

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetError, AssetTooLarge, UnreadableAsset, UnsegmentedAsset
from grafu.vocabulary import PartLabel
from small_assets import CABINET, glb_bytes, gltf_document, write_glb, yaw

# The smallest PNG: one pixel.
PNG = base64.b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="
)


def save(path, document, binary=b""):
    path.write_bytes(glb_bytes(document, binary))
    return path


def small(*names):
    return gltf_document(list(names or ("vertical_side_panel-1", "shelf-6")))


def test_nodes_are_parts_in_metres_and_handles_ride_by_contact(tmp_path):
    asset = load_asset(write_glb(tmp_path / "cabinet.glb"))
    assert asset.kind == "glb"
    assert len(asset.parts) == len(CABINET) - 1  # the drawer's bottom joins its front
    np.testing.assert_allclose(asset.box.size, [0.8, 0.43, 1.0], atol=1e-6)
    assert asset.part("handle_8").carried_by == "cabinet_door_surface_7"
    assert asset.part("handle_11").carried_by == "drawer_front_9"
    assert asset.frame.scale == 1.0


@pytest.mark.parametrize("turns", [1, 2, 3])
def test_a_turned_scene_is_turned_back_by_its_doors(tmp_path, turns):
    asset = load_asset(write_glb(tmp_path / "cabinet.glb", yaw(turns)))
    np.testing.assert_allclose(asset.part("handle_8").box.center, [0.35, -0.2, 0.325], atol=1e-6)
    assert any("front is" in said and "face or open there" in said for said in asset.frame.assumed)


def test_hierarchy_makes_one_part_of_a_drawer_and_keeps_its_handle(tmp_path):
    document, binary = gltf_document(list(CABINET))
    nodes = document["nodes"]
    nodes += [{"name": "Drawer_1", "children": [8, 9, 10]}, {"name": "cabinet", "children": [*range(8), 11]}]
    document["scenes"] = [{"nodes": [12]}]
    asset = load_asset(save(tmp_path / "h.glb", document, binary))
    drawer = asset.part("Drawer_1")
    assert drawer.label is PartLabel.DRAWER
    assert len(drawer.surfaces) == 2
    assert asset.part("handle_11").carried_by == "Drawer_1"


def test_a_group_of_whole_drawers_is_no_drawer(tmp_path):
    document, binary = gltf_document(["shelf-6", "drawer_front-9", "drawer_bottom-10"])
    names = ("shelf", "Drawer_1", "Drawer_2")
    document["nodes"] = [{**n, "name": name} for n, name in zip(document["nodes"], names, strict=True)]
    document["nodes"].append({"name": "drawer", "children": [1, 2]})
    document["scenes"] = [{"nodes": [0, 3]}]
    asset = load_asset(save(tmp_path / "h.glb", document, binary))
    assert [p.id for p in asset.parts] == ["shelf", "Drawer_1", "Drawer_2"]


def test_transforms_stack_and_a_mirrored_node_keeps_its_outside_out(tmp_path):
    document, binary = small()
    document["nodes"][1] |= {"scale": [-2, 1, 1], "translation": [0, 0.5, 0]}
    document["nodes"].append({"name": "root", "children": [0, 1], "rotation": [0, 0, 0, 1], "translation": [3, 0, 0]})
    document["scenes"] = [{"nodes": [2]}]
    asset = load_asset(save(tmp_path / "t.glb", document, binary), LoadOptions(front="+Z"))
    shelf = asset.part("shelf_6").mesh
    assert shelf.box.size[0] == pytest.approx(1.52)
    assert shelf.to_trimesh().volume > 0


def test_textures_keep_their_bytes_and_v_counts_from_below(tmp_path):
    document, binary = small()
    uv = np.array([[0.25, 0.0]] * 8, "<f4").tobytes()
    document["bufferViews"] += [
        {"buffer": 0, "byteOffset": len(binary), "byteLength": 64},
        {"buffer": 0, "byteOffset": len(binary) + 64, "byteLength": len(PNG)},
    ]
    document["accessors"].append({"bufferView": 4, "componentType": 5126, "count": 8, "type": "VEC2"})
    document["images"] = [{"bufferView": 5, "mimeType": "image/png", "name": "oak"}]
    document["textures"] = [{"source": 0}]
    pbr = {"baseColorTexture": {"index": 0}, "roughnessFactor": 0.25}
    document["materials"] = [{"name": "wood", "pbrMetallicRoughness": pbr, "doubleSided": True}]
    document["meshes"][0]["primitives"][0] |= {"material": 0}
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 4
    binary += uv + PNG
    document["buffers"][0]["byteLength"] = len(binary)
    surface = load_asset(save(tmp_path / "t.glb", document, binary)).parts[0].surfaces[0]
    assert surface.material.base_color_texture.data == PNG
    assert (surface.material.name, surface.material.roughness, surface.material.double_sided) == ("wood", 0.25, True)
    np.testing.assert_allclose(surface.uv, [[0.25, 1.0]] * 8)


def test_external_buffers_and_data_uris_are_read(tmp_path):
    document, binary = small()
    (tmp_path / "a b.bin").write_bytes(binary)
    document["buffers"][0]["uri"] = "a%20b.bin"
    (tmp_path / "x.gltf").write_text(json.dumps(document))
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    (tmp_path / "y.gltf").write_text(json.dumps(document))
    x, y = load_asset(tmp_path / "x.gltf"), load_asset(tmp_path / "y.gltf")
    assert [p.mesh for p in x.parts] == [p.mesh for p in y.parts]


def test_strips_and_fans_become_triangles(tmp_path):
    document, binary = small()
    for mesh, mode in zip(document["meshes"], (5, 6), strict=True):
        mesh["primitives"][0] |= {"mode": mode}
        del mesh["primitives"][0]["indices"]
    asset = load_asset(save(tmp_path / "t.glb", document, binary), LoadOptions(front="+Z"))
    assert all(0 < len(p.mesh.faces) <= 6 for p in asset.parts)


def broken(change, binary=None):
    document, data = small()
    change(document)
    return glb_bytes(document, data if binary is None else binary)


GOOD = glb_bytes(*small())


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (GOOD[:10], "truncated"),
        (GOOD[: len(GOOD) // 2], "truncated"),
        (b"glTF" + struct.pack("<II", 1, 20) + b"\0" * 8, "version 1"),
        (b"{}", "expected an `asset` entry"),
        (b"not json at all", "it is not JSON: expected glTF"),
        (json.dumps({"asset": {"version": "1.0"}}).encode(), "version 1.0"),
        (broken(lambda d: d["accessors"][0].update(count=10**6)), "more than its buffer holds"),
        (broken(lambda d: d["bufferViews"][0].update(byteLength=10**9)), "beyond its buffer"),
        (broken(lambda d: d["buffers"][0].update(byteLength=10**9)), "truncated"),
        (broken(lambda d: d["nodes"][0].update(mesh=99)), "not there"),
        (broken(lambda d: d["nodes"][0].update(children=[1, 0])), "cycle"),
        (broken(lambda d: d["nodes"][0].update(scale="big")), "must be 3 finite numbers"),
        (broken(lambda d: d["meshes"][0].update(primitives=[7])), "must be an object"),
        (broken(lambda d: d.update(extensionsRequired=["KHR_meshopt_compression"])), "meshopt"),
    ],
)
def test_damaged_scenes_are_refused_in_one_line(tmp_path, data, said):
    path = tmp_path / "bad.glb"
    path.write_bytes(data)
    with pytest.raises(UnreadableAsset, match=said) as caught:
        load_asset(path)
    assert "bad.glb" in str(caught.value)
    assert "\n" not in str(caught.value)


def test_zeros_out_of_nothing_are_refused(tmp_path):
    data = broken(lambda d: (d["accessors"][0].pop("bufferView"), d["accessors"][0].update(count=10**9)))
    (tmp_path / "bomb.glb").write_bytes(data)
    with pytest.raises(AssetTooLarge, match="1,000,000,000 vertices: at most"):
        load_asset(tmp_path / "bomb.glb")


def test_ten_thousand_instances_are_refused_with_the_limit_named(tmp_path):
    document, binary = small()
    document["nodes"] = [{"name": f"n{i}", "mesh": 0} for i in range(10_000)]
    document["scenes"] = [{"nodes": list(range(10_000))}]
    with pytest.raises(AssetTooLarge, match="10,000 parts: at most 5,000"):
        load_asset(save(tmp_path / "many.glb", document, binary))


def test_one_node_is_unsegmented_and_face_limits_hold(tmp_path):
    with pytest.raises(UnsegmentedAsset, match="one part"):
        load_asset(save(tmp_path / "one.glb", *small("shelf-6")))
    with pytest.raises(AssetError, match="at most 20 are read"):
        load_asset(save(tmp_path / "two.glb", *small()), LoadOptions(limits=Limits(max_faces=20)))
