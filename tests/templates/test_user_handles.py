"""Handles of the user's own, made from built-in ones: exported in millimetres, Y up, shifted, and read back."""

import numpy as np
import pytest

from grafu.errors import TemplateError
from grafu.geometry.mesh import merge_meshes
from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES, handle_template
from grafu.templates.user import load_gallery
from grafu.templates.user_handles import load_handle, load_handles
from own_templates import R, write_handle


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
