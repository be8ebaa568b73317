"""Each limit is held against the whole model before it is built, and no real piece of furniture meets one."""

import os
import tracemalloc
from pathlib import Path

import pytest

from grafu.asset.load import load_asset
from grafu.asset.options import Limits, LoadOptions
from grafu.errors import AssetError, AssetTooLarge, UnreadableAsset, UnsegmentedAsset
from small_assets import CABINET, glb_bytes, gltf_document, urdf_text, write_grouped_obj, write_pnm, write_urdf

MODELS = Path(os.environ.get("GRAFU_MODELS") or Path(__file__).parents[3] / "shared" / "models")
REAL = sorted(
    path
    for kind in ("pnm", "pnm2", "doors", "other", "wild", "articraft")
    for path in ((MODELS / kind).iterdir() if (MODELS / kind).is_dir() else ())
    if path.is_dir()
)[::3]  # every third: no model has ever met a limit
MEGABYTES = 2**20


def cheaply(path, name, limits=None, most=150 * MEGABYTES):
    """Asserts that a model is refused for what `name` limits, without memory taken for what it claims to hold."""
    tracemalloc.start()
    try:
        with pytest.raises(AssetTooLarge, match=rf"at most [\d,]+ are read; .*--limit {name}=\d+"):
            load_asset(path, LoadOptions(limits=limits or Limits()))
        assert tracemalloc.get_traced_memory()[1] < most
    finally:
        tracemalloc.stop()


def scene(path, change):
    document, binary = gltf_document(list(CABINET))
    change(document)
    path.write_bytes(glb_bytes(document, binary))
    return path


def test_one_primitive_listed_many_times_counts_each_time(tmp_path):
    def list_often(document):
        document["meshes"][0]["primitives"] *= 100_000

    cheaply(scene(tmp_path / "a.glb", list_often), "primitives")


def test_one_mesh_placed_many_times_counts_each_time(tmp_path):
    def place_often(document):
        document["nodes"] = [{"mesh": 0, "name": f"n{k}"} for k in range(3000)]
        document["scenes"] = [{"nodes": list(range(3000))}]

    cheaply(scene(tmp_path / "a.glb", place_often), "faces", Limits(max_faces=12 * 3000 - 1))


@pytest.mark.parametrize("key", ["attributes", "indices", "sparse"])
def test_numbers_without_bytes_behind_them_count(tmp_path, key):
    def claim(document):
        for k, accessor in enumerate(document["accessors"]):
            if (k % 2 == 1) == (key == "indices"):
                accessor.pop("bufferView")
                accessor["count"] = 9_000_000
                if key == "sparse":
                    accessor["sparse"] = {"count": 0, "indices": {}, "values": {}}

    cheaply(scene(tmp_path / "a.glb", claim), "faces" if key == "indices" else "vertices")


def test_a_deep_scene_and_a_broad_one_are_limited(tmp_path):
    def deepen(document):
        document["nodes"] = [{"children": [k + 1]} for k in range(60_000)] + [{"mesh": 0}]
        document["scenes"] = [{"nodes": [0]}]

    def broaden(document):  # a fifth of what is read at most, in a fifth of the memory: counting it takes long
        document["nodes"] = [{} for _ in range(12_000)]
        document["scenes"] = [{"nodes": list(range(12_000))}]

    cheaply(scene(tmp_path / "a.glb", deepen), "depth")
    cheaply(scene(tmp_path / "b.glb", broaden), "nodes", Limits(max_nodes=10_000), 30 * MEGABYTES)


def test_a_polygon_of_very_many_corners_is_refused(tmp_path):
    path = write_grouped_obj(tmp_path / "a.obj")
    path.write_text(path.read_text() + "f " + " ".join(["1", "2", "3"] * 34_000) + "\n")
    cheaply(path, "corners")


def test_lines_groups_and_pieces_of_one_obj_are_limited(tmp_path):
    path = write_grouped_obj(tmp_path / "a.obj")
    for name, limits in [
        ("lines", Limits(max_lines=50)),
        ("groups", Limits(max_groups=10)),
        ("primitives", Limits(max_primitives=10)),
        ("vertices", Limits(max_vertices=87)),
        ("faces", Limits(max_faces=131)),
        ("parts", Limits(max_parts=10)),
    ]:
        cheaply(path, name, limits)


def test_files_of_one_model_are_counted_together(tmp_path):
    folder = write_pnm(tmp_path / "m")
    largest = max(file.stat().st_size for file in folder.rglob("*.*"))
    with pytest.raises(AssetTooLarge, match="--limit bytes="):
        load_asset(folder, LoadOptions(limits=Limits(max_bytes=2 * largest)))
    cheaply(folder, "faces", Limits(max_faces=131))
    cheaply(write_urdf(tmp_path / "r"), "vertices", Limits(max_vertices=87))


def test_a_long_chain_and_a_crowd_of_links_are_limited(tmp_path):
    def joint(k, parent):
        return (
            f'<link name="l{k}"/><joint name="j{k}" type="fixed"><parent link="{parent}"/><child link="l{k}"/></joint>'
        )

    chain = "".join(joint(k, f"l{k - 1}" if k else "carcass") for k in range(1000))
    cheaply(write_urdf(tmp_path / "a", urdf_text(chain)), "depth")
    crowd = "".join(joint(k, "carcass") for k in range(400))
    cheaply(write_urdf(tmp_path / "b", urdf_text(crowd)), "nodes", Limits(max_nodes=400))


BALL = "<visual><geometry><sphere{}</geometry></visual>"
CROWDS = {
    "a.urdf": ('<robot name="a"><link name="l">', BALL.format(' radius="0.1"/>'), "</link></robot>"),
    "a.sdf": (
        '<sdf><model name="m"><link name="l">',
        BALL.format("><radius>0.1</radius></sphere>"),
        "</link></model></sdf>",
    ),
    "a.xml": ("<mujoco><worldbody>", '<geom type="sphere" size="0.1"/>', "</worldbody></mujoco>"),
    "bodies.xml": ("<mujoco><worldbody>", "<body/>", "</worldbody></mujoco>"),
    "copies.xml": (
        "<mujoco><worldbody>",
        '<replicate count="3"><geom type="sphere" size="0.1"/></replicate>',
        "</worldbody></mujoco>",
    ),
}


@pytest.mark.parametrize("name", CROWDS)
def test_the_shapes_of_a_robot_are_counted_before_one_is_made(tmp_path, monkeypatch, name):
    """Nor is MuJoCo asked, whose time grows with the square of what it is given."""
    made = []
    monkeypatch.setattr("grafu.asset.urdf_shapes.ShapeReader.read", lambda *_: made.append("a shape"))
    monkeypatch.setattr("grafu.asset.mjcf._library", lambda *_: made.append("MuJoCo"))
    before, one, after = CROWDS[name]
    (tmp_path / name).write_text(before + one * 4 + after)
    most = 11 if "copies" in name else 3

    with pytest.raises(AssetTooLarge, match=rf"{most + 1} parts: at most {most} are read"):
        load_asset(tmp_path / name, LoadOptions(limits=Limits(max_parts=most)))
    assert made == []


def test_hidden_geoms_are_no_parts(tmp_path):
    pytest.importorskip("mujoco")
    hidden = (
        '<geom type="sphere" size="0.1" group="3"/><geom class="far" size="0.1"/><geom class="collision" size="0.1"/>'
        '<body childclass="near"><geom size="0.1"/></body><geom size="0.1" rgba="1 1 1 0"/>'
    )
    classes = '<default class="far"><geom group="4"/><default class="near"/></default><default class="collision"/>'
    shown = '<geom type="box" size="1 1 1"/><geom class="far" group="0" type="box" size="1 1 2" pos="3 0 0"/>'
    text = f"<mujoco><default>{classes}</default><worldbody>{shown}{hidden}</worldbody></mujoco>"
    (tmp_path / "a.xml").write_text(text)

    assert len(load_asset(tmp_path / "a.xml", LoadOptions(limits=Limits(max_parts=2))).parts) == 2


def test_values_of_json_and_xml_are_limited(tmp_path):
    cheaply(scene(tmp_path / "a.glb", lambda document: document.update(extras=[[]] * 2_000_000)), "values")
    cheaply(write_urdf(tmp_path / "r", urdf_text("<a/>" * 1000)), "values", Limits(max_values=900))


def test_what_is_read_of_an_image_listed_in_many_places_is_kept_once(tmp_path):
    from grafu.asset.resources import ModelFiles
    from small_assets import png_bytes

    files = ModelFiles(tmp_path)
    padded = png_bytes(2, 2) + bytes(MEGABYTES)
    made = [files.image(bytes(padded), f"i{k}") for k in range(50)]
    assert len({id(texture.data) for texture in made}) == 1


@pytest.mark.parametrize("value", [0, -1, True])
def test_a_limit_is_a_whole_number_above_0(value):
    with pytest.raises(AssetError, match="--limit faces must be a whole number"):
        Limits(max_faces=value)


def test_limits_are_named_as_the_command_names_them():
    assert Limits().with_limit("image-pixels", 7).max_image_pixels == 7
    with pytest.raises(AssetError, match="must name one of bytes, parts, faces"):
        Limits().with_limit("face", 7)


@pytest.mark.skipif(not REAL, reason="the development models are not at hand")
@pytest.mark.parametrize("folder", REAL, ids=lambda p: f"{p.parent.name}/{p.name}")
def test_no_real_furniture_meets_a_limit(folder):
    found = [folder] if folder.parent.name != "articraft" else [folder / f"{folder.name}.urdf"]
    for path in found:
        try:
            asset = load_asset(path)
        except (UnsegmentedAsset, UnreadableAsset):  # some are one piece; AssetTooLarge is neither
            continue
        assert not any("limit" in note or "outside" in note for note in asset.notes)
