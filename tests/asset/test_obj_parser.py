import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.mesh_files import read_mesh_file
from grafu.asset.obj_parser import parse_obj
from grafu.asset.resources import ModelFiles
from small_assets import png_bytes

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"


def surface(tmp_path, text):
    (tmp_path / "a.obj").write_text(text)
    (found,) = read_mesh_file(tmp_path / "a.obj", ModelFiles(tmp_path)).surfaces
    return found


@pytest.mark.parametrize(
    "face",
    [
        "f 1 2 3 4",
        "f 1/1 2/2 3/3 4/4",
        "f 1//1 2//1 3//1 4//1",
        "f 1/1/1 2/2/1 3/3/1 4/4/1",
        "f -4 -3 -2 -1",
        "f -4/-4/-1 -3/-3/-1 -2/-2/-1 -1/-1/-1",
        "f 1/ 2/ 3/ 4/",
        "f  1   2 3 4 ",
        "f 1 2 \\\n 3 4",
        "f 1 2 3\nf 1/1/1 3/3/1 4/4/1",
        "  f 1 2 3 4",
    ],
)
def test_every_spelling_of_a_square_is_the_same_square(tmp_path, face):
    found = surface(tmp_path, SQUARE + face + "\n")
    assert found.mesh.area == pytest.approx(1.0)
    np.testing.assert_allclose(found.mesh.face_normals, [[0, 0, 1], [0, 0, 1]])


def test_texture_coordinates_and_normals_stay_with_their_corner(tmp_path):
    found = surface(tmp_path, SQUARE + "f 1/1/1 2/2/1 3/3/1 4/4/1\n")
    np.testing.assert_allclose(found.uv, found.mesh.vertices[:, :2])
    np.testing.assert_allclose(found.normals, [[0, 0, 1]] * 4)


def test_a_vertex_splits_where_texture_coordinates_differ(tmp_path):
    found = surface(tmp_path, SQUARE + "f 1/1 2/2 3/3\nf 1/2 3/3 4/4\n")
    assert len(found.mesh.vertices) == 5


def test_concave_polygons_keep_their_area(tmp_path):
    points = [(0, 0), (4, 0), (4, 1), (1, 1), (1, 3), (4, 3), (4, 4), (0, 4)]  # a C
    text = "".join(f"v {x} {y} 2\n" for x, y in points) + "f " + " ".join(map(str, range(1, 9)))
    found = surface(tmp_path, text)
    assert found.mesh.area == pytest.approx(10.0)
    assert (found.mesh.face_normals[:, 2] > 0.99).all()


def test_vertex_colours_are_read(tmp_path):
    found = surface(tmp_path, "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n")
    np.testing.assert_array_equal(found.colors, [[255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]])


def test_materials_and_textures_come_from_the_library(tmp_path):
    image = png_bytes(3, 2)
    (tmp_path / "oak wood.png").write_bytes(image)
    (tmp_path / "m.mtl").write_text("newmtl wood\nKd 1 0.5 0\nd 0.5\nmap_Kd oak wood.png\nnewmtl b\nmap_Kd no.png\n")
    (tmp_path / "a.obj").write_text("mtllib m.mtl\n" + SQUARE + "usemtl wood\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 3/3 4/4\n")
    found = read_mesh_file(tmp_path / "a.obj", ModelFiles(tmp_path))
    wood = found.surfaces[0].material
    assert wood.base_color_texture is not None
    assert wood.base_color_texture.data == image
    assert wood.base_color == (1.0, pytest.approx(0.214, abs=1e-3), 0.0, 0.5)
    assert (wood.alpha_mode, len(found.surfaces)) == ("BLEND", 2)
    assert "texture no.png is missing and was left out" in found.notes


def test_groups_and_objects_are_told_apart(tmp_path):
    text = SQUARE + "o A\ng one\nf 1 2 3\ng two\nf 1 3 4\no B\ng one\nf 1 2 4\n"
    (tmp_path / "a.obj").write_text(text)
    assert [p.name for p in read_mesh_file(tmp_path / "a.obj", ModelFiles(tmp_path)).pieces] == ["A", "B"]
    (tmp_path / "a.obj").write_text(text.replace("o B\n", ""))
    assert [p.name for p in read_mesh_file(tmp_path / "a.obj", ModelFiles(tmp_path)).pieces] == ["one", "two"]


@given(st.lists(st.tuples(*[st.floats(-1e3, 1e3)] * 3), min_size=3, max_size=20), st.data())
def test_what_is_written_is_read(points, data):
    index = st.integers(1, len(points))
    faces = data.draw(st.lists(st.lists(index, min_size=3, max_size=5), min_size=1, max_size=6))
    text = "".join(f"v {x!r} {y!r} {z!r}\n" for x, y, z in points)
    text += "".join("f " + " ".join(map(str, face)) + "\n" for face in faces)
    found = parse_obj(text.encode(), "here")
    np.testing.assert_array_equal(found.vertices, points)
    rows = [found.corners[a:b, 0] + 1 for a, b in zip(found.starts[:-1], found.starts[1:], strict=True)]
    assert [list(r) for r in rows] == faces
