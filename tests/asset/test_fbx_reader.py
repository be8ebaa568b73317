import struct
from contextlib import suppress

import numpy as np
import pytest

from fbx_scenes import fbx_bytes, fbx_records, write_fbx
from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset, UnsegmentedAsset
from grafu.vocabulary import PartLabel
from small_assets import Y_UP, png_bytes, write_obj_folder

DRAWER = dict.fromkeys(("drawer_front-9", "drawer_bottom-10"), "drawer_1")
IMAGE = png_bytes(4, 4)
WHOLE = fbx_bytes(fbx_records())


def load(folder, options=LoadOptions(), image=IMAGE, **stated):
    return load_asset(write_fbx(folder, fbx_bytes(fbx_records(**stated)), image), options)


@pytest.mark.parametrize(
    ("up", "centimetres", "matrix"),
    [("+Z", 100.0, np.eye(3)), ("+Y", 1.0, 100 * Y_UP), ("+Z", 2.54, np.eye(3) / 0.0254)],
    ids=["metres, Z up", "centimetres, Y up", "inches, Z up"],
)
def test_unit_and_axis_are_those_that_the_file_states(tmp_path, up, centimetres, matrix):
    asset = load(tmp_path, up=up, centimetres=centimetres, matrix=matrix)

    same = load_asset(write_obj_folder(tmp_path / "obj"), LoadOptions(scale=1.0))
    assert {p.id: p.label for p in asset.parts} == {p.id: p.label for p in same.parts}
    assert not any("left out" in note for note in asset.notes)
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, same.part(part.id).box.low, atol=1e-5)
        np.testing.assert_allclose(part.box.high, same.part(part.id).box.high, atol=1e-5)


def test_files_with_long_offsets_are_read(tmp_path):
    asset = load_asset(write_fbx(tmp_path, fbx_bytes(fbx_records(), 7700), IMAGE))
    assert len(asset.parts) == len(load(tmp_path).parts)


def test_images_colours_and_opacity_reach_the_surfaces(tmp_path):
    asset = load(tmp_path, materials={"shelf-6": "steel", "handle-8": "glass"})

    by_name = {p.source.name: p.surfaces[0] for p in asset.parts}
    panel = by_name["back_panel-5"]
    assert panel.material.base_color_texture.name == "wood grain.png"
    assert panel.uv.shape == (len(panel.mesh.vertices), 2)
    np.testing.assert_allclose(by_name["shelf-6"].material.base_color, [0.214, 0.214, 0.214, 1.0], atol=1e-3)
    assert by_name["handle-8"].material.base_color[3] == 0.25
    assert by_name["handle-8"].material.alpha_mode == "BLEND"


def test_images_within_the_file_are_read_and_missing_ones_noted(tmp_path):
    inside = load(tmp_path / "inside", image=None).notes
    assert any("wood grain.png is missing" in note for note in inside)
    found = load_asset(write_fbx(tmp_path / "in", fbx_bytes(fbx_records(image=IMAGE)))).part("shelf_6").surfaces[0]
    assert found.material.base_color_texture.data == IMAGE


def test_nodes_below_a_drawer_are_one_part(tmp_path):
    asset = load(tmp_path, below=DRAWER)
    drawers = [p for p in asset.parts if p.label is PartLabel.DRAWER]
    assert [p.id for p in drawers] == ["drawer_1"]
    assert len(drawers[0].surfaces) == 2


ABOUT = (0.5, 0.0, 0.25)
QUARTER = {"RotationActive": 1, "PreRotation": (0.0, 0.0, 90.0)}
POSES = {
    "translation": ({"Lcl_Translation": (0.0, 0.0, 0.5)}, lambda p: p + np.array([0, 0, 0.5])),
    "turn": ({"Lcl_Rotation": (0.0, 0.0, 90.0)}, lambda p: np.stack([-p[:, 1], p[:, 0], p[:, 2]], axis=1)),
    "turns": ({"Lcl_Rotation": (90.0, 0.0, 90.0)}, lambda p: np.stack([p[:, 2], p[:, 0], p[:, 1]], axis=1)),
    "order": (
        {"Lcl_Rotation": (90.0, 0.0, 90.0), "RotationActive": 1, "RotationOrder": 4},
        lambda p: np.stack([-p[:, 1], -p[:, 2], p[:, 0]], axis=1),
    ),
    "before": (QUARTER, lambda p: np.stack([-p[:, 1], p[:, 0], p[:, 2]], axis=1)),
    "after": (
        {"RotationActive": 1, "PostRotation": (0.0, 0.0, 90.0)},
        lambda p: np.stack([p[:, 1], -p[:, 0], p[:, 2]], axis=1),
    ),
    "pivot": (
        {"Lcl_Rotation": (0.0, 0.0, 180.0), "RotationPivot": ABOUT},
        lambda p: np.stack([1.0 - p[:, 0], -p[:, 1], p[:, 2]], axis=1),
    ),
    "scale": (
        {"Lcl_Scaling": (1.0, 1.0, 0.5), "ScalingPivot": (0.0, 0.0, 1.0)},
        lambda p: p * [1, 1, 0.5] + [0, 0, 0.5],
    ),
    "geometric": ({"GeometricTranslation": (0.0, 0.1, 0.0)}, lambda p: p + np.array([0, 0.1, 0])),
}


@pytest.mark.parametrize("name", POSES)
def test_transforms_follow_the_order_of_fbx(tmp_path, name):
    pose, moved = POSES[name]
    fixed = LoadOptions(up="+Z", front="-Y", scale=1.0)
    plain, posed = load(tmp_path, fixed), load(tmp_path, fixed, poses={"shelf-6": pose})
    lift = plain.part("top_panel_3").box.low - posed.part("top_panel_3").box.low  # the whole stands where it stands
    corners = plain.part("shelf_6").mesh.vertices - [0, 0.015, 0]
    found, expected = posed.part("shelf_6").mesh.vertices + lift - [0, 0.015, 0], moved(corners)
    np.testing.assert_allclose(found.min(axis=0), expected.min(axis=0), atol=1e-6)
    np.testing.assert_allclose(found.max(axis=0), expected.max(axis=0), atol=1e-6)


def test_hidden_models_are_left_out_with_a_note(tmp_path):
    asset = load(tmp_path, poses={"shelf-6": {"Visibility": 0.0}})
    assert "shelf-6 is hidden and was left out" in asset.notes


def changed(*places):
    """The whole file, records that a path leads to replaced."""
    records = fbx_records()
    for name, change in places:
        records = tuple(change(r) if r[0] == name else r for r in records)
    return fbx_bytes(records)


def geometry(change):
    def of(record):
        name, values, within = record
        return name, values, tuple(change(r) if r[0] == "Geometry" else r for r in within)

    return changed(("Objects", of))


def corners_of(values):
    def change(record):
        name, stated, within = record
        return name, stated, tuple((n, (values,), ()) if n == "PolygonVertexIndex" else (n, v, w) for n, v, w in within)

    return geometry(change)


def links(*added):
    return changed(("Connections", lambda r: (r[0], r[1], (*r[2], *(("C", link, ()) for link in added)))))


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"; FBX 7.4.0 project file", "no binary FBX"),
        (fbx_bytes(fbx_records(), 6100), "FBX 6.1"),
        (WHOLE[:25], "cut short"),
        (WHOLE[: len(WHOLE) // 2], "reaches beyond|cut short"),
        (corners_of(np.array([0, 1, -99])), "names vertex 98 of 8"),
        (corners_of(np.array([0.5, 1.0, 2.0])), "fractions"),
        (links((b"OO", 2000, 2001), (b"OO", 2001, 2000)), "two parents"),
        (fbx_bytes(fbx_records(poses={"shelf-6": {"Lcl_Translation": (1e30, 0.0, 0.0)}})), "no furniture has"),
        (WHOLE.replace(b"\x78\x9c", b"\x00\x00"), "cannot be unpacked"),
        (fbx_bytes(fbx_records()[:2]), "no part with faces"),
    ],
    ids=["text", "old", "head", "half", "vertex", "fractions", "cycle", "far", "packed", "no objects"],
)
def test_damaged_files_are_refused_in_one_line(tmp_path, data, said):
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(write_fbx(tmp_path, data))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("place", range(30, 4000, 97))
def test_changed_bytes_are_read_or_refused(tmp_path, place):
    data = bytearray(WHOLE)
    data[place] ^= 0xFF
    with suppress(UnreadableAsset, UnsegmentedAsset, AssetTooLarge):
        load_asset(write_fbx(tmp_path, bytes(data), IMAGE))


def test_arrays_are_counted_before_they_are_unpacked(tmp_path):
    count = struct.pack("<I", 24)
    bomb = WHOLE.replace(b"d" + count, b"d" + struct.pack("<I", 2**31))
    with pytest.raises(AssetTooLarge, match="vertices"):
        load_asset(write_fbx(tmp_path, bomb))


@pytest.mark.parametrize("name", ["faces", "vertices", "nodes", "parts", "values", "primitives", "corners"])
def test_limits_hold(tmp_path, name):
    with pytest.raises(AssetTooLarge, match=f"--limit {name}"):
        load(tmp_path, LoadOptions(limits=Limits().with_limit(name, 2)))
