"""User templates, made from built-in ones: exported in millimetres, Y up, and read back."""

import numpy as np
import pytest

from grafu.errors import TemplateError
from grafu.geometry.mesh import merge_meshes
from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES, handle_template
from grafu.templates.template import HingeSize, RailSize
from grafu.templates.user import load_gallery, load_handle, load_handles, load_template
from own_templates import R, way, write, write_handle

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


@pytest.mark.parametrize("template", HANDLES, ids=lambda t: t.id)
def test_a_built_in_handle_survives_the_way_through_files(template, tmp_path):
    write_handle(tmp_path, template)
    (read,) = load_handles(tmp_path).values()
    assert (read.id, read.title, read.family, read.turns) == ("mine", "Mine", template.family, template.turns)
    assert read.longest == pytest.approx(template.longest)
    np.testing.assert_allclose(read.natural.length, template.natural.length, rtol=1e-4)
    np.testing.assert_allclose(read.natural.protrusion, template.natural.protrusion, rtol=1e-4)
    box = merge_meshes(read.build()).box
    np.testing.assert_allclose(box.size, merge_meshes(template.build()).box.size, atol=2e-6)
    np.testing.assert_allclose(box.center[[0, 2]], 0.0, atol=2e-6)
    assert abs(box.high[1]) < 2e-6


@pytest.mark.parametrize("suffix", ["obj", "stl", "ply", "glb"])
def test_a_handle_is_read_from_each_kind_of_file(suffix, tmp_path):
    read = load_handle(write_handle(tmp_path, handle_template("bar-round"), suffix))
    assert len(merge_meshes(read.build()).faces) > 20


def test_bars_are_stretched_along_and_knobs_both_ways(tmp_path):
    bar = load_handle(write_handle(tmp_path, handle_template("bar-round"), name="bar"))
    knob = load_handle(write_handle(tmp_path, handle_template("knob-round"), name="knob"))
    long, wide = merge_meshes(bar.build(0.4, 0.02)).box.size, merge_meshes(knob.build(0.06, 0.02)).box.size
    np.testing.assert_allclose(long[:2], (0.4, 0.02), rtol=1e-4)
    np.testing.assert_allclose(long[2], merge_meshes(bar.build()).box.size[2], rtol=1e-4)
    np.testing.assert_allclose(wide, (0.06, 0.02, 0.06), rtol=1e-3)


def test_handles_and_mechanisms_share_a_folder(tmp_path):
    write_handle(tmp_path, handle_template("bar-round"))
    assert load_gallery(tmp_path).hinges == ()
    assert builtin_gallery().extended(load_gallery(tmp_path)).hinges == builtin_gallery().hinges
    (tmp_path / "hinge").mkdir()
    (tmp_path / "hinge" / "template.json").write_text('{"kind": "hinge"}')
    assert set(load_handles(tmp_path)) == {"mine"}
    with pytest.raises(TemplateError, match="hinge"):
        load_gallery(tmp_path)


BAD = [
    ({"family": "rope"}, "family"),
    ({"outwards": None}, "outwards"),
    ({"unit": 0}, "unit"),
    ({"colour": "red"}, "colour"),
    ({"along": [0, 0, 0]}, "`along` must be a direction"),
    ({"along": (R @ (1, -1, 0)).tolist()}, "`along` must be square"),
    ({"outwards": (R @ (0, 1, 0)).tolist()}, "`outwards` must point"),
    ({"foot": [5, 40, 10]}, "`foot` must be a point"),
    ({"longest": 10}, "`longest`"),
]


@pytest.mark.parametrize(("changes", "words"), BAD)
def test_what_is_wrong_is_said_in_one_line_with_the_folder(changes, words, tmp_path):
    folder = write_handle(tmp_path, handle_template("bar-round"), **changes)
    with pytest.raises(TemplateError) as caught:
        load_handle(folder)
    text = str(caught.value)
    assert words in text
    assert str(folder) in text
    assert "\n" not in text


def test_a_missing_or_empty_mesh_is_an_error(tmp_path):
    folder = write_handle(tmp_path, handle_template("bar-round"))
    (folder / "handle.obj").unlink()
    with pytest.raises(TemplateError, match="lacks its mesh"):
        load_handle(folder)
    (folder / "handle.obj").write_text("v 0 0 0\n")
    with pytest.raises(TemplateError, match=str(folder)):
        load_handle(folder)


def test_a_folder_that_is_not_there_is_an_error(tmp_path):
    with pytest.raises(TemplateError, match="is not a folder"):
        load_handles(tmp_path / "absent")
    assert load_handles(tmp_path) == {}


def test_damaged_files_of_other_kinds_are_none_of_ours(tmp_path):
    (tmp_path / "torn").mkdir()
    (tmp_path / "torn" / "template.json").write_bytes(b'{"kind": "handle"\xff')
    assert load_handles(tmp_path) == {}
