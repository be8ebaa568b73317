import re
import sys

import numpy as np
import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetError, AssetTooLarge, UnreadableAsset
from grafu.export.files import write_files
from grafu.export.mjcf import export_mjcf
from grafu.synth.truth.clashes import articulated_of
from predictions import cabinet
from robot_models import assert_same_robot, mjcf_text, sdf_text, write_mjcf, write_sdf
from small_assets import CABINET, load_annotated, png_bytes, write_obj_folder, write_urdf

EVERYTHING = tuple(CABINET)
IN_SDF = "<material><diffuse>0.6 0.4 0.2 1</diffuse></material>"


@pytest.mark.parametrize("boxes", [(), EVERYTHING], ids=["meshes", "boxes"])
@pytest.mark.parametrize("kind", ["sdf", "mjcf"])
def test_a_cabinet_is_the_same_in_every_robot_format(tmp_path, kind, boxes):
    made = write_sdf(tmp_path, sdf_text(boxes=boxes)) if kind == "sdf" else write_mjcf(tmp_path, mjcf_text(boxes=boxes))
    asset = load_annotated(made)
    assert asset.kind == kind
    assert asset.notes == ()
    assert_same_robot(asset, load_annotated(write_urdf(tmp_path / "urdf")))


@pytest.mark.parametrize("kind", ["sdf", "mjcf"])
def test_a_folder_with_one_robot_is_that_robot(tmp_path, kind):
    write_sdf(tmp_path) if kind == "sdf" else write_mjcf(tmp_path)
    assert load_asset(tmp_path).kind == kind


def test_what_is_written_as_mjcf_is_read_back(tmp_path):
    stated = articulated_of(cabinet())
    write_files(export_mjcf(stated), tmp_path, overwrite=True)
    asset = load_annotated(tmp_path / "model.xml")
    np.testing.assert_allclose(asset.box.size, cabinet().box.size, atol=1e-4)
    assert sorted(j.type.value for j in asset.joints) == sorted(j.type.value for j in stated.joints if j.kind.moves)


def test_colours_of_materials_reach_the_surfaces(tmp_path):
    by_sdf = load_asset(write_sdf(tmp_path / "s", sdf_text(looks=IN_SDF)))
    by_mjcf = load_asset(write_mjcf(tmp_path / "m", mjcf_text(boxes=EVERYTHING)))
    for asset in (by_sdf, by_mjcf):
        assert asset.part("shelf_6").surfaces[0].material.base_color == pytest.approx((0.6, 0.4, 0.2, 1.0))


def test_images_of_materials_are_read_and_missing_ones_noted(tmp_path):
    (tmp_path / "images").mkdir()
    (tmp_path / "images" / "oak.png").write_bytes(png_bytes(4, 4))
    text = mjcf_text(boxes=EVERYTHING).replace('meshdir="meshes"', 'texturedir="images"')
    text = text.replace('rgba="0.6 0.4 0.2 1"/>', 'texture="oak"/><texture name="oak" type="2d" file="oak.png"/>')
    shown = load_asset(write_mjcf(tmp_path, text)).part("shelf_6").surfaces[0].material
    assert shown.base_color_texture.name == "oak.png"
    (tmp_path / "images" / "oak.png").unlink()
    assert any("images/oak.png is missing" in note for note in load_asset(tmp_path / "cabinet.xml").notes)


def test_poses_of_sdf_count_from_the_frames_that_they_name(tmp_path):
    text = sdf_text('<frame name="up"><pose>0 0 0.5 0 0 0</pose></frame>', boxes=EVERYTHING)
    moved = text.replace(
        '<visual name="shelf-6"><pose relative_to="base">', '<visual name="shelf-6"><pose relative_to="up">'
    )
    plain = load_asset(write_sdf(tmp_path / "plain", text)).part("shelf_6").box.low
    np.testing.assert_allclose(
        load_asset(write_sdf(tmp_path / "moved", moved)).part("shelf_6").box.low - plain, [0, 0, 0.5], atol=1e-9
    )


@pytest.mark.parametrize("version", ["1.4", "1.7"])
def test_axes_of_old_sdf_lie_in_the_frame_of_the_model(tmp_path, version):
    text = sdf_text().replace('version="1.7"', f'version="{version}"')
    text = text.replace(
        '<link name="drawer_link"><pose>0 0 0 0 0 0', '<link name="drawer_link"><pose>0 0 0 0 0 1.5707963'
    )
    asset = load_annotated(write_sdf(tmp_path, text), LoadOptions(front="-Y"))
    drawer = next(j for j in asset.joints if j.part == "drawer_link")
    expected = [0, -1, 0] if version == "1.4" else [1, 0, 0]
    np.testing.assert_allclose(drawer.axis.direction, expected, atol=1e-6)


COUPLED_SDF = '<mimic joint="door_joint"><multiplier>0.2</multiplier><offset>0</offset><reference>0</reference></mimic>'
COUPLED_MJCF = '<equality><joint joint1="drawer_joint" joint2="door_joint" polycoef="0 0.2 0 0 0"/></equality>'


@pytest.mark.parametrize("kind", ["sdf", "mjcf"])
def test_coupled_joints_follow(tmp_path, kind):
    at = "<axis><xyz>0 -1 0</xyz>"
    path = (
        write_sdf(tmp_path, sdf_text().replace(at, at + COUPLED_SDF))
        if kind == "sdf"
        else write_mjcf(tmp_path, mjcf_text(COUPLED_MJCF))
    )
    coupling = next(j.coupling for j in load_annotated(path).joints if j.part == "drawer_link")
    assert (coupling.leader, coupling.multiplier, coupling.offset) == ("door_link", pytest.approx(0.2), 0.0)


def test_included_mjcf_files_are_put_in_place(tmp_path):
    text = mjcf_text()
    inner = re.search(r"<default>.*</default>", text)[0]
    (tmp_path / "looks.xml").write_text(f"<mujocoinclude>{inner}</mujocoinclude>")
    asset = load_annotated(write_mjcf(tmp_path, text.replace(inner, '<include file="looks.xml"/>')))
    assert_same_robot(asset, load_annotated(write_urdf(tmp_path / "urdf")))


def test_geoms_of_a_class_of_mjcf_are_as_their_class_states(tmp_path):
    classes = '<default><geom type="box"/><default class="red"><geom size="1 2 3" rgba="1 0 0 1"/></default></default>'
    geoms = '<geom class="red"/><body childclass="red" pos="5 0 0"><geom/><geom size="1 1 1" pos="4 0 0"/></body>'
    (tmp_path / "a.xml").write_text(f"<mujoco>{classes}<worldbody>{geoms}</worldbody></mujoco>")
    parts = load_asset(tmp_path / "a.xml", LoadOptions(parts="input", scale=1.0, front="-Y")).parts

    np.testing.assert_allclose([part.box.size for part in parts], [[2, 4, 6], [2, 4, 6], [2, 2, 2]])
    assert {part.surfaces[0].material.base_color for part in parts} == {(1.0, 0.0, 0.0, 1.0)}


def test_copies_in_mjcf_are_counted_before_they_are_made(tmp_path):
    many = '<replicate count="100000000" offset="0 0 1"><geom name="board" type="box" size="1 1 1"/></replicate>'
    with pytest.raises(AssetTooLarge, match="nodes"):
        load_asset(write_mjcf(tmp_path, mjcf_text(within=many)))
    few = many.replace("100000000", "2").replace('size="1 1 1"', 'size="0.3 0.1 0.01" pos="0 0 0.3"')
    names = [p.source.name for p in load_asset(write_mjcf(tmp_path / "few", mjcf_text(within=few))).parts]
    assert sum(name.startswith("board") for name in names) == 2


CIRCLE = sdf_text('<frame name="a"><pose relative_to="a"/></frame>', boxes=EVERYTHING).replace('to="base"', 'to="a"')


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (sdf_text().replace("sdf", "sd"), "root <sd>"),
        (sdf_text()[:400], "not readable XML"),
        (sdf_text().replace("<child>door_link", "<child>gone"), "'gone', which is not there"),
        (CIRCLE, "in a circle"),
        (sdf_text().replace("1 2 0 0 0 0", "1 2 0 0 0"), "expected 6 finite numbers"),
        (sdf_text().replace("1 2 0 0 0 0", "1e99 2 0 0 0 0"), "no furniture has"),
        (sdf_text().replace("model://cabinet", "model://../.."), "no visual shape"),
    ],
    ids=["root", "cut", "link", "circle", "pose", "far", "outside"],
)
def test_damaged_sdf_is_refused_in_one_line(tmp_path, text, said):
    path = write_sdf(tmp_path, text)
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(path)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (mjcf_text()[:500], "not readable XML"),
        (mjcf_text().replace('pos="1 2 0"', 'pos="a b c"'), "that MuJoCo compiles"),
        (mjcf_text().replace('class="visual" mesh', 'class="gone" mesh'), "that MuJoCo compiles"),
        (mjcf_text('<include file="../secret.xml"/>'), "lies outside"),
        (mjcf_text('<include file="none.xml"/>'), "is missing"),
        (mjcf_text('<include file="cabinet.xml"/>'), "included twice or by itself"),
        (mjcf_text().replace('meshdir="meshes"', 'meshdir="../elsewhere"'), "no visual shape"),
        ("<!DOCTYPE a [<!ENTITY b 'c'>]><mujoco/>", "document type"),
    ],
    ids=["cut", "number", "class", "outside", "missing", "itself", "folder", "entities"],
)
def test_damaged_mjcf_is_refused_in_one_line(tmp_path, text, said):
    (tmp_path / "secret.xml").write_text("<mujocoinclude/>")
    with pytest.raises(UnreadableAsset, match=said) as error:
        load_asset(write_mjcf(tmp_path / "model", text))
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("name", ["faces", "nodes", "bytes"])
@pytest.mark.parametrize("write", [write_sdf, write_mjcf])
def test_limits_hold(tmp_path, write, name):
    with pytest.raises(AssetTooLarge, match=f"--limit {name}"):
        load_asset(write(tmp_path), LoadOptions(limits=Limits().with_limit(name, 3)))


def test_without_mujoco_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "mujoco", None)
    with pytest.raises(AssetError, match=r"grafu\[sim\]"):
        load_asset(write_mjcf(tmp_path))


def test_a_mesh_that_is_missing_is_a_note(tmp_path):
    for path in (write_sdf(tmp_path / "s"), write_mjcf(tmp_path / "m")):
        (path.parent / "meshes" / "shelf-6.obj").unlink()
        assert any("shelf-6.obj is missing" in note for note in load_asset(path).notes)


def test_a_folder_of_meshes_beside_another_xml_stays_one(tmp_path):
    write_obj_folder(tmp_path)
    (tmp_path / "about.xml").write_text("<about/>")
    assert load_asset(tmp_path).kind == "mesh folder"
