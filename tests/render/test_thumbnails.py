"""Thumbnails of templates: one for each, with something to be seen on it, and files that name what they are of."""

import json

import pytest

from grafu.export.blend.process import unpacked
from grafu.render import thumbnails as module
from grafu.render.thumbnails import TemplateEntry, thumbnails, write_thumbnails
from grafu.templates.gallery import builtin_gallery
from grafu.templates.handles import HANDLES

SMALL = (24, 24)


@pytest.fixture(scope="module")
def drawn():
    return list(thumbnails(SMALL))


def test_every_template_has_one(drawn):
    gallery = builtin_gallery()
    expected = {("hinge", model.id) for model in (*gallery.hinges, *gallery.concealed)}
    expected |= {("rail", model.id) for model in gallery.rails} | {("handle", handle.id) for handle in HANDLES}
    assert {(entry.kind, entry.id) for entry, _, _ in drawn} == expected
    assert len({entry.key for entry, _, _ in drawn}) == len(drawn)


def test_no_picture_is_empty_and_no_two_are_the_same(drawn):
    assert all(picture.shape[:2] == SMALL and picture.max() > picture.min() for _, picture, _ in drawn)
    assert len({picture.tobytes() for _, picture, _ in drawn}) == len(drawn)


def test_hinges_and_rails_move_and_handles_do_not(drawn):
    assert all(bool(made.moving_joints) == (entry.kind != "handle") for entry, _, made in drawn)


def test_files_name_what_they_are_of(tmp_path, drawn, monkeypatch):
    monkeypatch.setattr(module, "thumbnails", lambda: iter(drawn[:2]))
    write_thumbnails(tmp_path)
    entries = json.loads((tmp_path / "templates.json").read_text())["templates"]
    assert [TemplateEntry(one["kind"], one["id"], one["title"], one["about"]) for one in entries] == [
        entry for entry, _, _ in drawn[:2]
    ]
    for one, (_, _, made) in zip(entries, drawn, strict=False):
        assert unpacked((tmp_path / f"{one['key']}.packed").read_bytes()).name == made.name
        assert (tmp_path / f"{one['key']}.png").read_bytes().startswith(b"\x89PNG")
    assert len(list(tmp_path.iterdir())) == 5
