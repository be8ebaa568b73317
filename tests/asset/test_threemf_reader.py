from contextlib import suppress

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset, UnsegmentedAsset
from grafu.vocabulary import PartLabel
from small_assets import write_obj_folder
from threemf_packages import threemf_bytes, threemf_text, write_threemf

DRAWER = dict.fromkeys(("drawer_front-9", "drawer_bottom-10"), "drawer_1")


@pytest.mark.parametrize(("unit", "metres"), [("millimeter", 0.001), ("inch", 0.0254), ("meter", 1.0)])
def test_units_are_those_that_the_file_states(tmp_path, unit, metres):
    asset = load_asset(write_threemf(tmp_path, threemf_bytes(threemf_text(unit, np.eye(3) / metres))))

    same = load_asset(write_obj_folder(tmp_path / "obj"), LoadOptions(scale=1.0))
    assert {p.id: p.label for p in asset.parts} == {p.id: p.label for p in same.parts}
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, same.part(part.id).box.low, atol=1e-5)
        np.testing.assert_allclose(part.box.high, same.part(part.id).box.high, atol=1e-5)


def test_colours_and_opacity_reach_the_surfaces(tmp_path):
    asset = load_asset(write_threemf(tmp_path))
    shelf, handle = (asset.part(name).surfaces[0].material for name in ("shelf_6", "handle_8"))
    np.testing.assert_allclose(shelf.base_color, [0.319, 0.133, 0.033, 1.0], atol=1e-3)
    assert (shelf.name, handle.name, handle.alpha_mode) == ("oak", "glass", "BLEND")
    assert handle.base_color[3] == pytest.approx(0.25, abs=0.01)


def test_triangles_have_colours_of_their_own(tmp_path):
    text = threemf_text().replace('<triangle v1="', '<triangle p1="1" v1="', 4)
    assert len(load_asset(write_threemf(tmp_path, threemf_bytes(text))).parts[0].surfaces) == 2


def test_components_of_a_drawer_are_one_part(tmp_path):
    asset = load_asset(write_threemf(tmp_path, threemf_bytes(threemf_text(below=DRAWER))))
    drawers = [p for p in asset.parts if p.label is PartLabel.DRAWER]
    assert [p.id for p in drawers] == ["drawer_1"]
    assert len(drawers[0].surfaces) == 2


def test_items_are_placed_by_rows_of_axes_and_a_translation(tmp_path):
    turned = '<item objectid="7" transform="0 1 0 -1 0 0 0 0 1 0 0 100"/>'  # x to y, y to -x, then up
    text = threemf_text().replace('<item objectid="7"/>', turned)
    fixed = LoadOptions(up="+Z", front="-Y")
    plain = load_asset(write_threemf(tmp_path / "plain"), fixed).part("shelf_6").box
    moved = load_asset(write_threemf(tmp_path / "moved", threemf_bytes(text)), fixed).part("shelf_6").box
    np.testing.assert_allclose(moved.size, plain.size[[1, 0, 2]], atol=1e-6)
    assert moved.low[2] - plain.low[2] == pytest.approx(0.1, abs=1e-6)


CIRCLE = '<object id="100" name="a"><components><component objectid="100"/></components></object></resources>'


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"PK\x03\x04", "no readable package"),
        (threemf_bytes()[:500], "no readable package"),
        (threemf_bytes().replace(b"3dmodel.model", b"3dmodel.other"), r"no 3D/\*\.model"),
        (threemf_bytes("<scene/>"), "root <scene>"),
        (threemf_bytes("<!DOCTYPE a [<!ENTITY b 'c'>]><model/>"), "document type"),
        (threemf_bytes(threemf_text().replace('v1="0"', 'v1="99"')), "names vertex 99 of 8"),
        (threemf_bytes(threemf_text().replace('<vertex x="', '<vertex x="n', 1)), "expected finite numbers"),
        (threemf_bytes(threemf_text().replace('objectid="', 'objectid="9')), "no part with faces"),
    ],
    ids=["magic", "cut", "empty", "root", "entities", "vertex", "number", "objects"],
)
def test_damaged_packages_are_refused_in_one_line(tmp_path, data, said):
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(write_threemf(tmp_path, data))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("field", "value"),
    [(6, 99), (8, 0x01), (8, 0x20), (8, 0x40), (10, 99)],
    ids=["version", "encrypted", "patched", "strongly encrypted", "method"],
)
def test_packages_that_zipfile_cannot_unpack_are_refused_in_one_line(tmp_path, field, value):
    data = bytearray(threemf_bytes())
    entry = data.find(b"PK\x01\x02")
    while entry >= 0:
        data[entry + field : entry + field + 2] = value.to_bytes(2, "little")
        entry = data.find(b"PK\x01\x02", entry + 4)

    with pytest.raises(UnreadableAsset, match="no readable package") as error:
        load_asset(write_threemf(tmp_path, bytes(data)))
    assert "\n" not in str(error.value)


def test_objects_that_contain_themselves_are_refused(tmp_path):
    text = threemf_text().replace("</resources>", CIRCLE).replace("<build>", '<build><item objectid="100"/>')
    with pytest.raises(AssetTooLarge, match="depth"):
        load_asset(write_threemf(tmp_path, threemf_bytes(text)))


def test_what_is_packed_counts_unpacked(tmp_path):
    data = threemf_bytes(threemf_text() + " " * 5_000_000)
    assert len(data) < 100_000
    with pytest.raises(AssetTooLarge, match="bytes"):
        load_asset(write_threemf(tmp_path, data), LoadOptions(limits=Limits(max_bytes=1_000_000)))


@pytest.mark.parametrize("place", range(0, 600, 23))
def test_changed_bytes_are_read_or_refused(tmp_path, place):
    data = bytearray(threemf_bytes())
    data[place] ^= 0xFF
    with suppress(UnreadableAsset, UnsegmentedAsset, AssetTooLarge):
        load_asset(write_threemf(tmp_path, bytes(data)))


@pytest.mark.parametrize("name", ["faces", "vertices", "nodes", "parts", "values", "primitives"])
def test_limits_hold(tmp_path, name):
    with pytest.raises(AssetTooLarge, match=f"--limit {name}"):
        load_asset(write_threemf(tmp_path), LoadOptions(limits=Limits().with_limit(name, 2)))
