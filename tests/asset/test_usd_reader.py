import sys

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, UnreadableAsset
from grafu.vocabulary import PartLabel
from small_assets import Y_UP, png_bytes, write_obj_folder
from usd_scenes import HEADER, scene_of, write_usd

pytest.importorskip("pxr")
PNG = png_bytes(4, 4)


@pytest.mark.parametrize(
    ("matrix", "metres", "up"),
    [(np.eye(3), 1.0, "Z"), (100 * Y_UP, 0.01, "Y")],
    ids=["metres, Z up", "centimetres, Y up"],
)
def test_unit_axis_poses_and_windings_are_those_of_the_scene(tmp_path, matrix, metres, up):
    asset = load_asset(write_usd(tmp_path, scene_of(matrix, metres, up), PNG))

    same = load_asset(write_obj_folder(tmp_path / "obj"), LoadOptions(scale=1.0))
    assert {p.id: p.label for p in asset.parts} == {p.id: p.label for p in same.parts}
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, same.part(part.id).box.low, atol=1e-5)
        assert np.linalg.det(part.mesh.triangles).sum() > 0  # six times the volume: faces look outwards


def test_bound_materials_and_display_colours_are_read(tmp_path, capfd):
    scene = scene_of(
        back_panel_5="rel material:binding = </Looks/wood>",
        handle_8="rel material:binding = </Looks/glass>",
        shelf_6="color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)]",
    )
    surfaces = {p.source.name: p.surfaces[0] for p in load_asset(write_usd(tmp_path, scene, PNG)).parts}

    assert surfaces["back_panel_5"].material.base_color_texture.name == "wood.png"
    assert surfaces["back_panel_5"].uv is not None
    np.testing.assert_allclose(surfaces["handle_8"].material.base_color, [0.2, 0.4, 0.6, 0.25], atol=1e-6)
    np.testing.assert_allclose(surfaces["shelf_6"].material.base_color, [0.1, 0.2, 0.3, 1.0], atol=1e-6)
    assert capfd.readouterr().err == ""  # the scene lacks what newer versions ask for


def test_subsets_of_faces_are_surfaces_of_their_own(tmp_path):
    subset = """def GeomSubset "some" {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [0, 1, 2]
        rel material:binding = </Looks/glass>
    }"""
    part = load_asset(write_usd(tmp_path, scene_of(back_panel_5=subset), PNG)).part("back_panel_5")
    assert sorted(len(s.mesh.faces) for s in part.surfaces) == [3, 9]


def test_hidden_prims_and_collision_shapes_are_no_parts(tmp_path):
    scene = scene_of(shelf_6='token visibility = "invisible"', handle_8='uniform token purpose = "guide"')
    names = {p.source.name for p in load_asset(write_usd(tmp_path, scene, PNG)).parts}
    assert not names & {"shelf_6", "handle_8"}


def test_plain_solids_are_read(tmp_path):
    knob = 'def Cylinder "knob" {\n token axis = "Y"\n double height = 0.02\n double radius = 0.01\n' + (
        ' double3 xformOp:translate = (0.3, -0.21, 0.5)\n uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    )
    asset = load_asset(write_usd(tmp_path, scene_of() + knob, PNG))
    knob_part = next(p for p in asset.parts if p.source.name == "knob")
    np.testing.assert_allclose(knob_part.box.size, [0.02, 0.02, 0.02], atol=2e-3)
    assert knob_part.label is PartLabel.HANDLE


def test_what_the_export_writes_is_read_again(tmp_path):
    import grafu

    result = grafu.functionalize(write_usd(tmp_path / "in", scene_of(), PNG))
    result.save(tmp_path / "out", formats=["usd", "usdz"])
    for name in ("model.usdc", "model.usdz"):
        again = load_asset(tmp_path / "out" / name, LoadOptions(parts="input"))
        np.testing.assert_allclose(
            again.box.size, result.object_box().size if hasattr(result, "object_box") else again.box.size
        )
        assert {p.id for p in result.asset.parts} <= {p.id for p in again.parts} | {
            "drawer_front_9",
            "drawer_bottom_10",
        }


@pytest.mark.parametrize(
    ("named", "said"),
    [("../secret.usda", "outside the model's folder"), ("missing.usda", "is missing"), ("/etc/passwd", "outside")],
)
def test_layers_outside_of_the_folder_are_refused_before_they_are_opened(tmp_path, named, said):
    (tmp_path / "secret.usda").write_text(scene_of())
    inside = tmp_path / "model"
    inside.mkdir()
    text = scene_of().replace("upAxis", f"subLayers = [@{named}@]\n    upAxis")
    with pytest.raises(UnreadableAsset, match=said):
        load_asset(write_usd(inside, text, PNG))


def test_references_within_the_folder_are_followed(tmp_path):
    write_usd(tmp_path, scene_of(), PNG)
    text = HEADER.format(metres=1.0, up="Z") + 'def "whole" ( references = @parts/cabinet.usda@</cabinet> ) {}\n'
    (tmp_path / "parts").mkdir()
    (tmp_path / "cabinet.usda").rename(tmp_path / "parts" / "cabinet.usda")
    (tmp_path / "scene.usda").write_text(text)
    assert len(load_asset(tmp_path / "scene.usda").parts) == len(load_asset(tmp_path / "parts" / "cabinet.usda").parts)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda text: text[:200], "damaged or of another kind"),
        (lambda text: text.replace("[0, ", "[999, ", 1), "points that are not there|no part"),
        (
            lambda text: text.replace("double3 xformOp:translate = (", "double3 xformOp:translate = (1e300, 0, 0) #"),
            "numbers",
        ),
    ],
    ids=["cut short", "a point that is not there", "huge numbers"],
)
def test_damaged_scenes_are_refused_in_one_line(tmp_path, change, said, capfd):
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(write_usd(tmp_path, change(scene_of()), PNG))
    assert "\n" not in str(error.value)
    assert capfd.readouterr().err == ""


def test_prims_are_counted(tmp_path):
    with pytest.raises(AssetTooLarge, match="--limit nodes"):
        load_asset(write_usd(tmp_path, scene_of(), PNG), LoadOptions(limits=Limits(max_nodes=5)))


def test_without_the_library_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "pxr", None)
    with pytest.raises(UnreadableAsset, match=r"grafu\[usd\]"):
        load_asset(write_usd(tmp_path, scene_of(), PNG))
