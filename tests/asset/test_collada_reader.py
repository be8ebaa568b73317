import re
import sys

import numpy as np
import pytest

from collada_documents import collada_text, write_collada
from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset
from grafu.vocabulary import PartLabel
from small_assets import Y_UP, load_annotated, png_bytes, urdf_text, write_obj_folder, write_urdf

DRAWER = dict.fromkeys(("drawer_front-9", "drawer_bottom-10"), "drawer_1")


@pytest.mark.parametrize(
    ("up", "metres", "matrix"),
    [("Z_UP", 1.0, np.eye(3)), ("Y_UP", 0.01, 100 * Y_UP), ("Z_UP", 0.0254, np.eye(3) / 0.0254)],
    ids=["metres, Z up", "centimetres, Y up", "inches, Z up"],
)
def test_unit_and_axis_are_those_that_the_file_states(tmp_path, up, metres, matrix):
    asset = load_asset(write_collada(tmp_path, collada_text(matrix, up, metres), png_bytes(4, 4)))

    same = load_asset(write_obj_folder(tmp_path / "obj"), LoadOptions(scale=1.0))
    assert {p.id: p.label for p in asset.parts} == {p.id: p.label for p in same.parts}
    np.testing.assert_allclose(asset.box.size, [0.8, 0.43, 1.0], atol=1e-5)
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, same.part(part.id).box.low, atol=1e-5)


def test_images_colours_and_opacity_reach_the_surfaces(tmp_path):
    text = collada_text(materials={"shelf-6": "steel", "handle-8": "glass"})
    asset = load_asset(write_collada(tmp_path, text, png_bytes(4, 4)))

    by_name = {p.source.name: p.surfaces[0] for p in asset.parts}
    assert by_name["back_panel-5"].material.base_color_texture.name == "wood grain.png"
    assert by_name["back_panel-5"].uv.shape == (len(by_name["back_panel-5"].mesh.vertices), 2)
    np.testing.assert_allclose(by_name["shelf-6"].material.base_color, [0.214, 0.214, 0.214, 1.0], atol=1e-3)
    assert by_name["handle-8"].material.base_color[3] == 0.25
    assert by_name["handle-8"].material.alpha_mode == "BLEND"


def test_a_missing_image_is_a_note(tmp_path):
    asset = load_asset(write_collada(tmp_path))
    assert any("wood grain.png is missing" in note for note in asset.notes)


def test_nodes_below_a_drawer_are_one_part(tmp_path):
    asset = load_asset(write_collada(tmp_path, collada_text(below=DRAWER), png_bytes(4, 4)))

    drawers = [p for p in asset.parts if p.label is PartLabel.DRAWER]
    assert [p.id for p in drawers] == ["drawer_1"]
    assert len(drawers[0].surfaces) == 2


def test_a_urdf_shows_its_collada_meshes_in_metres_along_their_own_axes(tmp_path):
    write_urdf(tmp_path)
    plain = load_annotated(tmp_path / "cabinet.urdf")
    write_collada(tmp_path / "meshes", collada_text(100 * np.eye(3), "Y_UP", 0.01))
    whole = '<link name="whole"><visual><geometry><mesh filename="meshes/cabinet.dae"/></geometry></visual></link>'
    joint = '<joint name="j" type="fixed"><parent link="carcass"/><child link="whole"/></joint>'
    (tmp_path / "cabinet.urdf").write_text(urdf_text(whole + joint))

    asset = load_annotated(tmp_path / "cabinet.urdf")

    np.testing.assert_allclose(asset.box.size, plain.box.size, atol=1e-5)
    assert len(asset.parts) > len(plain.parts)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("<COLLADA", "not readable XML"),
        ("<scene/>", "root <scene>"),
        ("<!DOCTYPE a [<!ENTITY b 'c'>]><COLLADA/>", "document type"),
        (collada_text().replace("<p>0", "<p>999"), "holds no part"),
        (re.sub(r"(<float_array[^>]*>)\S+", r"\g<1>1e30", collada_text(), count=1), "numbers that no furniture has"),
        (collada_text().replace("#scene", "#nowhere"), "holds no part"),
    ],
    ids=["cut short", "another root", "entities", "a vertex that is not there", "no number", "a lost reference"],
)
def test_damaged_documents_are_refused_in_one_line(tmp_path, text, said):
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(write_collada(tmp_path, text))
    assert "\n" not in str(error.value)


def test_a_piece_that_cannot_be_read_is_left_out_with_a_note(tmp_path):
    asset = load_asset(write_collada(tmp_path, collada_text().replace("<p>0", "<p>999", 1), png_bytes(4, 4)))
    assert len(asset.parts) == len(load_asset(write_collada(tmp_path / "whole", None, png_bytes(4, 4))).parts) - 1
    assert any("was left out" in note for note in asset.notes)


def test_nodes_that_multiply_are_counted_before_they_are_built(tmp_path):
    levels = "".join(
        f"<node id='n{k}'><instance_node url='#n{k + 1}'/><instance_node url='#n{k + 1}'/></node>" for k in range(20)
    )
    library = f"<library_nodes>{levels}<node id='n20'><instance_geometry url='#g0'/></node></library_nodes>"
    text = collada_text().replace("<library_visual_scenes>", f"{library}<library_visual_scenes>")
    text = text.replace("<visual_scene id='scene'>", "<visual_scene id='scene'><node><instance_node url='#n0'/></node>")
    with pytest.raises(AssetTooLarge, match="--limit"):
        load_asset(write_collada(tmp_path, text), LoadOptions(limits=Limits(max_nodes=1000)))


def test_without_the_library_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "collada", None)
    with pytest.raises(UnreadableAsset, match=r"grafu\[formats\]"):
        load_asset(write_collada(tmp_path))
