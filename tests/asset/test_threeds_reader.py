"""3DS files: names, shapes, colours, images; damage is a line."""

import struct

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset
from small_assets import png_bytes, write_obj_folder
from threeds_files import chunk, text, threeds_bytes, write_threeds

FIXED = LoadOptions(up="+Z", front="-Y", scale=1.0)


@pytest.mark.parametrize(("units", "metres"), [(100.0, 0.01), (1000.0, 0.001)])
def test_objects_are_parts_and_the_unit_is_found(tmp_path, units, metres):
    asset = load_asset(write_threeds(tmp_path, threeds_bytes(units * np.eye(3))))
    same = load_asset(write_obj_folder(tmp_path / "obj"), FIXED)
    assert (asset.frame.up, asset.frame.front, asset.frame.scale) == ("+Z", "-Y", metres)
    assert {p.id: p.label for p in asset.parts} == {p.id: p.label for p in same.parts}
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, same.part(part.id).box.low, atol=1e-5)


def test_colours_opacity_and_images_reach_the_surfaces(tmp_path):
    (tmp_path / "WOOD.PNG").write_bytes(png_bytes(8, 8))
    data = threeds_bytes(looks={"handle-8": "glass", "shelf-6": "pictured"}, image="WOOD.PNG")
    asset = load_asset(write_threeds(tmp_path, data))
    back, handle, shelf = (asset.part(name).surfaces[0] for name in ("back_panel_5", "handle_8", "shelf_6"))
    np.testing.assert_allclose(back.material.base_color, [0.319, 0.133, 0.033, 1.0], atol=1e-3)
    assert (back.material.name, handle.material.name, handle.material.alpha_mode) == ("oak", "glass", "BLEND")
    assert handle.material.base_color[3] == pytest.approx(0.25)
    assert shelf.material.base_color_texture is not None
    assert shelf.uv is not None
    assert len(shelf.uv) == len(shelf.mesh.vertices)


def test_what_is_hidden_or_missing_is_noted(tmp_path):
    data = threeds_bytes(looks={"shelf-6": "pictured"}, hidden="back_panel-5", image="../outside.png")
    (tmp_path / "outside.png").write_bytes(png_bytes(8, 8))
    asset = load_asset(write_threeds(tmp_path / "in", data))
    said = " ".join(asset.notes)
    assert "back_panel-5 is hidden and was left out" in said
    assert "outside.png" in said
    assert asset.part("shelf_6").surfaces[0].material.base_color_texture is None


FACE = chunk(0x4120, struct.pack("<H4H", 1, 0, 1, 2, 0))
UNREAL = chunk(0x4110, struct.pack("<H", 3), np.full(9, np.nan, "<f4").tobytes())
MESH = chunk(0x4110, struct.pack("<H", 3), np.zeros(9, "<f4").tobytes())


def of(*held: bytes) -> bytes:
    return chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, text("a"), chunk(0x4100, *held))))


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"PK\3\4", "does not begin as one"),
        (threeds_bytes()[:-1], "reaches beyond what holds it"),
        (struct.pack("<HI", 0x4D4D, 3), "reaches beyond what holds it"),
        (of(chunk(0x4110, struct.pack("<H", 65535)), chunk(0x4120, b"\0\0")), "a table of 65535 rows reaches beyond"),
        (of(chunk(0x4110), chunk(0x4120, b"\0\0")), "a table has no length"),
        (of(MESH, chunk(0x4120, struct.pack("<H4H", 1, 0, 1, 3, 0))), "a face names vertex 3 of 3"),
        (of(UNREAL, FACE), "a coordinate is none of furniture"),
        (
            of(MESH, chunk(0x4120, struct.pack("<H4H", 1, 0, 1, 2, 0), chunk(0x4130, text("m"), b"\1\0\7\0"))),
            "a material names face 7 of 1",
        ),
        (chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, b"no end"))), "a name has no end"),
    ],
)
def test_damage_is_a_line(tmp_path, data, said):
    with pytest.raises(UnreadableAsset, match=said) as raised:
        load_asset(write_threeds(tmp_path, data))
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize("limit", ["vertices", "faces", "nodes", "primitives", "values", "parts"])
def test_more_than_is_read_is_refused(tmp_path, limit):
    with pytest.raises(AssetTooLarge, match=f"{limit}"):
        load_asset(write_threeds(tmp_path), LoadOptions(limits=Limits().with_limit(limit, 5)))
