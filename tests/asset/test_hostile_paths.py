"""What a stranger's model may name: files of its own folder, and nothing else on the machine."""

import json
import os
import shutil
from pathlib import Path

import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.asset.regular_files import NotRegular, TooManyBytes, read_regular
from grafu.asset.resources import ModelFiles
from grafu.errors import AssetError, UnreadableAsset
from small_assets import CABINET, gltf_document, png_bytes, urdf_text, write_grouped_obj, write_obj_folder, write_urdf

SECRET = b"\x89PNG\r\n\x1a\n of another"
NAMES = [
    "../secret",
    "sub/../../secret",
    "{outside}",
    "file://{outside}",
    "link_out",
    "links/secret",
    "/proc/self/environ",
]
NO_NAMES = ["/dev/zero", "fifo", "a\0b", "\ud800", "x" * 5000, "sub", "."]

needs_fifos = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")


@pytest.fixture
def model(tmp_path):
    """Returns a model's folder; beside it lies what it must not read, and in it are ways out."""
    (tmp_path / "secret").write_bytes(png_bytes(2, 2) * 40)
    folder = tmp_path / "model"
    (folder / "sub").mkdir(parents=True)
    (folder / "link_out").symlink_to(tmp_path / "secret")
    (folder / "links").symlink_to(tmp_path)
    if hasattr(os, "mkfifo"):
        os.mkfifo(folder / "fifo")
    return folder


def spelled(name, folder):
    return name.format(outside=folder.parent / "secret")


def write_gltf(folder, **entries):
    document, binary = gltf_document(list(CABINET))
    (folder / "own.bin").write_bytes(binary)
    document["buffers"][0]["uri"] = "own.bin"
    for mesh in document["meshes"]:
        mesh["primitives"][0]["material"] = 0
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    document |= {"textures": [{"source": 0}], "images": [{"uri": "own.png"}]} | entries
    (folder / "own.png").write_bytes(png_bytes(2, 2))
    (folder / "a.gltf").write_text(json.dumps(document))
    return folder / "a.gltf"


def textures(asset):
    materials = {s.material for part in asset.parts for s in part.surfaces}
    return {m.base_color_texture.data for m in materials if m.base_color_texture}


@needs_fifos
@pytest.mark.parametrize("name", NAMES + NO_NAMES)
def test_a_buffer_outside_of_the_model_is_refused_in_one_line(model, name):
    path = write_gltf(model)
    document = json.loads(path.read_text())
    document["buffers"][0]["uri"] = spelled(name, model)
    path.write_text(json.dumps(document))
    with pytest.raises(UnreadableAsset) as caught:
        load_asset(path)
    assert "\n" not in str(caught.value)


@needs_fifos
@pytest.mark.parametrize("name", NAMES + NO_NAMES)
def test_an_image_outside_of_the_model_is_left_out_and_noted(model, name):
    path = write_gltf(model)
    assert textures(load_asset(path)) == {png_bytes(2, 2)}  # its own is read
    asset = load_asset(write_gltf(model, images=[{"uri": spelled(name, model)}]))
    assert not textures(asset)
    assert any("image 0" in note and "left out" in note for note in asset.notes)


@needs_fifos
@pytest.mark.parametrize("name", [name for name in NAMES + NO_NAMES if "\ud800" not in name])
@pytest.mark.parametrize("way", ["mtllib", "map_Kd"])
def test_a_material_library_and_its_images_lie_in_the_model(model, name, way):
    (model.parent / "secret").write_bytes(b"newmtl wood\nKd 1 0 0\n" if way == "mtllib" else png_bytes(2, 2))
    path = write_grouped_obj(model / "a.obj")
    library = spelled(name, model) if way == "mtllib" else "own.mtl"
    (model / "own.mtl").write_text(f"newmtl wood\nKd 0 1 0\nmap_Kd {spelled(name, model)}\n")
    path.write_text(f"mtllib {library}\nusemtl wood\n{path.read_text()}")
    asset = load_asset(path)
    assert not textures(asset)
    assert {s.material.base_color[0] for p in asset.parts for s in p.surfaces} != {1.0}
    assert any("library" in note or "texture" in note for note in asset.notes)


@needs_fifos
@pytest.mark.parametrize("name", [name for name in NAMES + NO_NAMES if "\0" not in name and "\ud800" not in name])
def test_a_mesh_and_a_texture_of_a_robot_lie_in_the_model(model, name):
    (model.parent / "secret").write_text((write_obj_folder(model / "meshes") / "shelf-6.obj").read_text())
    shutil.copyfile(model.parent / "secret", model.parent / "secret.obj")
    name = spelled(name, model).replace("secret", "secret.obj")
    visual = f'<visual name="shelf-99"><geometry><mesh filename="{name}"/></geometry></visual>'
    asset = load_asset(write_urdf(model, urdf_text().replace("</link>", visual + "</link>", 1)))
    assert "shelf-99" not in {part.source.name for part in asset.parts}
    assert any(note.startswith("mesh ") and "left out" in note for note in asset.notes)


def test_a_texture_of_a_robot_that_is_no_file_of_it_is_noted(model):
    text = urdf_text().replace("</visual>", '<material name="m"><texture filename="/dev/zero"/></material></visual>', 1)
    asset = load_asset(write_urdf(model, text))
    assert not textures(asset)
    assert any("texture /dev/zero" in note for note in asset.notes)


def test_a_folder_of_meshes_leads_nowhere_else(model):
    shutil.rmtree(model)
    write_obj_folder(model)
    (model.parent / "elsewhere.obj").write_text((model / "shelf-6.obj").read_text())
    (model / "shelf-6.obj").unlink()
    (model / "shelf-6.obj").symlink_to(model.parent / "elsewhere.obj")
    with pytest.raises(UnreadableAsset, match="outside the model's folder"):
        load_asset(model)


@needs_fifos
@pytest.mark.parametrize("suffix", [".obj", ".glb", ".gltf", ".urdf", ".ply", ".json"])
def test_an_input_that_is_no_regular_file_is_refused_and_never_waited_for(tmp_path, suffix):
    os.mkfifo(tmp_path / f"pipe{suffix}")
    with pytest.raises(UnreadableAsset, match=r"named pipe|not a kind"):
        load_asset(tmp_path / f"pipe{suffix}")
    (tmp_path / f"zero{suffix}").symlink_to("/dev/zero")
    with pytest.raises(UnreadableAsset, match=r"device|not a kind"):
        load_asset(tmp_path / f"zero{suffix}")


@pytest.mark.parametrize("name", ["a\0b.obj", "x" * 5000])
def test_a_name_that_no_file_has_is_one_line(name):
    with pytest.raises(AssetError) as caught:
        load_asset(Path(name))
    assert "\n" not in str(caught.value)


def test_the_folder_and_the_file_that_the_user_names_may_be_links(tmp_path):
    write_urdf(tmp_path / "real")
    (tmp_path / "alias").symlink_to(tmp_path / "real")
    assert len(load_asset(tmp_path / "alias").parts) == len(load_asset(tmp_path / "real").parts)
    write_grouped_obj(tmp_path / "a.obj")
    (tmp_path / "b.obj").symlink_to(tmp_path / "a.obj")
    assert len(load_asset(tmp_path / "b.obj").parts) == len(load_asset(tmp_path / "a.obj").parts)


@pytest.mark.parametrize("how", ["urdf folder", "package.xml", "given folder"])
def test_a_package_is_read_from_its_root(tmp_path, how):
    root = tmp_path / "stranger"
    write_obj_folder(root / "meshes")
    place = root / ("urdf" if how == "urdf folder" else "description")
    place.mkdir()
    (place / "a.urdf").write_text(urdf_text().replace('"meshes/', '"package://cabinet/meshes/'))
    (place / "b.urdf").write_text(urdf_text().replace('"meshes/', '"../meshes/'))
    if how == "package.xml":
        (root / "package.xml").write_text("<package/>")
    if how == "given folder":
        (place / "b.urdf").unlink()
    expected = len(load_asset(write_urdf(tmp_path / "plain")).parts)
    given = [root] if how == "given folder" else [place / "a.urdf", place / "b.urdf"]
    assert [len(load_asset(path).parts) for path in given] == [expected] * len(given)


def test_a_package_leads_to_no_folder_above_it(tmp_path):
    write_obj_folder(tmp_path / "meshes")
    (tmp_path / "stranger").mkdir()
    for spelled_as in ("package://meshes/", "package://x/meshes/", f"file://{tmp_path}/meshes/", "../meshes/"):
        text = urdf_text().replace('"meshes/', f'"{spelled_as}')
        (tmp_path / "stranger" / "a.urdf").write_text(text)
        with pytest.raises(UnreadableAsset, match="no visual shape"):
            load_asset(tmp_path / "stranger" / "a.urdf")


def test_what_lies_in_a_file_that_grows_or_lies_is_cut_off(tmp_path):
    with pytest.raises(TooManyBytes):
        read_regular(Path("/proc/self/maps"), 10)
    (tmp_path / "a.obj").write_text("v 0 0 0\n" * 100)
    with pytest.raises(AssetError, match=r"0 MiB of files: at most .* MiB are read.*--limit bytes="):
        load_asset(tmp_path / "a.obj", LoadOptions(limits=Limits(max_bytes=100)))


def test_a_link_that_is_put_in_the_way_meanwhile_is_not_followed(tmp_path):
    (tmp_path / "model").mkdir()
    (tmp_path / "secret").write_bytes(SECRET)
    (tmp_path / "model" / "late.bin").symlink_to(tmp_path / "secret")
    with pytest.raises(OSError):  # noqa: PT011  # what it is called differs
        read_regular(tmp_path / "model" / "late.bin", 10**6, tmp_path / "model")
    with pytest.raises(NotRegular, match="folder"):
        read_regular(tmp_path / "model", 10**6)
    with pytest.raises(UnreadableAsset, match="outside"):
        ModelFiles(tmp_path / "model").read(tmp_path / "model" / "late.bin")
