import subprocess
import sys
import warnings

import numpy as np
import pytest
import trimesh

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetError, AssetTooLarge, UnreadableAsset, UnsegmentedAsset
from grafu.vocabulary import JointType, PartLabel
from small_assets import CABINET, load_annotated, mesh_of, write_grouped_obj, write_obj_folder

Y_UP = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])


@pytest.mark.parametrize("matrix", [np.eye(3), Y_UP], ids=["z up", "y up"])
@pytest.mark.parametrize("unit", [1.0, 100.0, 1000.0], ids=["m", "cm", "mm"])
def test_units_and_up_are_guessed_from_shape_and_labels(tmp_path, matrix, unit):
    asset = load_asset(write_obj_folder(tmp_path / "m", 1.1 * unit * matrix))
    assert asset.frame.scale == pytest.approx(1 / unit)
    np.testing.assert_allclose(asset.box.size, [0.88, 0.473, 1.1], atol=1e-6)
    assert asset.frame.front == ("-Y" if matrix[1, 1] else "+Z")


def test_groups_of_one_file_are_parts(tmp_path):
    asset = load_asset(write_grouped_obj(tmp_path / "c.obj"))
    assert asset.kind == "mesh file"
    assert asset.name == "c"
    assert [p.source.name for p in asset.parts] == [n for n in CABINET if n != "drawer_bottom-10"]
    assert "drawer_bottom-10 joined to drawer_front_9" in asset.notes
    assert asset.part("handle_8").carried_by == "cabinet_door_surface_7"


def test_a_folder_with_one_grouped_file_reads_its_groups(tmp_path):
    write_grouped_obj(tmp_path / "c.obj")
    assert len(load_asset(tmp_path).parts) == len(CABINET) - 1


@pytest.mark.parametrize("suffix", ["stl", "ply"])
def test_folders_of_other_meshes_are_read(tmp_path, suffix):
    for name in CABINET:
        (mesh_of(name).to_trimesh().apply_scale(1.1)).export(tmp_path / f"{name}.{suffix}")
    asset = load_asset(tmp_path)
    assert asset.kind == "mesh folder"
    np.testing.assert_allclose(sorted(asset.box.size), [0.473, 0.88, 1.1], rtol=1e-5)


def test_the_user_states_frame_and_size(tmp_path):
    path = write_grouped_obj(tmp_path / "c.obj", 3 * np.eye(3))
    asset = load_asset(path, LoadOptions(up="Z", front="+x", height=2.0, scale=9.0))
    assert asset.box.size[2] == pytest.approx(2.0)
    assert (asset.frame.up, asset.frame.front) == ("+Z", "+X")
    assert load_asset(path, LoadOptions(scale=0.5)).box.size.max() == pytest.approx(1.5)


def test_normalised_meshes_get_the_same_size_at_any_scale(tmp_path):
    sizes = [load_asset(write_obj_folder(tmp_path / f"{s}", s * np.eye(3))).box.size for s in (1.0, 2.0)]
    np.testing.assert_allclose(sizes[0], sizes[1])


def test_numbered_pieces_are_one_drawer_with_its_handle(tmp_path):
    names = {"drawer_front-9": "drawer_1_front", "drawer_bottom-10": "drawer_1_bottom", "handle-11": "drawer_1_handle"}
    asset = load_asset(write_grouped_obj(tmp_path / "c.obj", names=names))
    assert asset.part("drawer_1").label is PartLabel.DRAWER
    assert len(asset.part("drawer_1").surfaces) == 2
    assert asset.part("handle_drawer_1_handle").carried_by == "drawer_1"


def test_repeated_and_strange_names_give_safe_unique_ids(tmp_path):
    odd = ["Tür links", "a/b\\c", "日本語", "日本語2", "7", "hinge_1", "rail_2", "handles", "x y", "x y.", "x-y"]
    asset = load_asset(write_grouped_obj(tmp_path / "c.obj", names=dict(zip(CABINET, odd, strict=True))))
    ids = [p.id for p in asset.parts]
    assert len(set(ids)) == len(ids) == len(CABINET)
    assert all(i.isidentifier() and i.isascii() and not i.startswith(("hinge_", "rail_", "support_")) for i in ids)
    assert [p.source.name for p in asset.parts] == odd


def test_degenerate_faces_and_empty_parts_are_dropped_with_a_note(tmp_path):
    folder = write_obj_folder(tmp_path / "m")
    with (folder / "shelf-6.obj").open("a") as stream:
        stream.write("f 1 1 2\nf 1 2 1\n")
    (folder / "empty-12.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    asset = load_asset(folder)
    assert len(asset.part("shelf_6").mesh.faces) == 12
    assert any("2 faces without area" in note for note in asset.notes)
    assert any("empty-12" in note and "no faces" in note for note in asset.notes)


def test_sweet_home_names_give_joints(tmp_path):
    names = {
        "cabinet_door_surface-7": "sweethome3d_opening_on_hinge_1_leaf",
        "handle-8": "sweethome3d_hinge_1_pin",
        "shelf-6": "sweethome3d_opening_on_hinge_2_x",
    }
    path = write_grouped_obj(tmp_path / "c.obj", 100 * Y_UP, names)
    asset = load_annotated(path)
    (joint,) = asset.joints
    assert joint.type is JointType.REVOLUTE
    np.testing.assert_allclose(np.abs(joint.axis.direction), [0, 0, 1], atol=1e-9)
    assert asset.part(joint.part).label is PartLabel.DOOR
    assert asset.frame.scale == 0.01
    assert any("kept in place" in note for note in asset.notes)


@pytest.mark.parametrize(("pane", "unit"), [("sweethome3d_window_pane", 0.01), ("window_pane", None)])
def test_a_fixed_window_of_sweet_home_has_panes_alone_and_its_unit(tmp_path, pane, unit):
    asset = load_asset(write_grouped_obj(tmp_path / "c.obj", 100 * Y_UP, {"shelf-6": pane}))
    assert ("Sweet Home" in asset.frame.assumed[2]) is (unit is not None)
    assert asset.joints == ()


@pytest.mark.parametrize(
    ("name", "material", "label"),
    [
        ("lamp_Cylinder.011_metal_handle", "metal_handle", PartLabel.MISC),
        ("lamp_Cylinder.011_metal_handle", "chrome", PartLabel.HANDLE),
        ("Cylinder.011_metal_handle", "metal_handle", PartLabel.HANDLE),
        ("knob_Sphere_dark_door.jpg", "dark_door.jpg", PartLabel.HANDLE),
        ("handle", "handle", PartLabel.HANDLE),
    ],
)
def test_a_material_behind_the_name_of_a_group_tells_nothing_where_it_has_words_of_its_own(
    tmp_path, name, material, label
):
    path = write_grouped_obj(tmp_path / "c.obj", names={"handle-8": name})
    materials = {name: material}
    lines = (
        line + f"\nusemtl {materials.get(line[2:], 'plain')}" if line.startswith("g ") else line
        for line in path.read_text().splitlines()
    )
    path.write_text("\n".join(lines) + "\n")
    (part,) = (part for part in load_asset(path, LoadOptions(parts="input")).parts if part.source.name == name)
    assert part.label is label


TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


@pytest.mark.parametrize(
    ("name", "data", "error", "said"),
    [
        ("a.obj", "", UnreadableAsset, "is empty: fetch or export it again"),
        ("a.obj", "\n", UnreadableAsset, "no part with faces"),
        ("a.obj", "hello world", UnreadableAsset, "holds no vertices"),
        ("a.obj", TRIANGLE, UnsegmentedAsset, "one part, `a`: expected several; it is one connected shell"),
        ("a.obj", TRIANGLE.replace("1 0 0", "nan 0 0"), UnreadableAsset, "NaN"),
        ("a.obj", TRIANGLE.replace("1 0 0", "1 zero 0"), UnreadableAsset, "not a readable OBJ"),
        ("a.obj", TRIANGLE.replace("1 0 0", "1 0"), UnreadableAsset, "2 coordinates"),
        ("a.obj", TRIANGLE.replace("f 1 2 3", "f 1 2 4"), UnreadableAsset, "not there"),
        ("a.obj", TRIANGLE.replace("f 1 2 3", "f -1 -2 -4"), UnreadableAsset, "not there"),
        ("a.obj", TRIANGLE.replace("f 1 2 3", "f a b c"), UnreadableAsset, "not a readable OBJ"),
        ("a.stl", "solid nothing", UnreadableAsset, "a.stl"),
        ("a.stl", "\0" * 80 + "\1\1\1\0" + "\0" * 10, UnreadableAsset, "truncated"),
        ("a.ply", "ply\nformat ascii 1.0\nelement vertex 99999\nend_header\n", UnreadableAsset, "truncated"),
        ("a.ply", "not a ply", UnreadableAsset, "a.ply"),
        ("a.ply", "ply\nformat ascii 1.0\nelement face 99999999\nend_header\n", AssetTooLarge, "2,000,000 are read"),
        ("a.txt", "text", UnreadableAsset, "not a kind of file"),
    ],
)
def test_bad_meshes_are_refused_in_one_line(tmp_path, name, data, error, said):
    path = tmp_path / name
    path.write_text(data)
    with pytest.raises(error, match=said) as caught:
        load_asset(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_missing_and_empty_places_are_told_apart(tmp_path):
    with pytest.raises(UnreadableAsset, match="does not exist"):
        load_asset(tmp_path / "gone.obj")
    with pytest.raises(UnreadableAsset, match="is empty"):
        load_asset(tmp_path)
    (tmp_path / "notes.txt").write_text("x")
    with pytest.raises(UnreadableAsset, match="nothing that is read"):
        load_asset(tmp_path)


@pytest.mark.parametrize(
    ("name", "way"),
    [
        ("a.c4d", "export it as GLB"),
        ("a.xacro", "xacro FILE.xacro > FILE.urdf"),
        ("a.skp", "GLB or COLLADA"),
        ("a.step", "glTF"),
        ("a.MAX", "export it as GLB"),
        ("a.zip", "unpack it"),
        ("a.jpg", "no model"),
    ],
)
def test_files_of_other_kinds_are_told_a_way_in(tmp_path, name, way):
    (tmp_path / name).write_bytes(b"\0\1")
    with pytest.raises(UnreadableAsset, match=way):
        load_asset(tmp_path / name)


def test_a_folder_of_models_names_the_pattern_that_gives_all(tmp_path):
    for name in ("a/m.glb", "b/m.glb"):
        (tmp_path / name).parent.mkdir()
        (tmp_path / name).touch()
    with pytest.raises(UnreadableAsset, match=r"2 \.glb files \(a/m\.glb, b/m\.glb\): .*/\*$"):
        load_asset(tmp_path)
    (tmp_path / "c.glb").touch()
    (tmp_path / "d.glb").touch()
    with pytest.raises(UnreadableAsset, match=r"\(c\.glb, d\.glb\): .*/\*\.glb$"):
        load_asset(tmp_path)


def test_one_piece_is_told_how_it_is_divided(tmp_path):
    trimesh.creation.box().export(tmp_path / "welded.stl")
    with pytest.raises(UnsegmentedAsset, match="By Loose Parts"):
        load_asset(tmp_path / "welded.stl")


def test_limits_are_named(tmp_path):
    path = write_grouped_obj(tmp_path / "c.obj")
    with pytest.raises(AssetTooLarge, match="11 parts: at most 10"):
        load_asset(path, LoadOptions(limits=Limits(max_parts=10)))
    with pytest.raises(AssetTooLarge, match="at most 100 are read"):
        load_asset(path, LoadOptions(limits=Limits(max_faces=100)))
    with pytest.raises(AssetTooLarge, match="MiB"):
        load_asset(path, LoadOptions(limits=Limits(max_bytes=100)))


def test_more_groups_than_the_limit_are_refused(tmp_path):
    text = TRIANGLE.partition("f")[0] + "".join(f"g part_{i}\nf 1 2 3\n" for i in range(5_001))
    (tmp_path / "many.obj").write_text(text)
    with pytest.raises(AssetTooLarge, match="5,001 parts: at most 5,000"):
        load_asset(tmp_path / "many.obj")


@pytest.mark.parametrize(
    "options", [{"up": "north"}, {"front": "+W"}, {"up": "+Z", "front": "-Z"}, {"scale": 0.0}, {"height": -1.0}]
)
def test_options_that_mean_nothing_are_refused(options):
    with pytest.raises(AssetError, match="--"):
        LoadOptions(**options)


def test_open_shells_doubled_faces_and_turned_normals_are_kept(tmp_path):
    folder = write_obj_folder(tmp_path / "m")
    open_box = trimesh.creation.box((0.7, 0.3, 0.02))
    open_box.apply_translation((0, 0, 0.3))
    faces = np.vstack([open_box.faces[:8], open_box.faces[:8, ::-1], open_box.faces[:4]])
    rows = [f"v {x} {y} {z}" for x, y, z in open_box.vertices] + [f"f {a} {b} {c}" for a, b, c in faces + 1]
    (folder / "shelf-20.obj").write_text("\n".join(rows))
    assert len(load_asset(folder).part("shelf_20").mesh.faces) == 20


@pytest.mark.parametrize("number", ["1e300", "nan", "1e400"])
def test_numpy_does_not_warn_of_numbers_that_damage_made(tmp_path, number):
    text = "".join(f"vertex {number} {number} {k}\nvertex {k} 0 -{number}\nvertex 0 {k} 0\n" for k in range(2))
    facets = f"facet normal 0 0 1\nouter loop\n{text}endloop\nendfacet\n"
    (tmp_path / "a.stl").write_text(f"solid x\n{facets}endsolid x\n")
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        with pytest.raises(UnreadableAsset, match="finite coordinates"):
            load_asset(tmp_path / "a.stl")
    assert not heard


def test_what_a_library_logs_of_a_damaged_file_is_not_printed(tmp_path):
    vertices = "".join(f"vertex {k} {k % 2} 0\n" for k in range(3))
    text = f"solid x\nfacet normal 0 zero 1\nouter loop\n{vertices}endloop\nendfacet\nendsolid x\n"
    (tmp_path / "a.stl").write_text(text)
    code = "import sys, pathlib, grafu.asset.load; grafu.asset.load.load_asset(pathlib.Path(sys.argv[1]))"
    command = [sys.executable, "-c", code, str(tmp_path / "a.stl")]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.stderr.count("Traceback") == 1  # that of our own exception alone
    assert "UnsegmentedAsset" in run.stderr


def test_xacro_is_no_urdf_yet(tmp_path):
    (tmp_path / "a.urdf.xacro").write_text('<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="a"/>')
    with pytest.raises(UnreadableAsset, match=r"xacro FILE\.xacro > FILE\.urdf"):
        load_asset(tmp_path / "a.urdf.xacro")
