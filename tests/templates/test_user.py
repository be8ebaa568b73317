"""User templates, made from built-in ones: exported in millimetres, Y up, and read back."""

import numpy as np
import pytest

from grafu.errors import TemplateError
from grafu.templates.gallery import builtin_gallery
from grafu.templates.template import HingeSize, RailSize
from grafu.templates.user import load_gallery, load_template
from own_templates import way, write

HINGES, RAILS = builtin_gallery().hinges, builtin_gallery().rails


@pytest.mark.parametrize("model", [*HINGES, *RAILS], ids=lambda m: m.id)
def test_a_built_in_template_survives_the_way_through_files(model, tmp_path):
    write(tmp_path, model)
    gallery = load_gallery(tmp_path)
    read, original = (gallery.hinges + gallery.rails)[0], model.build(model.natural)
    again = read.build(model.natural)
    assert (read.id, read.title, read.mechanism) == ("mine", "Mine", model.mechanism)
    for end in ("static", "dynamic"):
        a, b = getattr(again, end), getattr(original, end)
        np.testing.assert_allclose(a.mesh.box.low, b.mesh.box.low, atol=2e-6)
        np.testing.assert_allclose(a.mesh.box.high, b.mesh.box.high, atol=2e-6)
        np.testing.assert_allclose(a.snap.center, b.snap.center, atol=2e-6)
        np.testing.assert_array_equal(a.snap.normal, b.snap.normal)


@pytest.mark.parametrize("suffix", ["obj", "stl", "glb", "one.glb"])
def test_ends_are_read_from_each_kind_of_file(suffix, tmp_path):
    model = load_template(write(tmp_path, HINGES[0], suffix))
    box = model.build(HINGES[0].natural).dynamic.mesh.box
    np.testing.assert_allclose(box.low, HINGES[0].build(HINGES[0].natural).dynamic.mesh.box.low, atol=2e-6)


def test_a_hinge_keeps_its_barrel_round_and_within_the_size(tmp_path):
    model, n = load_template(write(tmp_path, HINGES[0])), HINGES[0].natural
    asked = HingeSize(2 * n.length, n.leaf / 2, n.thickness, n.radius)
    built = model.build(asked)
    found = (built.size.length, built.size.leaf, built.size.thickness, built.size.radius)
    assert found == pytest.approx((2 * n.length, n.leaf / 2, n.thickness / 2, n.radius / 2))
    assert built.static.snap.center[0] == pytest.approx(-built.size.thickness)
    np.testing.assert_allclose(built.static.mesh.box.high[:2], built.size.radius, rtol=1e-3)
    assert built.static.mesh.box.size[2] == pytest.approx(asked.length, rel=1e-3)


def test_a_rail_is_stretched_to_the_size(tmp_path):
    built = load_template(write(tmp_path, RAILS[0])).build(RailSize(0.3, 0.03, 0.02))
    np.testing.assert_allclose(built.static.mesh.box.union(built.dynamic.mesh.box).size, [0.02, 0.3, 0.03], rtol=1e-4)
    assert built.range == pytest.approx(0.24)


def test_user_templates_come_first(tmp_path):
    write(tmp_path, HINGES[0])
    assert builtin_gallery().extended(load_gallery(tmp_path)).hinges[0].id == "mine"


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"class": "Q"}, "class: Input should be 'C', 'F' or 'P'"),
        ({"kind": "drawer"}, "the file: .*'hinge', 'rail'"),
        ({"radius": None}, "radius: Field required"),
        ({"colour": "red"}, "colour: Extra inputs are not permitted"),
        ({"length": -3}, "length: Input should be greater than 0"),
        ({"range_deg": 400}, "range_deg: Input should be less than 360"),
        ({"opening": way([0, 0, 1])}, "`opening` must be square"),
        ({"opening": way([0, -1, 0])}, r"`static_snap.normal` must be \[-1, 0, 0\]"),
        ({"opening": [0, 0, 0]}, "`opening` must be a direction"),
        ({"length": 100}, "`length` must agree with the meshes"),
        ({"thickness": 5}, "`thickness` must agree with static_snap"),
        ({"leaf": 3}, "`leaf` must exceed `radius`"),
    ],
)
def test_a_wrong_annotation_is_refused_in_one_line(changes, said, tmp_path):
    folder = write(tmp_path, HINGES[0], **changes)
    with pytest.raises(TemplateError, match=said) as caught:
        load_template(folder)
    assert "\n" not in str(caught.value)
    assert "mine" in str(caught.value)


def test_a_corner_mount_without_support_is_refused(tmp_path):
    with pytest.raises(TemplateError, match="`support_snap` must be given for class corner-mount"):
        load_template(write(tmp_path, RAILS[1], support_snap=None))


def test_a_missing_end_is_named(tmp_path):
    folder = write(tmp_path, HINGES[0])
    (folder / "dynamic.ply").unlink()
    with pytest.raises(TemplateError, match=r"lacks its dynamic end: expected dynamic\.obj"):
        load_template(folder)


def test_a_damaged_mesh_is_a_template_error(tmp_path):
    folder = write(tmp_path, HINGES[0])
    (folder / "static.ply").write_bytes(b"ply\nnonsense")
    with pytest.raises(TemplateError, match=r"static\.ply"):
        load_template(folder)


def test_broken_json_says_where(tmp_path):
    folder = write(tmp_path, HINGES[0])
    (folder / "template.json").write_text('{"kind": ')
    with pytest.raises(TemplateError, match=r"template\.json: the file: .*JSON"):
        load_template(folder)


def test_a_folder_without_templates_is_refused(tmp_path):
    with pytest.raises(TemplateError, match="holds no template"):
        load_gallery(tmp_path)
    with pytest.raises(TemplateError, match="is not a folder"):
        load_gallery(tmp_path / "absent")
