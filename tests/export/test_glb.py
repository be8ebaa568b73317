from dataclasses import replace

import numpy as np
import pytest
from glb_reader import Glb
from gltf_validation import issues_of
from small_cabinet import GLASS, STEEL, WOOD, png

from grafu.articulation.articulated_object import ArticulatedObject, Link, Visual
from grafu.articulation.sweep import cycle_tracks, values_at
from grafu.export.glb import DEFAULT_GLB_CONFIG, GlbConfig, export_glb, export_merged_glb
from grafu.geometry.appearance import Material, Texture
from grafu.geometry.mesh import TriangleMesh
from grafu.geometry.transform import from_rotation, rotation_matrix, transform_points


def read(articulated: ArticulatedObject, config: GlbConfig = DEFAULT_GLB_CONFIG) -> Glb:
    return Glb.parse(export_glb(articulated, config)["model.glb"])


def posed_triangles(file: Glb, visual: str, link: str, time: float) -> np.ndarray:
    """The triangles of a node, object frame, with the link's own channel applied at a key time."""
    animation = file.tables["animations"][0]
    node = file.node(f"{link}_link")
    (channel,) = [c for c in animation["channels"] if file.tables["nodes"][c["target"]["node"]] is node]
    sampler = animation["samplers"][channel["sampler"]]
    times, values = file.array(sampler["input"])[:, 0], file.array(sampler["output"]).astype(float)
    value = values[int(np.argmin(np.abs(times - time)))]
    origin = np.array(node["translation"])
    if channel["target"]["path"] == "rotation":
        angle = 2 * np.arctan2(np.linalg.norm(value[:3]), value[3])
        motion = from_rotation(rotation_matrix(value[:3] / max(np.linalg.norm(value[:3]), 1e-12), float(angle)))
        motion[:3, 3] = origin - motion[:3, :3] @ origin
    else:
        motion = from_rotation(np.eye(3), value - origin)
    rest = file.triangles(visual)
    up = np.stack([rest[..., 0], rest[..., 2], -rest[..., 1]], axis=-1)
    moved = transform_points(motion, up.reshape(-1, 3)).reshape(up.shape)
    return np.stack([moved[..., 0], -moved[..., 2], moved[..., 1]], axis=-1)


def test_the_official_validator_finds_nothing(cabinet, tmp_path):
    issues = issues_of(export_glb(cabinet)["model.glb"], tmp_path)

    assert (issues["numErrors"], issues["numWarnings"], issues["numInfos"]) == (0, 0, 0), issues["messages"]


def test_every_part_reads_back_in_place(cabinet):
    file = read(cabinet)

    for link in cabinet.links:
        for visual in link.visuals:
            assert np.allclose(file.triangles(visual.name), visual.mesh.triangles, atol=1e-6), visual.name


def test_node_names_are_unique(cabinet):
    names = [node["name"] for node in read(cabinet).tables["nodes"]]

    assert len(names) == len(set(names)) == 12


def test_materials_read_back_and_each_image_is_written_once(cabinet):
    file = read(cabinet)

    assert [m["name"] for m in file.tables["materials"]] == ["oak", "white paint", "glass", "steel"]
    assert file.material("door_1", 1)["alphaMode"] == "BLEND"
    assert file.material("door_1", 1)["pbrMetallicRoughness"]["baseColorFactor"] == list(GLASS.base_color)
    assert file.material("handle_1")["doubleSided"] is True
    assert file.material("handle_1")["pbrMetallicRoughness"]["metallicFactor"] == STEEL.metallic
    assert len(file.tables["images"]) == 1
    assert file.view(file.tables["images"][0]["bufferView"]) == WOOD.base_color_texture.data


def test_texture_coordinates_are_flipped(make_cube):
    uv = np.linspace(0, 1, 16).reshape(8, 2)
    file = read(make_cube(material=WOOD, uv=uv))

    written = file.array(file.primitives("cube")[0]["attributes"]["TEXCOORD_0"])

    assert {tuple(row) for row in np.round(written, 5)} == {
        tuple(row) for row in np.round(uv * [1, -1] + [0, 1], 5).astype("f4")
    }


def test_joints_read_back_from_the_extras(cabinet):
    extras = read(cabinet).node("drawer_1_link")["extras"]["grafu"]

    assert extras["joint"] == {
        "id": "drawer_1_rail",
        "type": "prismatic",
        "axis": [0.0, 0.0, 1.0],  # glTF's front
        "lower": 0.0,
        "upper": 0.28,
        "after": ["door_1_hinge"],
    }


@pytest.mark.parametrize(("link", "joint"), [("door_1", "door_1_hinge"), ("drawer_1", "drawer_1_rail")])
def test_the_animation_moves_parts_as_the_joints_do(cabinet, link, joint):
    file, tracks = read(cabinet), cycle_tracks(cabinet)
    motion = cabinet.joint_of[link].motion
    (track,) = [t for t in tracks if t.joint == joint]

    for time in track.times[::5]:
        pose = motion(values_at(tracks, float(time))[joint])
        expected = transform_points(pose, cabinet.link(link).visuals[0].mesh.vertices)
        moved = posed_triangles(file, link, link, float(time)).reshape(-1, 3)
        assert np.allclose(moved.min(axis=0), expected.min(axis=0), atol=2e-6)
        assert np.allclose(moved.max(axis=0), expected.max(axis=0), atol=2e-6)


def test_quaternions_never_flip_between_keys(cabinet):
    file = read(cabinet)
    sampler = file.tables["animations"][0]["samplers"][0]
    q = file.array(sampler["output"])

    assert q.shape[1] == 4
    assert np.all(np.einsum("nd,nd->n", q[1:], q[:-1]) > 0.9)


def test_one_animation_opens_everything_and_one_each_joint(cabinet):
    animations = read(cabinet).tables["animations"]

    assert [animation["name"] for animation in animations] == [
        "open_close",
        "open_door_1_hinge",
        "open_drawer_1_rail",
    ]
    assert [len(animation["channels"]) for animation in animations] == [2, 1, 1]


@pytest.mark.parametrize(
    ("place", "link", "path"), [(1, "door_1_link", "rotation"), (2, "drawer_1_link", "translation")]
)
def test_the_clip_of_a_joint_opens_it_alone_from_closed_to_open(cabinet, place, link, path):
    file = read(cabinet)
    animation = file.tables["animations"][place]
    (channel,) = animation["channels"]
    sampler = animation["samplers"][channel["sampler"]]
    times, values = file.array(sampler["input"]).ravel(), file.array(sampler["output"])

    assert file.tables["nodes"][channel["target"]["node"]]["name"] == link
    assert channel["target"]["path"] == path
    assert (times[0], times[-1]) == (0.0, 1.5)
    if path == "translation":
        assert np.allclose(values[-1] - values[0], [0, 0, 0.28], atol=1e-6)
    else:
        assert np.allclose(values[0], [0, 0, 0, 1], atol=1e-6)
        assert 2 * np.arccos(values[-1][3]) == pytest.approx(1.75, abs=1e-4)


def test_a_click_plays_the_clip_of_its_joint_after_those_before_it(cabinet):
    file = read(cabinet)

    assert file.node("door_1_link")["extras"]["grafu"]["on_click"] == {
        "play": "open_door_1_hinge",
        "toggle": True,
        "after": [],
    }
    assert file.node("drawer_1_link")["extras"]["grafu"]["on_click"]["after"] == ["open_door_1_hinge"]
    assert "on_click" not in file.node("body_link")["extras"]["grafu"]
    bare = read(cabinet, GlbConfig(animate=False))
    assert "on_click" not in bare.node("door_1_link")["extras"]["grafu"]


def test_a_static_object_has_no_animation(make_cube):
    assert "animations" not in read(make_cube()).tables


def test_animation_can_be_left_out(cabinet):
    assert "animations" not in read(cabinet, GlbConfig(animate=False)).tables


def test_an_object_without_parts_is_a_valid_file(tmp_path):
    empty = ArticulatedObject("empty", "body", (Link("body", ()),))

    assert issues_of(export_glb(empty)["model.glb"], tmp_path)["numErrors"] == 0


def test_the_same_object_gives_the_same_bytes(cabinet):
    assert export_glb(cabinet)["model.glb"] == export_glb(replace(cabinet))["model.glb"]


def test_disordered_surfaces_pass_the_validator(make_cube, sheet, tmp_path):
    odd = Texture("ünïcode", png((1, 2, 3)), "image/png")
    wild = Material("mask", (2.0, -1.0, 0.5, 1.0), base_color_texture=odd, alpha_mode="MASK", emissive=(3.0, 0.0, 0.0))
    colors = np.full((4, 4), 128, np.uint8)
    uv = np.array([[0.0, 0], [np.nan, 0], [1, np.inf], [0, 1]])
    cube = make_cube(mesh=sheet, material=wild, uv=uv, normals=np.zeros((4, 3)), colors=colors)

    issues = issues_of(export_glb(cube)["model.glb"], tmp_path)

    assert (issues["numErrors"], issues["numWarnings"]) == (0, 0), issues["messages"]


def test_textures_without_coordinates_are_left_out(make_cube, tmp_path):
    data = export_glb(make_cube(material=WOOD))["model.glb"]

    assert issues_of(data, tmp_path)["numErrors"] == 0
    assert "images" not in Glb.parse(data).tables


def test_large_meshes_use_wide_indices(make_cube, tmp_path):
    n = 150
    x, y = np.meshgrid(np.arange(n, dtype=float), np.arange(n, dtype=float))
    height = np.random.default_rng(0).uniform(0, 9, (n, n))  # steep: every face keeps its own corners
    k = np.arange(n * (n - 1)).reshape(n - 1, n)[:, :-1].ravel()
    rough = TriangleMesh(
        np.c_[x.ravel(), y.ravel(), height.ravel()], np.vstack([np.c_[k, k + 1, k + n], np.c_[k + 1, k + n + 1, k + n]])
    )
    data = export_glb(make_cube(mesh=rough))["model.glb"]

    file = Glb.parse(data)

    assert file.tables["accessors"][file.primitives("cube")[0]["indices"]]["componentType"] == 5125
    assert np.allclose(file.triangles("cube"), rough.triangles, atol=1e-4)
    assert issues_of(data, tmp_path)["numErrors"] == 0


def test_links_and_parts_of_one_name_stay_apart(make_cube):
    cube = make_cube()
    named = Visual("body_link", cube.link("body").visuals[0].surfaces)

    names = [node["name"] for node in read(ArticulatedObject("o", "body", (Link("body", (named,)),))).tables["nodes"]]

    assert names == ["body_link_2", "body_link"]


def test_times_must_be_positive():
    with pytest.raises(ValueError, match="positive seconds"):
        GlbConfig(pause=0.0)


def test_a_merged_file_draws_each_link_with_one_primitive_per_material(cabinet, tmp_path):
    data = export_merged_glb(cabinet)["model_merged.glb"]
    file, whole = Glb.parse(data), read(cabinet)
    meshes = {mesh["name"]: len(mesh["primitives"]) for mesh in file.tables["meshes"]}

    assert meshes == {"body_parts": 2, "door_1_parts": 3, "drawer_1_parts": 1}
    assert file.tables["animations"][0]["name"] == "open_close"
    assert issues_of(data, tmp_path)["numErrors"] == 0
    for link in cabinet.links:
        parts = np.vstack([whole.triangles(visual.name) for visual in link.visuals]).reshape(-1, 3)
        merged = file.triangles(f"{link.id}_parts").reshape(-1, 3)
        assert len(merged) == len(parts)
        assert np.allclose(np.sort(merged, axis=0), np.sort(parts, axis=0), atol=1e-6)


def test_surfaces_with_and_without_coordinates_are_not_merged(make_cube):
    (visual,) = make_cube(material=WOOD).link("body").visuals
    plain = visual.surfaces[0]
    laid = replace(plain, uv=plain.mesh.vertices[:, :2])
    both = ArticulatedObject("o", "body", (Link("body", (Visual("a", (plain,)), Visual("b", (laid,)))),))

    mesh = Glb.parse(export_merged_glb(both)["model_merged.glb"]).tables["meshes"][0]

    assert ["TEXCOORD_0" in primitive["attributes"] for primitive in mesh["primitives"]] == [False, True]
