"""Documents that are built to trip a reader: each is read or refused in one line, and costs little memory."""

import json
import struct

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from grafu.asset.foreign.singapo import read_singapo
from grafu.asset.json_files import parse_json
from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetError, AssetTooLarge, UnreadableAsset
from small_assets import (
    CABINET,
    glb_bytes,
    gltf_document,
    png_bytes,
    urdf_text,
    write_grouped_obj,
    write_pnm,
    write_urdf,
)

ODD = [None, [], {}, "x", -1, 1.5, 10**400, 1e308, float("nan"), True, [[]], {"a": []}]


def saved(path, document, binary=b""):
    path.write_bytes(glb_bytes(document, binary))
    return path


def places(value, path=()):
    """Gives the way to every value in a JSON document."""
    yield path
    if isinstance(value, dict | list):
        for key, inner in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(inner, (*path, key))


def put(document, path, value):
    for key in path[:-1]:
        document = document[key]
    document[path[-1]] = value


def refused_or_read(path):
    said = ""
    try:
        load_asset(path)
    except AssetError as error:
        said = str(error)
    assert "\n" not in said


def painted_document():
    """Returns a document with every kind of entry that is read: materials, textures, images, colours."""
    document, binary = gltf_document(list(CABINET)[:3])
    for mesh in document["meshes"]:
        mesh["primitives"][0] |= {"material": 0, "mode": 4}
        mesh["primitives"][0]["attributes"] |= {"NORMAL": 0, "TEXCOORD_0": 0, "COLOR_0": 0}
    texture = {"index": 0, "texCoord": 0}
    document["materials"] = [
        {
            "name": "oak",
            "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0, "baseColorTexture": texture},
            "normalTexture": texture,
            "emissiveFactor": [0, 0, 0],
            "alphaMode": "MASK",
            "alphaCutoff": 0.5,
        }
    ]
    document["textures"], document["images"] = [{"source": 0}], [{"uri": "a.png", "name": "oak"}]
    document["nodes"][0] |= {"translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1], "children": []}
    document["nodes"][1]["matrix"] = np.eye(4).ravel().tolist()
    document |= {"extensionsRequired": [], "animations": [], "extras": {}}
    return document, binary


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_no_value_of_a_scene_ends_as_our_fault(tmp_path, data):
    document, binary = painted_document()
    path = data.draw(st.sampled_from([p for p in places(document) if p]))
    put(document, path, data.draw(st.sampled_from(ODD)))
    refused_or_read(saved(tmp_path / "a.glb", document, binary))


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_no_value_of_a_data_sets_files_ends_as_our_fault(tmp_path, data):
    folder = write_pnm(tmp_path / "m")
    name = data.draw(st.sampled_from(["mobility_v2.json", "result.json"]))
    document = json.loads((folder / name).read_text())
    put(document, data.draw(st.sampled_from([p for p in places(document) if p])), data.draw(st.sampled_from(ODD)))
    (folder / name).write_text(json.dumps(document))
    refused_or_read(folder)


@pytest.mark.parametrize(
    ("entry", "value"),
    [
        ("buffers", None),
        ("buffers", [{"byteLength": "many"}]),
        ("buffers", [{"byteLength": 10**400}]),
        ("extensionsRequired", 7),
        ("extensionsRequired", [{}]),
        ("nodes", [{"name": "\ud800", "mesh": 0}]),
        ("asset", []),
    ],
)
def test_entries_that_are_something_else_are_one_line(tmp_path, entry, value):
    document, binary = gltf_document(list(CABINET))
    refused_or_read(saved(tmp_path / "a.glb", document | {entry: value}, binary))


@pytest.mark.parametrize("index", ["9" * 30, "-" + "9" * 30, "9" * 4000, "1.5", "0x10"])
@pytest.mark.parametrize("face", ["f {} 2 3", "f 1/{} 2 3", "f 1/1/{} 2/2 3//3", "f 1 2 3 {}"])
def test_an_index_that_no_mesh_has_is_one_line(tmp_path, index, face):
    path = write_grouped_obj(tmp_path / "a.obj")
    path.write_text(path.read_text() + face.format(index) + "\n")
    with pytest.raises(UnreadableAsset) as caught:
        load_asset(path)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("row", ["v 1e300 0 0", "v 1e999 0 0", "vt 1e300", "vn nan 0 0", "vt "])
def test_a_number_that_no_furniture_has_is_one_line(tmp_path, row):
    path = write_grouped_obj(tmp_path / "a.obj")
    path.write_text(row + "\n" + path.read_text())
    with pytest.raises(UnreadableAsset):
        load_asset(path)


@pytest.mark.parametrize("kind", [["revolute"], {}, 7, None])
def test_a_joint_type_of_another_kind_is_one_line(tmp_path, kind):
    axis = {"origin": [0, 0, 0], "direction": [0, 0, 1]}
    box = {"center": [0, 0, 0], "size": [1, 1, 1]}
    node = {"id": 0, "parent": -1, "name": "door", "aabb": box, "joint": {"type": kind, "axis": axis, "range": [0, 9]}}
    (tmp_path / "object.json").write_text(json.dumps({"diffuse_tree": [node]}))
    with pytest.raises(UnreadableAsset, match="`type` must be"):
        read_singapo(tmp_path / "object.json")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (b"[" * 100_000, "nested too deeply"),
        (b'{"a": 1, "a": 2}', "twice"),
        (b"\xff\xfe\x00", "not JSON"),
        (b"1" * 5000, "not JSON"),
    ],
)
def test_json_that_no_two_readers_read_alike_is_refused(text, said):
    with pytest.raises(UnreadableAsset, match=said):
        parse_json(text, "a.json", "a list")


def test_half_a_character_in_json_can_be_written_again():
    (text,) = parse_json(rb'["a\ud800b"]', "a.json", "a list")
    assert text.encode() == "a\N{REPLACEMENT CHARACTER}b".encode()


@pytest.mark.parametrize(
    "head",
    [
        '<!DOCTYPE robot [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;">]>',
        '<!DOCTYPE robot SYSTEM "file:///etc/passwd">',
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_xml_that_declares_a_document_type_is_refused(tmp_path, head, encoding):
    text = urdf_text().replace('<?xml version="1.0"?>', f'<?xml version="1.0" encoding="{encoding}"?>{head}')
    write_urdf(tmp_path)
    (tmp_path / "cabinet.urdf").write_bytes(text.encode(encoding))
    with pytest.raises(UnreadableAsset, match=r"document type|XML"):
        load_asset(tmp_path / "cabinet.urdf")


def test_elements_without_end_are_refused(tmp_path):
    (tmp_path / "a.urdf").write_text("<robot>" * 100_000)
    with pytest.raises(UnreadableAsset, match="XML"):
        load_asset(tmp_path / "a.urdf")


def huge_png():
    """Returns a PNG whose header states 13,000 x 13,000 pixels, and that holds none."""
    data = png_bytes(1, 1)
    return data[:16] + struct.pack(">II", 13_000, 13_000) + data[24:]


@pytest.mark.parametrize(
    "image", [huge_png(), b"\x89PNG\r\n\x1a\n", png_bytes(99, 99)[:90], b"\xff\xd8\xff\xe0" * 9, b"GIF89a", b""]
)
def test_a_broken_image_costs_no_model(tmp_path, image):
    document, binary = painted_document()
    (tmp_path / "a.png").write_bytes(image)
    asset = load_asset(saved(tmp_path / "a.glb", document, binary))
    assert {s.material.base_color_texture for p in asset.parts for s in p.surfaces} == {None}
    assert any("image 0" in note and "left out" in note for note in asset.notes)


def test_pixels_are_limited_in_one_image_and_in_all(tmp_path):
    document, binary = painted_document()
    document["images"] = [{"uri": "a.png"}, {"uri": "b.png"}]
    document["textures"] = [{"source": 0}, {"source": 1}]
    document["materials"][0]["normalTexture"] = {"index": 1}
    (tmp_path / "a.png").write_bytes(png_bytes(8, 8))
    (tmp_path / "b.png").write_bytes(png_bytes(8, 4))
    path = saved(tmp_path / "a.glb", document, binary)
    for limits, said in [
        (Limits(max_image_pixels=63), "image-pixels=64"),
        (Limits(max_pixels=95), "--limit pixels=96"),
    ]:
        notes = load_asset(path, LoadOptions(limits=limits)).notes
        assert len([note for note in notes if said in note]) == 1
    assert not load_asset(path).notes or not any("pixels" in note for note in load_asset(path).notes)


def test_what_is_too_large_says_which_limit_and_how_to_raise_it(tmp_path):
    path = write_grouped_obj(tmp_path / "a.obj")
    with pytest.raises(AssetTooLarge, match=r"132 faces: at most 131 are read.*--limit faces=132"):
        load_asset(path, LoadOptions(limits=Limits(max_faces=131)))
