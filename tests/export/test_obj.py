import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from obj_reader import parse_mtl, parse_obj
from small_cabinet import GLASS, WOOD, board, door_link, png

from grafu.articulation.articulated_object import Visual
from grafu.export.obj import ObjFolder
from grafu.geometry.appearance import Material, Surface, Texture
from grafu.geometry.arrays import vec3
from grafu.geometry.mesh import TriangleMesh

ORIGIN = vec3(-0.3, -0.22, 0.4)


@pytest.fixture
def folder() -> ObjFolder:
    return ObjFolder(0.5)


def read(folder: ObjFolder, name: str):
    return parse_obj(folder.files[name].decode())


def test_a_visual_of_two_materials_reads_back(folder):
    door = door_link().visuals[0]

    made = read(folder, folder.add_visual(door, ORIGIN))

    assert np.allclose(made.triangles + ORIGIN, door.mesh.triangles, atol=1e-7)
    assert made.materials == ["oak"] * 12 + ["glass"] * 12
    assert np.allclose(made.normals, door.mesh.face_normals[:, None])


def test_texture_coordinates_read_back(folder):
    wooden = Visual("panel", (door_link().visuals[0].surfaces[0],))

    made = read(folder, folder.add_visual(wooden, ORIGIN))

    surface = wooden.surfaces[0]
    assert np.allclose(made.uv, surface.uv[surface.mesh.faces], atol=1e-7)


def test_materials_and_images_are_beside_the_mesh(folder):
    name = folder.add_visual(door_link().visuals[0], ORIGIN)

    materials = parse_mtl(folder.files[read(folder, name).mtllib].decode())

    assert [float(v) for v in materials["glass"]["Kd"]] == list(GLASS.base_color[:3])
    assert materials["glass"]["d"] == ["0.3"]
    assert folder.files[materials["oak"]["map_Kd"][0]] == WOOD.base_color_texture.data


def test_one_image_is_one_file(folder):
    for name in ("a", "b"):
        folder.add_visual(Visual(name, door_link().visuals[0].surfaces), ORIGIN)

    assert [name for name in folder.files if name.endswith(".png")] == ["textures/oak.png"]


def test_two_images_of_one_name_are_two_files(folder):
    mesh = board(0, 0, 0, 1, 1, 1)
    looks = [Material("m", base_color_texture=Texture("Oak 1.png", png((k, 0, 0)), "image/png")) for k in (1, 2)]
    surfaces = tuple(Surface(mesh, look, uv=np.zeros((8, 2))) for look in looks)

    made = read(folder, folder.add_visual(Visual("a", surfaces), ORIGIN))

    materials = parse_mtl(folder.files[made.mtllib].decode())
    assert set(made.materials) == set(materials) == {"m", "m_2"}
    assert materials["m"]["map_Kd"] == ["textures/Oak_1.png"]
    assert materials["m_2"]["map_Kd"] == ["textures/Oak_1_2.png"]


def test_names_are_safe_and_apart_on_any_disk(folder):
    mesh = (Surface(board(0, 0, 0, 1, 1, 1)),)

    names = [folder.add_visual(Visual(name, mesh), ORIGIN) for name in ("Door/1", "door_1", "../door 1", "…")]

    assert names == ["Door_1.obj", "door_1_2.obj", "_door_1.obj", "_.obj"]


def test_no_file_is_called_as_a_device_of_windows(folder):
    mesh = board(0, 0, 0, 1, 1, 1)
    look = Material("nul", base_color_texture=Texture("aux.png", png((1, 0, 0)), "image/png"))

    names = [folder.add_visual(Visual(n, (Surface(mesh, look, uv=np.zeros((8, 2))),)), ORIGIN) for n in ("CON", "con")]
    names.append(folder.add_mesh("com1", mesh, ORIGIN))

    assert names == ["_CON.obj", "_con_2.obj", "_com1.obj"]
    assert set(folder.files) == {*names, "_CON.mtl", "_con_2.mtl", "textures/_aux.png"}


def test_vertex_colours_are_kept(folder):
    colors = np.tile(np.array([255, 0, 51, 255], np.uint8), (8, 1))

    name = folder.add_visual(Visual("a", (Surface(board(0, 0, 0, 1, 1, 1), colors=colors),)), ORIGIN)

    assert folder.files[name].decode().count(" 1 0 0.2\n") == 8


@given(st.integers(1, 40), st.integers(0, 2**32 - 1))
def test_rows_are_written_once_and_faces_still_find_them(count, seed):
    random = np.random.default_rng(seed)
    corners = random.integers(-4, 5, (3 * count, 3)) / 8  # binary fractions: the bits that tell them apart are few
    mesh = TriangleMesh(corners, np.arange(3 * count).reshape(-1, 3))
    surface = Surface(mesh, uv=random.integers(0, 5, (3 * count, 2)) / 4)
    folder = ObjFolder(0.5)

    name = folder.add_visual(Visual("soup", (surface,)), vec3(0.0, 0.0, 0.0))

    made, lines = read(folder, name), folder.files[name].decode().splitlines()
    assert np.array_equal(made.triangles, mesh.triangles)
    assert np.array_equal(made.uv, surface.uv[mesh.faces])
    rows = [line for line in lines if line.startswith("v")]
    assert len(rows) == len(set(rows))
