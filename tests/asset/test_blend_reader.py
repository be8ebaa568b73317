"""Blender files: read by Blender in a process of its own; without it, one line names the extra."""

import gzip
import json
import struct
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from grafu.asset import blend
from grafu.asset.load import detect, load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetTooLarge, ExportError, UnreadableAsset
from grafu.export.blend.exporter import find_interpreter
from small_assets import CABINET, write_obj_folder

MAKE = """
import json, sys
import bpy
boxes, extra, target = json.loads(sys.argv[1]), sys.argv[2], sys.argv[3]
bpy.ops.wm.read_factory_settings(use_empty=True)
oak = bpy.data.materials.new("oak")
oak.use_nodes = True
oak.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.3, 0.2, 0.1, 1.0)
for name, (low, high) in boxes.items():
    mesh = bpy.data.meshes.new(name)
    size = [b - a for a, b in zip(low, high)]
    points = [(x * size[0], y * size[1], z * size[2]) for z in (0, 1) for y in (0, 1) for x in (0, 1)]
    mesh.from_pydata(points, [], [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)])
    mesh.materials.append(oak)
    made = bpy.data.objects.new(name, mesh)
    made.location = low
    bpy.context.scene.collection.objects.link(made)
exec(extra)
bpy.ops.wm.save_as_mainfile(filepath=target, compress="packed" in target)
"""


@pytest.fixture(scope="module")
def interpreter() -> str:
    try:
        return find_interpreter()
    except ExportError as error:
        pytest.skip(str(error))


def made(interpreter: str, path: Path, extra: str = "") -> Path:
    command = [interpreter, "-c", MAKE, json.dumps(CABINET), extra, str(path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert path.is_file(), done.stderr
    return path


@pytest.mark.parametrize("name", ["plain.blend", "packed.blend"])
def test_objects_are_parts_where_they_stand(interpreter: str, tmp_path: Path, name: str) -> None:
    asset = load_asset(made(interpreter, tmp_path / name))
    same = load_asset(write_obj_folder(tmp_path / "obj"), LoadOptions(up="+Z", front="-Y", scale=1.0))
    assert (asset.frame.up, asset.frame.front, asset.frame.scale) == ("+Z", "-Y", 1.0)
    assert {p.id: p.label for p in asset.parts} == {p.id: p.label for p in same.parts}
    for part in asset.parts:
        np.testing.assert_allclose(part.box.low, same.part(part.id).box.low, atol=1e-5)
        np.testing.assert_allclose(part.box.high, same.part(part.id).box.high, atol=1e-5)
        np.testing.assert_allclose(part.surfaces[0].material.base_color, (0.3, 0.2, 0.1, 1.0), atol=1e-3)
    assert {p.source.file for p in asset.parts} == {name}


def test_units_modifiers_and_hidden_objects_count(interpreter: str, tmp_path: Path) -> None:
    extra = (
        "bpy.context.scene.unit_settings.scale_length = 0.5\n"
        "bpy.data.objects['shelf-6'].hide_viewport = True\n"
        "bpy.data.objects['back_panel-5'].modifiers.new('a', 'ARRAY').count = 3\n"
    )
    asset = load_asset(made(interpreter, tmp_path / "a.blend", extra))
    assert asset.frame.scale == 0.5
    assert "shelf_6" not in {p.id for p in asset.parts}
    assert len(asset.part("back_panel_5").mesh.faces) == 36


def test_no_script_in_it_is_run(interpreter: str, tmp_path: Path) -> None:
    trace = tmp_path / "trace"
    script = f"open({str(trace)!r}, 'w')"
    extra = f"text = bpy.data.texts.new('t.py')\ntext.write({script!r})\ntext.use_module = True\n"
    path = made(interpreter, tmp_path / "a.blend", extra)
    opened = f"import bpy; bpy.ops.wm.open_mainfile(filepath={str(path)!r}, use_scripts=True)"
    subprocess.run([interpreter, "-c", opened], capture_output=True, timeout=120, check=False)
    assert trace.exists()  # where scripts are on, it runs
    trace.unlink()
    load_asset(path)
    assert not trace.exists()


NAMES_OTHERS = {
    "other .blend files": "with bpy.data.libraries.load({other!r}, link=True) as (there, here):\n"
    "    here.objects = ['shelf-6']\n"
    "bpy.context.scene.collection.objects.link(here.objects[0])\n",
    "caches": "bpy.ops.cachefile.open(filepath={other!r})\nbpy.data.cache_files[0].use_fake_user = True\n",
    "sounds": "bpy.data.sounds.load({other!r}).use_fake_user = True\n",
    "volumes": "bpy.data.volumes.new('smoke').filepath = {other!r}\nbpy.data.volumes[0].use_fake_user = True\n",
    "films": "bpy.data.movieclips.load({other!r}).use_fake_user = True\n",
}


@pytest.mark.parametrize("packed", [False, True], ids=["plain", "packed"])
@pytest.mark.parametrize("what", NAMES_OTHERS)
def test_a_file_that_names_others_is_refused_before_blender_sees_it(
    interpreter: str, tmp_path: Path, what: str, packed: bool
) -> None:
    other = made(interpreter, tmp_path / "other.blend")
    extra = NAMES_OTHERS[what].format(other=str(other))
    path = made(interpreter, tmp_path / ("packed.blend" if packed else "a.blend"), extra)
    with pytest.raises(UnreadableAsset, match=f"names {what}, which are not opened"):
        load_asset(path)


def header(version: str, pointer: int) -> bytes:
    return b"BLENDER17-01v0500" if version == "5" else b"BLENDER" + (b"-" if pointer == 8 else b"_") + b"v405"


def block(code: bytes, length: int, version: str, pointer: int) -> bytes:
    if version == "5":
        return struct.pack("<4si8xqq", code, 0, length, 1) + bytes(length)
    return struct.pack(f"<4si{pointer}xii", code, length, 0, 1) + bytes(length)


@pytest.mark.parametrize(("version", "pointer"), [("4", 8), ("4", 4), ("5", 8)])
def test_the_blocks_of_every_form_of_the_format_are_listed(version: str, pointer: int) -> None:
    codes = [(b"REND", 72), (b"OB", 100), (b"LI", 0), (b"DATA", 7), (b"ENDB", 0)]
    data = header(version, pointer) + b"".join(block(code, length, version, pointer) for code, length in codes)
    assert blend._block_codes(data) == {b"REND", b"OB", b"LI", b"DATA"}
    assert blend._block_codes(blend._unpacked(gzip.compress(data))) == {b"REND", b"OB", b"LI", b"DATA"}
    with pytest.raises(ValueError, match="cut off"):
        blend._block_codes(data[:-30])


@pytest.mark.parametrize("data", [b"BLENDER-V405", b"BLENDER18-02v0600", b"BLENDER*v405", b"BLENDER"])
def test_a_form_of_the_format_that_is_not_known_is_refused(data: bytes) -> None:
    with pytest.raises(ValueError, match="header"):
        blend._block_codes(data)


def test_damage_and_limits_are_lines(interpreter: str, tmp_path: Path) -> None:
    path = made(interpreter, tmp_path / "a.blend")
    with pytest.raises(AssetTooLarge, match="faces"):
        load_asset(path, LoadOptions(limits=Limits(max_faces=20)))
    (tmp_path / "cut.blend").write_bytes(path.read_bytes()[:900])
    with pytest.raises(UnreadableAsset, match="could not be opened by Blender") as raised:
        load_asset(tmp_path / "cut.blend")
    assert "\n" not in str(raised.value)


def test_without_blender_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "a.blend").write_bytes(b"BLENDER-v405")
    monkeypatch.setenv(blend.INTERPRETER_VARIABLE, str(tmp_path / "nothing"))
    with pytest.raises(UnreadableAsset, match=r"pip install 'grafu\[blender\]'"):
        load_asset(tmp_path / "a.blend")


def test_what_is_no_blender_file_starts_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(blend.INTERPRETER_VARIABLE, sys.executable)
    (tmp_path / "a.blend").write_bytes(b"no")
    with pytest.raises(UnreadableAsset, match="is no file of Blender"):
        load_asset(tmp_path / "a.blend")


def test_meshes_beside_a_scene_of_blender_come_first(tmp_path: Path) -> None:
    write_obj_folder(tmp_path / "model")
    (tmp_path / "model" / "model.blend").write_bytes(b"BLENDER")
    assert detect(tmp_path / "model")[0] == "mesh folder"
    (tmp_path / "alone").mkdir()
    (tmp_path / "alone" / "model.blend").write_bytes(b"BLENDER")
    assert detect(tmp_path / "alone")[0] == "blend"
