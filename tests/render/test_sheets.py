"""Contact sheets of `scripts/pictures.py sheets`: every tile is there, poses differ, close-ups show their hardware."""

import sys
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import grafu
from grafu.articulation.articulated_object import VisualRole
from grafu.geometry.appearance import Surface
from grafu.geometry.mesh import TriangleMesh
from grafu.render.picture import box_of
from grafu.synth.cabinets.cabinet import Cabinet, make_cabinet
from grafu.synth.case.case import Case
from grafu.synth.fronts.layout import Door, Drawer, Stack

ROOT = Path(__file__).parent.parent.parent
sys.path.insert(0, str(ROOT / "scripts"))

import pictures  # noqa: E402
import pictures_close_ups  # noqa: E402
import pictures_sheets  # noqa: E402

SAMPLE = ROOT / "samples" / "kitchen_base.glb"
SMALL = pictures_sheets.SheetConfig(tile=(96, 72), font=8)
SIZE = (192, 144)


@pytest.fixture(scope="module")
def result():
    return grafu.functionalize(SAMPLE)


@pytest.fixture(scope="module")
def devices(result):
    return pictures_close_ups.devices_of(result.object)


def pixels_of(picture, colour):
    """Returns how many pixels have the hue of a colour, in whatever light."""
    seen = (picture[..., :3] / 255.0) ** 2.2
    strong = seen.max(axis=-1) - seen.min(axis=-1) > 0.04
    unit = np.array(colour) / np.linalg.norm(colour)
    return int(np.sum(strong & (seen @ unit > 0.93 * np.linalg.norm(seen, axis=-1))))


def shut_in(result):
    """Returns the object with boards all around the hinges of its first door."""
    made, box = result.object, next(v for v in result.object.links[0].visuals if v.role is VisualRole.PART)
    hinge = pictures_close_ups.devices_of(made)[0]
    pose = pictures_close_ups.open_pose(made, hinge.joint)
    found = [v for v in pictures_close_ups.painted_visuals(made, hinge, pose) if v.name in hinge.visuals]
    around = box_of(found).grown(0.005)
    shell = replace(box, name="shell", surfaces=(Surface(TriangleMesh.box_mesh(around)),))
    root = replace(made.link(made.root), visuals=(*made.link(made.root).visuals, shell))
    return replace(made, links=tuple(root if link.id == made.root else link for link in made.links)), hinge


def test_every_hinge_and_rail_is_one_device(result, devices):
    counts = {joint.id: joint.count for joint in result.joints}
    assert {name: sum(d.joint == name for d in devices) for name in counts} == counts
    hardware = {v.name for link in result.object.links for v in link.visuals if v.role is VisualRole.HARDWARE}
    assert set().union(*(d.visuals for d in devices)) == hardware
    assert all(d.fixed and d.moving for d in devices)
    assert devices[0].title == "hinge 1 of 2"
    assert {d.title for d in devices if "drawer" in d.joint} == {"left rail", "right rail"}


def test_a_joint_without_hardware_is_shown_by_what_moves(result):
    made = result.object
    bare = replace(
        made,
        links=tuple(
            replace(link, visuals=tuple(v for v in link.visuals if v.role is not VisualRole.HARDWARE))
            for link in made.links
        ),
    )
    (door, *_) = pictures_close_ups.devices_of(bare)
    assert door.title == "no hardware"
    assert len(pictures_close_ups.devices_of(bare)) == len(made.moving_joints)
    assert pixels_of(pictures_close_ups.close_up(bare, door, SIZE).picture, pictures_close_ups.MOVING_PART) > 800


def test_each_close_up_shows_what_is_fixed_and_what_moves(result, devices):
    for device in devices[:2] + devices[-2:]:
        picture = pictures_close_ups.close_up(result.object, device, SIZE).picture
        assert picture.shape == (*SIZE[::-1], 4)
        assert pixels_of(picture, pictures_close_ups.ON_FIXED) > 20
        assert pixels_of(picture, pictures_close_ups.ON_MOVING) > 20


def test_a_hinge_in_the_open_is_not_seen_through_anything(result, devices):
    assert not pictures_close_ups.close_up(result.object, devices[0], SIZE).is_through


def test_hardware_that_is_shut_in_is_seen_through_what_hides_it(result):
    hidden, hinge = shut_in(result)
    found = pictures_close_ups.close_up(hidden, hinge, SIZE)
    assert found.is_through
    assert pixels_of(found.picture, pictures_close_ups.ON_MOVING) > 20


def test_views_differ_from_pose_to_pose(result):
    tiles = pictures_sheets.view_tiles(result, SMALL)
    assert [tile.lines[0][0] for tile in tiles[:4]] == ["as drawn", "closed", "half open", "open"]
    changed = [np.mean(np.any(a.picture != b.picture, axis=-1)) for a, b in pairwise(tiles)]
    assert min(changed[1:]) > 0.03, changed


def test_half_open_leaves_closed_what_waits():
    case = Case(0.6, 0.8, 0.5)
    asset = make_cabinet(Cabinet("cabinet", case, Stack((Door("left", behind=Drawer()), Drawer()), (2.0, 1.0))))
    made = grafu.functionalize(asset, motion="annotation").object
    waiting = {joint.id for joint in made.moving_joints if joint.after}
    assert waiting
    half, wide = pictures_sheets.half_open(made), pictures_sheets.wide_open(made)
    for joint in made.moving_joints:
        assert half[joint.id] == (0 if joint.id in waiting else pytest.approx(joint.limits.upper / 2))
        assert wide[joint.id] > half[joint.id]


def test_close_ups_that_one_sheet_does_not_hold_go_to_the_next(result, devices):
    config = replace(SMALL, close_ups=4)
    sheets = pictures_sheets.sheets_of(result, config)
    assert len(sheets) == -(-len(devices) // 4) == 2
    assert {sheet.shape[1] for sheet in sheets} == {4 * 96}
    row = 72 + config.rows_of_text * config.line
    assert sheets[0].shape[0] == 2 * (72 + config.line) + row
    assert sheets[1].shape[0] == 2 * config.line + row


def test_text_that_does_not_fit_is_cut_or_counted():
    font = pictures_sheets.ImageFont.load_default(size=10)
    cut = pictures_sheets._fitted("a long line of text " * 20, 100, font)
    assert cut.endswith(" ...")
    assert font.getlength(cut) <= 100
    assert pictures_sheets._fitted("short", 100, font) == "short"
    rows = pictures_sheets._wrapped("many words in rows " * 9, 100, font)
    assert len(rows) > 3
    assert " ".join(rows) == ("many words in rows " * 9).strip()
    assert max(map(font.getlength, rows)) <= 100
    tile = pictures_sheets.Tile(np.zeros((2, 2, 4), np.uint8), (("name", "red"), ("many words in rows " * 9, "blue")))
    below = pictures_sheets._text_below(tile, 100, 3, font)
    assert [colour for _, colour in below] == ["red", "blue", "blue"]
    assert below[-1][0].endswith(" ...")
    many = [("x", "#000000")] * 100
    assert pictures_sheets.panel(many, (200, 60), SMALL).shape == (60, 200, 4)


def test_the_script_writes_a_sheet_for_each_input_and_names_what_cannot_be_read(tmp_path, monkeypatch, capsys, result):
    monkeypatch.setattr(pictures_sheets.grafu, "functionalize", lambda path, motion: _given(path, result))
    tiny = replace(SMALL, tile=(48, 36))
    made = pictures_sheets.sheets_of(result, tiny)
    monkeypatch.setattr(pictures_sheets, "sheets_of", lambda _: [*made, *made])
    out = tmp_path / "out"
    monkeypatch.setattr(sys, "argv", ["pictures.py", "sheets", str(SAMPLE), "broken.glb", "--out", str(out)])
    assert pictures.main() == 1
    assert sorted(path.name for path in out.iterdir()) == ["kitchen_base.png", "kitchen_base_2.png"]
    with Image.open(out / "kitchen_base.png") as sheet:
        assert sheet.size == made[0].shape[1::-1]
    assert "broken.glb: it is broken" in capsys.readouterr().err


def _given(path, result):
    if path.name == "broken.glb":
        raise grafu.FunctionalizationError("it is broken")
    return result


def test_two_inputs_of_one_name_are_refused(tmp_path):
    with pytest.raises(SystemExit):
        pictures_sheets.main(["a/desk.glb", "b/desk.glb", "--out", str(tmp_path)])
